#include "app/desktop/steps/compensator_presenter.h"

#include <cmath>
#include <mutex>

#include "app/desktop/ask.h"
#include "app/desktop/pin_dialog.h"
#include "core/flow/rollback_and_switch.h"
#include "ui/widgets/progress_strip.h"

namespace zerodrift::desktop {

namespace {

constexpr int drain_ms = 100;

QString wordsOf(compensation::FollowerMode mode) {
  switch (mode) {
    case compensation::FollowerMode::following:
      return CompensatorPresenter::tr("compensating");
    case compensation::FollowerMode::held_at_edge:
      return CompensatorPresenter::tr("at the edge");
    case compensation::FollowerMode::safe_zero:
      return CompensatorPresenter::tr("running to 0");
    case compensation::FollowerMode::stopping:
      return CompensatorPresenter::tr("ending");
  }
  return {};
}

}  // namespace

/// Between the compensator's thread and the page.
struct CompensatorPresenter::Shared {
  struct Turn {
    double host_s = 0.0;
    flow::LiveTurn live;
  };
  std::mutex mutex;
  std::vector<Turn> turns;
  std::chrono::steady_clock::time_point begun = std::chrono::steady_clock::now();
};

CompensatorPresenter::CompensatorPresenter(Workbench& bench, ui::CompensatorPage* page)
    : Presenter(bench, page), m_page(page) {
  m_timer.setInterval(drain_ms);
  connect(&m_timer, &QTimer::timeout, this, &CompensatorPresenter::drain);
  connect(&bench, &Workbench::heldTableChanged, this, [this] { refresh(); });
  connect(page, &ui::Page::primaryTriggered, this, [this] {
    if (!m_running) {
      start();
      return;
    }
    m_state.phase = ui::CompensatorPhase::stopping;
    this->bench().tasks().cancel();
    refresh();
  });
}

void CompensatorPresenter::forget() {
  m_state = {};
  m_page->clear();
}

/// The sign of the offset was watched by camera or probes, in this job.
bool CompensatorPresenter::signsSeen() const {
  const auto& upload = bench().body("upload");
  return upload.is_object() && upload.contains("sign_check") && upload["sign_check"].is_object();
}

bool CompensatorPresenter::agreed(bool signs_seen) {
  const auto& profile = bench().profile();
  QString text = tr("The axes of %1 move by what the model predicts, at most %2 µm, until you press Stop.")
                     .arg(QString::fromStdString(profile->name))
                     .arg(profile->max_um, 0, 'f', 0);
  if (!bench().compensationOn())
    text += QLatin1Char(' ') + tr("The compensation is switched ON for it and OFF after it.");
  if (!signs_seen) {
    text += QStringLiteral("\n\n") +
            tr("First the axes go to the measuring position and a test offset of 10 µm is written in each direction, "
               "while the camera watches that it goes the right way. Is the work area clear?");
  }
  return ask(page(), tr("Compensate from this computer?"), text, tr("Start compensating"));
}

void CompensatorPresenter::start() {
  const auto profile = bench().profile();
  const auto job = bench().job();
  if (!profile || job == nullptr || m_running) return;
  const bool seen = signsSeen();
  if (!agreed(seen)) return;
  const auto permit = permit_for(bench(), page(), tr("Compensating"));
  if (!permit) return;
  m_running = true;
  m_state = {};
  m_state.phase = ui::CompensatorPhase::running;
  m_state.doing = seen ? tr("starting") : tr("checking signs");
  m_state.limit_um = profile->max_um;
  m_page->clear();
  m_shared = std::make_shared<Shared>();
  m_timer.start();
  refresh();
  runTask<controller::CompensatorSummary>(
      tr("Host compensator"),
      [job, profile = *profile, permit = *permit, seen,
       shared = m_shared](const TaskContext& context) -> Result<controller::CompensatorSummary> {
        if (!seen) {
          ZD_TRY(const auto signs, flow::try_signs(*job, profile, permit, flow::Consent::given(), context));
          ZD_CHECK(signs.result);
        }
        flow::LiveOptions options;
        options.permit = permit;
        return flow::compensate_live(*job, profile, options, context, [&](const flow::LiveTurn& live) {
          const std::scoped_lock lock(shared->mutex);
          const std::chrono::duration<double> since = std::chrono::steady_clock::now() - shared->begun;
          shared->turns.push_back({since.count(), live});
        });
      },
      [this](const Result<controller::CompensatorSummary>& summary) { ended(summary); });
}

void CompensatorPresenter::drain() {
  std::vector<Shared::Turn> turns;
  {
    const std::scoped_lock lock(m_shared->mutex);
    turns.swap(m_shared->turns);
  }
  for (const auto& [host_s, live] : turns) {
    const auto& turn = live.turn;
    ++m_state.turns;
    m_state.running_s = host_s;
    m_state.latest_ms = std::fmax(m_state.latest_ms, 1e3 * turn.late_s);
    m_state.notMeasured = bench().inWords(live.not_measured);
    m_state.reasons.clear();
    for (const auto& reason : turn.output.reasons) m_state.reasons << bench().inWords(reason);
    m_state.good =
        !turn.link_lost && turn.switch_on && !turn.foreign && turn.output.mode == compensation::FollowerMode::following;
    if (turn.link_lost) {
      ++m_state.lostTurns;
      m_state.doing = tr("no answer");
      m_state.reasons << tr("The controller does not answer; its watchdog takes the offset out meanwhile.");
      m_state.axes = {};
      continue;
    }
    m_state.doing = turn.switch_on ? wordsOf(turn.output.mode) : tr("switch is OFF");
    for (std::size_t axis = 0; axis < 3; ++axis) {
      auto& shown = m_state.axes[axis];
      shown.predicted_um = turn.output.predicted_um[axis];
      shown.applied_um = turn.applied_um[axis];
      if (live.left) shown.left_um = live.left->error_um[axis];
      if (live.left && !std::isnan(shown.left_um)) {
        shown.largestLeft_um = std::max(shown.largestLeft_um, std::abs(shown.left_um));
      }
    }
    m_page->append(host_s, m_state.axes, live.left.has_value());
    if (!live.not_measured.empty()) forgetMeasured();
  }
  if (turns.empty()) return;
  const auto& last = turns.back().live.turn;
  bench().tellController(!last.link_lost, last.switch_on);
  refresh();
}

void CompensatorPresenter::forgetMeasured() {
  for (auto& axis : m_state.axes) axis.left_um = std::nan("");
}

void CompensatorPresenter::ended(const Result<controller::CompensatorSummary>& summary) {
  drain();
  m_timer.stop();
  m_running = false;
  m_state.phase = ui::CompensatorPhase::ready;
  if (summary) {
    m_state.summary = tr("Ended after %1: %2 turns, %3 without the controller; the offset is back at 0.")
                          .arg(ui::durationText(m_state.running_s))
                          .arg(summary->turns)
                          .arg(summary->lost_turns);
  }
  refresh();
}

Presenter::Standing CompensatorPresenter::standing() const {
  return {m_running ? m_state.doing : tr("When needed")};
}

void CompensatorPresenter::refresh() {
  ui::CompensatorState state = m_state;
  if (bench().job() == nullptr || !bench().has("model")) {
    state.blocked = tr("Fit a model first: it says from the temperatures what to compensate.");
  } else if (!bench().profile() || (!m_running && !bench().connected())) {
    state.blocked = tr("Connect the machine first.");
  }
  const auto held = bench().heldTable();
  if (held == HeldTable::own || held == HeldTable::another) {
    state.notNow = tr("The controller holds a table of its own: roll it back in Upload first.");
  }
  if (const auto& profile = bench().profile()) state.limit_um = profile->max_um;
  m_page->setState(state);
}

}  // namespace zerodrift::desktop
