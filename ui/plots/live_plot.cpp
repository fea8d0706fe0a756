#include "ui/plots/live_plot.h"

#include <cmath>

#include "ui/plots/custom_plot.h"
#include "ui/plots/dense_graph.h"
#include "ui/plots/series.h"
#include "ui/widgets/number_text.h"

namespace zerodrift::ui {

struct LivePlot::Entry {
  Curve curve;
  int index = 0;  // place in the list, for the colour
  Series series;
  DenseGraph* graph = nullptr;
  QCPGraph* bandLow = nullptr;
  QCPGraph* bandHigh = nullptr;
  bool visible = true;
  bool strong = false;

  QColor color() const { return curve.color.isValid() ? curve.color : curveColor(index); }
};

LivePlot::LivePlot(QWidget* parent) : PlotWidget(parent) {
  setTimeAxis(true);
  setVerticalZoom(false);
  plot()->addLayer("bands", plot()->layer("main"), QCustomPlot::limBelow);
  plot()->addLayer("strong", plot()->layer("main"), QCustomPlot::limAbove);
  xAxis()->setRange(0, 60);
  connect(this, &PlotWidget::viewChanged, this, [this](double from, double to) {
    m_following = false;
    showStretch(from, to);
  });
}

LivePlot::~LivePlot() {
  qDeleteAll(m_entries);
}

void LivePlot::setCurves(const QVector<Curve>& curves) {
  QHash<QString, Entry*> kept;
  QVector<Entry*> entries;
  for (int i = 0; i < curves.size(); ++i) {
    Entry* entry = m_byId.take(curves[i].id);
    if (entry == nullptr) {
      entry = new Entry;
      entry->graph = new DenseGraph(plot()->xAxis, plot()->yAxis);
      entry->graph->setAdaptiveSampling(true);
    }
    entry->curve = curves[i];
    entry->index = i;
    entries.append(entry);
    kept.insert(curves[i].id, entry);
  }
  for (Entry* gone : std::as_const(m_byId)) {
    for (QCPGraph* graph : {static_cast<QCPGraph*>(gone->graph), gone->bandHigh, gone->bandLow}) {
      if (graph != nullptr) plot()->removeGraph(graph);
    }
    delete gone;
  }
  m_entries = entries;
  m_byId = kept;
  restyle();
  schedule();
}

void LivePlot::setData(const QString& id, const QVector<double>& time_s, const QVector<double>& values) {
  Entry* entry = m_byId.value(id);
  if (entry == nullptr) return;
  entry->series.clear();
  append(id, time_s, values);
}

void LivePlot::append(const QString& id, const QVector<double>& time_s, const QVector<double>& values) {
  Entry* entry = m_byId.value(id);
  if (entry == nullptr) return;
  entry->series.append(time_s.constData(), values.constData(), std::min(time_s.size(), values.size()));
  schedule();
}

void LivePlot::clearData() {
  for (Entry* entry : m_entries) {
    entry->series.clear();
    for (QCPGraph* graph : {entry->bandHigh, entry->bandLow}) {
      if (graph != nullptr) graph->data()->clear();
    }
  }
  m_following = true;
  setMarks({});
  schedule();
}

void LivePlot::setBand(const QString& id, const QVector<double>& time_s, const QVector<double>& low,
                       const QVector<double>& high) {
  Entry* entry = m_byId.value(id);
  if (entry == nullptr) return;
  if (entry->bandLow == nullptr) {
    entry->bandLow = plot()->addGraph();
    entry->bandHigh = plot()->addGraph();
    for (QCPGraph* graph : {entry->bandLow, entry->bandHigh}) {
      graph->setLayer("bands");
      graph->setPen(Qt::NoPen);
    }
    entry->bandHigh->setChannelFillGraph(entry->bandLow);
  }
  entry->bandLow->setData(time_s, low, true);
  entry->bandHigh->setData(time_s, high, true);
  restyle();
  schedule();
}

void LivePlot::setRegimes(const QVector<Regime>& regimes, double fastest_rpm, bool labels) {
  m_regimeLabels = labels;
  m_regimes = regimes;
  m_fastest_rpm = std::max(1.0, fastest_rpm);
  QVector<Span> spans;
  for (const Regime& regime : regimes) {
    const double share = std::clamp(std::abs(regime.speed_rpm) / m_fastest_rpm, 0.0, 1.0);
    QColor color = mix(colors().panel, colors().muted, 0.03 + 0.17 * share);
    if (regime.coolant) color = mix(color, colors().accent, 0.10);
    if (regime.speed_rpm == 0.0 && !regime.coolant) color.setAlpha(0);
    QString label;
    if (regime.speed_rpm != 0.0) label = tr("%1 rpm").arg(regime.speed_rpm, 0, 'f', 0);
    if (regime.coolant) label += label.isEmpty() ? tr("coolant") : tr(" · coolant");
    spans.append({regime.from_s, regime.to_s, color, labels ? label : QString()});
  }
  setSpans(spans);
}

void LivePlot::setCurveVisible(const QString& id, bool visible) {
  Entry* entry = m_byId.value(id);
  if (entry == nullptr || entry->visible == visible) return;
  entry->visible = visible;
  restyle();
  schedule();
}

void LivePlot::highlight(const QString& id) {
  if (id == m_highlighted) return;
  m_highlighted = id;
  restyle();
  replot();
}

void LivePlot::setEmphasis(const QString& id, bool strong) {
  Entry* entry = m_byId.value(id);
  if (entry == nullptr || entry->strong == strong) return;
  entry->strong = strong;
  restyle();
  replot();
}

void LivePlot::restyle() {
  const bool some = m_byId.contains(m_highlighted);
  for (Entry* entry : m_entries) {
    const bool chosen = entry->curve.id == m_highlighted;
    QColor color = entry->color();
    if (some && !chosen) color.setAlphaF(0.25F);
    const double width = chosen || entry->strong ? 2.2 : entry->curve.width;
    entry->graph->setPen(QPen(color, width, entry->curve.dashed ? Qt::DashLine : Qt::SolidLine));
    entry->graph->setLayer(chosen || entry->strong ? "strong" : "main");
    entry->graph->setLineStyle(entry->curve.steps ? QCPGraph::lsStepLeft : QCPGraph::lsLine);
    entry->graph->setScatterStyle(entry->curve.points
                                      ? QCPScatterStyle(QCPScatterStyle::ssDisc, QPen(color), QBrush(color), 4)
                                      : QCPScatterStyle::ssNone);
    entry->graph->setVisible(entry->visible);
    if (entry->bandHigh == nullptr) continue;
    QColor fill = entry->color();
    fill.setAlphaF(0.16F);
    entry->bandHigh->setBrush(fill);
    entry->bandHigh->setVisible(entry->visible);
  }
  if (!m_regimes.isEmpty()) setRegimes(QVector<Regime>(m_regimes), m_fastest_rpm, m_regimeLabels);
}

void LivePlot::setTimeWindow(double seconds) {
  m_window_s = seconds;
  m_following = true;
  schedule();
}

void LivePlot::linkTime(LivePlot* other) {
  if (other == nullptr || other == this || m_linked.contains(other)) return;
  m_linked.append(other);
  other->m_linked.append(this);
}

double LivePlot::newest() const {
  double last = 0.0;
  for (const Entry* entry : m_entries) {
    if (entry->series.size() > 0) last = std::max(last, entry->series.time(entry->series.size() - 1));
  }
  return last;
}

void LivePlot::showStretch(double from, double to) {
  xAxis()->setRange(from, to);
  schedule();
  for (const auto& other : m_linked) {
    if (other == nullptr || (other->xAxis()->range().lower == from && other->xAxis()->range().upper == to)) continue;
    other->m_following = false;
    other->showStretch(from, to);
  }
}

void LivePlot::fit() {
  m_following = true;
  schedule();
  for (const auto& other : m_linked) {
    if (other == nullptr || other->m_following) continue;
    other->m_following = true;
    other->schedule();
  }
}

void LivePlot::schedule() {
  if (m_scheduled) return;
  m_scheduled = true;
  QTimer::singleShot(33, this, [this] {
    if (m_scheduled) updateView();
  });
}

void LivePlot::flush() {
  updateView();
  plot()->replot(QCustomPlot::rpImmediateRefresh);
}

void LivePlot::updateView() {
  m_scheduled = false;
  if (m_following) {
    double last = newest();
    for (const auto& other : m_linked) {
      if (other != nullptr) last = std::max(last, other->newest());
    }
    last = std::max(last, 60.0);
    xAxis()->setRange(m_window_s > 0.0 ? std::max(0.0, last - m_window_s) : 0.0, last);
  }
  const QCPRange range = xAxis()->range();
  const int columns = std::max(100, plot()->axisRect()->width());
  QVector<double> times;
  QVector<double> values;
  bool any = false;
  for (Entry* entry : m_entries) {
    any = any || entry->series.size() > 0;
    if (!entry->visible) continue;
    entry->graph->setDense(entry->series.view(range.lower, range.upper, columns, &times, &values));
    entry->graph->setData(times, values, true);
  }
  showPlaceholder(!any);
  scaleOrdinate();
  replot();
}

void LivePlot::scaleOrdinate() {
  double low = std::numeric_limits<double>::quiet_NaN();
  double high = low;
  for (const Entry* entry : m_entries) {
    if (!entry->visible) continue;
    const auto first = std::max<qsizetype>(0, entry->series.indexAt(xAxis()->range().lower) - 1);
    const auto [a, b] = entry->series.extremes(first, entry->series.indexAt(xAxis()->range().upper) + 1);
    low = std::fmin(low, a);
    high = std::fmax(high, b);
  }
  if (std::isnan(low)) {
    low = 0.0;
    high = std::max(1.0, m_smallestSpan);
  }
  if (m_includeZero) {
    low = std::min(low, 0.0);
    high = std::max(high, 0.0);
  }
  const double lack = std::max(m_smallestSpan, 1e-6) - (high - low);
  if (lack > 0.0) {
    low -= lack / 2.0;
    high += lack / 2.0;
  }
  const double margin = 0.06 * (high - low);
  // The names of the regimes and notes stand at the top: the curves keep below them.
  const double words_px = (hasSpanLabels() ? 20.0 : 0.0) + (hasMarkTexts() ? 30.0 : 0.0);
  const double words = words_px * (high - low) / std::max(60, height() - 60);
  yAxis()->setRange(low - margin, high + margin + words);
}

qsizetype LivePlot::sampleCount(const QString& id) const {
  const Entry* entry = m_byId.value(id);
  return entry == nullptr ? 0 : entry->series.size();
}

PlotWidget::Near LivePlot::nearest(const QPointF& pixel) const {
  Near best;
  const double x = xAxis()->pixelToCoord(pixel.x());
  for (const Entry* entry : m_entries) {
    if (!entry->visible || entry->series.size() == 0) continue;
    const qsizetype after = std::min(entry->series.indexAt(x), entry->series.size() - 1);
    for (qsizetype i = std::max<qsizetype>(0, after - 1); i <= after; ++i) {
      const double value = entry->series.value(i);
      if (std::isnan(value)) continue;
      const QPointF at(xAxis()->coordToPixel(entry->series.time(i)), yAxis()->coordToPixel(value));
      const double distance = std::hypot(at.x() - pixel.x(), at.y() - pixel.y());
      if (distance >= best.distance_px) continue;
      best = {entry->curve.id,
              QStringLiteral("%1   %2 %3   %4")
                  .arg(entry->curve.tag, fixedText(value, entry->curve.decimals), entry->curve.unit,
                       xText(entry->series.time(i))),
              entry->series.time(i),
              value,
              distance,
              entry->color()};
    }
  }
  return best;
}

QString LivePlot::csv() const {
  // All visible samples; curves recorded at other times keep their own rows, the rest of the row stays empty.
  std::map<double, QVector<QString>> rows;
  const auto count = m_entries.size();
  QString text = "time_s";
  for (int k = 0; k < count; ++k) {
    const Entry* entry = m_entries[k];
    text += ',' + entry->curve.id;
    const qsizetype last = entry->series.indexAt(xAxis()->range().upper);
    for (qsizetype i = entry->series.indexAt(xAxis()->range().lower); i < last; ++i) {
      auto& row = rows[entry->series.time(i)];
      row.resize(count);
      if (!std::isnan(entry->series.value(i))) row[k] = QString::number(entry->series.value(i), 'g', 9);
    }
  }
  text += '\n';
  for (const auto& [time, row] : rows) {
    text += QString::number(time, 'f', 3) + ',' + QStringList(row).join(',') + '\n';
  }
  return text;
}

void LivePlot::resizeEvent(QResizeEvent* event) {
  PlotWidget::resizeEvent(event);
  schedule();
}

}  // namespace zerodrift::ui
