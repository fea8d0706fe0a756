// LinuxCNC COMP_FILE (2.9; read by usrmotintf): lines "nominal forward reverse" in mm, ascending, at most 256; the ends
// are held. Type 0 lists the actual positions (nominal + error); type 1 the trim added to the command (-error). A
// comment, comma or blank line would end reading without a message, so none is written; it is read at start only.

#include <fmt/format.h>

#include "core/controller/exports/export_tools.h"
#include "core/controller/exports/formats.h"

namespace zerodrift::controller::exports {
namespace {

using compensation::Table;

Result<Table> read_linuxcnc(std::string_view text, const ExportOptions& options) {
  std::vector<double> x;
  std::vector<double> up;
  std::vector<double> down;
  for (const std::string_view line : lines_of(text)) {
    double nominal = 0.0;
    double forward = 0.0;
    double reverse = 0.0;
    if (std::sscanf(std::string(line).c_str(), "%lf %lf %lf", &nominal, &forward, &reverse) != 3) break;
    x.push_back(nominal);
    up.push_back(1000.0 * (options.linuxcnc_type == 0 ? forward - nominal : -forward));
    down.push_back(1000.0 * (options.linuxcnc_type == 0 ? reverse - nominal : -reverse));
  }
  if (x.size() < 2) return unreadable("linuxcnc", text.substr(0, text.find('\n')), "lines of three numbers");
  Table table;
  table.axes[options.axis.empty() ? "X" : options.axis] = axis_from(x, up, down);
  return checked("linuxcnc", std::move(table));
}

Result<Exported> write_linuxcnc(const Table& table, const ExportOptions& options) {
  ZD_TRY(const std::string name, chosen_axis(table, options));
  const auto& axis = table.axes.at(name);
  const auto state = state_of(table, options);
  const int limit = limit_of(linuxcnc(), options);
  ZD_TRY(const Curve curve, curve_within(name, axis, state, limit));
  Exported out;
  std::string text;
  for (std::size_t i = 0; i < curve.x_mm.size(); ++i) {
    const double x = curve.x_mm[i];
    const bool actual = options.linuxcnc_type == 0;
    text += fmt::format("{:.6f} {:.6f} {:.6f}\n", x, actual ? x + 1e-3 * curve.up_um[i] : -1e-3 * curve.up_um[i],
                        actual ? x + 1e-3 * curve.down_um[i] : -1e-3 * curve.down_um[i]);
  }
  out.files.push_back({"", text});
  if (curve.x_mm.size() != axis.points.size()) {
    out.losses.push_back(
        fmt::format("axis {}: {} points are resampled to {}", name, axis.points.size(), curve.x_mm.size()));
  }
  tell_temperature(axis, name, state, out);
  ExportOptions named = options;
  named.axis = name;
  ZD_CHECK(measure_loss(linuxcnc(), table, named, {name}, out));
  return out;
}

}  // namespace

ExportFormat linuxcnc() {
  return {"linuxcnc",
          {.equidistant = false,
           .two_directions = true,
           .max_points = 256,
           .resolution_um = 0.001,
           .sign = "type 0: actual position = nominal + error; type 1: trim = -error"},
          write_linuxcnc,
          read_linuxcnc};
}

}  // namespace zerodrift::controller::exports
