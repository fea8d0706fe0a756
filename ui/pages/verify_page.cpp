#include "ui/pages/verify_page.h"

#include <cmath>

#include "ui/plots/xy_plot.h"
#include "ui/widgets/card.h"
#include "ui/widgets/data_table.h"
#include "ui/widgets/figure_card.h"
#include "ui/widgets/legend_row.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/progress_strip.h"
#include "ui/widgets/toggle_segment.h"
#include "ui/widgets/wrap_label.h"

namespace zerodrift::ui {

VerifyPage::VerifyPage(QWidget* parent) : Page("verify", parent) {
  m_view = new ToggleSegment(this);
  m_run = new RunView(this);
  m_views = new QStackedWidget(this);
  m_views->addWidget(m_run);
  m_result = new VerifyResult(this);
  m_views->addWidget(m_result);
  m_views->addWidget(makeCorrection());
  auto* column = new QVBoxLayout;
  column->setSpacing(8);
  column->addWidget(m_view, 0, Qt::AlignLeft);
  column->addWidget(m_views, 1);
  content()->addLayout(column, 1);
  connect(m_view, &ToggleSegment::currentChanged, this, [this](int index) {
    m_views->setCurrentIndex(index);
    refresh();
  });
  connect(m_run, &RunView::noteRequested, this, &VerifyPage::noteRequested);
  refresh();
}

QWidget* VerifyPage::makeCorrection() {
  auto* view = new QWidget(this);
  m_plotCard = new Card(view);
  m_plotCard->setBodyMargins(6, 0, 6, 6);
  m_plot = new XyPlot(m_plotCard);
  m_plot->setTimeAxis(true);
  m_plot->setIncludeZero(true);
  m_legend = new LegendRow(m_plotCard);
  m_plotCard->body()->addWidget(m_legend);
  m_plotCard->body()->addWidget(m_plot, 1);
  m_tableCard = new Card(view);
  m_tableCard->setFixedWidth(500);
  m_tableCard->setBodyMargins(1, 0, 1, 12);
  m_thresholdName = new QLabel(m_tableCard);
  m_thresholdName->setProperty("role", "caption");
  m_threshold = new QDoubleSpinBox(m_tableCard);
  m_threshold->setObjectName("threshold");
  m_threshold->setRange(0.1, 100.0);
  m_threshold->setDecimals(1);
  m_threshold->setSuffix(QStringLiteral(" µm"));
  m_thresholdName->setBuddy(m_threshold);
  m_tableCard->tools()->addWidget(m_thresholdName);
  m_tableCard->tools()->addWidget(m_threshold);
  m_table = new DataTable(m_tableCard);
  m_table->setRowHeight(30);
  m_table->setFitted(true);
  m_words = new WrapLabel(m_tableCard);
  m_words->setContentsMargins(15, 8, 15, 0);
  m_tableCard->body()->addWidget(m_table);
  m_tableCard->body()->addWidget(m_words);
  m_tableCard->body()->addStretch(1);
  auto* row = new QHBoxLayout(view);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(16);
  row->addWidget(m_plotCard, 1);
  row->addWidget(m_tableCard);
  connect(m_threshold, &QDoubleSpinBox::valueChanged, this, [this](double value) {
    if (!m_filling) Q_EMIT thresholdChanged(value);
  });
  connect(m_table, &DataTable::rowSelected, this, [this] { renderResiduals(); });
  return view;
}

void VerifyPage::setState(const VerifyState& state) {
  // A finished run shows its result by itself, once.
  if (state.phase == VerifyPhase::finished && m_state.phase != VerifyPhase::finished) m_view->setCurrentIndex(1);
  m_state = state;
  refresh();
}

void VerifyPage::showView(int index) {
  m_view->setCurrentIndex(index);
}

QString VerifyPage::title() const {
  return tr("Verify");
}

QString VerifyPage::sentence() const {
  if (!m_state.blocked.isEmpty()) return notYet();
  if (!m_state.silentSince.isEmpty()) return RunView::waitingSentence(m_state.silentSince);
  switch (m_state.phase) {
    case VerifyPhase::interrupted:
      return tr("The verification was interrupted. Everything stored is here; resume or finish with it.");
    case VerifyPhase::ready:
      if (!m_state.notHeld.isEmpty()) return m_state.notHeld;
      if (!m_state.switchedOff.isEmpty()) return m_state.switchedOff;
      return tr("Run the machine with the compensation on and measure what is left.");
    case VerifyPhase::running:
      return tr("The compensation works while the camera watches. The measured curve must stay near zero.");
    case VerifyPhase::paused:
      return tr("Paused. Resume when the machine may run again.");
    case VerifyPhase::finished:
      return finishedSentence();
  }
  return {};
}

QStringList VerifyPage::axesOverLimit() const {
  QStringList axes;
  for (const AxisResult& axis : m_state.results) {
    if (axis.after_um > m_state.peakLimit_um) axes.append(axis.axis);
  }
  if (axes.isEmpty() && m_state.peakAfter_um > m_state.peakLimit_um) axes.append(m_state.afterAxis);
  return axes;
}

/// What matters most comes first: an axis that got worse, then one over its limit, then a correction to look at.
QString VerifyPage::finishedSentence() const {
  if (!m_state.notHeld.isEmpty()) return sentencesText({m_state.notHeld, tr("The result below is of before.")});
  const QStringList over = axesOverLimit();
  if (m_state.runsDisagree) {
    return tr(
        "Which of the last two versions is better changes from run to run: record a further warm-up run and update "
        "the fit with it.");
  }
  if (!m_state.worseThanBefore.isEmpty()) {
    QStringList axes;
    for (const WorseThanBefore& axis : m_state.worseThanBefore) axes.append(axis.axis);
    return tr("Worse than with version %2: %1. Roll back, or correct it.")
        .arg(listText(axes))
        .arg(m_state.versionBefore);
  }
  if (!over.isEmpty() && !m_state.outsideRange.isEmpty()) {
    return tr("%1 is above the limit of %2 µm, but this run left the model's range: record a further warm-up run that "
              "goes there and update the fit with it.")
        .arg(listText(over))
        .arg(m_state.peakLimit_um);
  }
  if (!over.isEmpty()) {
    const QString what = m_state.correctionProposed ? tr("Look at the proposed correction.")
                         : m_state.leftAsItIs       ? tr("It is left as it is.")
                                                    : tr("Verify again, or leave it as it is.");
    return tr("%1 is still above the limit of %2 µm.").arg(listText(over)).arg(m_state.peakLimit_um) +
           QLatin1Char(' ') + what;
  }
  const Figure removed = removedFigure();
  if (removed.judgement == Judgement::bad || removed.judgement == Judgement::warn) {
    return tr("Every axis keeps its limit of %1 µm, but less than %2 % of the error is removed in one of them.")
        .arg(m_state.peakLimit_um)
        .arg(m_state.removedTarget_percent);
  }
  return m_state.correctionProposed
             ? tr("The proof is complete: every axis keeps its limit. A correction for what is left is proposed.")
             : tr("The proof is complete: every axis keeps its limit. Save the report next.");
}

/// Within the limits another table is the engineer's choice, not the next step; nor is one made where the model
/// guessed.
bool VerifyPage::correctionNeeded() const {
  return m_state.correctionProposed && m_state.worseThanBefore.isEmpty() && m_state.outsideRange.isEmpty() &&
         !axesOverLimit().isEmpty();
}

/// An axis over its limit is no result to go on with, unless the engineer has said so.
bool VerifyPage::fallenShort() const {
  return !m_state.leftAsItIs && (m_state.runsDisagree || !axesOverLimit().isEmpty());
}

bool VerifyPage::furtherRunNeeded() const {
  return fallenShort() && !rollbackNeeded() && (m_state.runsDisagree || !m_state.outsideRange.isEmpty());
}

bool VerifyPage::verifyAgainNeeded() const {
  return fallenShort() && !rollbackNeeded() && !correctionNeeded() && !furtherRunNeeded();
}

/// The version before was better, and no earlier run says otherwise.
bool VerifyPage::rollbackNeeded() const {
  return !m_state.worseThanBefore.isEmpty() && !m_state.runsDisagree;
}

PageAction VerifyPage::primary() const {
  if (!m_state.blocked.isEmpty()) return {"primary", tr("Start verification"), false, m_state.blocked};
  if (!m_state.silentSince.isEmpty()) {
    return {"primary", m_state.phase == VerifyPhase::paused ? tr("Resume") : tr("Pause"), false,
            RunView::silentReason()};
  }
  switch (m_state.phase) {
    case VerifyPhase::interrupted:
    case VerifyPhase::ready: {
      const QString reason = !m_state.offline.isEmpty()   ? m_state.offline
                             : !m_state.notHeld.isEmpty() ? m_state.notHeld
                                                          : m_state.switchedOff;
      return {"primary", m_state.phase == VerifyPhase::ready ? tr("Start verification") : tr("Resume"),
              reason.isEmpty(), reason, tr("The run of the warm-up once more, with the compensation on")};
    }
    case VerifyPhase::running:
      return {"primary", tr("Pause"), true, {}, tr("Stops the machine; the recording goes on")};
    case VerifyPhase::paused:
      return {"primary", tr("Resume"), true, {}, tr("Goes on with the plan where it was stopped")};
    case VerifyPhase::finished:
      if (!m_state.notHeld.isEmpty()) {
        return {"primary",
                tr("Bring the table back"),
                true,
                {},
                tr("Opens Upload, which compares the table with what the machine holds and asks before it writes.")};
      }
      if (rollbackNeeded()) {
        return {"primary",
                tr("Roll back to version %1").arg(m_state.versionBefore),
                true,
                {},
                tr("Opens the history in Upload with that version chosen; it asks before it writes.")};
      }
      if (correctionNeeded()) {
        return {"primary", tr("Apply correction"), true, {}, tr("Writes the corrected table. Asks first.")};
      }
      if (furtherRunNeeded()) {
        return {"primary",
                tr("Plan a further run"),
                true,
                {},
                tr("Opens Warm-up with a new run to plan; the model is fitted anew with what it shows.")};
      }
      if (verifyAgainNeeded()) {
        return {"primary", tr("Verify again"), true, {}, tr("A new run with what is written now")};
      }
      return {"primary", tr("Go on"), true, {}};
  }
  return {};
}

QVector<PageAction> VerifyPage::secondary() const {
  if (!m_state.blocked.isEmpty()) return {};
  switch (m_state.phase) {
    case VerifyPhase::ready:
      return {};
    case VerifyPhase::interrupted: {
      const PageAction resume = primary();  // finishing takes the run up once more
      return {m_state.keptBefore
                  ? PageAction{"drop", tr("Discard"), true, {}, tr("The verification before counts")}
                  : PageAction{"again", tr("New run"), true, {}, tr("The interrupted one stays in the job unused")},
              {"finish", tr("Finish"), resume.enabled, resume.reason,
               tr("Ends the run here and keeps what was measured. Asks first.")}};
    }
    case VerifyPhase::running:
    case VerifyPhase::paused:
      return {{"note", tr("Add note"), true, {}, tr("Writes a remark at this moment of the run")},
              {"abort", tr("Abort"), true, {}, tr("Stops the machine and drops this verification. Asks first.")},
              {"finish", tr("Finish"), true, {}, tr("Ends the run here and keeps what was measured. Asks first.")}};
    case VerifyPhase::finished:
      break;
  }
  QVector<PageAction> actions;
  if (!verifyAgainNeeded() || !m_state.notHeld.isEmpty())
    actions.append({"again", tr("Verify again"), true, {}, tr("A new run with what is written now")});
  if (fallenShort() && !correctionNeeded()) {
    actions.append({"goOn", tr("Leave as it is"), true, {}, tr("Goes on with what is left above the limit")});
  }
  if (correctionNeeded()) {
    actions.append({"skip", tr("Leave as it is"), true, {}, tr("Goes on without the correction")});
  } else if (m_state.correctionProposed) {
    actions.append({"correct", tr("Apply correction"), true, {}, tr("Writes the corrected table. Asks first.")});
  }
  if (!m_state.worseThanBefore.isEmpty() && !rollbackNeeded()) {
    actions.append({"rollback",
                    tr("Roll back to version %1").arg(m_state.versionBefore),
                    true,
                    {},
                    tr("Opens the history in Upload with that version chosen; it asks before it writes.")});
  }
  return actions;
}

QVector<Figure> VerifyPage::figures() const {
  const bool finished = m_state.phase == VerifyPhase::finished;
  // Before a verification has ended only the warm-up run tells, and it is another run: its figure says so.
  Figure before = figureOf(finished ? tr("Peak without") : tr("Peak of the warm-up"), m_state.peakBefore_um, 1, "µm");
  if (!m_state.beforeAxis.isEmpty()) before.limit = tr("in %1").arg(m_state.beforeAxis);
  before.tip = !finished ? tr("Largest error of the whole warm-up run.")
               : m_state.sameRun
                   ? tr("Largest error that this very run would have had without compensation: measured less applied.")
                   : tr("Largest error of the warm-up run, over the minutes that the verification lasted.");
  Figure after = figureAtMost(tr("Peak with"), m_state.peakAfter_um, 1, "µm", m_state.peakLimit_um);
  if (!m_state.afterAxis.isEmpty()) after.limit = tr("in %1, %2").arg(m_state.afterAxis, after.limit);
  Figure rms = figureOf(tr("rms with"), m_state.rmsAfter_um, 2, "µm");
  Figure removed = removedFigure();
  QStringList worse;
  for (const AxisResult& axis : m_state.results) {
    if (axis.worse() || axis.worseAtTheEnd()) worse.append(axis.axis);
  }
  if (!worse.isEmpty()) {
    removed.judgement = Judgement::bad;
    removed.limit.clear();  // the tip has it
    removed.word = tr("%1 worse").arg(listText(worse));
  }
  if (finished) {
    Figure promised = figureOf(tr("Fit promised"), m_state.promised_um, 1, "µm");
    promised.tip = tr("Largest error that the fit left on stretches of the warm-up run it had not seen.");
    if (m_state.promiseBroken()) {
      promised.judgement = Judgement::warn;
      promised.word = tr("not reached");
    } else if (!std::isnan(m_state.promised_um)) {
      promised.judgement = Judgement::ok;
      promised.word = tr("held");
    }
    return {before, after, rms, removed, promised};
  }
  Figure frame = figureAtMost(tr("Last good frame"), m_state.lastGoodFrame_s, 0, "s", m_state.frameLimit_s);
  if (frame.judgement == Judgement::ok) frame.word = tr("measuring");
  if (!m_state.silentSince.isEmpty()) RunView::markStopped(frame);
  frame.tip = tr("Machine time since the camera last measured the error. Up to %1 it is as planned.")
                  .arg(durationText(m_state.frameLimit_s));
  return {before, after, rms, removed, frame};
}

/// Direction by direction: a peak in one of them says nothing of another's. What was small before is not judged.
Figure VerifyPage::removedFigure() const {
  QStringList axes;
  QStringList values;
  double least_percent = std::numeric_limits<double>::quiet_NaN();
  double largest_um = 0.0;
  for (const AxisResult& axis : m_state.results) largest_um = std::fmax(largest_um, axis.before_um);
  for (const AxisResult& axis : m_state.results) {
    if (std::isnan(axis.removed_percent)) continue;
    axes << axis.axis;
    const double whole_percent = std::floor(axis.removed_percent);  // 84.7 is not the 85 that is asked
    values << fixedText(whole_percent, 0);
    const bool counts = axis.before_um > m_state.peakLimit_um || axis.before_um >= largest_um;
    if (counts) least_percent = std::fmin(least_percent, whole_percent);
  }
  Figure removed = figureAtLeast(tr("Removed"), least_percent, 0, "%", m_state.removedTarget_percent);
  removed.tip = tr("Share of the largest error that is gone, for each direction by itself; %1. Judged by the least of "
                   "those whose error was above %2 µm before.")
                    .arg(removed.limit)
                    .arg(m_state.peakLimit_um);
  if (values.isEmpty()) return removed;
  removed.label = tr("Removed in %1").arg(listText(axes));
  removed.value = values.join(QStringLiteral(" / "));
  return removed;
}

/// What the figures alone do not say.
QStringList VerifyPage::words() const {
  QStringList lines;
  for (const AxisResult& axis : m_state.results) {
    if (axis.worse()) {
      lines << tr("%1 became worse: up to %2 µm without, %3 µm with the compensation.")
                   .arg(axis.axis)
                   .arg(axis.before_um, 0, 'f', 1)
                   .arg(axis.after_um, 0, 'f', 1);
    } else if (axis.worseAtTheEnd()) {
      lines << tr("At the end %1 is worse than without: %2 µm instead of %3 µm.")
                   .arg(axis.axis)
                   .arg(fixedText(axis.endAfter_um, 1))
                   .arg(fixedText(axis.endBefore_um, 1));
    }
  }
  if (!m_state.outsideRange.isEmpty()) {
    lines << tr("Outside the model's range in this run, where it guesses: %1. A further warm-up run that goes there "
                "widens the range.")
                 .arg(listText(m_state.outsideRange));
  }
  for (const WorseThanBefore& axis : m_state.worseThanBefore) {
    lines << tr("%1 is worse than with version %2: %3 µm rms now; over this same run version %2 would have left %4 µm. "
                "Roll back to version %2?")
                 .arg(axis.axis)
                 .arg(m_state.versionBefore)
                 .arg(axis.now_um, 0, 'f', 2)
                 .arg(axis.before_um, 0, 'f', 2);
  }
  if (m_state.promiseBroken()) {
    lines << tr("The fit promised %1 µm, measured are %2 µm. The promise is of stretches of the warm-up run that were "
                "left out, as means of some minutes each; this run goes through other speeds in another order, and "
                "every single measurement counts with its noise.")
                 .arg(m_state.promised_um, 0, 'f', 1)
                 .arg(m_state.peakAfter_um, 0, 'f', 1);
  }
  lines << (m_state.sameRun
                ? tr("Without is this same run less what was applied: the same speeds and the same minutes.")
                : tr("Without is the warm-up run: other speeds, over the same minutes since the start of each run, as "
                     "far as the shorter one goes."));
  lines.last() = sentencesText({lines.last(), tr("At the end: mean of the last tenth.")});
  return lines;
}

void VerifyPage::render() {
  if (!m_state.blocked.isEmpty()) {
    showEmpty(Icon::tick, tr("Nothing to verify yet"), m_state.blocked);
    return;
  }
  showContent();
  setFigures(figures());
  m_view->setItems({m_state.phase == VerifyPhase::finished ? tr("Run") : tr("Live"), tr("Result"),
                    m_state.correctionProposed ? tr("Correction proposed") : tr("Correction")});
  m_run->retranslate();
  m_result->setResults(m_state.results, std::isnan(m_state.compared_s) ? 0.0 : m_state.compared_s, m_state.peakLimit_um,
                       m_state.sameRun, words());
  renderCorrection();
}

void VerifyPage::renderCorrection() {
  m_filling = true;
  m_plotCard->setTitle(tr("Residual"));
  m_plotCard->setSubtitle(QStringLiteral("µm"));
  m_tableCard->setTitle(tr("Correction of the model"));
  m_thresholdName->setText(tr("Threshold"));
  m_threshold->setValue(m_state.threshold_um);
  m_table->setColumns({{tr("Axis"), 52, false, {}},
                       {QStringLiteral("κ"), 130, true, tr("The temperatures' effect is multiplied by this")},
                       {tr("Offset"), 0, true, {}},
                       {tr("Peak now"), 100, true, {}},
                       {tr("Then"), 100, true, tr("Predicted with the correction")}});
  QVector<QVector<DataCell>> rows;
  QStringList reasons;
  for (const AxisCorrection& axis : m_state.corrections) {
    DataCell name{axis.axis};
    name.strong = axis.proposed;
    const auto um = [](double value) {
      return DataCell{std::isnan(value) ? QStringLiteral("–") : fixedText(value, 1) + QStringLiteral(" µm")};
    };
    DataCell kappa{QStringLiteral("–")};
    DataCell offset = kappa;
    DataCell then = kappa;
    if (axis.proposed) {
      kappa.text = fixedText(axis.kappa, 3);
      if (axis.kappaSigma > 0.0) kappa.text += QStringLiteral(" ± %1").arg(axis.kappaSigma, 0, 'f', 3);
      offset = um(axis.offset_um);
      then = um(axis.peakAfter_um);
    }
    reasons.append(QStringLiteral("%1: %2").arg(axis.axis, axis.evidence));
    rows.append({name, kappa, offset, um(axis.peakBefore_um), then});
  }
  m_table->setRows(rows);
  if (m_table->currentRow() < 0 && !rows.isEmpty()) {
    int first = 0;
    while (first < rows.size() - 1 && !m_state.corrections[first].proposed) ++first;
    m_table->selectRow(m_state.corrections[first].proposed ? first : 0);
  }
  const QString conclusion =
      !m_state.noCorrection.isEmpty() ? tr("No correction could be computed: %1").arg(m_state.noCorrection)
      : m_state.corrections.isEmpty() ? tr("The correction is computed from the verification run when it is finished.")
      : m_state.correctionProposed
          ? tr("With the correction the table is written anew, as a new version. The old one stays for rollback.")
      : std::any_of(m_state.corrections.begin(), m_state.corrections.end(),
                    [](const AxisCorrection& one) { return one.proposed; })
          ? tr("A correction was proposed and left aside: the table stays as it is.")
          : tr("All parts of the error are below the threshold. No correction is needed.");
  m_words->setText((QStringList{conclusion} + reasons).join(QStringLiteral("\n\n")));
  m_filling = false;
  renderResiduals();
}

void VerifyPage::renderResiduals() {
  m_plot->setPlaceholder(tr("Shown when the verification is finished"));
  const int row = m_table->currentRow();
  if (row < 0 || row >= m_state.corrections.size()) {
    m_legend->setItems({});
    return m_plot->clear();
  }
  const AxisCorrection& axis = m_state.corrections[row];
  m_plotCard->setSubtitle(QStringLiteral("%1, µm").arg(axis.axis));
  m_plot->setLimits(
      {{m_state.threshold_um, tr("threshold"), Judgement::warn}, {-m_state.threshold_um, {}, Judgement::warn}});
  PartStyle style;
  QVector<LegendItem> legend = {{tr("as measured"), colors().bad}};
  if (!axis.corrected_um.isEmpty()) legend.append({tr("with the correction"), colors().ok});
  m_legend->setItems(legend);
  style.unit = "µm";
  style.tag = tr("%1, measured").arg(axis.axis);
  style.color = colors().bad;
  m_plot->setPart("1now", axis.time_s, axis.residual_um, style);
  m_plot->removePart("2then");
  if (axis.corrected_um.isEmpty()) return;
  style.tag = tr("%1, with correction").arg(axis.axis);
  style.color = colors().ok;
  style.width = 2.0;
  m_plot->setPart("2then", axis.time_s, axis.corrected_um, style);
}

}  // namespace zerodrift::ui
