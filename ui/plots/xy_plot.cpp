#include "ui/plots/xy_plot.h"

#include <cmath>
#include <limits>

#include "ui/plots/custom_plot.h"
#include "ui/widgets/number_text.h"

namespace zerodrift::ui {

struct XyPlot::Part {
  QVector<double> x, y, high;  // high: upper edge of a band
  PartStyle style;
  QVector<QCPAbstractPlottable*> plottables;
  QVector<QCPItemText*> labels;
  bool visible = true;
};

XyPlot::XyPlot(QWidget* parent) : PlotWidget(parent) {
  plot()->addLayer("bands", plot()->layer("main"), QCustomPlot::limBelow);
  connect(plot(), &QCustomPlot::beforeReplot, this, &XyPlot::placeLabels);
  connect(this, &PlotWidget::clicked, this, [this](const QString&, double x, double y) {
    QString id;
    const int index = nearestPoint({xAxis()->coordToPixel(x), yAxis()->coordToPixel(y)}, &id);
    if (index >= 0) Q_EMIT pointClicked(id, index);
  });
}

XyPlot::~XyPlot() {
  qDeleteAll(m_parts);
}

void XyPlot::setPart(const QString& id, const QVector<double>& x, const QVector<double>& y, const PartStyle& style,
                     const QStringList& labels) {
  removePart(id);
  auto* part = new Part;
  part->x = x;
  part->y = y;
  part->style = style;
  auto* curve = new QCPCurve(xAxis(), yAxis());
  curve->setData(x, y);
  curve->setLineStyle(style.line ? QCPCurve::lsLine : QCPCurve::lsNone);
  curve->setPen(QPen(style.color, style.width, style.dashed ? Qt::DashLine : Qt::SolidLine));
  if (style.points) {
    const QPen edge(style.hollow ? style.color : mix(style.color, colors().panel, 0.2), style.hollow ? 1.6 : 0.8);
    curve->setScatterStyle(QCPScatterStyle(
        QCPScatterStyle::ssCircle, edge, style.hollow ? QBrush(colors().panel) : QBrush(style.color), style.pointSize));
  }
  part->plottables.append(curve);
  for (int i = 0; i < labels.size() && i < x.size(); ++i) {
    auto* text = new QCPItemText(plot());
    text->setText(labels[i]);
    text->position->setCoords(x[i], y[i]);
    text->setPositionAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    const int gap = static_cast<int>(style.pointSize) / 2 + 4;
    text->setPadding(QMargins(gap, gap - 2, gap, gap - 2));
    part->labels.append(text);
  }
  m_parts.insert(id, part);
  styleLabels();
  fit();
}

void XyPlot::setBand(const QString& id, const QVector<double>& x, const QVector<double>& low,
                     const QVector<double>& high, const QColor& color) {
  removePart(id);
  auto* part = new Part;
  part->x = x;
  part->y = low;
  part->high = high;
  part->style.color = color;
  part->style.line = false;
  QColor fill = color;
  fill.setAlphaF(0.16F);
  auto* lower = new QCPGraph(xAxis(), yAxis());
  auto* upper = new QCPGraph(xAxis(), yAxis());
  lower->setData(x, low);
  upper->setData(x, high);
  for (QCPGraph* graph : {lower, upper}) {
    graph->setLayer("bands");
    graph->setPen(Qt::NoPen);
    part->plottables.append(graph);
  }
  upper->setBrush(fill);
  upper->setChannelFillGraph(lower);
  m_parts.insert(id, part);
  fit();
}

void XyPlot::setBars(const QString& id, const QVector<double>& x, const QVector<double>& heights, double width,
                     const QColor& color) {
  removePart(id);
  auto* part = new Part;
  part->x = x;
  part->y = heights;
  part->style.color = color;
  part->style.line = false;
  auto* bars = new QCPBars(xAxis(), yAxis());
  bars->setData(x, heights);
  bars->setWidth(width);
  bars->setPen(Qt::NoPen);
  bars->setBrush(color);
  part->plottables.append(bars);
  m_parts.insert(id, part);
  fit();
}

void XyPlot::removePart(const QString& id) {
  Part* part = m_parts.take(id);
  if (part == nullptr) return;
  for (QCPItemText* label : part->labels) plot()->removeItem(label);
  // A fill refers to the graph made before it: remove the later one first.
  for (auto it = part->plottables.rbegin(); it != part->plottables.rend(); ++it) plot()->removePlottable(*it);
  delete part;
  replot();
}

void XyPlot::clear() {
  const QStringList ids = m_parts.keys();
  for (const QString& id : ids) removePart(id);
  // Words left beside an empty plot would be about what is gone, in the language it was drawn in.
  setLimits({});
  setMarks({});
  setAxisLabels({}, {});
  xAxis()->setRange(0.0, 5.0);  // as QCustomPlot begins: ranges too are of what is gone
  yAxis()->setRange(0.0, 5.0);
  showPlaceholder(true);
  replot();
}

void XyPlot::setPartVisible(const QString& id, bool visible) {
  Part* part = m_parts.value(id);
  if (part == nullptr) return;
  part->visible = visible;
  for (auto* plottable : part->plottables) plottable->setVisible(visible);
  for (auto* label : part->labels) label->setVisible(visible);
  replot();
}

void XyPlot::setTickWords(const QVector<double>& at, const QStringList& words) {
  QSharedPointer<QCPAxisTickerText> ticker(new QCPAxisTickerText);
  for (int i = 0; i < at.size() && i < words.size(); ++i) ticker->addTick(at[i], words[i]);
  xAxis()->setTicker(ticker);
  replot();
}

void XyPlot::setIntegerX(bool integer) {
  QSharedPointer<QCPAxisTickerFixed> ticker(new QCPAxisTickerFixed);
  ticker->setTickStep(1.0);
  ticker->setScaleStrategy(QCPAxisTickerFixed::ssMultiples);
  if (integer) xAxis()->setTicker(ticker);
}

void XyPlot::setEqualScale(bool equal) {
  m_equal = equal;
  setVerticalZoom(true);
  fit();
}

void XyPlot::setYRange(double low, double high) {
  m_fixedY = true;
  m_yLow = low;
  m_yHigh = high;
  fit();
}

void XyPlot::setXRange(double low, double high) {
  m_fixedX = true;
  m_xLow = low;
  m_xHigh = high;
  fit();
}

void XyPlot::fit() {
  double xLow = std::numeric_limits<double>::quiet_NaN();
  double xHigh = xLow, yLow = xLow, yHigh = xLow;
  for (const Part* part : std::as_const(m_parts)) {
    if (!part->visible) continue;
    for (const double v : part->x) xLow = std::fmin(xLow, v), xHigh = std::fmax(xHigh, v);
    for (const double v : part->y) yLow = std::fmin(yLow, v), yHigh = std::fmax(yHigh, v);
    for (const double v : part->high) yLow = std::fmin(yLow, v), yHigh = std::fmax(yHigh, v);
  }
  // A limit belongs into the picture unless it is so far away that it would press the curves flat.
  const double reach = 4.0 * std::max(std::abs(yLow), std::abs(yHigh));
  for (const Limit& limit : limits()) {
    if (std::abs(limit.value) > reach) continue;
    yLow = std::fmin(yLow, limit.value);
    yHigh = std::fmax(yHigh, limit.value);
  }
  bool labelled = false;
  for (const Part* part : std::as_const(m_parts)) labelled = labelled || (part->visible && !part->labels.isEmpty());
  showPlaceholder(m_parts.isEmpty());
  if (std::isnan(xLow) || std::isnan(yLow)) return replot();
  if (m_includeZero) {
    yLow = std::min(yLow, 0.0);
    yHigh = std::max(yHigh, 0.0);
  }
  const auto widen = [](double* low, double* high, double share) {
    const double span = std::max(*high - *low, 1e-9 + 1e-6 * std::abs(*high));
    *low -= share * span;
    *high += share * span;
  };
  widen(&xLow, &xHigh, m_equal ? 0.08 : 0.03);
  widen(&yLow, &yHigh, 0.08);
  if (labelled) {
    xLow -= 0.05 * (xHigh - xLow);
    xHigh += 0.12 * (xHigh - xLow);
  }
  if (hasSpanLabels()) yHigh += 20.0 * (yHigh - yLow) / std::max(60, height() - 60);
  xAxis()->setRange(m_fixedX ? m_xLow : xLow, m_fixedX ? m_xHigh : xHigh);
  yAxis()->setRange(m_fixedY ? m_yLow : yLow, m_fixedY ? m_yHigh : yHigh);
  if (m_equal) {
    // The axis that has room to spare is widened.
    const QRect box = plot()->axisRect()->rect();
    const double perX = xAxis()->range().size() / std::max(1, box.width());
    const double perY = yAxis()->range().size() / std::max(1, box.height());
    if (perX > perY) {
      yAxis()->setScaleRatio(xAxis(), 1.0);
    } else {
      xAxis()->setScaleRatio(yAxis(), 1.0);
    }
  }
  replot();
}

void XyPlot::flush() {
  fit();
  plot()->replot(QCustomPlot::rpImmediateRefresh);
}

void XyPlot::styleLabels() {
  for (const Part* part : std::as_const(m_parts)) {
    for (QCPItemText* label : part->labels) {
      label->setFont(uiFont(11));
      label->setColor(colors().text);
    }
  }
}

void XyPlot::placeLabels() {
  // Right of the point, else left, below, above: the first place inside the axes that covers no point and no earlier
  // label; where none is free, the one that covers least.
  static constexpr int sides[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  const QFontMetrics metrics(uiFont(11));
  const QRectF axes = plot()->axisRect()->rect();
  const auto pixel = [&](const Part& part, qsizetype i) {
    return QPointF(xAxis()->coordToPixel(part.x[i]), yAxis()->coordToPixel(part.y[i]));
  };
  const auto area = [](const QRectF& box) { return box.isValid() ? box.width() * box.height() : 0.0; };
  QVector<QRectF> taken;
  for (const Part* part : std::as_const(m_parts)) {
    if (!part->visible) continue;
    for (int i = 0; i < part->labels.size(); ++i) {
      QRectF dot(0.0, 0.0, part->style.pointSize, part->style.pointSize);
      dot.moveCenter(pixel(*part, i));
      taken.append(dot);
    }
  }
  for (const Part* part : std::as_const(m_parts)) {
    if (!part->visible) continue;
    const double gap = part->style.pointSize / 2.0 + 4.0;
    for (int i = 0; i < part->labels.size(); ++i) {
      const QPointF at = pixel(*part, i);
      const QSizeF size(metrics.horizontalAdvance(part->labels[i]->text()), metrics.height() - 4);
      int chosen = 0;
      QRectF best;
      double least = std::numeric_limits<double>::infinity();
      for (int k = 0; k < 4 && least > 0.0; ++k) {
        QRectF box(QPointF(), size);
        box.moveCenter(at +
                       QPointF(sides[k][0] * (gap + size.width() / 2.0), sides[k][1] * (gap + size.height() / 2.0)));
        double covered = area(box) - area(box.intersected(axes));
        for (const QRectF& other : taken) covered += area(box.intersected(other));
        if (covered >= least) continue;
        least = covered;
        chosen = k;
        best = box;
      }
      static const Qt::Alignment anchors[4] = {Qt::AlignLeft | Qt::AlignVCenter, Qt::AlignRight | Qt::AlignVCenter,
                                               Qt::AlignTop | Qt::AlignHCenter, Qt::AlignBottom | Qt::AlignHCenter};
      part->labels[i]->setPositionAlignment(anchors[chosen]);
      taken.append(best);
    }
  }
}

void XyPlot::restyle() {
  styleLabels();
}

int XyPlot::nearestPoint(const QPointF& pixel, QString* id) const {
  double best = 14.0;
  int index = -1;
  for (auto it = m_parts.cbegin(); it != m_parts.cend(); ++it) {
    if (!it.value()->visible || !it.value()->style.points) continue;
    for (int i = 0; i < it.value()->x.size() && i < it.value()->y.size(); ++i) {
      const double distance = std::hypot(xAxis()->coordToPixel(it.value()->x[i]) - pixel.x(),
                                         yAxis()->coordToPixel(it.value()->y[i]) - pixel.y());
      if (distance >= best) continue;
      best = distance;
      index = i;
      *id = it.key();
    }
  }
  return index;
}

PlotWidget::Near XyPlot::nearest(const QPointF& pixel) const {
  Near best;
  for (auto it = m_parts.cbegin(); it != m_parts.cend(); ++it) {
    const Part& part = *it.value();
    if (!part.visible || !part.high.isEmpty()) continue;
    for (int i = 0; i < part.x.size() && i < part.y.size(); ++i) {
      if (std::isnan(part.y[i])) continue;
      const double distance =
          std::hypot(xAxis()->coordToPixel(part.x[i]) - pixel.x(), yAxis()->coordToPixel(part.y[i]) - pixel.y());
      if (distance >= best.distance_px) continue;
      const QString name = i < part.labels.size() ? part.labels[i]->text() : part.style.tag;
      best = {it.key(),
              QStringLiteral("%1   %2 %3   %4")
                  .arg(name, fixedText(part.y[i], part.style.decimals), part.style.unit, xText(part.x[i])),
              part.x[i],
              part.y[i],
              distance,
              part.style.color};
    }
  }
  return best;
}

QString XyPlot::csv() const {
  QString text = "part,x,y,y_high\n";
  for (auto it = m_parts.cbegin(); it != m_parts.cend(); ++it) {
    const Part& part = *it.value();
    for (int i = 0; part.visible && i < part.x.size() && i < part.y.size(); ++i) {
      text += QStringLiteral("%1,%2,%3,%4\n")
                  .arg(it.key(), QString::number(part.x[i], 'g', 9), QString::number(part.y[i], 'g', 9),
                       i < part.high.size() ? QString::number(part.high[i], 'g', 9) : QString());
    }
  }
  return text;
}

void XyPlot::resizeEvent(QResizeEvent* event) {
  PlotWidget::resizeEvent(event);
  if (m_equal) fit();
}

}  // namespace zerodrift::ui
