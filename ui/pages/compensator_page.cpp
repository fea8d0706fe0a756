#include "ui/pages/compensator_page.h"

#include <cmath>

#include "ui/widgets/card.h"
#include "ui/widgets/data_table.h"
#include "ui/widgets/figure_card.h"
#include "ui/widgets/legend_row.h"
#include "ui/widgets/progress_strip.h"
#include "ui/widgets/toggle_segment.h"
#include "ui/widgets/wrap_label.h"

namespace zerodrift::ui {
namespace {

const QString predicted = QStringLiteral("predicted");
const QString applied = QStringLiteral("applied");
const QString left = QStringLiteral("left");

QString um(double value) {
  if (std::isnan(value)) return QStringLiteral("–");
  const double rounded = std::round(10.0 * value) / 10.0;
  return QString::number(rounded == 0.0 ? 0.0 : rounded, 'f', 1) + QStringLiteral(" µm");
}

}  // namespace

CompensatorPage::CompensatorPage(QWidget* parent) : Page("compensator", parent) {
  m_plotCard = new Card(this);
  m_plotCard->setBodyMargins(6, 0, 4, 4);
  m_plotCard->body()->setSpacing(0);
  m_span = new ToggleSegment(m_plotCard);
  m_plotCard->tools()->addWidget(m_span);
  m_legend = new LegendRow(m_plotCard);
  m_plotCard->body()->addWidget(m_legend);
  for (LivePlot*& plot : m_plots) {
    plot = new LivePlot(m_plotCard);
    plot->setTimeAxis(true);
    plot->setSmallestSpan(4.0);
    plot->setIncludeZero(true);
    m_plotCard->body()->addWidget(plot, 1);
  }
  m_plots[0]->linkTime(m_plots[1]);
  m_plots[0]->linkTime(m_plots[2]);
  m_plots[1]->linkTime(m_plots[2]);
  connect(m_span, &ToggleSegment::currentChanged, this, [this](int index) {
    static constexpr double spans_s[] = {60.0, 600.0, 0.0};
    for (LivePlot* plot : m_plots) plot->setTimeWindow(spans_s[std::clamp(index, 0, 2)]);
  });
  m_tableCard = new Card(this);
  m_tableCard->setFixedWidth(360);
  m_tableCard->setBodyMargins(1, 0, 1, 12);
  m_table = new DataTable(m_tableCard);
  m_table->setFitted(true);
  m_words = new WrapLabel(m_tableCard);
  m_words->setContentsMargins(15, 8, 15, 0);
  m_tableCard->body()->addWidget(m_table);
  m_tableCard->body()->addWidget(m_words);
  m_tableCard->body()->addStretch(1);
  auto* row = new QHBoxLayout;
  row->setSpacing(16);
  row->addWidget(m_plotCard, 1);
  row->addWidget(m_tableCard);
  content()->addLayout(row, 1);
  setCurves();
  refresh();
  m_span->setCurrentIndex(2);
}

void CompensatorPage::setCurves() {
  for (int axis = 0; axis < 3; ++axis) {
    const QString letter(QLatin1Char("XYZ"[axis]));
    Curve model{predicted, tr("%1 predicted").arg(letter), "µm", axisColor(axis), 1};
    model.dashed = true;
    Curve now{applied, tr("%1 applied").arg(letter), "µm", mix(colors().panel, axisColor(axis), 0.45), 1};
    Curve rest{left, tr("%1 left").arg(letter), "µm", axisColor(axis), 1};
    rest.points = true;
    rest.width = 2.0;
    m_plots[static_cast<std::size_t>(axis)]->setCurves({model, now, rest});
  }
}

void CompensatorPage::setState(const CompensatorState& state) {
  m_state = state;
  refresh();
}

void CompensatorPage::clear() {
  for (LivePlot* plot : m_plots) plot->clearData();
}

void CompensatorPage::append(double time_s, const std::array<CompensatorAxis, 3>& axes, bool measured) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    m_plots[axis]->append(predicted, {time_s}, {axes[axis].predicted_um});
    m_plots[axis]->append(applied, {time_s}, {axes[axis].applied_um});
    if (measured && !std::isnan(axes[axis].left_um)) m_plots[axis]->append(left, {time_s}, {axes[axis].left_um});
  }
}

QString CompensatorPage::title() const {
  return tr("Host compensator");
}

QString CompensatorPage::sentence() const {
  if (!m_state.blocked.isEmpty()) return notYet();
  switch (m_state.phase) {
    case CompensatorPhase::ready:
      if (!m_state.notNow.isEmpty()) return m_state.notNow;
      return tr(
          "This computer compensates: for controllers without a table of their own, and for models that remember.");
    case CompensatorPhase::running:
      return tr(
          "Temperatures are read, the model predicts, the controller gets the offset. Keep this computer connected.");
    case CompensatorPhase::stopping:
      return tr("The offset runs to 0.");
  }
  return {};
}

