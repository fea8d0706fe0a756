#pragma once
// What the formats share: the curve of an axis at given temperatures, equidistant grids, the measured loss.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/controller/exports/export_format.h"

namespace zerodrift::controller::exports {

/// Error of an axis over position at fixed temperatures, straight between the knots.
struct Curve {
  std::vector<double> x_mm;
  std::vector<double> up_um;
  std::vector<double> down_um;

  double mean(std::size_t i) const { return 0.5 * (up_um[i] + down_um[i]); }
};

/// The axis the options name, or the only one; bad_argument otherwise.
Result<std::string> chosen_axis(const compensation::Table& table, const ExportOptions& options);
/// The temperatures of the options, and the references of the sensors they do not name.
compensation::Temperatures state_of(const compensation::Table& table, const ExportOptions& options);

/// Knots of points, else of segments; not_enough_data when the axis has neither.
Result<std::vector<double>> knots_of(const std::string& name, const compensation::AxisTable& axis);
Result<Curve> curve_at(const compensation::AxisTable& axis, const std::vector<double>& x_mm,
                       const compensation::Temperatures& temperatures);
/// All knots, or, when there are more than the format takes, as many on a fixed step.
Result<Curve> curve_within(const std::string& name, const compensation::AxisTable& axis,
                           const compensation::Temperatures& temperatures, int max_points);

struct Grid {
  double start_mm = 0.0;
  double step_mm = 1.0;
  int count = 2;

  std::vector<double> positions() const;
};
/// A fixed step that meets every knot if at most max_points are needed, else the finest allowed. `through`: a position
/// that must lie on the grid (the reference point); the grid may then reach a little beyond the knots.
Grid grid_for(const std::vector<double>& knots_mm, int max_points, std::optional<double> through = std::nullopt);

/// Axis table of a curve: what readers return.
compensation::AxisTable axis_from(const std::vector<double>& x_mm, const std::vector<double>& up_um,
                                  const std::vector<double>& down_um);
/// Largest difference within the travel of the original, at the knots of both, in both directions.
Result<double> largest_difference_um(const std::string& name, const compensation::AxisTable& original,
                                     const compensation::AxisTable& rebuilt,
                                     const compensation::Temperatures& temperatures);
/// Reads the main file back and puts the measured loss into `exported`.
Status measure_loss(const ExportFormat& format, const compensation::Table& table, const ExportOptions& options,
                    const std::vector<std::string>& axes, Exported& exported);

/// Sentences on what every table without temperature loses.
void tell_temperature(const compensation::AxisTable& axis, const std::string& name,
                      const compensation::Temperatures& temperatures, Exported& exported);
void tell_directions(const Curve& curve, const std::string& name, const std::string& where, Exported& exported);

int limit_of(const ExportFormat& format, const ExportOptions& options);
/// Number after the last '=' of a line, or after a letter of an NC word ("P-3"), or with an empty key at the beginning;
/// nothing when there is none.
std::optional<double> number_after(std::string_view line, std::string_view key);
/// The same where a count or the number of a point is meant: whole, at most 1e9 either way.
std::optional<int> whole_after(std::string_view line, std::string_view key);
std::vector<std::string_view> lines_of(std::string_view text);
tl::unexpected<Error> unreadable(std::string_view format, std::string_view line, std::string_view expected);
/// What a reader has understood, if its numbers are any and its positions do not run back.
Result<compensation::Table> checked(std::string_view format, compensation::Table table);

}  // namespace zerodrift::controller::exports
