#include "core/flow/live_compensation.h"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/analysis/model.h"
#include "core/compensation/model_table.h"
#include "core/controller/table_words.h"
#include "core/flow/devices.h"
#include "core/flow/machine_write.h"
#include "core/flow/steps/fit_step.h"
#include "core/flow/steps/inputs.h"

namespace zerodrift::flow {

using nlohmann::json;

namespace {

const std::string elsewhere = "the machine is not at the measuring position";
const std::string no_answer = "the controller does not answer";

/// Measures on a thread of its own, with devices of its own: a camera needs longer than a turn of the compensator.
class Watch {
 public:
  Watch(const commissioning::Job& job, const controller::Profile& profile, const LiveOptions& options)
      : m_options(options), m_position_mm(profile.measure_position_mm) {
    const Status opened = open(job, profile);
    if (!opened) {
      m_why = describe(opened.error());
      return;
    }
    m_why = elsewhere;
    m_thread = std::jthread([this](const std::stop_token& stop) { work(stop); });
  }

  /// Where the machine is now; what was measured since the last call.
  void exchange(LiveTurn& turn) {
    const std::scoped_lock lock(m_mutex);
    const bool was_there = m_there;
    m_there = stands_there(turn.turn);
    if (!m_there) ++m_moves;
    if (m_there && !was_there) m_stand = acquisition::standing_now();
    turn.left = std::exchange(m_sample, std::nullopt);
    turn.not_measured = turn.turn.link_lost ? no_answer : m_thread.joinable() && !m_there ? elsewhere : m_why;
    if (m_there) m_arrived.notify_all();
  }

 private:
  Status open(const commissioning::Job& job, const controller::Profile& profile) {
    ZD_TRY(const Input warmup, need(job, "compensator", "warmup"));
    ZD_TRY(m_devices, Devices::open(profile));
    ZD_TRY(m_source, open_error_source(job, m_devices));
    const auto zero = warmup.body.find("zero_um");
    if (zero == warmup.body.end() || !zero->is_array() ||
        !m_source->restore_zero_um(zero->get<std::array<double, 3>>())) {
      return fail(ErrorCode::machine_not_ready,
                  {{"what", m_source->name()}, {"reason", "the zero of the warm-up run cannot be restored"}});
    }
    return {};
  }

  bool stands_there(const controller::CompensatorTurn& turn) const {
    if (turn.link_lost || turn.moving) return false;
    for (const auto& [axis, wanted_mm] : m_position_mm) {
      const auto at = turn.axes.find(axis);
      if (at == turn.axes.end() || !(std::abs(at->second - wanted_mm) <= m_options.there_mm)) return false;
    }
    return true;
  }

  /// On this thread an exception would end the program, and the offset would stay in the machine.
  Result<acquisition::ErrorSample> measure(const acquisition::Stand& stand, const TaskContext& context) {
    try {
      return m_source->measure(stand, context);
    } catch (const std::exception& thrown) {
      return fail(ErrorCode::internal, {{"detail", thrown.what()}});
    }
  }

  void work(const std::stop_token& stop) {
    const TaskContext context{stop, {}};
    std::unique_lock lock(m_mutex);
    while (m_arrived.wait(lock, stop, [this] { return m_there; }) && !stop.stop_requested()) {
      const long moves = m_moves;
      const acquisition::Stand stand = m_stand;
      lock.unlock();
      auto sample = measure(stand, context);
      lock.lock();
      // A machine that moved meanwhile was not measured where it was thought to stand.
      if (sample && moves == m_moves) {
        m_why = sample->problems.empty() ? std::string() : sample->problems.front();
        m_sample = std::move(*sample);
      } else if (!sample) {
        m_why = describe(sample.error());
      }
      const auto rest = std::chrono::duration<double>(m_options.measure_every_s);
      m_arrived.wait_for(lock, stop, rest, [] { return false; });
    }
  }

  LiveOptions m_options;
  std::map<std::string, double> m_position_mm;
  Devices m_devices;
  std::unique_ptr<acquisition::ErrorSource> m_source;
  std::mutex m_mutex;
  std::condition_variable_any m_arrived;
  bool m_there = false;
  acquisition::Stand m_stand;  // since it is there
  long m_moves = 0;            // turns that found it elsewhere
  std::optional<acquisition::ErrorSample> m_sample;
  std::string m_why;
  std::jthread m_thread;  // last: ends before what it uses
};

Result<analysis::Model> running_model(const commissioning::Job& job) {
  ZD_TRY(const auto artefact, job.latest("model"));
  if (!artefact) return fail(ErrorCode::step_blocked, {{"step", "compensator"}, {"needs", "model"}});
  ZD_TRY(auto model, flow::model_of(*artefact));
  if (model.method != analysis::Method::physics) return model;
  return fail(ErrorCode::bad_argument, {{"what", "the job's model"},
                                        {"found", "a physics model, which predicts recordings"},
                                        {"expected", "one that runs sample by sample"}});
}

}  // namespace

Result<controller::CompensatorSummary> compensate_live(commissioning::Job& job, const controller::Profile& profile,
                                                       const LiveOptions& options, const TaskContext& context,
                                                       const std::function<void(const LiveTurn&)>& observer) {
  ZD_TRY(const auto model, running_model(job));
  ZD_TRY(const auto table, compensation::table_from_model(model, controller::table_options(profile)));
  ZD_TRY(const auto machine, controller::ModbusMachine::open(profile, options.permit));
  ZD_TRY(const auto identity, machine->identify());
  ZD_CHECK(same_machine(job, "compensator", identity.serial));
  Watch watch(job, profile, options);
  controller::HostCompensatorOptions how;
  how.period_s = options.period_s;
  how.switch_on = true;
  if (!model.is_static()) how.predictor = compensation::live_predictor(model);

  // It ends with the operation: whoever starts it has given the word for it.
  ZD_TRY(const auto write, MachineWrite::begin(&job, options.permit, Consent::given(),
                                               {"Compensating", machine_text(identity.name, identity.serial)}));
  commissioning::AuditEntry entry;
  entry.action = "compensate from this computer";
  entry.subject = "host offset of X, Y, Z";
  ZD_TRY(const bool was_on, machine->compensation_on());
  entry.old_value = was_on ? "0 um, switch on" : "0 um, switch off";
  entry.new_value = fmt::format("what the model says, at most {:.0f} um, every {} s", profile.max_um, options.period_s);
  controller::CompensatorSummary summary;
  const auto work = [&]() -> Status {
    auto ran = controller::run_host_compensator(*machine, table, how, context, [&](const auto& turn) {
      LiveTurn live{turn, {}, {}};
      watch.exchange(live);
      observer(live);
    });
    if (!ran) return fail(ran.error());
    summary = *ran;
    return {};
  };
  ZD_CHECK(write.write(entry, work));
  return summary;
}

}  // namespace zerodrift::flow
