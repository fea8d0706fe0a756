#include "ui/plots/heat_map.h"

#include <cmath>

#include "ui/plots/custom_plot.h"
#include "ui/widgets/number_text.h"

namespace zerodrift::ui {

HeatMap::HeatMap(QWidget* parent) : PlotWidget(parent) {
  setTimeAxis(true);
  setVerticalZoom(false);
  m_map = new QCPColorMap(xAxis(), yAxis());
  m_map->setInterpolate(true);
  m_map->setTightBoundary(true);
  m_scale = new QCPColorScale(plot());
  m_scale->setType(QCPAxis::atRight);
  m_scale->setBarWidth(10);
  m_scale->setRangeDrag(false);
  m_scale->setRangeZoom(false);
  plot()->plotLayout()->addElement(0, 1, m_scale);
  auto* group = new QCPMarginGroup(plot());
  plot()->axisRect()->setMarginGroup(QCP::msBottom | QCP::msTop, group);
  m_scale->setMarginGroup(QCP::msBottom | QCP::msTop, group);
  m_map->setColorScale(m_scale);
  m_region = new QCPItemRect(plot());
  m_region->setVisible(false);
  m_region->setLayer("overlay");
  HeatMap::restyle();
  connect(plot(), &QCustomPlot::afterReplot, this, &HeatMap::layoutChanged);
}

QCPAxis* HeatMap::positionAxis() const {
  return m_across ? xAxis() : yAxis();
}

QCPAxis* HeatMap::timeAxis() const {
  return m_across ? yAxis() : xAxis();
}

void HeatMap::setPositionAcross(bool across) {
  m_across = across;
  setTimeAxis(!across);
  if (across) yAxis()->setTicker(QSharedPointer<QCPAxisTicker>(elapsedTicker()));
  setVerticalZoom(across);
}

void HeatMap::setPositionRange(double from_mm, double to_mm) {
  positionAxis()->setRange(from_mm, to_mm);
  replot();
}

double HeatMap::positionToPixel(double position_mm) const {
  return xAxis()->coordToPixel(position_mm);
}

void HeatMap::setData(const HeatMapData& map) {
  m_data = map;
  auto* cells = m_map->data();
  const bool some = map.columns > 0 && map.rows > 0 && map.values.size() >= qsizetype{map.columns} * map.rows;
  showPlaceholder(!some);
  m_map->setVisible(some);
  m_scale->setVisible(some);
  timeAxis()->setTickLabels(some);
  if (!some) return replot();
  const QCPRange times(map.from_s, map.to_s);
  const QCPRange positions(map.from_mm, map.to_mm);
  cells->setSize(m_across ? map.rows : map.columns, m_across ? map.columns : map.rows);
  cells->setRange(m_across ? positions : times, m_across ? times : positions);
  double largest = 0.0;
  for (int row = 0; row < map.rows; ++row) {
    for (int column = 0; column < map.columns; ++column) {
      const double value = map.values[qsizetype{row} * map.columns + column];
      cells->setCell(m_across ? row : column, m_across ? column : row, value);
      if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
    }
  }
  // Zero must stay in the middle of the colours, whatever the data does.
  m_scale->setDataRange(QCPRange(-std::max(largest, 1e-9), std::max(largest, 1e-9)));
  fit();
}

void HeatMap::setSensors(const QVector<SensorTick>& sensors) {
  m_sensors = sensors;
  QSharedPointer<QCPAxisTickerText> ticker(new QCPAxisTickerText);
  for (const SensorTick& sensor : sensors) {
    ticker->addTick(
        sensor.position_mm,
        m_across ? sensor.tag : QStringLiteral("%1  %2").arg(sensor.tag).arg(sensor.position_mm, 0, 'f', 0));
  }
  if (!sensors.isEmpty()) positionAxis()->setTicker(ticker);
  replot();
}

void HeatMap::setRegion(double from_s, double to_s, double from_mm, double to_mm) {
  m_region->topLeft->setCoords(m_across ? QPointF(from_mm, to_s) : QPointF(from_s, to_mm));
  m_region->bottomRight->setCoords(m_across ? QPointF(to_mm, from_s) : QPointF(to_s, from_mm));
  m_region->setVisible(to_s > from_s);
  replot();
}

void HeatMap::fit() {
  timeAxis()->setRange(m_data.from_s, m_data.to_s);
  positionAxis()->setRange(m_data.from_mm, m_data.to_mm);
  replot();
}

void HeatMap::flush() {
  plot()->replot(QCustomPlot::rpImmediateRefresh);
}

void HeatMap::restyle() {
  QCPColorGradient gradient;
  gradient.clearColorStops();
  for (int i = 0; i <= 20; ++i) gradient.setColorStopAt(i / 20.0, divergingColor(i / 10.0 - 1.0));
  // What was not measured has no colour: the end of the scale would be the strongest cold.
  gradient.setNanHandling(QCPColorGradient::nhTransparent);
  m_map->setGradient(gradient);
  m_scale->setGradient(gradient);
  const Colors& c = colors();
  m_scale->axis()->setTickLabelColor(c.muted);
  m_scale->axis()->setTickLabelFont(uiFont(11));
  m_scale->axis()->setLabelColor(c.muted);
  m_scale->axis()->setLabelFont(uiFont(11));
  m_scale->axis()->setBasePen(Qt::NoPen);
  m_scale->axis()->setTickPen(Qt::NoPen);
  m_scale->axis()->setSubTickPen(Qt::NoPen);
  for (auto* axis : m_scale->axis()->axisRect()->axes()) axis->setBasePen(QPen(c.line));
  m_region->setPen(QPen(c.text, 1.5, Qt::DashLine));
  m_region->setBrush(Qt::NoBrush);
}

PlotWidget::Near HeatMap::nearest(const QPointF& pixel) const {
  if (m_data.values.isEmpty()) return {};
  const double x = xAxis()->pixelToCoord(pixel.x());
  const double y = yAxis()->pixelToCoord(pixel.y());
  if (!m_map->data()->keyRange().contains(x) || !m_map->data()->valueRange().contains(y)) return {};
  const double value = m_map->data()->data(x, y);
  if (std::isnan(value)) return {};
  const double position_mm = m_across ? x : y;
  const double time_s = m_across ? y : x;
  Near near;
  near.id = "map";
  near.text = QStringLiteral("%1 %2   %3 mm   %4")
                  .arg(fixedText(value, 1), m_data.unit)
                  .arg(position_mm, 0, 'f', 0)
                  .arg(elapsedText(time_s));
  near.x = x;
  near.y = y;
  near.distance_px = 0.0;
  near.color = divergingColor(value / std::max(1e-9, m_scale->dataRange().upper));
  return near;
}

QString HeatMap::csv() const {
  QString text = "time_s,position_mm,value\n";
  for (int row = 0; row < m_data.rows; ++row) {
    for (int column = 0; column < m_data.columns; ++column) {
      double x = 0.0;
      double y = 0.0;
      m_map->data()->cellToCoord(m_across ? row : column, m_across ? column : row, &x, &y);
      text += QStringLiteral("%1,%2,%3\n")
                  .arg(m_across ? y : x)
                  .arg(m_across ? x : y)
                  .arg(m_data.values[row * m_data.columns + column]);
    }
  }
  return text;
}

}  // namespace zerodrift::ui
