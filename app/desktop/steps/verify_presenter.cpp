#include "app/desktop/steps/verify_presenter.h"

#include <QSettings>
#include <algorithm>
#include <cmath>

#include "app/desktop/ask.h"
#include "app/text/error_text.h"
#include "core/base/error_json.h"
#include "core/flow/flow.h"
#include "core/flow/steps/inputs.h"
#include "core/flow/steps/verify_compare.h"
#include "core/report/comparison.h"
#include "core/report/limits.h"
#include "core/report/promise.h"
#include "ui/pages/verify_page.h"

namespace zerodrift::desktop {

using nlohmann::json;

namespace {

constexpr int threshold_rest_ms = 600;
constexpr double missed_measurements = 3.0;  // so many periods without one are too long

/// Largest number of an object {"X": ..., "Y": ...}; NaN when there is none.
double largest(const json& body, const char* key) {
  double value = std::nan("");
  for (const auto& one : body.value(key, json::object())) {
    if (one.is_number()) value = std::fmax(value, one.get<double>());
  }
  return value;
}

double error_or_nan(const compensation::Table& table, const std::string& axis,
                    const compensation::ResidualSample& sample) {
  return compensation::error_um(table, axis, sample.position_mm, compensation::Approach::up, sample.temperatures)
      .value_or(std::nan(""));
}

/// What was measured of a channel up to a time since the run's start.
void measured_until(const recording::Recording& run, const std::string& channel, double until_s,
                    QVector<double>& time_s, QVector<double>& values) {
  const auto* found = run.find(channel);
  for (std::size_t r = 0; found != nullptr && r < run.rows(); ++r) {
    const double at_s = run.time_s[r] - run.time_s.front();
    if (at_s > until_s || std::isnan(found->values[r])) continue;
    time_s.append(at_s);
    values.append(found->values[r]);
  }
}

double keptThreshold_um() {
  return QSettings().value(QStringLiteral("verification/threshold_um"), flow::VerifyOptions().threshold_um).toDouble();
}

}  // namespace

VerifyPresenter::VerifyPresenter(Workbench& bench, ui::VerifyPage* page)
    : RunPresenter(bench, page, page->run()), m_page(page), m_threshold_um(keptThreshold_um()) {
  feed().setCompensated(true);
  m_judging.setSingleShot(true);
  m_judging.setInterval(threshold_rest_ms);
  connect(&m_judging, &QTimer::timeout, this, &VerifyPresenter::judgeAgain);
  connect(page, &ui::VerifyPage::thresholdChanged, this, [this](double threshold_um) {
    m_threshold_um = threshold_um;
    QSettings().setValue(QStringLiteral("verification/threshold_um"), threshold_um);
    m_judging.start();
  });
  connect(page, &ui::VerifyPage::noteRequested, this, [this](double) { secondary(QStringLiteral("note")); });
  connect(page, &ui::Page::primaryTriggered, this, &VerifyPresenter::primary);
  connect(page, &ui::Page::secondaryTriggered, this, &VerifyPresenter::secondary);
  connect(&feed(), &RunFeed::updated, this, [this] { refresh(); });
  connect(&bench, &Workbench::heldTableChanged, this, [this] { refresh(); });
}

void VerifyPresenter::forget() {
  RunPresenter::forget();
  m_judging.stop();
  m_skipped = false;
  m_computed = 0;
  m_residuals = {};
  m_corrected.reset();
  m_axes.clear();
  m_axesOf = 0;
  m_compared_s = 0.0;
  m_sameRun = false;
  m_threshold_um = keptThreshold_um();
}

void VerifyPresenter::primary() {
  if (running()) {
    pauseOrResume();
    refresh();
  } else if (m_page->state().phase == ui::VerifyPhase::interrupted) {
    if (interrupted() && agreed(interrupted()->plan)) start({});
  } else if (m_page->state().phase != ui::VerifyPhase::finished) {
    const json warmup = bench().body("warmup");
    if (!warmup.is_object()) return;
    const auto plan = acquisition::plan_from_json(warmup.value("plan", json::object()), "the warm-up's plan");
    if (plan && agreed(flow::verification_plan(*plan))) start({});
  } else if (!m_page->state().notHeld.isEmpty()) {
    Q_EMIT pageRequested(QStringLiteral("upload"));
  } else if (m_page->rollbackNeeded()) {
    Q_EMIT rollbackWanted(m_page->state().versionBefore);
  } else if (m_page->correctionNeeded()) {
    applyCorrection({});
  } else if (m_page->furtherRunNeeded()) {
    Q_EMIT furtherRunWanted();
  } else if (m_page->verifyAgainNeeded()) {
    secondary(QStringLiteral("again"));
  } else {
    Q_EMIT nextRequested();
  }
}

void VerifyPresenter::secondary(const QString& action) {
  if (action == QStringLiteral("again")) {
    m_again = true;
    forgetRun();  // the next run's plots begin empty
  }
  if (action == QStringLiteral("skip") || action == QStringLiteral("goOn")) m_skipped = true;
  if (action == QStringLiteral("drop")) dropInterrupted();
  if (action == QStringLiteral("finish") && !running()) return finishInterrupted();
  if (action == QStringLiteral("correct")) return applyCorrection({});
  if (action == QStringLiteral("rollback")) {
    Q_EMIT rollbackWanted(m_page->state().versionBefore);
    return;
  }
  steer(action);
  refresh();
  if (action == QStringLiteral("goOn")) Q_EMIT nextRequested();
}

void VerifyPresenter::finishInterrupted() {
  if (m_page->state().phase != ui::VerifyPhase::interrupted) return;
  if (!ask(m_page, tr("Finish the interrupted run?"), tr("What was recorded until the interruption is kept and used."),
           tr("Finish"))) {
    return;
  }
  resumeToFinish();
}

Result<std::optional<flow::RecordedRun>> VerifyPresenter::readInterrupted() const {
  ZD_TRY(auto found, flow::interrupted_verification(*bench().job()));
  const json& kept = bench().body("verification");
  const bool older = found && kept.is_object() && kept.value("series", 0LL) > found->series;
  return older ? std::nullopt : std::move(found);
}

void VerifyPresenter::start(std::function<void(bool good)> done) {
  if (running()) return;
  m_skipped = false;
  m_page->showView(0);
  record(
      tr("Verification run"), {},
      [threshold_um = m_threshold_um](commissioning::Job& job, flow::Devices& devices, const flow::RunOptions& run,
                                      const TaskContext& context) {
        flow::VerifyOptions options;
        options.threshold_um = threshold_um;
        options.run = run;
        return flow::verify(job, devices, options, context);
      },
      std::move(done));
}

void VerifyPresenter::judgeAgain() {
  if (running() || !bench().has("verification")) return;
  if (bench().tasks().running()) return m_judging.start();
  const double threshold_um = m_threshold_um;
  runStep(
      tr("Judging the residual"),
      [threshold_um](commissioning::Job& job, const TaskContext&) { return flow::judge_again(job, threshold_um); }, {},
      From::elsewhere);
}

void VerifyPresenter::applyCorrection(std::function<void(bool good)> done) {
  if (!m_corrected) return;
  Q_EMIT correctionWanted(*m_corrected, [this, done = std::move(done)](bool good) {
    if (good) {
      m_again = true;  // what was corrected is proved again
      forgetRun();
    }
    refresh();
    if (done) done(good);
  });
}

void VerifyPresenter::fillRun(ui::VerifyState& state) {
  const auto& now = feed().now();
  state.phase = feed().paused() ? ui::VerifyPhase::paused : ui::VerifyPhase::running;
  state.silentSince = silentSince();
  if (!feed().receiving()) return;
  state.peakAfter_um = feed().largestError_um();
  state.afterAxis = feed().largestErrorAxis();
  if (feed().measuredAt_s() >= 0) state.lastGoodFrame_s = std::max(0.0, now.time_s - feed().measuredAt_s());
}

void VerifyPresenter::fillInterrupted(ui::VerifyState& state) {
  state.phase = ui::VerifyPhase::interrupted;
  state.keptBefore = bench().has("verification");
  showInterrupted();
  state.peakAfter_um = feed().largestError_um();
  state.afterAxis = feed().largestErrorAxis();
}

/// The reference is the one the job's figures have: page and report say the same.
void VerifyPresenter::compare(const json& body) {
  m_axes.clear();
  const auto warmup = flow::need(*bench().job(), "verify", "warmup");
  if (!warmup) return;
  const auto before = flow::run_of(*bench().job(), *warmup);
  const auto after = bench().job()->read_series(body.at("series").get<long long>());
  if (!before || !after) return;
  flow::VerificationReference reference{*before, false};
  if (body.value("reference", "") == "same_run") reference = flow::reference_of(*after, *before);
  m_sameRun = reference.same_run;
  const auto compared = report::compare_runs(reference.without, *after);
  m_compared_s = compared.span_s;
  for (const auto& axis : compared.axes) {
    ui::AxisResult row;
    row.axis = QString::fromStdString(axis.axis);
    row.before_um = axis.before_um;
    row.after_um = axis.after_um;
    row.removed_percent = axis.removed_percent;
    row.endBefore_um = axis.end_before_um;
    row.endAfter_um = axis.end_after_um;
    const std::string channel = "d" + axis.axis + "_um";
    measured_until(reference.without, channel, compared.span_s, row.beforeTime_s, row.before);
    measured_until(*after, channel, compared.span_s, row.afterTime_s, row.after);
    m_axes.append(row);
  }
}

void VerifyPresenter::fillAxes(ui::VerifyState& state, const json& body) {
  const auto artefact = bench().job()->latest("verification");
  if (!artefact || !*artefact) return;
  if (m_axesOf != (*artefact)->id) compare(body);
  m_axesOf = (*artefact)->id;
  state.results = m_axes;
  state.sameRun = m_sameRun;
  state.compared_s = m_compared_s;
  double before_um = std::nan("");
  double after_um = std::nan("");
  for (const auto& axis : m_axes) {
    if (!(axis.before_um <= before_um)) state.beforeAxis = axis.axis, before_um = axis.before_um;
    if (!(axis.after_um <= after_um)) state.afterAxis = axis.axis, after_um = axis.after_um;
  }
  state.peakBefore_um = before_um;
}

void VerifyPresenter::fillResult(ui::VerifyState& state, const json& body) {
  state.phase = ui::VerifyPhase::finished;
  showKept(body);
  state.peakAfter_um = largest(body, "peak_error_after_um");
  state.rmsAfter_um = largest(body, "rms_error_after_um");
  state.peakLimit_um = body.value("limit_um", flow::VerifyOptions().limit_um);
  fillAxes(state, body);
  for (const auto& text : body.value("outside_range", json::array())) {
    state.outsideRange << bench().inWords(text.get<std::string>());
  }
  if (const json before = body.value("version_before", json()); before.is_object()) {
    state.versionBefore = before.value("version", 0);
    state.runsDisagree = before.value("contradicted", false);
    for (const auto& axis : before.value("axes", json::array())) {
      if (!axis.value("worse", false)) continue;
      state.worseThanBefore.append({QString::fromStdString(axis.value("axis", "")), axis.value("rms_before_um", 0.0),
                                    axis.value("rms_now_um", 0.0)});
    }
  }
  state.promiseReach = report::limits::promise_reach;
  state.promised_um = report::promise_of(bench().body("model"), body).promised_um;
  fillCorrection(state);
  state.leftAsItIs = m_skipped;
}

void VerifyPresenter::compute(const commissioning::Artefact& verification) {
  if (verification.id == m_computed) return;
  m_computed = verification.id;
  m_corrected.reset();
  m_residuals = {};
  if (auto residuals = flow::verification_residuals(*bench().job())) m_residuals = std::move(*residuals);
  if (auto corrected = flow::corrected_table(verification)) m_corrected = std::move(*corrected);
}

/// The correction is the job's, so that page and report say the same.
void VerifyPresenter::fillCorrection(ui::VerifyState& state) {
  const auto artefact = bench().job()->latest("verification");
  if (!artefact || !*artefact) return;
  const json& body = bench().body("verification");
  // The threshold that the job was judged by, unless another one is being set.
  if (!m_judging.isActive() && body.contains("threshold_um")) m_threshold_um = body["threshold_um"].get<double>();
  state.threshold_um = m_threshold_um;
  compute(**artefact);
  for (const auto& problem : body.value("problems", json::array())) {
    const auto error = error_from_json(problem);
    if (error) state.noCorrection = bench().inWords(lineOf(*error).toStdString());
  }
  for (const auto& axis : body.value("correction", json::array())) {
    const std::string name = axis.value("axis", "");
    ui::AxisCorrection row;
    row.axis = QString::fromStdString(name);
    row.kappa = axis.value("kappa", 1.0);
    row.offset_um = axis.value("offset_um", 0.0);
    row.evidence = bench().inWords(axis.value("reason", ""));
    row.proposed = m_corrected && (row.kappa != 1.0 || row.offset_um != 0.0);
    row.peakBefore_um = axis.value("largest_before_um", std::nan(""));
    row.peakAfter_um = row.proposed ? axis.value("largest_after_um", std::nan("")) : row.peakBefore_um;
    fillCurves(name, row);
    state.corrections.append(row);
    state.correctionProposed = state.correctionProposed || row.proposed;
  }
  state.correctionProposed = state.correctionProposed && !m_skipped;
}

void VerifyPresenter::fillCurves(const std::string& axis, ui::AxisCorrection& row) const {
  const auto samples = m_residuals.samples.find(axis);
  if (samples == m_residuals.samples.end()) return;
  const auto& times = m_residuals.time_s.at(axis);
  row.time_s = QVector<double>(times.begin(), times.end());
  for (const auto& sample : samples->second) {
    row.residual_um.append(sample.residual_um);
    if (!row.proposed) continue;
    // What the table says more than before is compensated more than before.
    row.corrected_um.append(sample.residual_um - error_or_nan(*m_corrected, axis, sample) +
                            error_or_nan(m_residuals.table, axis, sample));
  }
}

/// The table was written anew since: what was proved is not what runs.
bool VerifyPresenter::ofAnotherTable() {
  const auto status = flow::status_of(*bench().job(), "verify");
  return std::any_of(status.reasons.begin(), status.reasons.end(), [](const flow::Reason& reason) {
    return reason.kind == "upload" && reason.cause == flow::Cause::changed;
  });
}

Presenter::Standing VerifyPresenter::standing() const {
  if (Standing table = tableStanding(); !table.words.isEmpty()) return table;
  if (bench().job() == nullptr || running()) return {};
  if (flow::status_of(*bench().job(), "verify").state != flow::StepState::current) return {};
  const json& body = bench().body("verification");
  if (!body.is_object()) return {};
  if (body.value("verdict", "") == "failed") return {tr("Above the limit")};
  if (!report::promise_of(bench().body("model"), body).held()) {
    return {tr("Promise not reached"), ui::StepState::stale};
  }
  if (report::least_removed_percent(body) < report::limits::removed_percent) {
    return {tr("Less than %1 % removed").arg(report::limits::removed_percent, 0, 'f', 0), ui::StepState::stale};
  }
  return {};
}

void VerifyPresenter::refresh() {
  ui::VerifyState state;
  const auto job = bench().job();
  if (job == nullptr || !bench().has("upload")) {
    state.blocked = tr("Write the table to the machine first; then the run shows what is left.");
    m_page->setState(state);
    return;
  }
  state.offline = offlineReason();
  const auto held = bench().heldTable();
  if (held == HeldTable::none) state.notHeld = tr("The machine holds no table: write it in Upload, or bring it back.");
  if (held == HeldTable::another) {
    state.notHeld = tr("The machine holds another table than this job's: compare them in Upload.");
  }
  if (held == HeldTable::own && !bench().compensationOn()) {
    state.switchedOff = tr("The compensation is OFF: switch it on with the lamp below, then start.");
  }
  state.threshold_um = m_threshold_um;
  state.peakLimit_um = flow::VerifyOptions().limit_um;
  state.compensationOn = bench().compensationOn();
  const auto& warmup = bench().body("warmup");
  if (warmup.is_object()) {
    state.peakBefore_um = largest(warmup, "peak_um");
    state.frameLimit_s = missed_measurements * warmup.value("plan", json::object()).value("measure_period_s", 60.0);
  }
  const json& body = bench().body("verification");
  if (running()) {
    fillRun(state);
  } else if (!m_again && interrupted()) {
    fillInterrupted(state);
  } else if (body.is_object() && !m_again && !ofAnotherTable()) {
    fillResult(state, body);
  }
  m_page->setState(state);
}

void VerifyPresenter::tour(std::function<void(bool good)> done) {
  // As an engineer would: what the residual shows is corrected once and proved again.
  start([this, done = std::move(done)](bool good) {
    refresh();
    if (!good || !m_page->state().correctionProposed) {
      done(good);
      return;
    }
    applyCorrection([this, done](bool written) {
      if (written) {
        start(done);
      } else {
        done(false);
      }
    });
  });
}

}  // namespace zerodrift::desktop
