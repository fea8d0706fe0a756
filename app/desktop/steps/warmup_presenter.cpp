#include "app/desktop/steps/warmup_presenter.h"

#include <QDir>
#include <QFileDialog>
#include <cmath>
#include <filesystem>

#include "app/desktop/ask.h"
#include "app/text/core_text.h"
#include "core/base/json.h"
#include "core/flow/steps/warmup_step.h"
#include "core/recording/csv.h"
#include "core/report/limits.h"
#include "ui/pages/warmup_page.h"
#include "ui/widgets/number_text.h"

namespace zerodrift::desktop {

using nlohmann::json;

namespace {

constexpr std::size_t undo_depth = 100;

QVector<ui::PlanStepRow> rows_of(const acquisition::Plan& plan) {
  QVector<ui::PlanStepRow> rows;
  for (const auto& step : plan.steps)
    rows.append({step.duration_s, step.spindle_rpm, step.coolant_on, step.path_cycle});
  return rows;
}

}  // namespace

WarmupPresenter::WarmupPresenter(Workbench& bench, ui::WarmupPage* page)
    : RunPresenter(bench, page, page->run()), m_page(page), m_presets(acquisition::preset_plans()) {
  if (!m_presets.empty()) m_plan = m_presets.front();
  connect(page, &ui::WarmupPage::presetChosen, this, [this](int index) {
    if (index < 0 || index >= static_cast<int>(m_presets.size())) return;
    m_preset = index;
    setPlan(m_presets[static_cast<std::size_t>(index)]);
  });
  connect(page, &ui::WarmupPage::planEdited, this, [this](const QVector<ui::PlanStepRow>& rows) {
    acquisition::Plan plan = m_plan;
    plan.steps.clear();
    for (const auto& row : rows) plan.steps.push_back({row.duration_s, row.speed_rpm, row.coolant, row.cycle});
    m_preset = -1;
    setPlan(plan);
  });
  connect(page, &ui::WarmupPage::periodsEdited, this, [this](double sample_s, double measure_s) {
    acquisition::Plan plan = m_plan;
    plan.sample_period_s = sample_s;
    plan.measure_period_s = measure_s;
    setPlan(plan);
  });
  connect(page, &ui::WarmupPage::noteRequested, this, [this](double) { secondary(QStringLiteral("note")); });
  connect(page, &ui::Page::primaryTriggered, this, &WarmupPresenter::primary);
  connect(page, &ui::Page::secondaryTriggered, this, &WarmupPresenter::secondary);
  connect(page, &ui::Page::emptyActionTriggered, this, &WarmupPresenter::importWanted);
  connect(&feed(), &RunFeed::updated, this, &WarmupPresenter::refresh);
  wireRecordings();
}

void WarmupPresenter::forget() {
  RunPresenter::forget();
  m_preset = 0;
  m_plan = m_presets.empty() ? acquisition::Plan{} : m_presets.front();
  m_undo.clear();
  m_recording = 0;
  m_recordingsBefore.clear();
}

void WarmupPresenter::setPlan(const acquisition::Plan& plan) {
  m_undo.push_back(m_plan);
  if (m_undo.size() > undo_depth) m_undo.erase(m_undo.begin());
  m_plan = plan;
  refresh();
}

void WarmupPresenter::propose(const acquisition::Plan& plan) {
  if (running()) return;
  m_again = true;
  m_preset = -1;
  setPlan(plan);
}

void WarmupPresenter::planFurtherRun() {
  if (running()) return;
  m_again = true;
  refresh();
}

void WarmupPresenter::undo() {
  if (!m_recordingsBefore.empty()) {
    const auto before = std::move(m_recordingsBefore.back());
    m_recordingsBefore.pop_back();
    return changeRecordings(before);
  }
  if (running() || m_undo.empty()) return;
  m_plan = m_undo.back();
  m_undo.pop_back();
  refresh();
}

void WarmupPresenter::primary() {
  if (m_page->state().phase == ui::RunPhase::finished) {
    Q_EMIT nextRequested();
  } else if (m_page->state().filesOnly) {
    Q_EMIT importWanted();
  } else if (running()) {
    pauseOrResume();
  } else if (agreed(comingPlan())) {
    start({});
  }
  refresh();
}

/// What would be run now.
const acquisition::Plan& WarmupPresenter::comingPlan() {
  return !m_again && interrupted() ? interrupted()->plan : m_plan;
}

void WarmupPresenter::secondary(const QString& action) {
  if (action == QStringLiteral("finish") && !running()) return finishInterrupted();
  if (steer(action)) return;
  if (action == QStringLiteral("import") && !running()) return Q_EMIT importWanted();
  if (action == QStringLiteral("load")) loadPlan();
  if (action == QStringLiteral("save")) savePlan();
  if (action == QStringLiteral("export")) exportRun();
  if (action == QStringLiteral("drop")) dropInterrupted();
  if (action == QStringLiteral("again")) planFurtherRun();
}

/// An interrupted run is taken up only to be ended as it should: spindle off, series closed, what there is kept.
void WarmupPresenter::finishInterrupted() {
  if (m_page->state().phase != ui::RunPhase::interrupted) return;
  const bool there = bench().connected() && !bench().lost();
  const QString kept = tr("What was recorded until the interruption is kept and used.");
  const QString away = tr("No machine is connected, so none is stopped: look whether its spindle stands.");
  if (!ask(m_page, tr("Finish the interrupted run?"), there ? kept : ui::sentencesText({kept, away}), tr("Finish"))) {
    return;
  }
  if (!there) {
    runStep(tr("Finishing the interrupted run"),
            [](commissioning::Job& job, const TaskContext&) { return flow::end_interrupted_warmup(job); });
    return;
  }
  resumeToFinish();
}

void WarmupPresenter::loadPlan() {
  const QString path = QFileDialog::getOpenFileName(m_page, tr("Warm-up plan"), bench().folder(), tr("Plans (*.json)"));
  if (path.isEmpty()) return;
  const auto plan = acquisition::read_plan(path.toStdString());
  if (!plan) {
    show(plan.error());
    return;
  }
  m_preset = -1;
  setPlan(*plan);
}

void WarmupPresenter::exportRun() {
  const json body = bench().body("warmup");
  if (!body.is_object()) return;
  const QString path = QFileDialog::getSaveFileName(
      m_page, tr("Save as CSV"), bench().folder() + QStringLiteral("/warm-up.csv"), tr("Recordings (*.csv)"));
  if (path.isEmpty()) return;
  const auto run = bench().job()->read_series(body.at("series").get<long long>());
  const Status written = run ? recording::write_recording(path.toStdString(), *run) : Status(fail(run.error()));
  if (!written) show(written.error());
}

void WarmupPresenter::savePlan() {
  const QString path = QFileDialog::getSaveFileName(
      m_page, tr("Save plan"), bench().folder() + QStringLiteral("/plan.json"), tr("Plans (*.json)"));
  if (path.isEmpty()) return;
  if (const Status written = write_json_file(path.toStdString(), acquisition::to_json(m_plan)); !written) {
    show(written.error());
  }
}

void WarmupPresenter::start(std::function<void(bool good)> done) {
  const auto& profile = bench().profile();
  m_runningPlan = comingPlan();
  const auto plan = acquisition::with_measuring_position(
      m_runningPlan, profile ? profile->measure_position_mm : std::map<std::string, double>());
  if (!plan) {
    show(plan.error());
    if (done) done(false);
    return;
  }
  record(
      tr("Warm-up run"), *plan,
      [](commissioning::Job& job, flow::Devices& devices, const flow::RunOptions& options, const TaskContext& context) {
        return flow::record_warmup(job, devices, options, context);
      },
      std::move(done));
}

void WarmupPresenter::fillRun(ui::WarmupState& state) {
  const auto& now = feed().now();
  state.phase = feed().paused() ? ui::RunPhase::paused : ui::RunPhase::running;
  state.silentSince = silentSince();
  state.plan = rows_of(m_runningPlan);
  state.elapsed_s = now.time_s;
  if (feed().receiving()) {
    state.timeLeft_s = now.seconds_left;
    state.wallTimeLeft = wallTime(now.seconds_left);
  }
  state.largestError_um = feed().largestError_um();
  state.largestErrorAxis = feed().largestErrorAxis();
  state.slope_um_per_h = now.trend.slope_um_per_h.value_or(std::nan(""));
  state.slope_K_per_h = now.trend.slope_K_per_h.value_or(std::nan(""));
  state.steady = now.trend.steady;
  state.samplesLost = now.lost_samples;
  state.samples = now.rows;
  state.longestHole_s = feed().longestHole_s();
}

void WarmupPresenter::fillKept(ui::WarmupState& state, const json& body) {
  state.phase = ui::RunPhase::finished;
  if (!state.filesOnly || m_recording == 0) showKept(body);
  state.elapsed_s = body.value("duration_s", 0.0);
  state.timeLeft_s = 0.0;
  state.largestError_um = feed().largestError_um();
  state.largestErrorAxis = feed().largestErrorAxis();
  state.samplesLost = body.value("lost_samples", 0LL);
  state.samples = body.value("rows", 0LL);
  state.longestHole_s = feed().longestHole_s();
  fillImported(state, body);
  if (state.filesOnly) fillRecordings(state);
}

void WarmupPresenter::fillImported(ui::WarmupState& state, const json& body) {
  state.imported = body.value("source", "") == "file";
  if (!state.imported) return;
  for (const auto& channel : bench().warmupRun().channels) {
    if (recording::present_count(channel) == 0) continue;
    state.temperatures += channel.kind() == recording::ChannelKind::temperature;
    state.errors += channel.kind() == recording::ChannelKind::error;
  }
  if (state.errors == 0) state.largestError_um = std::nan("");
}

/// What was recorded until then is there to be looked at before it is gone on with or finished.
void WarmupPresenter::fillInterrupted(ui::WarmupState& state) {
  const auto& run = *interrupted();
  state.phase = ui::RunPhase::interrupted;
  state.keptBefore = bench().has("warmup");
  feed().setImported(false);
  showInterrupted();
  state.plan = rows_of(run.plan);
  state.elapsed_s = run.summary.duration_s;
  state.timeLeft_s = std::max(0.0, run.plan.duration_s() - state.elapsed_s);
  state.largestError_um = feed().largestError_um();
  state.largestErrorAxis = feed().largestErrorAxis();
  state.samplesLost = run.summary.lost_samples;
  state.samples = run.summary.rows;
  state.longestHole_s = feed().longestHole_s();
}

void WarmupPresenter::refresh() {
  ui::WarmupState state;
  const auto job = bench().job();
  state.filesOnly = bench().kind() == commissioning::JobKind::files;
  if (job == nullptr || (!state.filesOnly && !bench().has("calibration") && !bench().has("warmup"))) {
    state.blocked = tr("Calibrate the camera first: without it no error can be measured.");
    m_page->setState(state);
    return;
  }
  state.offline = offlineReason();
  for (const auto& preset : m_presets) state.presets << coreText(preset.name);
  state.preset = m_preset;
  state.plan = rows_of(m_plan);
  state.harmlessHole_s = report::limits::harmless_hole_s;
  state.worstHole_s = report::limits::worst_hole_s;
  state.wallTimeTotal = wallTime(m_plan.duration_s());
  state.samplePeriod_s = m_plan.sample_period_s;
  state.measurePeriod_s = m_plan.measure_period_s;
  state.compensationOn = bench().compensationOn();
  std::error_code unknown;
  const auto space = std::filesystem::space(std::filesystem::absolute(job->path()).parent_path(), unknown);
  state.diskFree_GB = unknown ? std::nan("") : static_cast<double>(space.available) / 1e9;
  const json& body = bench().body("warmup");
  if (running()) {
    fillRun(state);
  } else if (!m_again && interrupted()) {
    fillInterrupted(state);
  } else if (body.is_object() && !m_again) {
    fillKept(state, body);
  }
  m_page->setState(state);
}

Result<std::optional<flow::RecordedRun>> WarmupPresenter::readInterrupted() const {
  ZD_TRY(auto found, flow::interrupted_warmup(*bench().job()));
  const json& kept = bench().body("warmup");
  const bool older = found && kept.is_object() && kept.value("series", 0LL) > found->series;
  return older ? std::nullopt : std::move(found);
}

void WarmupPresenter::tour(std::function<void(bool good)> done) {
  start(std::move(done));
}

}  // namespace zerodrift::desktop
