// import: any logger's file to a recording in the contract's form, with the fate of each of its columns.

#include <fmt/format.h>

#include <filesystem>

#include "app/cli/job_file.h"
#include "app/cli/recording_input.h"
#include "app/text/error_text.h"
#include "core/base/error_json.h"
#include "core/base/json.h"
#include "core/commissioning/job_kind.h"
#include "core/flow/flow.h"
#include "core/flow/steps/import_step.h"
#include "core/flow/steps/recordings_step.h"
#include "core/recording/csv.h"

namespace zerodrift::cli {
namespace import_command {

struct Options {
  std::string file;
  std::string map;
  std::string save_map;
  std::string sheet;
  std::string out;
  std::string job;
  std::string role;
};

std::string fate_text(const recording::ColumnFate& fate) {
  std::string text = fmt::format("\n  #{} {:<24} ", fate.place, fate.name.empty() ? "(no name)" : fate.name);
  if (fate.fate != "channel") return text + fate.fate;
  text += fate.channel;
  if (fate.scale != 1.0 || fate.offset != 0.0) {
    text += fmt::format(" = {:g} x {:+g}", fate.scale, fate.offset);
  }
  if (!fate.unit.empty()) text += fmt::format(", {} by {}", fate.unit, fate.unit_from);
  return text;
}

std::string text_of(const recording::Imported& imported, const std::string& target) {
  std::string text = fmt::format("{}: {} rows, {}", target, imported.recording.rows(), imported.form.encoding);
  if (!imported.form.separator.empty()) text += ", separated by " + imported.form.separator;
  if (!imported.form.sheet.empty()) text += ", sheet " + imported.form.sheet;
  text += fmt::format(", decimal {}", imported.form.numbers.decimal);
  text += "\ntime: " + imported.time.rule;
  if (!imported.time.unit.empty()) text += " in " + imported.time.unit;
  if (!imported.time.order.empty()) text += ", " + imported.time.order;
  if (!imported.time.start.empty()) text += ", from " + imported.time.start;
  for (const auto& fate : imported.columns) text += fate_text(fate);
  return text;
}

/// The recording as the job's warm-up run, or beside it where it has a role; the job is made if it is not there.
Status into_job(const Options& options, const recording::Imported& imported, const nlohmann::json& how) {
  ZD_TRY(JobFile file, JobFile::open_or_create(options.job));
  auto& job = file.job();
  if (file.made()) ZD_CHECK(commissioning::set_kind(job, commissioning::JobKind::files));
  const std::string name = std::filesystem::path(options.file).filename().string();
  if (!options.role.empty()) {
    ZD_TRY(const auto role, flow::recording_role_from(options.role));
    const auto add = [&](commissioning::Job& in, const TaskContext&) {
      return flow::add_recording(in, imported.recording, name, role, how);
    };
    return flow::Flow().take_in(job, "recordings", add, {}).map([](const auto&) {});
  }
  const auto take = [&](commissioning::Job& in, const TaskContext&) {
    return flow::import_warmup(in, imported.recording, name, how);
  };
  return flow::Flow().take_in(job, "warmup", take, {}).map([](const auto&) {});
}

Status run(const Options& options, CommandOutput& output) {
  ZD_TRY(recording::HeaderMap map, header_map_from(options.map, output.warnings));
  map.table.sheet = options.sheet;
  ZD_TRY(const recording::Imported imported, recording::import_file(options.file, map));
  output.json = recording::to_json(imported);
  output.json["warnings"] = nlohmann::json::array();
  for (const Error& warning : imported.warnings) {
    nlohmann::json one = to_json(warning);
    one["text"] = lineOf(warning).toStdString();
    output.json["warnings"].push_back(std::move(one));
    output.warnings.push_back(lineOf(warning).toStdString());
  }
  output.text = text_of(imported, options.out.empty() ? options.job : options.out);
  if (!options.job.empty()) {
    nlohmann::json how = output.json;
    how["map"] = recording::map_of(imported, map);
    ZD_CHECK(into_job(options, imported, how));
    output.json["job"] = options.job;
  } else {
    ZD_CHECK(recording::write_recording(options.out, imported.recording));
    output.json["out"] = options.out;
  }
  if (options.save_map.empty()) return {};
  output.json["map"] = options.save_map;
  return write_json_file(options.save_map, recording::map_of(imported, map));
}

}  // namespace import_command

void add_import(Cli& cli) {
  using namespace import_command;
  auto options = std::make_shared<Options>();
  CLI::App& app = *cli.add("import", "Read a logger's file, say what became of each column, write it as a recording",
                           [options](const TaskContext&, CommandOutput& output) { return run(*options, output); });
  app.add_option("FILE", options->file, "Text table of any logger or spreadsheet, or .xlsx")->required();
  add_map_option(app, options->map);
  app.add_option("--save-map", options->save_map, "Header map to write: what was read, to be edited and used again");
  app.add_option("--sheet", options->sheet, "Sheet of a workbook (default: the first)");
  app.add_option("--out", options->out, "Recording to write (CSV)");
  app.add_option("--job", options->job, "Job to put the recording into, made if it is not there");
  app.add_option("--as", options->role,
                 "With --job: beside the warm-up run of the job, instead of in its place: training (fitted too), "
                 "other_day (the fit is tested on it) or cooling; the diagnosis explains all of them together")
      ->check(CLI::IsMember({"training", "other_day", "cooling"}));
  app.parse_complete_callback([options] {
    if (!options->role.empty() && options->job.empty()) throw CLI::RequiredError("--job with --as");
    if (options->out.empty() == options->job.empty()) throw CLI::RequiredError("--out or --job: one of them");
  });
}

}  // namespace zerodrift::cli
