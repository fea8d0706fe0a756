// Fanuc pitch error compensation: increments per interval in detection units, summed by the control from the reference
// point. Point n stands for the interval below it, (n - reference - 1) to (n - reference) intervals from the reference.
// Increments of -error are written; what rounding leaves is carried to the next point, so that no error adds up.
// Parameters: 3620 reference point, 3621 lowest, 3622 highest, 3623 magnification, 3624 interval. Needs power-off and
// homing.

#include <fmt/format.h>

#include <cmath>

#include "core/controller/exports/export_tools.h"
#include "core/controller/exports/formats.h"

namespace zerodrift::controller::exports {
namespace {

using compensation::Table;

constexpr int pitch_offset = 10000;  // N10040 is point 40
constexpr int most_points = 10000;   // of any series; a file that claims more is none
constexpr int first_gap = 10;        // free points between two axes
constexpr int largest_old_increment = 7;

int axis_number(const std::string& name) {
  return name == "X" ? 1 : name == "Y" ? 2 : 3;
}

struct Layout {
  Grid grid;
  int reference_index = 0;  // of the grid
  int reference_point = 0;  // parameter 3620
  int lowest = 0;           // 3621
  int highest = 0;          // 3622
};

Layout layout_of(const std::vector<double>& knots, int limit, const ExportOptions& options, int first_free) {
  const double reference_mm = options.fanuc_reference_mm;
  Layout layout;
  layout.grid = grid_for(knots, limit, reference_mm);
  layout.reference_index = static_cast<int>(std::lround((reference_mm - layout.grid.start_mm) / layout.grid.step_mm));
  layout.reference_point = std::max(options.fanuc_reference_point, first_free + layout.reference_index - 1);
  layout.lowest = layout.reference_point - layout.reference_index + 1;
  layout.highest = layout.reference_point + layout.grid.count - 1 - layout.reference_index;
  return layout;
}

/// Compensation in whole units at each grid position, 0 at the reference; differences are the increments.
std::vector<long> steps_of(const Curve& curve, int reference, double unit_um) {
  std::vector<long> steps;
  for (std::size_t i = 0; i < curve.x_mm.size(); ++i) {
    steps.push_back(std::lround(-(curve.mean(i) - curve.mean(static_cast<std::size_t>(reference))) / unit_um));
  }
  return steps;
}

struct AxisFile {
  int reference = 0;
  int lowest = 0;
  int highest = 0;
  double interval_mm = 0.0;

