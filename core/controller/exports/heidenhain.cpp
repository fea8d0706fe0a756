// Heidenhain TNC 640: a .COM file for each axis, assigned in a line of a .CMA file of which one is active. Rows
// "NR AXISPOS BACKLASH X Y Z" in mm with four decimals, at most 256; +error is written, as the exporter known does.
// BACKLASH is written 0 and read as nothing else: no source at hand says which direction it belongs to, or whether the
// control takes all of it or half on each side. What the directions differ by is told as a loss.

#include <fmt/format.h>

#include <cmath>

#include "core/controller/exports/export_tools.h"
#include "core/controller/exports/formats.h"

namespace zerodrift::controller::exports {
namespace {

using compensation::Table;

Result<Table> read_heidenhain(std::string_view text, const ExportOptions&) {
  const auto lines = lines_of(text);
  const std::string_view begin = "BEGIN AXIS_";
  if (lines.empty() || !lines.front().starts_with(begin) || lines.front().size() <= begin.size()) {
    return unreadable("heidenhain", lines.empty() ? "" : lines.front(), "BEGIN AXIS_X.COM MM");
  }
  const char name = lines.front()[begin.size()];
  const int column = name == 'X' ? 0 : name == 'Y' ? 1 : 2;
  std::vector<double> x;
  std::vector<double> um;
  for (std::size_t i = 2; i < lines.size() && !lines[i].starts_with("[END]"); ++i) {
    int number = 0;
    double position = 0.0;
    double backlash = 0.0;
    std::array<double, 3> value{};
    if (std::sscanf(std::string(lines[i]).c_str(), "%d %lf %lf %lf %lf %lf", &number, &position, &backlash, &value[0],
                    &value[1], &value[2]) != 6) {
      return unreadable("heidenhain", lines[i], "NR AXISPOS BACKLASH X Y Z");
    }
    if (backlash != 0.0) return unreadable("heidenhain", lines[i], "BACKLASH 0: its sign and share are not published");
    x.push_back(position);
    um.push_back(1000.0 * value.at(static_cast<std::size_t>(column)));
  }
  if (x.size() < 2) return unreadable("heidenhain", lines.front(), "two rows or more");
  Table table;
  table.axes[std::string(1, name)] = axis_from(x, um, um);
  return checked("heidenhain", std::move(table));
}

Result<Exported> write_heidenhain(const Table& table, const ExportOptions& options) {
  const ExportFormat self = heidenhain();
  ZD_TRY(const std::string name, chosen_axis(table, options));
  const auto& axis = table.axes.at(name);
  const auto state = state_of(table, options);
  ZD_TRY(const Curve curve, curve_within(name, axis, state, limit_of(self, options)));
  Exported out;
  std::string text = fmt::format("BEGIN AXIS_{}.COM MM\nNR AXISPOS BACKLASH X Y Z\n", name);
  for (std::size_t i = 0; i < curve.x_mm.size(); ++i) {
    const double mm = 1e-3 * curve.mean(i);
    const auto own = [&](const char* column) { return column == name ? mm + 0.0 : 0.0; };
    text += fmt::format("{} {:+.4f} {:+.4f} {:+.4f} {:+.4f} {:+.4f}\n", i, curve.x_mm[i], 0.0, own("X"), own("Y"),
                        own("Z"));
  }
  out.files.push_back({"", text + "[END]\n"});
  out.files.push_back({".CMA", fmt::format("BEGIN CONFIG.CMA\nNR AXIS_{}\n0 AXIS_{}.COM\n[END]\n", name, name)});
  if (curve.x_mm.size() != axis.points.size()) {
    out.losses.push_back(
        fmt::format("axis {}: {} points are resampled to {}", name, axis.points.size(), curve.x_mm.size()));
  }
  out.losses.push_back(fmt::format("axis {}: values and positions are rounded to 0.0001 mm", name));
  tell_directions(curve, name,
                  "the control's backlash parameter (BACKLASH is written 0: its sign and share are not published)",
                  out);
  tell_temperature(axis, name, state, out);
  out.confirm.emplace_back("the sign (+error), and the form of the .CMA file on this control");
  ZD_CHECK(measure_loss(self, table, options, {name}, out));
  return out;
}

}  // namespace

ExportFormat heidenhain() {
  return {"heidenhain",
          {.equidistant = false, .two_directions = false, .max_points = 256, .resolution_um = 0.1, .sign = "+error"},
          write_heidenhain,
          read_heidenhain};
}

}  // namespace zerodrift::controller::exports
