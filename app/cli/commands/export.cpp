// export: a table in the file of another controller, and what is lost on the way.

#include <fmt/format.h>

#include "app/cli/command.h"
#include "core/base/file.h"
#include "core/controller/exports/export_format.h"

namespace zerodrift::cli {
namespace export_command {

struct Options {
  std::string table;
  std::string format;
  std::string out;
  std::string temperatures;
  bool one_point = false;
  controller::ExportOptions how;
};

/// "T1_C=25.5,T2_C=31"
Result<compensation::Temperatures> temperatures_from(const std::string& text) {
  compensation::Temperatures out;
  for (const auto& pair : names_from(text)) {
    const auto equals = pair.find('=');
    if (equals == std::string::npos) {
      return fail(ErrorCode::bad_argument,
                  {{"what", "--at"}, {"found", pair}, {"expected", "SENSOR=C, for example T3_C=25"}});
    }
    ZD_TRY(const auto value, numbers_from(pair.substr(equals + 1), "--at", 1));
    out[pair.substr(0, equals)] = value.front();
  }
  return out;
}

Result<CommandOutput> run(Options options, const TaskContext&) {
  CommandOutput output;
  ZD_TRY(const auto* format, controller::export_format(options.format));
  ZD_TRY(const auto table, compensation::read_table_file(options.table, &output.warnings));
  ZD_TRY(options.how.temperatures, temperatures_from(options.temperatures));
  ZD_TRY(const auto exported, options.one_point ? controller::write_one_point(*format, table, options.how)
                                                : controller::write_table(*format, table, options.how));
  nlohmann::json files = nlohmann::json::array();
  for (const auto& file : exported.files) {
    ZD_CHECK(write_file(options.out + file.suffix, file.text));
    files.push_back(options.out + file.suffix);
    output.text += fmt::format("written: {}\n", options.out + file.suffix);
  }
  output.text += fmt::format("sign: {}\nlargest difference from the table: {:.3f} um\n", format->capabilities.sign,
                             exported.loss_um);
  for (const auto& loss : exported.losses) output.text += "lost: " + loss + "\n";
  for (const auto& doubt : exported.confirm) {
    output.text +=
        (options.one_point ? "expect: " : "confirm on one point (--one-point) before the rest: ") + doubt + "\n";
  }
  output.text.pop_back();
  output.json = {{"format", format->id},
                 {"files", files},
                 {"sign", format->capabilities.sign},
                 {"loss_um", exported.loss_um},
                 {"losses", exported.losses},
                 {"confirm", exported.confirm}};
  return output;
}

std::vector<std::string> names_of_formats() {
  std::vector<std::string> names;
  for (const auto& format : controller::export_formats()) names.emplace_back(format.id);
  return names;
}

}  // namespace export_command

void add_export(Cli& cli) {
  using namespace export_command;
  auto options = std::make_shared<Options>();
  CLI::App* command = cli.add("export", "Write a table as the file of another controller",
                              [options](const TaskContext& context) { return run(*options, context); });
  command->add_option("--table", options->table, "Table file")->required();
  command
      ->add_option("--format", options->format, "linuxcnc, sinumerik-thermal, sinumerik-leadscrew, fanuc, heidenhain")
      ->required()
      ->check(CLI::IsMember(names_of_formats()));
  command->add_option("--type", options->how.linuxcnc_type, "linuxcnc: 0 actual positions, 1 trims")
      ->check(CLI::IsMember({0, 1}));
  command->add_option("--out", options->out, "File to write; further files get its name and an ending")->required();
  command->add_option("--axis", options->how.axis, "Axis, for formats with one axis a file")
      ->check(CLI::IsMember({"X", "Y", "Z"}));
  command->add_option("--at", options->temperatures,
                      "Temperatures the file holds for, T1_C=25,T2_C=30; default: references");
  command->add_flag("--one-point", options->one_point, "A file that moves the axis at one place by 5 um, to try first");
  command->add_option("--max-points", options->how.max_points, "Points an axis may have on this controller")
      ->check(CLI::Range(4, 100000));
  command->add_flag("--cec", options->how.sinumerik_cec, "sinumerik-leadscrew: two CEC tables, one a direction");
  command->add_option("--unit-um", options->how.fanuc_unit_um, "fanuc: detection unit x magnification, um")
      ->check(CLI::PositiveNumber);
  command->add_option("--reference-mm", options->how.fanuc_reference_mm, "fanuc: position of the reference point");
}

}  // namespace zerodrift::cli
