// access: the engineer's PIN on this computer. audit: the trail of a job, verified.

#include "app/cli/access.h"

#include <fmt/format.h>

#include "core/commissioning/audit_words.h"
#include "core/commissioning/job.h"

namespace zerodrift::cli {
namespace access_command {

using nlohmann::json;

struct Options {
  std::string action;
  std::string new_pin_file;
  double idle_s = access::default_idle_lock_s;
  std::string job;
};

json state_of(const access::Access& access) {
  return {{"file", access::access_file().string()},
          {"pin", access.has_pin()},
          {"role", access::name_of(access.role())},
          {"idle_lock_s", access.idle_lock_s()}};
}

Result<CommandOutput> run(const Options& options, const PinOption& pin_option) {
  access::Access access(access::access_file());
  std::string old_pin;
  if (options.action != "show" && access.has_pin()) {
    ZD_TRY(old_pin, pin_from(pin_option.file, "PIN of the engineer: ", "Changing the access"));
  }
  if (options.action == "set-pin") {
    ZD_TRY(const std::string pin, pin_from(options.new_pin_file, "New PIN: ", "Setting a PIN"));
    ZD_CHECK(access.set_pin(old_pin, pin));
  } else if (options.action == "clear-pin") {
    ZD_CHECK(access.clear_pin(old_pin));
  } else if (options.action == "idle") {
    ZD_CHECK(access.set_idle_lock(old_pin, options.idle_s));
  }
  CommandOutput output;
  const access::Access now(access::access_file());
  output.json = state_of(now);
  output.text =
      now.has_pin()
          ? fmt::format("writing to a machine needs the PIN; locked after {:.0f} s without a touch\nkept in {}",
                        now.idle_lock_s(), access::access_file().string())
          : "no PIN is set: whoever uses this computer works as engineer";
  return output;
}

Result<CommandOutput> audit(const Options& options) {
  CommandOutput output;
  ZD_TRY(const auto job, commissioning::Job::open_read_only(options.job));
  ZD_TRY(const auto trail, job.audit_trail());
  ZD_CHECK(job.verify_audit());
  ZD_TRY(const auto whole, job.check());
  if (!whole.ok()) return fail(whole.problems.front());
  json rows = json::array();
  for (const auto& entry : trail) {
    rows.push_back({{"id", entry.id},
                    {"utc", entry.utc},
                    {"engineer", entry.engineer},
                    {"machine", entry.machine},
                    {"action", entry.action},
                    {"subject", entry.subject},
                    {"old", entry.old_value},
                    {"new", entry.new_value},
                    {"result", entry.result},
                    {"sha256", entry.hash}});
    output.text += fmt::format("{:>4}  {}  {}: {} {} ({} -> {}): {}\n", entry.id, entry.utc,
                               entry.engineer.empty() ? "-" : entry.engineer, entry.action, entry.subject,
                               commissioning::value_in_short(entry.old_value),
                               commissioning::value_in_short(entry.new_value), entry.result);
  }
  const std::string last = trail.empty() ? std::string() : trail.back().hash;
  output.text += trail.empty() ? "the audit trail is empty"
                               : fmt::format("{} entries, none changed, removed or inserted; last hash {}",
                                             trail.size(), last.substr(0, 16));
  output.json = {{"whole", true}, {"entries", rows}, {"last_sha256", last}};
  return output;
}

}  // namespace access_command

void add_access(Cli& cli) {
  using namespace access_command;
  auto options = std::make_shared<Options>();
  auto pin = std::make_shared<std::shared_ptr<PinOption>>();
  auto* command = cli.add("access", "Who may write to machines from this computer: the engineer's PIN",
                          [options, pin](const TaskContext&) { return run(*options, **pin); });
  command->add_option("action", options->action, "show, set-pin, clear-pin or idle")
      ->required()
      ->check(CLI::IsMember({"show", "set-pin", "clear-pin", "idle"}));
  command->add_option("--new-pin-file", options->new_pin_file, "set-pin: file with the new PIN");
  command->add_option("--seconds", options->idle_s, "idle: lock after so long without a touch");
  *pin = add_pin_option(*command);

  command = cli.add("audit", "Every write to the machine that a job knows of; fails when the trail was tampered with",
                    [options](const TaskContext&) { return audit(*options); });
  command->add_option("--job", options->job, "Job file")->required();
}

}  // namespace zerodrift::cli
