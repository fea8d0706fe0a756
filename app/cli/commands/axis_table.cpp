// axis-table and axis-apply: the geometric error of an axis from a laser report, and its use.

#include <fmt/format.h>

#include "app/cli/command.h"
#include "core/base/file.h"
#include "core/base/json.h"
#include "core/compensation/axis_map.h"
#include "core/compensation/laser.h"
#include "core/compensation/positioning.h"
#include "core/compensation/segmentation.h"
#include "core/recording/csv.h"

namespace zerodrift::cli {
namespace axis_table_command {

using compensation::Criterion;
using compensation::Segmentation;
using compensation::SegmentationOptions;
using nlohmann::json;

struct TableOptions {
  std::string laser;
  std::string axis;
  std::string criterion = "errors";
  SegmentationOptions segmentation;
  std::vector<std::string> columns;
  std::string map;
  bool negate = false;
  std::size_t max_points = 20000;
  std::string out;
  std::string statistics;
};

struct ApplyOptions {
  std::string table;
  std::string axis;
  std::string direction;
  std::string positions;
  std::string out;
};

json summary(const Segmentation& one) {
  return {{"segments", one.fitted},
          {"pieces", one.segments.size()},
          {"largest_residual_um", one.largest_residual_um},
          {"largest_at_mm", one.largest_at_mm}};
}

Result<std::map<std::string, std::string>> columns_from(const std::vector<std::string>& pairs) {
  std::map<std::string, std::string> out;
  for (const auto& pair : pairs) {
    const auto equals = pair.rfind('=');
    if (equals == std::string::npos) {
      return fail(ErrorCode::bad_argument,
                  {{"what", "--column"}, {"found", pair}, {"expected", "COLUMN=NAME, for example Pos=position_mm"}});
    }
    out[pair.substr(0, equals)] = pair.substr(equals + 1);
  }
  return out;
}

std::string figures_text(const compensation::PositioningFigures& f) {
  const auto um = [](double value) { return std::isfinite(value) ? fmt::format("{:.2f}", value) : std::string("-"); };
  return fmt::format(
      "ISO 230-2 (um): A {} (up {}, down {}), E {} (up {}, down {}), R {} (up {}, down {}), B {} (mean {}), M {}\n"
      "VDI 3441 (um): P {}, Pa {}, Ps max {}, Ps mean {}, U max {}, U mean {}\n",
      um(f.A_um), um(f.A_up_um), um(f.A_down_um), um(f.E_um), um(f.E_up_um), um(f.E_down_um), um(f.R_um), um(f.R_up_um),
      um(f.R_down_um), um(f.B_um), um(f.B_mean_um), um(f.M_um), um(f.P_um), um(f.Pa_um), um(f.Ps_max_um),
      um(f.Ps_mean_um), um(f.U_max_um), um(f.U_mean_um));
}

/// The published rule beside the fewest segments for the same largest residual or the tolerance asked for.
Result<json> compare(const std::vector<double>& x, const std::vector<double>& e, const SegmentationOptions& options,
                     std::string& text) {
  SegmentationOptions published = options;
  if (published.criterion == Criterion::tolerance) published.criterion = Criterion::errors;
  SegmentationOptions optimal = options;
  optimal.criterion = Criterion::tolerance;
  ZD_TRY(const Segmentation rule, segment_errors(x, e, published));
  ZD_TRY(const Segmentation fewest, segment_errors(x, e, optimal));
  text +=
      fmt::format("published rule: {} segments, largest residual {:.3f} um\n", rule.fitted, rule.largest_residual_um);
  text += fmt::format("fewest within {:g} um: {} segments, largest residual {:.3f} um\n", optimal.tolerance_um,
                      fewest.fitted, fewest.largest_residual_um);
  return json{{"published", summary(rule)}, {"optimal", summary(fewest)}};
}

/// What was asked for, else the report's own axis; a report that names none, or another, is taken as X and said so.
std::string axis_of(const TableOptions& options, const std::string& told, std::vector<std::string>& warnings) {
  if (!options.axis.empty()) return options.axis;
  const char letter = told.empty() ? '\0' : static_cast<char>(std::toupper(static_cast<unsigned char>(told.front())));
  if (letter == 'X' || letter == 'Y' || letter == 'Z') return {letter};
  if (!told.empty()) warnings.push_back(fmt::format("the report's axis is \"{}\"; the table is made for X", told));
  return "X";
}

/// What became of each column of the file.
json columns_of(const compensation::LaserReport& report) {
  json list = json::array();
  for (const auto& [column, fate] : report.columns) list.push_back({{"column", column}, {"fate", fate}});
  return list;
}

Result<CommandOutput> make_table(const TableOptions& options) {
  CommandOutput output;
  compensation::LaserOptions how;
  how.negate = options.negate;
  how.max_points = options.max_points;
  how.axis = options.axis;
  ZD_TRY(how.columns, columns_from(options.columns));
  if (!options.map.empty()) {
    ZD_TRY(how.map, recording::read_header_map(options.map, &output.warnings));
  }
  ZD_TRY(const auto report, compensation::read_laser(options.laser, how));
  output.warnings.insert(output.warnings.end(), report.warnings.begin(), report.warnings.end());
  const auto points = compensation::points_of(report);
  std::vector<double> x;
  std::vector<double> e;
  for (const auto& point : points) {
    x.push_back(point.position_mm);
    e.push_back(0.5 * (point.error_up_um + point.error_down_um));
  }
  ZD_TRY(const Segmentation segmentation, segment_errors(x, e, options.segmentation));
  compensation::Table table;
  table.machine = report.machine;
  table.version = 1;
  const std::string axis = axis_of(options, report.axis, output.warnings);
  table.axes[axis].segments = segmentation.segments;
  table.axes[axis].points = points;
  ZD_CHECK(compensation::write_table_file(options.out, table));
  const auto figures = compensation::positioning_figures(report);
  if (!options.statistics.empty()) ZD_CHECK(write_json_file(options.statistics, to_json(figures)));
  output.text = fmt::format("axis {}: {} targets, {} segments, largest residual {:.3f} um at {:g} mm\n", axis, x.size(),
                            segmentation.fitted, segmentation.largest_residual_um, segmentation.largest_at_mm);
  for (const auto& note : segmentation.notes) output.text += note + "\n";
  ZD_TRY(const json comparison, compare(x, e, options.segmentation, output.text));
  output.text += figures_text(figures);
  output.text.pop_back();
  if (options.segmentation.criterion == Criterion::coordinates) output.warnings.push_back(segmentation.notes.front());
  output.json = {{"table", to_json(table)},        {"statistics", to_json(figures)},
                 {"criterion", options.criterion}, {"largest_residual_um", segmentation.largest_residual_um},
                 {"notes", segmentation.notes},    {"comparison", comparison},
                 {"columns", columns_of(report)}};
  return output;
}

/// The column position_mm, or the only one; a file of bare numbers has no header.
Result<std::vector<double>> read_positions(const std::string& file) {
  ZD_TRY(std::string text, read_file(file));
  const auto first = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  const bool bare =
      first != std::string::npos && std::string_view("+-.0123456789").find(text[first]) != std::string_view::npos;
  if (bare) text = "position_mm\n" + text;
  ZD_TRY(const auto table, recording::parse_table(text, file));
  const int column = table.header.size() == 1 ? 0 : table.column("position_mm");
  if (column < 0) {
    return fail(ErrorCode::channel_missing,
                {{"channel", "position_mm"}, {"available", fmt::format("{}", fmt::join(table.header, ", "))}});
  }
  std::vector<double> positions;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    ZD_TRY(const double value, recording::number_in(table, row, column));
    if (!std::isfinite(value)) {
      return fail(
          ErrorCode::csv_bad_number,
          {{"file", file}, {"line", std::to_string(table.lines[row])}, {"column", "position_mm"}, {"found", ""}});
    }
    positions.push_back(value);
  }
  return positions;
}

Result<CommandOutput> apply(const ApplyOptions& options) {
  CommandOutput output;
  ZD_TRY(const auto table, compensation::read_table_file(options.table, &output.warnings));
  std::string available;
  for (const auto& [name, axis] : table.axes) available += (available.empty() ? "" : ", ") + name;
  const std::string name = options.axis.empty() && table.axes.size() == 1 ? table.axes.begin()->first : options.axis;
  if (!table.axes.contains(name)) {
    return fail(ErrorCode::bad_argument,
                {{"what", "--axis"}, {"found", options.axis}, {"expected", "one of the table's axes " + available}});
  }
  ZD_TRY(const auto map, compensation::AxisMap::from(table.axes.at(name)));
  ZD_TRY(const auto positions, read_positions(options.positions));
  std::string csv = "position_mm,input_mm\n";
  json results = json::array();
  for (const double position : positions) {
    const double result = options.direction == "forward" ? map.forward(position) : map.inverse(position);
    csv += recording::number_text(result) + "," + recording::number_text(position) + "\n";
    results.push_back(result);
  }
  ZD_CHECK(write_file(options.out, csv));
  output.json = {{"axis", name}, {"direction", options.direction}, {"position_mm", results}};
  output.text = fmt::format("axis {}, {}: {} positions", name, options.direction, positions.size());
  return output;
}

void add_apply(Cli& cli) {
  auto options = std::make_shared<ApplyOptions>();
  CLI::App* command = cli.add("axis-apply", "Transform positions by an axis table",
                              [options](const TaskContext&) { return apply(*options); });
  command->add_option("--table", options->table, "Table with the axis")->required();
  command
      ->add_option("--direction", options->direction,
                   "forward: encoder -> true coordinate; inverse: true position -> encoder")
      ->required()
      ->check(CLI::IsMember({"forward", "inverse"}));
  command->add_option("--positions", options->positions, "CSV with a column position_mm")->required();
  command->add_option("--out", options->out, "CSV to write: position_mm (the result), input_mm")->required();
  command->add_option("--axis", options->axis, "Axis, when the table has several");
}

}  // namespace axis_table_command

