// compensate: the host compensator (C1), until stopped or for a time.

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "app/cli/access.h"
#include "app/cli/service_notice.h"
#include "app/text/error_text.h"
#include "core/analysis/model.h"
#include "core/base/real_time.h"
#include "core/base/write_failure.h"
#include "core/compensation/model_table.h"
#include "core/controller/host_compensator.h"
#include "core/controller/table_words.h"

namespace zerodrift::cli {
namespace compensate_command {

struct Options {
  std::string profile;
  std::string model;
  double seconds = 0.0;
  double period_s = 0.5;
  bool switch_on = false;
  std::string log;
};

class Log {
 public:
  Status open(const std::string& file) {
    if (file.empty()) return {};
    m_stream.open(file);
    if (!m_stream) return fail(write_failure(file, errno));
    m_stream << "time_s,predicted_X_um,predicted_Y_um,predicted_Z_um,offset_X_um,offset_Y_um,offset_Z_um,"
                "applied_X_um,applied_Y_um,applied_Z_um,mode\n";
    return {};
  }
  void add(const controller::CompensatorTurn& turn) {
    if (!m_stream.is_open() || turn.link_lost || !std::isfinite(turn.machine_time_s)) return;
    m_stream << fmt::format("{:.2f},{:.3f},{:.3f},{:.3f},{}\n", turn.machine_time_s,
                            fmt::join(turn.output.predicted_um, ","), fmt::join(turn.output.offset_um, ","),
                            fmt::join(turn.applied_um, ","), static_cast<int>(turn.output.mode))
             << std::flush;
  }

 private:
  std::ofstream m_stream;
};

/// Says each reason once while it lasts, and each remark on the link once.
class Speaker {
 public:
  explicit Speaker(const controller::LinkHealth& health) : m_health(health) {}

  void hear(const controller::CompensatorTurn& turn) {
    std::vector<std::string> reasons = turn.output.reasons;
    if (turn.fault) {
      reasons.push_back(textOf(*turn.fault).sentence.toStdString() +
                        " The controller's watchdog takes the offset out.");
    }
    std::vector<std::string> kinds;
    for (const auto& reason : reasons) kinds.push_back(reason.substr(0, 12));  // without the changing figures
    if (turn.fault) kinds.emplace_back(name_of(turn.fault->code));
    if (kinds != m_last) {
      for (const auto& reason : reasons) std::fprintf(stderr, "%s\n", reason.c_str());
    }
    m_last = std::move(kinds);
    for (; m_remarks < m_health.remarks.size(); ++m_remarks) {
      std::fprintf(stderr, "warning: %s\n", m_health.remarks[m_remarks].c_str());
    }
  }

 private:
  const controller::LinkHealth& m_health;
  std::vector<std::string> m_last;
  std::size_t m_remarks = 0;
};

/// Under systemd: ready with the first turn that reached the machine, alive with every turn - also one that did not,
/// for then it is the machine that is gone - and what it does, in words, when that changes.
class Service {
 public:
  void hear(const controller::CompensatorTurn& turn) {
    const std::string status = status_of(turn);
    std::string lines = "WATCHDOG=1";
    if (!turn.link_lost && !m_ready) lines += "\nREADY=1";
    if (status != m_status) lines += "\nSTATUS=" + status;
    m_ready = m_ready || !turn.link_lost;
    m_status = status;
    m_notice.say(lines);
  }
  ~Service() { m_notice.say("STOPPING=1"); }

 private:
  static std::string status_of(const controller::CompensatorTurn& turn) {
    if (turn.link_lost) return "no answer from the controller";
    if (!turn.switch_on) return "the compensation switch is off";
    switch (turn.output.mode) {
      case compensation::FollowerMode::following:
        return "compensating";
      case compensation::FollowerMode::held_at_edge:
        return "compensating, held at the edge of the training range";
      case compensation::FollowerMode::safe_zero:
        return "the offset runs to 0: a sensor is dead";
      case compensation::FollowerMode::stopping:
        return "ending: the offset runs to 0";
    }
    return {};
  }