PageAction CompensatorPage::primary() const {
  if (!m_state.blocked.isEmpty()) return {"primary", tr("Start compensating"), false, m_state.blocked};
  switch (m_state.phase) {
    case CompensatorPhase::ready:
      return {"primary", tr("Start compensating"), m_state.notNow.isEmpty(), m_state.notNow,
              tr("This computer sends the predicted error to the machine as an offset until it is stopped")};
    case CompensatorPhase::running:
      return {"primary", tr("Stop"), true, {}, tr("The offset runs to 0 at the machine's rate.")};
    case CompensatorPhase::stopping:
      return {"primary", tr("Stop"), false, tr("The offset runs to 0.")};
  }
  return {};
}

void CompensatorPage::changeEvent(QEvent* event) {
  if (event->type() == QEvent::LanguageChange || event->type() == QEvent::PaletteChange) setCurves();
  Page::changeEvent(event);
}

void CompensatorPage::render() {
  if (!m_state.blocked.isEmpty()) {
    showEmpty(Icon::plug, tr("Nothing to compensate with yet"), m_state.blocked);
    return;
  }
  showContent();
  const bool running = m_state.phase != CompensatorPhase::ready;
  Figure doing{tr("State"), running ? m_state.doing : tr("off"), {}, {}, Judgement::none, {}, {}};
  if (running) {
    doing.judgement = m_state.good ? Judgement::ok : Judgement::warn;
    doing.word = m_state.good ? tr("as it should") : tr("see at the right");
    doing.limit = tr("for %1").arg(durationText(m_state.running_s));
  }
  double left_um = std::nan("");
  double largest_um = 0.0;
  for (const CompensatorAxis& axis : m_state.axes) {
    left_um = std::fmax(left_um, std::abs(axis.left_um));
    largest_um = std::max(largest_um, axis.largestLeft_um);
  }
  Figure now =
      figureOf(tr("Left now"), left_um, 1, "µm", m_state.notMeasured.isEmpty() ? QString() : tr("not measured"));
  now.tip = m_state.notMeasured;
  const Figure most = figureOf(tr("Most left"), largest_um > 0.0 ? largest_um : std::nan(""), 1, "µm", tr("measured"));
  Figure lost = figureOf(tr("Turns"), m_state.turns > 0 ? static_cast<double>(m_state.turns) : std::nan(""), 0, {});
  if (m_state.turns > 0) {
    lost.judgement = m_state.lostTurns == 0 ? Judgement::ok : Judgement::warn;
    lost.word = m_state.lostTurns == 0 ? tr("none lost") : tr("%1 lost").arg(m_state.lostTurns);
  }
  setFigures({doing, now, most, lost, figureAtMost(tr("Latest turn"), m_state.latest_ms, 0, "ms", 100.0)});
  m_plotCard->setTitle(tr("Prediction, compensation and what is left"));
  m_plotCard->setSubtitle(QStringLiteral("µm"));
  m_span->setItems({tr("1 min"), tr("10 min"), tr("All")});
  m_legend->setItems({{tr("error predicted by the model"), colors().text, true},
                      {tr("compensation applied"), mix(colors().panel, colors().text, 0.45)},
                      {tr("left, measured"), colors().text, false, false, true}});
  for (std::size_t axis = 0; axis < m_plots.size(); ++axis) {
    m_plots[axis]->setAxisLabels({}, QString(QLatin1Char("XYZ"[axis])));
    m_plots[axis]->setPlaceholder(running ? tr("Waiting for the first turn")
                                          : tr("Drawn while this computer compensates"));
  }
  m_tableCard->setTitle(tr("Now"));
  m_table->setColumns({{tr("Axis"), 52, false, {}},
                       {tr("Predicted"), 0, true, tr("Error = actual − commanded, as the model says")},
                       {tr("Applied"), 92, true, tr("Compensation, as the controller tells")},
                       {tr("Left"), 92, true, tr("Error as measured, with the compensation")}});
  QVector<QVector<DataCell>> rows;
  for (int axis = 0; axis < 3; ++axis) {
    const CompensatorAxis& one = m_state.axes[static_cast<std::size_t>(axis)];
    DataCell name{QString(QLatin1Char("XYZ"[axis]))};
    name.swatch = axisColor(axis);
    rows.append({name, DataCell{um(one.predicted_um)}, DataCell{um(one.applied_um)}, DataCell{um(one.left_um)}});
  }
  m_table->setRows(rows);
  QStringList words = m_state.reasons;
  if (running && !m_state.notMeasured.isEmpty()) words << tr("Nothing is measured: %1.").arg(m_state.notMeasured);
  if (!running && !m_state.summary.isEmpty()) words << m_state.summary;
  words
      << tr("No offset is larger than %1 µm. If this computer or the cable fails, the controller takes the offset out "
            "by itself.")
             .arg(m_state.limit_um, 0, 'f', 0);
  m_words->setText(words.join(QStringLiteral("\n\n")));
}

}  // namespace zerodrift::ui
