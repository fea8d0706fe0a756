#include "app/desktop/steps/verify_presenter.h"

#include <QInputDialog>
#include <QSettings>
#include <algorithm>
#include <cmath>

#include "core/flow/flow.h"
#include "ui/pages/verify_page.h"

namespace zerodrift::desktop {

using compensation::CorrectionKind;
using nlohmann::json;

namespace {

constexpr double usual_limit_um = 5.0;

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

double largest_of(const QVector<double>& values) {
  double peak = 0.0;
  for (const double value : values) {
    if (std::isfinite(value)) peak = std::max(peak, std::abs(value));
  }
  return peak;
}

}  // namespace

VerifyPresenter::VerifyPresenter(Workbench& bench, ui::VerifyPage* page)
    : Presenter(bench, page),
      m_page(page),
      m_feed(new RunFeed(bench, page->run(), this)),
      m_threshold_um(QSettings().value(QStringLiteral("verification/limit_um"), usual_limit_um).toDouble()) {
  m_feed->setCompensated(true);
  connect(page, &ui::VerifyPage::thresholdChanged, this, [this](double threshold_um) {
    m_threshold_um = threshold_um;
    m_computed = 0;
    QSettings().setValue(QStringLiteral("verification/limit_um"), threshold_um);
    refresh();
  });
  connect(page, &ui::VerifyPage::noteRequested, this, [this](double) { secondary(QStringLiteral("note")); });
  connect(page, &ui::Page::primaryTriggered, this, &VerifyPresenter::primary);
  connect(page, &ui::Page::secondaryTriggered, this, &VerifyPresenter::secondary);
  connect(m_feed, &RunFeed::updated, this, [this] {
    if (m_feed->now().measured) m_measured_s = m_feed->now().time_s;
    refresh();
  });
}

void VerifyPresenter::primary() {
  if (m_running) {
    if (m_feed->paused()) {
      m_feed->resume();
    } else {
      m_feed->pause();
    }
    refresh();
  } else if (m_page->state().phase != ui::VerifyPhase::finished) {
    start({});
  } else if (m_page->state().correctionProposed) {
    applyCorrection({});
  } else {
    Q_EMIT nextRequested();
  }
}

void VerifyPresenter::secondary(const QString& action) {
  if (action == QStringLiteral("finish")) m_feed->finish();
  if (action == QStringLiteral("abort")) m_feed->abort();
  if (action == QStringLiteral("again")) m_again = true;
  if (action == QStringLiteral("skip")) m_skipped = true;
  if (action == QStringLiteral("note")) {
    const QString text = QInputDialog::getText(m_page, tr("Note"), tr("What happened?"));
    if (!text.isEmpty()) m_feed->note(text);
  }
  refresh();
}

void VerifyPresenter::start(std::function<void(bool good)> done) {
  const auto profile = bench().profile();
  auto* job = bench().job();
  if (!profile || job == nullptr || m_running) {
    if (!profile) show(Error{ErrorCode::step_blocked, {{"step", "verify"}, {"needs", "a connected machine"}}});
    if (done) done(false);
    return;
  }
  m_running = true;
  m_again = false;
  m_skipped = false;
  m_measured_s = -1.0;
  m_page->showView(0);
  m_feed->begin();
  flow::VerifyOptions options;
  options.limit_um = m_threshold_um;
  options.run.observer = m_feed->observer();
  options.run.control = m_feed->control();
  options.run.cameras = m_feed->cameras();
  refresh();
  runStep(
      tr("Verification run"),
      [profile = *profile, job, options](const TaskContext& context) -> Result<commissioning::NewArtefact> {
        ZD_TRY(auto devices, flow::Devices::open(profile));
        return flow::verify(*job, devices, options, context);
      },
      [this, done = std::move(done)](bool good) {
        m_feed->stop();
        m_running = false;
        m_shown = 0;
        refresh();
        if (done) done(good);
      });
}

void VerifyPresenter::applyCorrection(std::function<void(bool good)> done) {
  if (!m_correction) return;
  Q_EMIT correctionWanted(m_correction->table, [this, done = std::move(done)](bool good) {
    if (good) m_again = true;  // what was corrected is proved again
    refresh();
    if (done) done(good);
  });
}

void VerifyPresenter::fillRun(ui::VerifyState& state) {
  const auto& now = m_feed->now();
  state.phase = m_feed->paused() ? ui::VerifyPhase::paused : ui::VerifyPhase::running;
  if (!m_feed->receiving()) return;
  state.timeLeft_s = now.seconds_left;
  state.peakAfter_um = m_feed->largestError_um();
  if (m_measured_s >= 0) state.lastGoodFrame_s = std::max(0.0, now.time_s - m_measured_s);
}

void VerifyPresenter::showKept(const json& body) {
  const auto series = body.at("series").get<long long>();
  if (series == m_shown) return;
  if (const auto run = bench().job()->read_series(series)) {
    m_shown = series;
    m_feed->showRecording(*run);
  }
}

void VerifyPresenter::fillResult(ui::VerifyState& state, const json& body) {
  state.phase = ui::VerifyPhase::finished;
  showKept(body);
  state.peakBefore_um = largest(body, "peak_error_before_um");
  state.peakAfter_um = largest(body, "peak_error_after_um");
  state.rmsAfter_um = largest(body, "rms_error_after_um");
  if (state.peakBefore_um > 0) state.removed_percent = 100.0 * (1.0 - state.peakAfter_um / state.peakBefore_um);
  fillCorrection(state);
}

void VerifyPresenter::compute(long long verification) {
  if (verification == m_computed) return;
  m_computed = verification;
  m_correction.reset();
  auto residuals = flow::verification_residuals(*bench().job());
  if (!residuals) return;
  m_residuals = std::move(*residuals);
  compensation::ResidualOptions options;
  options.threshold_um = m_threshold_um;
  if (auto correction = compensation::correct_residual(m_residuals.table, m_residuals.samples, options)) {
    m_correction = std::move(*correction);
  }
}

void VerifyPresenter::fillCorrection(ui::VerifyState& state) {
  const auto artefact = bench().job()->latest("verification");
  if (!artefact || !*artefact) return;
  compute((*artefact)->id);
  if (!m_correction) return;
  for (const auto& axis : m_correction->axes) {
    const auto samples = m_residuals.samples.find(axis.axis);
    if (samples == m_residuals.samples.end()) continue;
    ui::AxisCorrection row;
    row.axis = QString::fromStdString(axis.axis);
    row.kappa = axis.kappa;
    row.evidence = QString::fromStdString(axis.reason);
    row.proposed = axis.kind != CorrectionKind::none;
    const auto& times = m_residuals.time_s.at(axis.axis);
    row.time_s = QVector<double>(times.begin(), times.end());
    for (const auto& sample : samples->second) {
      row.residual_um.append(sample.residual_um);
      // What the table says more than before is compensated more than before.
      row.corrected_um.append(sample.residual_um - error_or_nan(m_correction->table, axis.axis, sample) +
                              error_or_nan(m_residuals.table, axis.axis, sample));
    }
    row.peakBefore_um = largest_of(row.residual_um);
    row.peakAfter_um = largest_of(row.corrected_um);
    state.corrections.append(row);
    state.correctionProposed = state.correctionProposed || row.proposed;
  }
  state.correctionProposed = state.correctionProposed && !m_skipped;
}

void VerifyPresenter::refresh() {
  ui::VerifyState state;
  const auto* job = bench().job();
  if (job == nullptr || !bench().has("upload")) {
    state.blocked = tr("Write the table to the machine first; then the run shows what is left.");
    m_page->setState(state);
    return;
  }
  state.threshold_um = m_threshold_um;
  state.peakLimit_um = m_threshold_um;
  state.compensationOn = bench().compensationOn();
  const auto warmup = bench().body("warmup");
  if (warmup.is_object()) state.peakBefore_um = largest(warmup, "peak_um");
  const json body = bench().body("verification");
  if (m_running) {
    fillRun(state);
  } else if (body.is_object() && !m_again) {
    fillResult(state, body);
  }
  m_page->setState(state);
}

void VerifyPresenter::tour(std::function<void(bool good)> done) {
  start(std::move(done));
}

}  // namespace zerodrift::desktop