void add_axis_table(Cli& cli) {
  using namespace axis_table_command;
  auto options = std::make_shared<TableOptions>();
  CLI::App* command =
      cli.add("axis-table", "Make an axis table and its figures from a laser report", [options](const TaskContext&) {
        options->segmentation.criterion = options->criterion == "tolerance"     ? Criterion::tolerance
                                          : options->criterion == "coordinates" ? Criterion::coordinates
                                                                                : Criterion::errors;
        return make_table(*options);
      });
  command->add_option("--laser", options->laser, "Laser report: a table (CSV, XLSX ...), .rtl, .REN, .pos")->required();
  command->add_option("--criterion", options->criterion, "When a segment is good: r of errors, of coordinates, or um")
      ->check(CLI::IsMember({"coordinates", "errors", "tolerance"}));
  command->add_option("--threshold", options->segmentation.threshold, "Least |r| of a segment")
      ->check(CLI::Range(0.0, 1.0));
  command->add_option("--start-points", options->segmentation.start_points, "Points a segment begins with")
      ->check(CLI::Range(2, 100000));
  command
      ->add_option("--tolerance-um", options->segmentation.tolerance_um, "Largest residual for the criterion tolerance")
      ->check(CLI::PositiveNumber);
  command->add_option("--out", options->out, "Table file to write")->required();
  command->add_option("--statistics", options->statistics, "JSON to write: ISO 230-2 and VDI 3441 figures");
  command
      ->add_option("--axis", options->axis,
                   "Axis of the report, or which one of a report with several; default: as it says, else X")
      ->check(CLI::IsMember({"X", "Y", "Z"}));
  command->add_option("--column", options->columns, "COLUMN=NAME: read a column of the CSV as another name");
  command->add_option("--map", options->map, "Column map (JSON): what the columns of the file are");
  command->add_option("--max-points", options->max_points, "Most targets an axis may have");
  command->add_flag("--negate", options->negate, "Turn the sign of the report");
  add_apply(cli);
}

}  // namespace zerodrift::cli
