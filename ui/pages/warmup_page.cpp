#include "ui/pages/warmup_page.h"

#include <cmath>

#include "ui/plots/xy_plot.h"
#include "ui/widgets/card.h"
#include "ui/widgets/figure_card.h"
#include "ui/widgets/progress_strip.h"
#include "ui/widgets/wrap_label.h"

namespace zerodrift::ui {

WarmupPage::WarmupPage(QWidget* parent) : Page("warmup", parent) {
  m_plan = makePlan();
  m_run = new RunView(this);
  content()->addWidget(m_plan, 1);
  content()->addWidget(m_run, 1);
  connect(m_run, &RunView::noteRequested, this, &WarmupPage::noteRequested);
  m_recordings = new RecordingList(m_run);
  m_run->setSide(m_recordings);
  connect(m_recordings, &RecordingList::shown, this, &WarmupPage::recordingShown);
  connect(m_recordings, &RecordingList::renamed, this, &WarmupPage::recordingRenamed);
  connect(m_recordings, &RecordingList::roleChosen, this, &WarmupPage::recordingRoleChosen);
  connect(m_recordings, &RecordingList::removeRequested, this, &WarmupPage::recordingRemoved);
  refresh();
}

QWidget* WarmupPage::makePlan() {
  auto* view = new QWidget(this);
  m_timelineCard = new Card(view);
  m_timelineCard->setBodyMargins(8, 0, 8, 8);
  m_presets = new QComboBox(m_timelineCard);
  m_presets->setObjectName("presets");
  m_presets->setMinimumWidth(220);
  m_add = new QPushButton(lineIcon(Icon::plus), {}, m_timelineCard);
  m_add->setObjectName("addStep");
  m_remove = new QPushButton(lineIcon(Icon::trash), {}, m_timelineCard);
  m_remove->setObjectName("removeStep");
  for (QWidget* tool :
       {static_cast<QWidget*>(m_presets), static_cast<QWidget*>(m_add), static_cast<QWidget*>(m_remove)}) {
    m_timelineCard->tools()->addWidget(tool);
  }
  m_timeline = new PlanTimeline(m_timelineCard);
  m_timeline->setObjectName("timeline");
  m_timelineCard->body()->addWidget(m_timeline);

  m_stepCard = new Card(view);
  m_stepCard->setFixedWidth(304);
  makeStepEditor(m_stepCard->body());
  m_expectedCard = new Card(view);
  m_expectedCard->setBodyMargins(6, 0, 4, 4);
  m_expected = new XyPlot(m_expectedCard);
  m_expected->setTimeAxis(true);
  m_expected->setIncludeZero(true);
  m_expectedCard->body()->addWidget(m_expected);

  auto* left = new QVBoxLayout;
  left->setSpacing(16);
  left->addWidget(m_timelineCard, 1);
  left->addWidget(m_expectedCard, 1);
  auto* all = new QHBoxLayout(view);
  all->setContentsMargins(0, 0, 0, 0);
  all->setSpacing(16);
  all->addLayout(left, 1);
  all->addWidget(m_stepCard);

  connect(m_presets, &QComboBox::activated, this, &WarmupPage::presetChosen);
  connect(m_timeline, &PlanTimeline::selectionChanged, this, &WarmupPage::showStep);
  connect(m_timeline, &PlanTimeline::edited, this, &WarmupPage::planTouched);
  connect(m_add, &QPushButton::clicked, this, [this] {
    auto steps = m_timeline->steps();
    const int after = std::min(m_timeline->selectedStep() + 1, static_cast<int>(steps.size()));
    steps.insert(after, steps.isEmpty() ? PlanStepRow{} : steps[after - 1]);
    m_timeline->setSteps(steps);
    m_timeline->selectStep(after);
    planTouched();
  });
  connect(m_remove, &QPushButton::clicked, this, [this] {
    auto steps = m_timeline->steps();
    if (steps.size() < 2) return;
    steps.removeAt(m_timeline->selectedStep());
    m_timeline->setSteps(steps);
    planTouched();
  });
  return view;
}

void WarmupPage::makeStepEditor(QVBoxLayout* into) {
  m_minutes = new QSpinBox(m_stepCard);
  m_minutes->setObjectName("stepMinutes");
  m_minutes->setRange(1, 48 * 60);
  m_speed = new QSpinBox(m_stepCard);
  m_speed->setObjectName("stepSpeed");
  m_speed->setSingleStep(100);
  m_motion = new QComboBox(m_stepCard);
  m_coolant = new QCheckBox(m_stepCard);
  m_coolant->setObjectName("stepCoolant");
  m_sample = new QDoubleSpinBox(m_stepCard);
  m_sample->setRange(0.1, 600.0);
  m_sample->setDecimals(1);
  m_measure = new QDoubleSpinBox(m_stepCard);
  m_measure->setRange(1.0, 7200.0);
  m_measure->setDecimals(0);
  auto* grid = new QGridLayout;
  grid->setVerticalSpacing(6);
  grid->setHorizontalSpacing(12);
  const QVector<QWidget*> fields = {m_minutes, m_speed, m_motion, m_coolant, m_sample, m_measure};
  for (int i = 0; i < fields.size(); ++i) {
    auto* name = new QLabel(m_stepCard);
    name->setProperty("role", "muted");
    name->setBuddy(fields[i]);
    m_fieldNames.append(name);
    grid->addWidget(name, i, 0);
    grid->addWidget(fields[i], i, 1);
  }
  grid->setColumnStretch(1, 1);
  into->addLayout(grid);
  m_hint = new WrapLabel(m_stepCard);
  m_hint->setProperty("role", "caption");
  into->addWidget(m_hint);
  into->addStretch();
  connect(m_minutes, &QSpinBox::valueChanged, this, &WarmupPage::stepEdited);
  connect(m_speed, &QSpinBox::valueChanged, this, &WarmupPage::stepEdited);
  connect(m_motion, &QComboBox::activated, this, &WarmupPage::stepEdited);
  connect(m_coolant, &QCheckBox::toggled, this, &WarmupPage::stepEdited);
  const auto periods = [this] {
    if (!m_filling) Q_EMIT periodsEdited(m_sample->value(), m_measure->value());
  };
  connect(m_sample, &QDoubleSpinBox::editingFinished, this, periods);
  connect(m_measure, &QDoubleSpinBox::editingFinished, this, periods);
}

void WarmupPage::setState(const WarmupState& state) {
  m_state = state;
  refresh();
}

double WarmupPage::planLength_s() const {
  double sum = 0.0;
  for (const PlanStepRow& step : m_state.plan) sum += step.duration_s;
  return sum;
}

QString WarmupPage::title() const {
  return tr("Warm-up");
}

QString WarmupPage::sentence() const {
  if (!m_state.blocked.isEmpty()) return notYet();
  if (!m_state.silentSince.isEmpty()) return RunView::waitingSentence(m_state.silentSince);
  switch (m_state.phase) {
    case RunPhase::planning:
      if (m_state.filesOnly)
        return tr("Import the recording of your logger: its columns are shown before it is taken.");
      return tr("Choose a plan, change it by dragging, then start. The machine must be cold and at rest.");
    case RunPhase::running:
      return m_state.steady
                 ? tr("Steady: %1. More time adds little; finish when you like.").arg(m_state.steadyCriterion)
                 : tr("The machine warms up. Watch that the errors move and no sensor drops out.");
    case RunPhase::paused:
      return tr("Paused. The machine stands; the gap stays visible in the recording.");
    case RunPhase::interrupted:
      return tr("The run was interrupted. Everything stored is here; resume or finish with it.");
    case RunPhase::finished:
      if (m_state.imported) {
        return m_state.errors > 0 || m_state.shownRecording > 0
                   ? tr("Imported. Look it over, then go on to the sensors.")
                   : tr("Imported, without errors: the heat can be explained, in Physics.");
      }
      return tr("The run is complete. Look it over, then go on to the sensors.");
  }
  return {};
}

PageAction WarmupPage::primary() const {
  if (m_state.filesOnly && m_state.phase == RunPhase::planning)
    return {"primary", tr("Import a recording"), true, {}, tr("A file of any logger: text or Excel")};
  if (!m_state.blocked.isEmpty()) return {"primary", tr("Start"), false, m_state.blocked};
  const QString locked = tr("The compensation is ON. Measuring for the model is locked until it is switched off.");
  const bool starts = m_state.phase == RunPhase::planning || m_state.phase == RunPhase::interrupted;
  if (starts && !m_state.offline.isEmpty()) {
    return {"primary", m_state.phase == RunPhase::planning ? tr("Start") : tr("Resume"), false, m_state.offline};
  }
  if (!m_state.silentSince.isEmpty()) {
    return {"primary", m_state.phase == RunPhase::paused ? tr("Resume") : tr("Pause"), false, RunView::silentReason()};
  }
  switch (m_state.phase) {
    case RunPhase::planning:
      if (m_state.plan.isEmpty()) return {"primary", tr("Start"), false, tr("The plan has no steps yet.")};
      return {"primary", tr("Start"), !m_state.compensationOn, locked,
              tr("The machine runs by the plan; temperatures and errors are recorded")};
    case RunPhase::running:
      return {"primary", tr("Pause"), true, {}, tr("Stops the machine; the recording goes on")};
    case RunPhase::paused:
    case RunPhase::interrupted:
      return {"primary", tr("Resume"), !m_state.compensationOn, locked,
              tr("Goes on with the plan where it was stopped")};
    case RunPhase::finished:
      return {"primary", tr("Use this run"), true, {}, tr("Goes on: the sensors are chosen from it")};
  }
  return {};
}

QVector<PageAction> WarmupPage::secondary() const {
  const PageAction import = {
      "import", tr("Import"), true, {}, tr("A recording of another logger takes the place of the run")};
  if (!m_state.blocked.isEmpty()) return {import};
  const PageAction abort = {"abort", tr("Abort"), true, {}, tr("Stops the machine and drops this run. Asks first.")};
  const PageAction finish = {
      "finish", tr("Finish"), true, {}, tr("Ends the run here and goes on with what was recorded. Asks first.")};
  switch (m_state.phase) {
    case RunPhase::planning:
      if (m_state.filesOnly) return {};
      return {import,
              {"load", tr("Load plan"), true, {}, tr("A plan that was saved before")},
              {"save", tr("Save plan"), true, {}, tr("As a file, for other machines and the command line")}};
    case RunPhase::running:
    case RunPhase::paused:
      return {{"note", tr("Add note"), true, {}, tr("Writes a remark at this moment of the run")}, abort, finish};
    case RunPhase::interrupted:
      if (m_state.keptBefore) {
        return {{"drop", tr("Discard"), true, {}, tr("The run before counts; the interrupted one stays unused")},
                finish};
      }
      return {{"again", tr("New run"), true, {}, tr("Plans a new run; the interrupted one stays in the job unused")},
              finish};
    case RunPhase::finished:
      if (m_state.filesOnly)
        return {
            {"import", tr("Import another"), true, {}, tr("A further run of this machine, or one in place of this")},
            {"export", tr("Save as CSV"), true, {}, tr("The recording shown, for a spreadsheet")}};
      return {import,
              {"again", tr("New run"), true, {}, tr("Plans a new run; this one stays in the job")},
              {"export", tr("Save as CSV"), true, {}, tr("The recording shown, for a spreadsheet")}};
  }
  return {};
}

QVector<Figure> WarmupPage::planFigures() const {
  const double length = planLength_s();
  double expected = std::numeric_limits<double>::quiet_NaN();
  for (const double drift : m_state.expectedDrift_um) expected = std::fmax(expected, std::abs(drift));
  Figure largest = figureOf(tr("Expected drift"), expected, 0, "µm", m_state.expectedFrom);
  const double measurements = m_state.measurePeriod_s > 0.0 ? std::floor(length / m_state.measurePeriod_s) : NAN;
  Figure count = figureAtLeast(tr("Measurements"), measurements, 0, {}, 20.0);
  count.tip = tr("How often the error is measured. A model needs at least 20.");
  Figure time = figureOf(tr("Total time"), NAN, 0, {});
  time.value = length > 0.0 ? durationText(length) : QString();
  time.limit = m_state.wallTimeTotal;
  time.tip = tr("Time of the machine. A virtual machine goes through it faster than the clock on the wall.");
  Figure disk = figureAtLeast(tr("Disk free"), m_state.diskFree_GB, 1, "GB", 0.5);
  if (m_state.expectedDrift_um.isEmpty()) return {time, count, disk};
  return {time, count, largest, disk};
}

QVector<Figure> WarmupPage::runFigures() const {
  Figure left = figureOf(tr("Time left"), NAN, 0, {}, tr("of %1").arg(durationText(planLength_s())));
  if (!m_state.wallTimeLeft.isEmpty()) left.limit = m_state.wallTimeLeft;
  left.tip = tr("Time of the machine. All curves and periods are in it; the bar above counts the time on the wall.");
  if (m_state.phase == RunPhase::finished) {
    left = figureOf(tr("Recorded"), NAN, 0, {});
    left.value = durationText(m_state.elapsed_s);
  } else if (!std::isnan(m_state.timeLeft_s)) {
    left.value = durationText(m_state.timeLeft_s);
  }
  if (!m_state.silentSince.isEmpty()) RunView::markStopped(left);
  Figure largest = figureOf(tr("Largest error"), m_state.largestError_um, 1, "µm");
  if (!m_state.largestErrorAxis.isEmpty()) largest.limit = tr("in %1").arg(m_state.largestErrorAxis);
  Figure slope = figureOf(tr("Error slope now"), m_state.slope_um_per_h, 1, "µm/h");
  Figure heat = figureOf(tr("Heat slope now"), m_state.slope_K_per_h, 1, "K/h");
  for (Figure* figure : {&slope, &heat}) {
    if (figure->value.isEmpty()) continue;
    if (!m_state.silentSince.isEmpty()) {
      RunView::markStopped(*figure);
      continue;
    }
    figure->judgement = m_state.steady ? Judgement::ok : Judgement::none;
    figure->word = m_state.steady ? tr("steady") : tr("still moving");
    figure->tip = m_state.steadyCriterion;
  }
  if (m_state.imported) {
    if (m_state.errors == 0) {
      largest.word = tr("heat only");
      largest.tip = tr("The recording holds no error: Sensors and Fit need one, Physics does not.");
    }
    return {left, largest, figureOf(tr("Temperatures"), m_state.temperatures, 0, {}),
            figureOf(tr("Rows"), static_cast<double>(m_state.samples), 0, {})};
  }
  Figure disk = figureAtLeast(tr("Disk free"), m_state.diskFree_GB, 1, "GB", 0.5);
  if (disk.judgement == Judgement::ok) disk.limit.clear();
  if (m_state.phase == RunPhase::finished) return {left, largest, lostFigure(), disk};  // nothing moves any more
  return {left, largest, slope, heat, lostFigure(), disk};
}

/// A lost sample is judged by what it costs: temperatures change over minutes.
Figure WarmupPage::lostFigure() const {
  const auto all = m_state.samples + m_state.samplesLost;
  Figure lost = figureOf(tr("Samples lost"), static_cast<double>(m_state.samplesLost), 0, tr("of %1").arg(all));
  const QString hole = durationText(m_state.longestHole_s);
  if (!m_state.silentSince.isEmpty()) {
    RunView::markStopped(lost);
    lost.tip = tr("Counted again when the controller answers.");
  } else if (m_state.samplesLost == 0) {
    lost.judgement = Judgement::ok;
    lost.word = tr("none");
    lost.tip = tr("Every sample of the plan was stored.");
  } else if (m_state.longestHole_s <= m_state.harmlessHole_s) {
    lost.judgement = Judgement::warn;
    lost.word = tr("harmless");
    lost.tip = tr("The longest time without a sample was %1 of machine time. Temperatures change over minutes: the "
                  "model is the same without them. It stays in the report.")
                   .arg(hole);
  } else {
    const bool bad = m_state.longestHole_s > m_state.worstHole_s;
    lost.judgement = bad ? Judgement::bad : Judgement::warn;
    lost.word = bad ? tr("a part is missing") : tr("gap of %1").arg(hole);
    lost.tip = tr("Nothing is known about %1 of machine time. The model does not hold what happened then; a new run is "
                  "better if the errors moved meanwhile.")
                   .arg(hole);
  }
  return lost;
}

void WarmupPage::render() {
  if (!m_state.blocked.isEmpty()) {
    showEmpty(Icon::clock, tr("No run yet"), m_state.blocked);
    return;
  }
  if (m_state.filesOnly && m_state.phase == RunPhase::planning) {
    showEmpty(Icon::file, tr("No recording yet"),
              tr("The temperatures and errors of your recording appear here. Drop a logger's table anywhere on the "
                 "window, or choose it: text, CSV or a workbook, with any names and units."),
              tr("Import a recording"));
    return;
  }
  showContent();
  const bool planning = m_state.phase == RunPhase::planning;
  setFigures(planning ? planFigures() : runFigures());
  m_plan->setVisible(planning);
  m_run->setVisible(!planning);
  m_run->retranslate();
  m_recordings->setVisible(m_state.recordings.size() > 1);
  m_recordings->retranslate();
  m_recordings->setRecordings(m_state.recordings, m_state.shownRecording);
  renderPlan();
}

void WarmupPage::renderPlan() {
  m_filling = true;
  m_timelineCard->setTitle(tr("Plan"));
  m_timelineCard->setSubtitle(tr("spindle speed in rpm over time"));
  m_stepCard->setTitle(tr("Step %1").arg(m_timeline->selectedStep() + 1));
  m_expectedCard->setTitle(tr("Expected drift"));
  m_expectedCard->setSubtitle(m_state.expectedFrom.isEmpty() ? QStringLiteral("µm") : "µm, " + m_state.expectedFrom);
  const QStringList names = {tr("Duration"), tr("Speed"),        tr("Axes"),
                             tr("Coolant"),  tr("Sample every"), tr("Measure every")};
  for (int i = 0; i < names.size(); ++i) m_fieldNames[i]->setText(names[i]);
  m_hint->setText(tr("Blue ticks under the plan: here the machine goes to the measuring position."));
  m_minutes->setSuffix(tr(" min"));
  m_speed->setSuffix(tr(" rpm"));
  m_sample->setSuffix(tr(" s"));
  m_measure->setSuffix(tr(" s"));
  m_coolant->setText(tr("on"));
  m_add->setText(tr("Add step"));
  m_remove->setText({});
  m_remove->setToolTip(tr("Remove the selected step"));
  m_remove->setAccessibleName(m_remove->toolTip());
  const int motion = std::max(0, m_motion->currentIndex());
  m_motion->clear();
  m_motion->addItems({tr("run the path"), tr("stand still")});
  m_motion->setCurrentIndex(motion);
  m_presets->clear();
  m_presets->addItems(m_state.presets);
  m_presets->setPlaceholderText(tr("Choose a plan"));
  m_presets->setCurrentIndex(m_state.preset);
  m_presets->setAccessibleName(tr("Preset plans"));
  m_speed->setRange(0, static_cast<int>(m_state.fastest_rpm));
  m_sample->setValue(m_state.samplePeriod_s);
  m_measure->setValue(m_state.measurePeriod_s);
  m_timeline->setFastest(m_state.fastest_rpm);
  m_timeline->setMeasurePeriod(m_state.measurePeriod_s);
  m_timeline->setSteps(m_state.plan);
  m_expectedCard->setVisible(!m_state.expectedTime_s.isEmpty());  // known after the first run of this machine
  if (m_state.expectedTime_s.isEmpty()) {
    m_expected->clear();
  } else {
    PartStyle style;
    style.tag = tr("Expected drift");
    style.unit = "µm";
    style.color = axisColor(2);
    m_expected->setPart("expected", m_state.expectedTime_s, m_state.expectedDrift_um, style);
  }
  m_filling = false;
  showStep();
}

void WarmupPage::showStep() {
  const auto& steps = m_timeline->steps();
  const int index = m_timeline->selectedStep();
  const bool some = index < steps.size();
  for (QWidget* field : {static_cast<QWidget*>(m_minutes), static_cast<QWidget*>(m_speed),
                         static_cast<QWidget*>(m_coolant), static_cast<QWidget*>(m_motion)}) {
    field->setEnabled(some);
  }
  m_remove->setEnabled(steps.size() > 1);
  m_stepCard->setTitle(tr("Step %1 of %2").arg(some ? index + 1 : 0).arg(steps.size()));
  if (!some) return;
  m_filling = true;
  m_minutes->setValue(static_cast<int>(std::lround(steps[index].duration_s / 60.0)));
  m_speed->setValue(static_cast<int>(std::lround(steps[index].speed_rpm)));
  m_coolant->setChecked(steps[index].coolant);
  m_motion->setCurrentIndex(steps[index].cycle ? 0 : 1);
  m_filling = false;
}

void WarmupPage::stepEdited() {
  if (m_filling) return;
  auto steps = m_timeline->steps();
  const int index = m_timeline->selectedStep();
  if (index >= steps.size()) return;
  steps[index] = {60.0 * m_minutes->value(), static_cast<double>(m_speed->value()), m_coolant->isChecked(),
                  m_motion->currentIndex() == 0};
  m_timeline->setSteps(steps);
  planTouched();
}

void WarmupPage::planTouched() {
  m_state.plan = m_timeline->steps();
  m_state.preset = -1;
  // The drawn expectation belongs to the plan it was made for.
  m_state.expectedTime_s.clear();
  m_state.expectedDrift_um.clear();
  refresh();
  Q_EMIT planEdited(m_state.plan);
}

}  // namespace zerodrift::ui
