// table: the controller's table from a model and axis tables.

#include <fmt/format.h>

#include "app/cli/command.h"
#include "core/compensation/model_table.h"
#include "core/controller/table_words.h"

namespace zerodrift::cli {
namespace table_command {

struct Options {
  std::string model;
  std::vector<std::string> axis_tables;
  std::string profile;
  std::string out;
};

Result<CommandOutput> run(const Options& options, const TaskContext&) {
  CommandOutput output;
  ZD_TRY(const controller::Profile profile, controller::read_profile(options.profile, &output.warnings));
  if (options.model.empty() && options.axis_tables.empty()) {
    return fail(ErrorCode::bad_argument,
                {{"what", "--model"}, {"found", "nothing"}, {"expected", "a model of the fit, or an --axis-table"}});
  }
  const auto made_for = controller::table_options(profile);
  compensation::Table table{made_for.machine, made_for.serial, 1, {}, {}};
  if (!options.model.empty()) {
    ZD_TRY(const analysis::Model model, analysis::read_model(options.model, &output.warnings));
    ZD_TRY(table, compensation::table_from_model(model, made_for, &output.warnings));
  }
  for (const auto& file : options.axis_tables) {
    ZD_TRY(const auto axis_table, compensation::read_table_file(file, &output.warnings));
    ZD_CHECK(compensation::add_axis_table(table, axis_table, made_for));
  }
  // What the controller could not take is said now, not at the upload.
  ZD_TRY(const auto words, controller::encode_table(table, profile));
  ZD_CHECK(compensation::write_table_file(options.out, table));
  output.json = compensation::to_json(table);
  for (const auto& [name, axis] : table.axes) {
    output.text += fmt::format("axis {}: offset {:+.2f} um", name, axis.offset_um);
    for (const auto& term : axis.terms) {
      output.text += fmt::format(", {:+.3f} um/K x ({} - {:.2f} C)", term.um_per_K, term.sensor, term.reference_C);
    }
    if (!axis.points.empty()) output.text += fmt::format(", {} points", axis.points.size());
    output.text += "\n";
  }
  output.text += fmt::format("{} registers", words.size());
  return output;
}

}  // namespace table_command

void add_table(Cli& cli) {
  using namespace table_command;
  auto options = std::make_shared<Options>();
  CLI::App* command = cli.add("table", "Make the controller's table from a model and axis tables",
                              [options](const TaskContext& context) { return run(*options, context); });
  command->add_option("--model", options->model, "Model file of the fit; may be absent where an axis table is given");
  command->add_option("--axis-table", options->axis_tables, "Axis table to add; may be given several times");
  command->add_option("--profile", options->profile, "Connection profile")->required();
  command->add_option("--out", options->out, "Table file to write")->required();
}

}  // namespace zerodrift::cli
