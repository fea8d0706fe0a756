// A file full of zeros loads without a word and compensates nothing: it is not written.

#include <algorithm>
#include <cmath>

#include "core/controller/exports/export_tools.h"

namespace zerodrift::controller {
namespace {

/// Whether the format would say anything other than 0 of the axis.
bool says_something(const ExportFormat& format, const compensation::AxisTable& axis,
                    const compensation::Temperatures& temperatures) {
  if (format.capabilities.temperature) {
    return std::abs(axis.offset_um) > 0.0 || std::any_of(axis.terms.begin(), axis.terms.end(), [](const auto& term) {
             return std::abs(term.um_per_K) > 0.0 || std::abs(term.slope_um_per_m_per_K) > 0.0;
           });
  }
  std::vector<double> x_mm;
  for (const auto& point : axis.points) x_mm.push_back(point.position_mm);
  const auto curve = exports::curve_at(axis, x_mm, temperatures);
  const auto any = [](const std::vector<double>& um) {
    return std::any_of(um.begin(), um.end(), [](double value) { return std::abs(value) > 0.0; });
  };
  return !curve || any(curve->up_um) || any(curve->down_um);
}

}  // namespace

Result<Exported> write_table(const ExportFormat& format, const compensation::Table& table,
                             const ExportOptions& options) {
  ZD_TRY(Exported made, format.write(table, options));  // what the format lacks is said first
  const auto temperatures = exports::state_of(table, options);
  const bool some = std::any_of(table.axes.begin(), table.axes.end(), [&](const auto& one) {
    return (options.axis.empty() || options.axis == one.first) && says_something(format, one.second, temperatures);
  });
  if (some) return made;
  return fail(ErrorCode::not_enough_data,
              {{"what", "values other than 0 for this format"}, {"found", "0"}, {"needed", "1"}});
}

}  // namespace zerodrift::controller
