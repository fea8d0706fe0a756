// compensation: the switch of the compensation, by itself.

#include <fmt/format.h>

#include <optional>

#include "app/cli/access.h"
#include "app/cli/consent.h"
#include "app/cli/operator.h"
#include "core/commissioning/job.h"
#include "core/flow/rollback_and_switch.h"
#include "core/flow/steps/inputs.h"

namespace zerodrift::cli {
namespace compensation_command {

struct Options {
  std::string state;
  std::string profile;
  std::string job;
  std::string person;
  bool yes = false;
};

Result<CommandOutput> run(const Options& options, const PinOption& pin) {
  CommandOutput output;
  const bool on = options.state == "on";
  ZD_TRY(const auto profile, controller::read_profile(options.profile, &output.warnings));
  ZD_TRY(const auto permit, engineer(pin, "Switching the compensation"));
  const flow::Consent consent = consent_of(options.yes);
  ZD_CHECK(consent.possible("Switching the compensation"));
  std::optional<commissioning::Job> job;
  if (!options.job.empty()) {
    ZD_TRY(job, commissioning::Job::open(options.job));
  }
  ZD_TRY(auto person, operator_of(profile, options.person));
  ZD_TRY(auto devices, flow::Devices::open(profile, false, permit, std::move(person)));
  if (job) {
    ZD_TRY(const auto identity, devices.machine->identify());
    ZD_CHECK(flow::same_machine(*job, "upload", identity.serial));
  }
  ZD_TRY(const bool before, devices.machine->compensation_on());
  ZD_TRY(const bool now, flow::switch_compensation(job ? &*job : nullptr, devices, consent, on));
  output.json = {{"compensation_on", now}, {"was_on", before}};
  output.text = fmt::format("compensation {}{}", now ? "on" : "off", now == before ? ", as it was" : "");
  const auto remarks = devices.machine->remarks();
  output.warnings.insert(output.warnings.end(), remarks.begin(), remarks.end());
  return output;
}

}  // namespace compensation_command

void add_compensation(Cli& cli) {
  using namespace compensation_command;
  auto options = std::make_shared<Options>();
  auto pin = std::make_shared<std::shared_ptr<PinOption>>();
  CLI::App* command = cli.add("compensation", "Switch the compensation on or off, and write nothing else",
                              [options, pin](const TaskContext&) { return run(*options, **pin); });
  *pin = add_pin_option(*command);
  command->add_option("state", options->state, "on or off")->required()->check(CLI::IsMember({"on", "off"}));
  command->add_option("profile,--profile", options->profile, "Connection profile of the machine")->required();
  command->add_option("--job", options->job,
                      "Job whose audit trail keeps it; without one the history of the machine's tables does");
  command->add_flag("--yes", options->yes, "Do not ask");
  add_operator_option(*command, options->person);
}

}  // namespace zerodrift::cli