  ServiceNotice m_notice;
  std::string m_status;
  bool m_ready = false;
};

Result<CommandOutput> run(const Options& options, const PinOption& pin, const TaskContext& context) {
  CommandOutput output;
  ZD_TRY(const controller::Profile profile, controller::read_profile(options.profile, &output.warnings));
  ZD_TRY(const analysis::Model model, analysis::read_model(options.model, &output.warnings));
  if (model.method == analysis::Method::physics) {
    return fail(ErrorCode::bad_argument, {{"what", "--model"},
                                          {"found", "a physics model, which predicts recordings"},
                                          {"expected", "a model of another method (fit --method auto)"}});
  }
  ZD_TRY(const auto table, compensation::table_from_model(model, controller::table_options(profile)));
  ZD_TRY(const auto permit, engineer(pin, "Compensating"));
  ZD_TRY(const auto machine, controller::ModbusMachine::open(profile, permit));
  Log log;
  ZD_CHECK(log.open(options.log));
  controller::HostCompensatorOptions how;
  how.period_s = options.period_s;
  how.switch_on = options.switch_on;
  if (options.seconds > 0.0) how.duration_s = options.seconds;
  if (!model.is_static()) how.predictor = compensation::live_predictor(model);
  const bool real_time = ask_for_real_time();
  Speaker speaker(machine->health());
  Service service;
  ZD_TRY(const auto summary, controller::run_host_compensator(*machine, table, how, context, [&](const auto& turn) {
           log.add(turn);
           speaker.hear(turn);
           service.hear(turn);
         }));
  output.json = {{"turns", summary.turns},
                 {"late_turns", summary.late_turns},
                 {"lost_turns", summary.lost_turns},
                 {"largest_jitter_s", summary.lateness.largest_s()},
                 {"jitter_p50_s", summary.lateness.quantile_s(0.5)},
                 {"jitter_p99_s", summary.lateness.quantile_s(0.99)},
                 {"jitter_p999_s", summary.lateness.quantile_s(0.999)},
                 {"turns_later_than_20_ms", summary.lateness.above(0.02)},
                 {"largest_offset_um", summary.largest_offset_um},
                 {"real_time", real_time},
                 {"faults", machine->health().faults},
                 {"remarks", machine->health().remarks}};
  output.text = fmt::format(
      "{} turns, {} late, {} without the machine; began at most {:.1f} ms late, 99.9 % within {:.0f} ms; the offset is "
      "back at 0",
      summary.turns, summary.late_turns, summary.lost_turns, 1e3 * summary.lateness.largest_s(),
      1e3 * summary.lateness.quantile_s(0.999));
  return output;
}

}  // namespace compensate_command

void add_compensate(Cli& cli) {
  using namespace compensate_command;
  auto options = std::make_shared<Options>();
  auto pin = std::make_shared<std::shared_ptr<PinOption>>();
  CLI::App* command =
      cli.add("compensate", "Compensate from this computer: read temperatures, predict, write the offset",
              [options, pin](const TaskContext& context) { return run(*options, **pin, context); });
  *pin = add_pin_option(*command);
  command->add_option("--profile", options->profile, "Connection profile")->required();
  command->add_option("--model", options->model, "Model file of the fit")->required();
  command->add_option("--for", options->seconds, "Seconds to run; without it until stopped")
      ->check(CLI::PositiveNumber);
  command->add_option("--period", options->period_s, "Seconds between two turns")->check(CLI::Range(0.02, 10.0));
  command->add_flag("--switch-on", options->switch_on,
                    "Switch the compensation on first and off at the end; otherwise it must be on");
  command->add_option("--log", options->log, "CSV to write: what was predicted, written and applied");
}

}  // namespace zerodrift::cli
