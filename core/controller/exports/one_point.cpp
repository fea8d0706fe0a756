// A file that moves one axis at one place by a few micrometres and nothing else: what is loaded first on a control
// whose sign or form rests on no source at hand.

#include <fmt/format.h>

#include <cmath>

#include "core/controller/exports/export_format.h"

namespace zerodrift::controller {
namespace {

using compensation::AxisTable;
using compensation::Table;

/// Where the error of +size stands: the middle of the points, or everywhere for a table of temperatures alone.
std::string keep_one_point(const std::string& name, AxisTable& axis, bool straight_line, double size_um) {
  axis.offset_um = straight_line ? size_um : 0.0;
  axis.terms.clear();
  axis.segments.clear();
  if (straight_line) {
    axis.points.clear();
    return fmt::format("axis {} must move by {:+.1f} um, everywhere alike, when this file takes effect", name,
                       -size_um);
  }
  const std::size_t middle = axis.points.size() / 2;
  for (std::size_t i = 0; i < axis.points.size(); ++i) {
    auto& point = axis.points[i];
    point.error_up_um = point.error_down_um = i == middle ? size_um : 0.0;
    point.um_per_K = 0.0;
  }
  return fmt::format("at {:g} mm axis {} must move by {:+.1f} um when this file takes effect, and nowhere else",
                     axis.points[middle].position_mm, name, -size_um);
}

}  // namespace

Result<Exported> write_one_point(const ExportFormat& format, const Table& table, const ExportOptions& options) {
  constexpr double size_um = 5.0;
  Table one = table;
  std::vector<std::string> expected;
  for (auto& [name, axis] : one.axes) {
    if (!options.axis.empty() && options.axis != name) continue;
    if (!format.capabilities.temperature && axis.points.size() < 2) continue;
    expected.push_back(keep_one_point(name, axis, format.capabilities.temperature, size_um));
  }
  ZD_TRY(Exported out, format.write(one, options));
  out.losses.clear();
  out.confirm = std::move(expected);
  return out;
}

}  // namespace zerodrift::controller
