#include "ui/plots/report_plot.h"

#include <QBuffer>
#include <QCoreApplication>
#include <QSvgGenerator>
#include <algorithm>
#include <cmath>

#include "ui/plots/custom_plot.h"
#include "ui/widgets/colors.h"
#include "ui/widgets/paper_colors.h"

namespace zerodrift::ui {
namespace {

constexpr int legendColumn = 90;  // px that a legend's entry takes
constexpr int fewCurves = 8;      // up to here neighbours may differ most; above, one hue serves four curves

QFont paperFont(int pixels) {
  QFont font(QStringLiteral("Inter"));
  font.setFamilies({QStringLiteral("Inter"), QStringLiteral("Noto Sans CJK SC"), QStringLiteral("DejaVu Sans")});
  font.setPixelSize(pixels);
  font.setStyleStrategy(QFont::PreferNoShaping);  // so that numbers keep their signs when they are copied
  return font;
}

void styleAxis(QCPAxis* axis, const QString& label) {
  axis->setLabel(label);
  axis->setLabelFont(paperFont(11));
  axis->setTickLabelFont(paperFont(10));
  axis->setBasePen(QPen(QColor(0x5F6E7C), 1));
  axis->setTickPen(QPen(QColor(0x5F6E7C), 1));
  axis->setSubTicks(false);
  axis->grid()->setPen(QPen(QColor(0xE2E7EC), 0.7));
  axis->grid()->setZeroLinePen(QPen(QColor(0x9AA7B3), 0.7));
}

void addCurve(QCustomPlot& plot, const ReportCurve& curve, int index, bool many) {
  QCPGraph* graph = plot.addGraph();
  const QColor own = many ? paperCurveColor(index) : paperGroupColor(index);
  const QColor color = curve.color.isValid() ? curve.color : own;
  graph->setPen(QPen(color, curve.width, curve.style));
  graph->setName(curve.name);
  graph->setData(curve.x, curve.y);
  if (curve.name.isEmpty()) graph->removeFromLegend();
  if (curve.points) {
    graph->setLineStyle(QCPGraph::lsNone);
    graph->setScatterStyle(QCPScatterStyle(QCPScatterStyle::ssDisc, 3.5));
  }
}

/// A rectangle behind grid and curves, over the whole height when no ordinates are given.
void addBack(QCustomPlot& plot, double left, double right, double low, double high, const QColor& color,
             bool wholeHeight) {
  auto* back = new QCPItemRect(&plot);
  back->setLayer(QStringLiteral("background"));
  back->setPen(Qt::NoPen);
  back->setBrush(color);
  const auto vertical = wholeHeight ? QCPItemPosition::ptAxisRectRatio : QCPItemPosition::ptPlotCoords;
  back->topLeft->setTypeX(QCPItemPosition::ptPlotCoords);
  back->bottomRight->setTypeX(QCPItemPosition::ptPlotCoords);
  back->topLeft->setTypeY(vertical);
  back->bottomRight->setTypeY(vertical);
  back->topLeft->setCoords(left, wholeHeight ? 0.0 : high);
  back->bottomRight->setCoords(right, wholeHeight ? 1.0 : low);
}

/// Text at the top of the axis rectangle.
void addTopText(QCustomPlot& plot, double x, const QString& text, double ratio, const QColor& color) {
  auto* item = new QCPItemText(&plot);
  item->position->setTypeX(QCPItemPosition::ptPlotCoords);
  item->position->setTypeY(QCPItemPosition::ptAxisRectRatio);
  item->position->setCoords(x, ratio);
  item->setPositionAlignment(Qt::AlignHCenter | Qt::AlignTop);
  item->setFont(paperFont(9));
  item->setColor(color);
  item->setText(text);
}

void addStretches(QCustomPlot& plot, const ReportPlotData& data, double width_px) {
  const QCPRange range = plot.xAxis->range();
  const QFontMetricsF metrics(paperFont(9));
  for (const auto& stretch : data.stretches) {
    const double from = std::max(stretch.from, range.lower);
    const double to = std::min(stretch.to, range.upper);
    if (to <= from) continue;
    addBack(plot, from, to, 0.0, 0.0, mix(QColor(Qt::white), QColor(0x0F6CBD), 0.02 + 0.08 * stretch.strength), true);
    const double room_px = width_px * (to - from) / range.size();
    if (metrics.horizontalAdvance(stretch.text) + 6.0 > room_px) continue;
    addTopText(plot, 0.5 * (from + to), stretch.text, 0.01, QColor(0x5F6E7C));
  }
  for (const auto& mark : data.marks) {
    if (!range.contains(mark.x)) continue;
    auto* line = new QCPItemStraightLine(&plot);
    line->setPen(QPen(QColor(0x5F6E7C), 0.8, Qt::DotLine));
    line->point1->setCoords(mark.x, 0.0);
    line->point2->setCoords(mark.x, 1.0);
    addTopText(plot, mark.x, mark.text, 0.09, QColor(0x1C2530));
  }
}

void addLegend(QCustomPlot& plot, double width_px) {
  auto* below = new QCPLayoutGrid;
  plot.plotLayout()->addElement(1, 0, below);
  below->addElement(0, 0, plot.legend);
  plot.plotLayout()->setRowStretchFactor(1, 0.001);
  plot.legend->setVisible(true);
  plot.legend->setWrap(std::max(2, static_cast<int>(width_px) / legendColumn));
  plot.legend->setFillOrder(QCPLegend::foColumnsFirst, true);
  plot.legend->setBorderPen(Qt::NoPen);
  plot.legend->setBrush(Qt::NoBrush);
  plot.legend->setFont(paperFont(10));
  plot.legend->setIconSize(16, 8);
  plot.legend->setRowSpacing(0);
}

void fill(QCustomPlot& plot, const ReportPlotData& data, double width_px) {
  plot.setAntialiasedElements(QCP::aeAll);
  styleAxis(plot.xAxis, data.xLabel);
  styleAxis(plot.yAxis, data.yLabel);
  const bool many = data.curves.size() > fewCurves;
  for (int i = 0; i < data.curves.size(); ++i) addCurve(plot, data.curves[i], i, many);
  plot.rescaleAxes();
  // A limit near the curves belongs into the picture; one far away would flatten them.
  const QCPRange shown = plot.yAxis->range();
  if (data.limit > 0.0 && data.limit < 2.0 * std::max(std::abs(shown.lower), std::abs(shown.upper))) {
    plot.yAxis->setRange(std::min(shown.lower, -data.limit), std::max(shown.upper, data.limit));
  }
  plot.yAxis->scaleRange(data.stretches.isEmpty() ? 1.1 : 1.2);
  if (plot.yAxis->range().size() <= 0) plot.yAxis->setRange(plot.yAxis->range().center(), 2, Qt::AlignCenter);
  addStretches(plot, data, width_px - 60.0);
  if (data.limit > 0.0) {
    const QCPRange x = plot.xAxis->range();
    addBack(plot, x.lower, x.upper, -data.limit, data.limit, QColor(0xE3F1E9), false);
  }
  const auto named =
      std::count_if(data.curves.begin(), data.curves.end(), [](const auto& c) { return !c.name.isEmpty(); });
  if (named >= 2) addLegend(plot, width_px);
}

double largestOf(const QVector<QVector<double>>& rows) {
  double largest = 0.0;
  for (const auto& row : rows) {
    for (const double value : row) {
      if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
    }
  }
  return largest;
}

void fillMap(QCustomPlot& plot, const ReportMapData& data, double largest) {
  styleAxis(plot.xAxis, data.xLabel);
  styleAxis(plot.yAxis, data.yLabel);
  plot.xAxis->setRange(data.xFrom, data.xTo);
  plot.yAxis->setRange(data.yFrom, data.yTo);
  const auto height = (data.yTo - data.yFrom) / static_cast<double>(data.rows.size());
  for (int r = 0; r < data.rows.size(); ++r) {
    const auto width = (data.xTo - data.xFrom) / static_cast<double>(std::max<qsizetype>(1, data.rows[r].size()));
    for (int c = 0; c < data.rows[r].size(); ++c) {
      const double value = data.rows[r][c];
      if (!std::isfinite(value)) continue;
      const QColor color = paperDivergingColor(largest > 0.0 ? value / largest : 0.0);
      addBack(plot, data.xFrom + c * width, data.xFrom + (c + 1) * width, data.yFrom + r * height,
              data.yFrom + (r + 1) * height, color, false);
    }
  }
  for (const auto& [at, name] : data.ticks) {
    auto* text = new QCPItemText(&plot);
    text->position->setTypeX(QCPItemPosition::ptAxisRectRatio);
    text->position->setTypeY(QCPItemPosition::ptPlotCoords);
    text->position->setCoords(0.998, at);
    text->setPositionAlignment(Qt::AlignRight | Qt::AlignVCenter);
    text->setFont(paperFont(9));
    text->setText(name + QStringLiteral(" –"));
  }
}

/// What the colours mean: a strip with its ends in figures.
void drawScale(QPainter& painter, const QRectF& place, double largest, const QString& unit) {
  constexpr int steps = 41;
  const double width = place.width() / steps;
  for (int i = 0; i < steps; ++i) {
    const double value = 2.0 * i / (steps - 1) - 1.0;
    painter.fillRect(QRectF(place.left() + i * width, place.top(), width + 0.2, place.height()),
                     paperDivergingColor(value));
  }
  painter.setPen(QColor(0x5F6E7C));
  painter.setFont(paperFont(10));
  const int digits = largest < 10.0 ? 2 : 0;
  const QString end = QString::number(largest, 'f', digits) + QLatin1Char(' ') + unit;
  painter.drawText(QRectF(place.left() - 84.0, place.top() - 3.0, 80.0, 16.0), Qt::AlignRight | Qt::AlignVCenter,
                   QStringLiteral("−") + end);
  painter.drawText(QRectF(place.right() + 4.0, place.top() - 3.0, 80.0, 16.0), Qt::AlignLeft | Qt::AlignVCenter,
                   QStringLiteral("+") + end);
}

void onto(QPainter& painter, const QRectF& place, QCustomPlot& plot) {
  painter.save();
  painter.translate(place.topLeft());
  plot.toPainter(static_cast<QCPPainter*>(&painter), int(std::lround(place.width())), int(std::lround(place.height())));
  painter.restore();
}

template <class Draw>
QByteArray svgOf(const QSize& size, const Draw& draw) {
  QByteArray bytes;
  QBuffer buffer(&bytes);
  QSvgGenerator generator;
  generator.setOutputDevice(&buffer);
  generator.setSize(size);
  generator.setResolution(96);
  generator.setViewBox(QRect(QPoint(0, 0), size));
  {
    const auto painter = makeVectorPainter(&generator);
    draw(*painter, QRectF(QPointF(0, 0), size));
  }
  return bytes.mid(bytes.indexOf("<svg"));
}

}  // namespace

void EndVectorPainter::operator()(QPainter* painter) const {
  delete static_cast<QCPPainter*>(painter);
}

VectorPainter makeVectorPainter(QPaintDevice* device) {
  auto painter = std::make_unique<QCPPainter>(device);
  painter->setMode(QCPPainter::pmVectorized);
  painter->setMode(QCPPainter::pmNoCaching);
  return VectorPainter(painter.release());
}

void drawReportPlot(QPainter& painter, const QRectF& place, const ReportPlotData& data) {
  QCustomPlot plot;
  fill(plot, data, place.width());
  onto(painter, place, plot);
}

ReportPlotDrawing::ReportPlotDrawing(const QRectF& place, const ReportPlotData& data)
    : m_place(place), m_plot(std::make_unique<QCustomPlot>()) {
  fill(*m_plot, data, place.width());
  // A new plot asks to be painted in its own window, which this one has not.
  QCoreApplication::removePostedEvents(m_plot.get(), QEvent::MetaCall);
}

ReportPlotDrawing::~ReportPlotDrawing() = default;

bool ReportPlotDrawing::step(QPainter& painter) {
  constexpr int strips = 5;
  auto* page = painter.device()->devType() == QInternal::Image ? static_cast<QImage*>(painter.device()) : nullptr;
  if (page == nullptr) {  // lines are written down there and not filled
    onto(painter, m_place, *m_plot);
    return false;
  }
  // The whole is drawn onto each strip, which keeps what falls on it: the same pixels as at once.
  const QTransform scale = painter.deviceTransform();
  const QRect all = scale.mapRect(m_place).toAlignedRect().adjusted(-2, -2, 2, 2) & page->rect();
  const int left = all.left() + all.width() * m_next / strips;
  const int right = all.left() + all.width() * (m_next + 1) / strips;
  const QRect strip(left, all.top(), right - left, all.height());
  QImage part = page->copy(strip);
  const auto on = makeVectorPainter(&part);
  on->setRenderHints(painter.renderHints());
  on->setTransform(scale * QTransform::fromTranslate(-strip.left(), -strip.top()));
  onto(*on, m_place, *m_plot);
  on->end();
  painter.save();
  painter.resetTransform();
  painter.drawImage(strip.topLeft(), part);
  painter.restore();
  return ++m_next < strips;
}

void drawReportMap(QPainter& painter, const QRectF& place, const ReportMapData& data) {
  constexpr double scaleHeight = 22.0;
  const double largest = largestOf(data.rows);
  QCustomPlot plot;
  fillMap(plot, data, largest);
  onto(painter, place.adjusted(0, 0, 0, -scaleHeight), plot);
  drawScale(painter, QRectF(place.center().x() - 90.0, place.bottom() - 14.0, 180.0, 10.0), largest, data.unit);
}

QByteArray reportPlotSvg(const ReportPlotData& data, const QSize& size) {
  return svgOf(size, [&](QPainter& painter, const QRectF& place) { drawReportPlot(painter, place, data); });
}

QByteArray reportMapSvg(const ReportMapData& data, const QSize& size) {
  return svgOf(size, [&](QPainter& painter, const QRectF& place) { drawReportMap(painter, place, data); });
}

}  // namespace zerodrift::ui
