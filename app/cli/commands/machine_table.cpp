// push, read-back, rollback: the table in the controller.

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "app/cli/access.h"
#include "app/cli/consent.h"
#include "core/base/time_text.h"
#include "core/controller/rollback.h"
#include "core/controller/table_words.h"
#include "core/flow/steps/upload_step.h"

namespace zerodrift::cli {
namespace machine_table_command {

using controller::TableOrigin;
using controller::UploadOptions;
using controller::UploadRecord;

struct Options {
  std::shared_ptr<PinOption> push_pin;
  std::shared_ptr<PinOption> rollback_pin;
  std::string profile;
  std::string table;
  std::string out;
  std::optional<int> to;
  bool list = false;
  bool dry_run = false;
  bool yes = false;
};

/// A dry run only reads.
Result<access::Permit> permit_for(const Options& options, const PinOption& pin, const std::string& operation) {
  if (options.dry_run) return access::Permit::read_only();
  return engineer(pin, operation);
}

using Transaction = std::function<UploadRecord(const UploadOptions&)>;

/// Preview, question, then the transaction.
Result<UploadRecord> confirmed(const std::string& operation, const Options& options, access::Permit permit,
                               const Transaction& transaction) {
  flow::UploadPreview preview;
  if (options.dry_run || !options.yes) {
    UploadOptions dry;
    dry.dry_run = true;
    preview.record = transaction(dry);
    if (!preview.record.result) return fail(preview.record.result.error());
    if (options.dry_run) return preview.record;
  }
  const flow::WriteQuestion question{operation, flow::machine_text(preview.record.machine, preview.record.serial),
                                     &preview};
  ZD_TRY(const auto write, flow::MachineWrite::begin(nullptr, permit, consent_of(options.yes), question));
  UploadOptions upload;
  upload.observer = [](const controller::UploadStep& step) {
    if (::isatty(STDERR_FILENO) != 0) std::fprintf(stderr, "\r%-40s", std::string(name_of(step.state)).c_str());
  };
  UploadRecord record;
  ZD_CHECK(write.write({}, [&]() -> Status {
    record = transaction(upload);
    return record.result;
  }));
  return record;
}

CommandOutput output_of(const UploadRecord& record, const controller::ModbusMachine& machine,
                        std::vector<std::string> warnings) {
  CommandOutput output;
  output.json = to_json(record);
  output.text = text_of(record);
  output.warnings = std::move(warnings);
  for (const auto& more : {record.warnings, machine.health().remarks}) {
    output.warnings.insert(output.warnings.end(), more.begin(), more.end());
  }
  return output;
}

Result<CommandOutput> push(const Options& options, const TaskContext& context) {
  std::vector<std::string> warnings;
  ZD_TRY(const controller::Profile profile, controller::read_profile(options.profile, &warnings));
  ZD_TRY(const compensation::Table table, compensation::read_table_file(options.table, &warnings));
  ZD_TRY(const auto permit, permit_for(options, *options.push_pin, "Writing the table into the controller"));
  ZD_TRY(const auto machine, controller::ModbusMachine::open(profile, permit));
  const auto record =
      confirmed("Writing the table into the controller", options, permit, [&](const UploadOptions& how) {
        return controller::push_table(*machine, table, controller::TableOrigin::upload, how, context);
      });
  if (!record) return fail(record.error());
  return output_of(*record, *machine, std::move(warnings));
}

Result<CommandOutput> read_back(const Options& options, const TaskContext&) {
  CommandOutput output;
  ZD_TRY(const controller::Profile profile, controller::read_profile(options.profile, &output.warnings));
  ZD_TRY(const auto machine, controller::ModbusMachine::open(profile));
  ZD_TRY(const auto identity, machine->identify());
  ZD_CHECK(controller::require_table(identity));
  ZD_TRY(const controller::ActiveTable active, controller::read_active(*machine));
  ZD_TRY(compensation::Table table, controller::decode_table(active.words, profile));
  table.version = active.sequence;
  table.serial = identity.serial;
  ZD_CHECK(compensation::write_table_file(options.out, table));
  output.json = {{"version", active.sequence},
                 {"crc32", fmt::format("{:08x}", active.crc)},
                 {"registers", active.words.size()},
                 {"words", active.words},
                 {"table", compensation::to_json(table)}};
  output.text =
      fmt::format("version {}, {} registers, CRC {:08x}, axes:", active.sequence, active.words.size(), active.crc);
  for (const auto& [name, axis] : table.axes) {
    output.text += fmt::format(" {} ({} terms, {} points)", name, axis.terms.size(), axis.points.size());
  }
  return output;
}

/// One line of the log: "* 3  2026-11-21T13:00:12.250Z  ann  rollback to version 1, 48 registers".
std::string line_of(const controller::TableEntry& entry, const controller::TableLog& log, bool active) {
  std::string how(name_of(entry.origin));
  const controller::TableEntry* of = entry.of.empty() ? nullptr : log.find(entry.of);
  if (of != nullptr)
    how += fmt::format(" {} version {}", entry.origin == TableOrigin::rollback ? "to" : "of", of->version);
  if (entry.words) how += fmt::format(", {} registers", entry.words->size());
  if (!entry.words) how += ", only its check sum is known";
  return fmt::format("{} {:>5}  {:24}  {:12}  {}", active ? '*' : ' ', entry.version,
                     entry.time.empty() ? "-" : entry.time, entry.who.empty() ? "-" : entry.who, how);
}

/// Everything that was ever active, the active one last and marked; nothing is written.
Result<CommandOutput> list_tables(controller::ModbusMachine& machine, std::vector<std::string> warnings) {
  ZD_TRY(const auto identity, machine.identify());
  ZD_TRY(const auto before, controller::TableHistory().read(identity.serial));
  ZD_TRY(const auto active, controller::read_active(machine));
  const controller::TableLog log = with_active(before, active, to_text(SystemClock().utc()));
  CommandOutput output;
  output.warnings = std::move(warnings);
  if (log.damaged_lines > 0) {
    output.warnings.push_back(fmt::format("{} damaged lines of the history were left out", log.damaged_lines));
  }
  output.json = nlohmann::json::array();
  for (const auto& entry : log.entries) {
    const bool last = &entry == &log.entries.back();
    const auto* of = log.find(entry.of);
    output.json.push_back({{"version", entry.version},
                           {"time", entry.time},
                           {"who", entry.who},
                           {"kind", name_of(entry.origin)},
                           {"of_version", of == nullptr ? nlohmann::json() : nlohmann::json(of->version)},
                           {"registers", entry.words ? nlohmann::json(entry.words->size()) : nlohmann::json()},
                           {"crc32", fmt::format("{:08x}", entry.crc)},
                           {"note", entry.note},
                           {"active", last}});
    output.text += (output.text.empty() ? "" : "\n") + line_of(entry, log, last);
  }
  return output;
}

Result<CommandOutput> rollback(const Options& options, const TaskContext& context) {
  std::vector<std::string> warnings;
  ZD_TRY(const controller::Profile profile, controller::read_profile(options.profile, &warnings));
  const auto permit = options.list ? access::Permit::read_only()
                                   : permit_for(options, *options.rollback_pin, "Going back to a former table");
  if (!permit) return fail(permit.error());
  ZD_TRY(const auto machine, controller::ModbusMachine::open(profile, *permit));
  if (options.list) return list_tables(*machine, std::move(warnings));
  ZD_TRY(const auto target, controller::rollback_target(*machine, {options.to, ""}));
  const std::string since = target.table.time.empty() ? "" : fmt::format(" of {}", target.table.time);
  ZD_TRY(const UploadRecord record,
         confirmed(fmt::format("Going back to version {}{}", target.table.version, since), options, *permit,
                   [&](const UploadOptions& how) { return controller::roll_back(*machine, target, how, context); }));
  CommandOutput output = output_of(record, *machine, std::move(warnings));
  output.json["rolled_back_to"] = target.table.version;
  return output;
}

}  // namespace machine_table_command

void add_machine_table(Cli& cli) {
  using namespace machine_table_command;
  auto options = std::make_shared<Options>();
  const auto with_profile = [&](CLI::App* command) {
    command->add_option("--profile", options->profile, "Connection profile")->required();
  };
  CLI::App* command = cli.add("push", "Write a table into the controller, as a transaction",
                              [options](const TaskContext& context) { return push(*options, context); });
  with_profile(command);
  options->push_pin = add_pin_option(*command);
  command->add_option("--table", options->table, "Table to write")->required();
  command->add_flag("--dry-run", options->dry_run, "Check and compare only; write nothing");
  command->add_flag("--yes", options->yes, "Do not ask");

  command = cli.add("read-back", "Read the active table out of the controller",
                    [options](const TaskContext& context) { return read_back(*options, context); });
  with_profile(command);
  command->add_option("--out", options->out, "Table file to write")->required();

  command = cli.add("rollback", "Bring a former table back: the one before the active one, or the one chosen",
                    [options](const TaskContext& context) { return rollback(*options, context); });
  with_profile(command);
  options->rollback_pin = add_pin_option(*command);
  command->add_option("--to", options->to, "Version to go back to")->check(CLI::Range(0, 65535));
  command->add_flag("--list", options->list, "List everything that was ever active, with versions; write nothing");
  command->add_flag("--dry-run", options->dry_run, "Check and compare only; write nothing");
  command->add_flag("--yes", options->yes, "Do not ask");
}

}  // namespace zerodrift::cli