  /// Points of the control's list, in order, with the reference among them or just before them.
  bool possible() const {
    return lowest >= -most_points && highest <= most_points && lowest <= highest + 1 && reference >= lowest - 1 &&
           reference <= highest;
  }
};

Result<Table> read_fanuc(std::string_view text, const ExportOptions& options) {
  std::map<int, long> increments;
  std::map<std::string, AxisFile> axes;
  for (const std::string_view line : lines_of(text)) {
    if (!line.starts_with("N")) continue;
    const int number = whole_after(line.substr(0, line.find(' ')), "N").value_or(0);
    const auto value = whole_after(line, "P");
    if (!value) return unreadable("fanuc", line, "a whole number after P");
    if (number >= pitch_offset) {
      increments[number - pitch_offset] = *value;
      continue;
    }
    const int axis = whole_after(line, "A").value_or(0);
    if (axis < 1 || axis > 3) return unreadable("fanuc", line, "a parameter with axis A1 to A3");
    AxisFile& file = axes[std::string(1, "XYZ"[axis - 1])];
    if (number == 3620) file.reference = *value;
    if (number == 3621) file.lowest = *value;
    if (number == 3622) file.highest = *value;
    if (number == 3624) file.interval_mm = 1e-3 * *value;
  }
  if (axes.empty()) return unreadable("fanuc", text.substr(0, 40), "parameters 3620 to 3624");
  Table table;
  for (const auto& [name, file] : axes) {
    if (!file.possible()) {
      return unreadable("fanuc", fmt::format("reference point {}", file.reference), "one between lowest and highest");
    }
    std::vector<double> x;
    std::vector<double> um;
    long sum = 0;
    std::vector<long> sums = {0};
    for (int point = file.lowest; point <= file.highest; ++point) sums.push_back(sum += increments[point]);
    const int reference_index = file.reference - file.lowest + 1;
    const double reference_mm = options.fanuc_reference_mm;
    for (int i = 0; i < static_cast<int>(sums.size()); ++i) {
      x.push_back(reference_mm + file.interval_mm * (i - reference_index));
      um.push_back(-options.fanuc_unit_um * static_cast<double>(sums[static_cast<std::size_t>(i)] -
                                                                sums[static_cast<std::size_t>(reference_index)]));
    }
    table.axes[name] = axis_from(x, um, um);
  }
  return checked("fanuc", std::move(table));
}

/// Parameters and increments of one axis; the same as a G10 program.
void write_axis(const std::string& name, const Layout& layout, const std::vector<long>& steps, std::string& text,
                std::string& program) {
  const int axis = axis_number(name);
  const std::vector<std::pair<int, long>> parameters = {{3620, layout.reference_point},
                                                        {3621, layout.lowest},
                                                        {3622, layout.highest},
                                                        {3624, std::lround(1000.0 * layout.grid.step_mm)}};
  for (const auto& [number, value] : parameters) {
    text += fmt::format("N{:05} Q1 A{} P{}\n", number, axis, value);
    program += fmt::format("N{} P{} R{}\n", number, axis, value);
  }
  for (std::size_t i = 1; i < steps.size(); ++i) {
    const int point = layout.lowest + static_cast<int>(i) - 1 + pitch_offset;
    text += fmt::format("N{} Q0 P{}\n", point, steps[i] - steps[i - 1]);
    program += fmt::format("N{} R{}\n", point, steps[i] - steps[i - 1]);
  }
}

void tell(const std::string& name, const Layout& layout, const std::vector<long>& steps, double at_reference_um,
          Exported& out) {
  long largest = 0;
  for (std::size_t i = 1; i < steps.size(); ++i) largest = std::max(largest, std::abs(steps[i] - steps[i - 1]));
  if (largest > largest_old_increment) {
    out.losses.push_back(
        fmt::format("axis {}: an increment of {} units; older series take no more than 7", name, largest));
  }
  if (std::abs(at_reference_um) > 1e-3) {
    out.losses.push_back(
        fmt::format("axis {}: the error of {:.2f} um at the reference point shifts the whole axis and is left out",
                    name, at_reference_um));
  }
  if (layout.highest > 1023) {
    out.losses.push_back(fmt::format("axis {}: points up to {}; many controls end at 1023", name, layout.highest));
  }
}

Result<Exported> write_fanuc(const Table& table, const ExportOptions& options) {
  const ExportFormat self = fanuc();
  const auto state = state_of(table, options);
  Exported out;
  std::string text = "%\n";
  std::string program = "%\nO9000 (ERROR = ACTUAL - COMMANDED. WRITTEN: INCREMENTS OF -ERROR)\nG10 L50\n";
  std::vector<std::string> written;
  int first_free = 0;
  for (const auto& [name, axis] : table.axes) {
    if (axis.points.size() < 2 || (!options.axis.empty() && options.axis != name)) continue;
    ZD_TRY(const auto knots, knots_of(name, axis));
    Layout layout = layout_of(knots, limit_of(self, options), options, first_free);
    // The interval is a parameter in whole micrometres: a resampled grid takes the next larger one.
    const double step_mm = 1e-3 * std::ceil(1e3 * layout.grid.step_mm - 1e-6);
    layout.grid.start_mm += layout.reference_index * (layout.grid.step_mm - step_mm);
    layout.grid.step_mm = step_mm;
    ZD_TRY(const Curve curve, curve_at(axis, layout.grid.positions(), state));
    const auto steps = steps_of(curve, layout.reference_index, options.fanuc_unit_um);
    write_axis(name, layout, steps, text, program);
    tell(name, layout, steps, curve.mean(static_cast<std::size_t>(layout.reference_index)), out);
    tell_directions(curve, name, "the backlash parameter 1851", out);
    tell_temperature(axis, name, state, out);
    written.push_back(name);
    first_free = layout.highest + first_gap;
  }
  if (written.empty()) {
    return fail(ErrorCode::not_enough_data, {{"what", "axes with position points"}, {"found", "0"}, {"needed", "1"}});
  }
  out.files.push_back({"", text + "%\n"});
  out.files.push_back({".G10", program + "G11\nM30\n%\n"});
  out.confirm.emplace_back("the sign, with a single point of +1 unit before the rest");
  out.confirm.emplace_back(
      "axes X, Y, Z are numbers 1, 2, 3; the parameter lines (Q1) and the G10 form on this series");
  ZD_CHECK(measure_loss(self, table, options, written, out));
  return out;
}

}  // namespace

ExportFormat fanuc() {
  return {"fanuc",
          {.equidistant = true,
           .two_directions = false,
           .increments = true,
           .max_points = 128,
           .resolution_um = 1.0,
           .sign = "increments of -error per interval"},
          write_fanuc,
          read_fanuc};
}

}  // namespace zerodrift::controller::exports
