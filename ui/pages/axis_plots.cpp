// The two pictures of the axis page: the measurement as ISO 230-2 draws it, and the segments over the means.

#include <cmath>

#include "ui/pages/axis_page.h"
#include "ui/plots/xy_plot.h"
#include "ui/widgets/legend_row.h"

namespace zerodrift::ui {

void AxisPage::renderLegend() {
  const bool cut = m_views->currentIndex() == 1;
  if (cut) {
    m_legend->setItems({{tr("mean of both"), colors().muted, false, false, true},
                        {tr("segments used"), colors().accent},
                        {tr("the other rule"), mix(colors().panel, colors().warn, 0.7), true}});
  } else {
    m_legend->setItems({{tr("mean up"), axisColor(2)},
                        {tr("mean down"), axisColor(0)},
                        {tr("± 2 s"), colors().muted, true, true},
                        {tr("reversal B"), mix(colors().panel, colors().text, 0.5)},
                        {tr("runs"), colors().muted, false, false, true}});
  }
}

void AxisPage::renderMeasurement() {
  const Colors& c = colors();
  m_measurement->clear();
  m_measurement->setAxisLabels(tr("position / mm"), tr("error / µm"));
  const auto band = [&](const QString& id, const QVector<double>& mean, const QVector<double>& sigma,
                        const QColor& color) {
    QVector<double> low;
    QVector<double> high;
    for (int i = 0; i < mean.size() && i < sigma.size(); ++i) {
      low.append(mean[i] - 2.0 * sigma[i]);
      high.append(mean[i] + 2.0 * sigma[i]);
    }
    if (low.isEmpty()) return;
    m_measurement->setBand(id, m_state.position_mm, low, high, color);
    PartStyle edge;
    edge.unit = "µm";
    edge.tag = tr("Mean ± 2 s");
    edge.color = color;
    edge.width = 1.0;
    edge.dashed = true;
    m_measurement->setPart(id + "low", m_state.position_mm, low, edge);
    m_measurement->setPart(id + "high", m_state.position_mm, high, edge);
  };
  const QColor up = axisColor(2);
  const QColor down = axisColor(0);
  band("0up", m_state.meanUp_um, m_state.sigmaUp_um, up);
  band("0down", m_state.meanDown_um, m_state.sigmaDown_um, down);
  PartStyle style;
  style.unit = "µm";
  style.points = true;
  style.line = false;
  style.pointSize = 3.5;
  int number = 0;
  for (const LaserRun& run : m_state.runs) {
    style.tag = run.upwards ? tr("Run %1 upwards").arg(number + 1) : tr("Run %1 downwards").arg(number + 1);
    style.color = mix(c.panel, run.upwards ? up : down, 0.6);
    m_measurement->setPart(QStringLiteral("1run%1").arg(number++, 3, 10, QChar('0')), run.position_mm, run.error_um,
                           style);
  }
  style.line = true;
  style.width = 2.0;
  style.pointSize = 5;
  style.tag = tr("Mean upwards");
  style.color = up;
  m_measurement->setPart("2up", m_state.position_mm, m_state.meanUp_um, style);
  style.tag = tr("Mean downwards");
  style.color = down;
  if (!m_state.meanDown_um.isEmpty()) m_measurement->setPart("2down", m_state.position_mm, m_state.meanDown_um, style);
  renderLimits();
}

/// The reversal at each target as a bar between the means, and what A spans.
void AxisPage::renderLimits() {
  QVector<double> x;
  QVector<double> y;
  double low = INFINITY;
  double high = -INFINITY;
  const auto reach = [&](const QVector<double>& mean, const QVector<double>& sigma, qsizetype i) {
    low = std::min(low, mean[i] - 2.0 * sigma.value(i));
    high = std::max(high, mean[i] + 2.0 * sigma.value(i));
  };
  const bool both = m_state.meanDown_um.size() == m_state.position_mm.size();
  for (qsizetype i = 0; i < std::min(m_state.position_mm.size(), m_state.meanUp_um.size()); ++i) {
    reach(m_state.meanUp_um, m_state.sigmaUp_um, i);
    if (!both) continue;
    reach(m_state.meanDown_um, m_state.sigmaDown_um, i);
    x.append({m_state.position_mm[i], m_state.position_mm[i], std::nan("")});
    y.append({m_state.meanUp_um[i], m_state.meanDown_um[i], std::nan("")});
  }
  PartStyle style;
  style.unit = "µm";
  style.tag = tr("Reversal");
  style.color = mix(colors().panel, colors().text, 0.5);
  style.width = 1.0;
  if (!x.isEmpty()) m_measurement->setPart("1reversal", x, y, style);
  if (low > high || m_state.position_mm.size() > 200) return m_measurement->setLimits({});
  const QString a = tr("A = %1 µm").arg(high - low, 0, 'f', 1);
  m_measurement->setLimits({{high, a, Judgement::none}, {low, {}, Judgement::none}});
}

void AxisPage::renderSegments() {
  const Colors& c = colors();
  m_segmentPlot->clear();
  m_segmentPlot->setAxisLabels(tr("position / mm"), tr("error / µm"));
  PartStyle style;
  style.unit = "µm";
  style.tag = tr("Mean of both directions");
  style.color = c.muted;
  style.line = false;
  style.points = true;
  style.pointSize = 5;
  m_segmentPlot->setPart("0points", m_state.position_mm, m_state.mean_um, style);
  const auto draw = [&](const QString& id, const QVector<AxisSegment>& list, const QColor& color, double width,
                        bool dashed) {
    PartStyle line;
    line.unit = "µm";
    line.tag = tr("Segments");
    line.color = color;
    line.width = width;
    line.dashed = dashed;
    QVector<double> x;
    QVector<double> y;
    for (const AxisSegment& one : list) {
      // The error along a segment: measured - commanded.
      for (const double at : {one.from_mm, one.to_mm}) {
        x.append(at);
        y.append(((one.a - 1.0) * at + one.b_mm) * 1000.0);
      }
    }
    m_segmentPlot->setPart(id, x, y, line);
  };
  draw("1other", m_state.useOptimal ? m_state.published : m_state.optimal, mix(c.panel, c.warn, 0.7), 1.2, true);
  draw("2chosen", segments(), c.accent, 2.2, false);
}

}  // namespace zerodrift::ui
