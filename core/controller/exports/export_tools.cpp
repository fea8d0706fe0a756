#include "core/controller/exports/export_tools.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>

namespace zerodrift::controller::exports {

using compensation::Approach;
using compensation::AxisTable;
using compensation::Table;
using compensation::Temperatures;

Result<std::string> chosen_axis(const Table& table, const ExportOptions& options) {
  std::string names;
  for (const auto& [name, axis] : table.axes) names += (names.empty() ? "" : ", ") + name;
  if (!options.axis.empty() && table.axes.contains(options.axis)) return options.axis;
  if (options.axis.empty() && table.axes.size() == 1) return table.axes.begin()->first;
  return fail(ErrorCode::bad_argument, {{"what", "the axis to export (this format holds one axis a file)"},
                                        {"found", options.axis},
                                        {"expected", "one of " + names}});
}

Temperatures state_of(const Table& table, const ExportOptions& options) {
  Temperatures state = options.temperatures;
  for (const auto& [sensor, value] : compensation::reference_temperatures(table)) state.try_emplace(sensor, value);
  return state;
}

Result<std::vector<double>> knots_of(const std::string& name, const AxisTable& axis) {
  std::vector<double> knots;
  for (const auto& point : axis.points) knots.push_back(point.position_mm);
  if (knots.size() < 2) {
    return fail(
        ErrorCode::not_enough_data,
        {{"what", "position points of axis " + name}, {"found", std::to_string(knots.size())}, {"needed", "2"}});
  }
  return knots;
}

Result<Curve> curve_at(const AxisTable& axis, const std::vector<double>& x_mm, const Temperatures& temperatures) {
  Curve curve;
  curve.x_mm = x_mm;
  for (const double x : x_mm) {
    ZD_TRY(const double up, compensation::error_um(axis, x, Approach::up, temperatures));
    ZD_TRY(const double down, compensation::error_um(axis, x, Approach::down, temperatures));
    curve.up_um.push_back(up);
    curve.down_um.push_back(down);
  }
  return curve;
}

std::vector<double> Grid::positions() const {
  std::vector<double> out;
  for (int i = 0; i < count; ++i) out.push_back(start_mm + step_mm * i);
  return out;
}

Grid grid_for(const std::vector<double>& knots_mm, int max_points, std::optional<double> through) {
  std::vector<double> all = knots_mm;
  if (through) all.push_back(*through);
  std::sort(all.begin(), all.end());
  const double range = all.back() - all.front();
  double gap = range;
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (all[i] - all[i - 1] > 1e-6) gap = std::min(gap, all[i] - all[i - 1]);
  }
  // The smallest gap, or a whole part of it, that meets every knot.
  for (int part = 1; part <= 10; ++part) {
    const double step = gap / part;
    const double count = std::round(range / step) + 1.0;
    if (count > max_points) break;
    const bool meets = std::all_of(all.begin(), all.end(), [&](double x) {
      const double n = (x - all.front()) / step;
      return std::abs(n - std::round(n)) * step < 1e-6;
    });
    if (meets) return {all.front(), step, static_cast<int>(count)};
  }
  if (!through) return {all.front(), range / (max_points - 1), max_points};
  // Two intervals are spare for the ends, since the grid starts from the reference point.
  const double step = range / (max_points - 3);
  const double below = std::ceil((*through - all.front()) / step - 1e-9);
  const double above = std::ceil((all.back() - *through) / step - 1e-9);
  return {*through - below * step, step, static_cast<int>(below + above) + 1};
}

Result<Curve> curve_within(const std::string& name, const AxisTable& axis, const Temperatures& temperatures,
                           int max_points) {
  ZD_TRY(std::vector<double> knots, knots_of(name, axis));
  if (static_cast<int>(knots.size()) > max_points) {
    knots = Grid{knots.front(), (knots.back() - knots.front()) / (max_points - 1), max_points}.positions();
  }
  return curve_at(axis, knots, temperatures);
}

AxisTable axis_from(const std::vector<double>& x_mm, const std::vector<double>& up_um,
                    const std::vector<double>& down_um) {
  AxisTable axis;
  axis.max_um = 1e6;
  for (std::size_t i = 0; i < x_mm.size(); ++i) axis.points.push_back({x_mm[i], up_um[i], down_um[i], 0.0});
  return axis;
}

Result<double> largest_difference_um(const std::string& name, const AxisTable& original, const AxisTable& rebuilt,
                                     const Temperatures& temperatures) {
  ZD_TRY(const auto own, knots_of(name, original));
  std::set<double> where(own.begin(), own.end());
  for (const auto& point : rebuilt.points) {
    if (point.position_mm > own.front() && point.position_mm < own.back()) where.insert(point.position_mm);
  }
  double largest = 0.0;
  for (const double x : where) {
    for (const Approach approach : {Approach::up, Approach::down}) {
      ZD_TRY(const double wanted, compensation::error_um(original, x, approach, temperatures));
      ZD_TRY(const double written, compensation::error_um(rebuilt, x, approach, temperatures));
      largest = std::max(largest, std::abs(wanted - written));
    }
  }
  return largest;
}

/// How far the table's errors go beyond its own limit, which every file keeps; 0 within it.
static Result<double> cut_by_limit_um(const std::string& name, const AxisTable& axis,
                                      const Temperatures& temperatures) {
  AxisTable unlimited = axis;
  unlimited.max_um = std::numeric_limits<double>::max();
  ZD_TRY(const auto knots, knots_of(name, axis));
  double cut = 0.0;
  for (const double x : knots) {
    for (const Approach approach : {Approach::up, Approach::down}) {
      ZD_TRY(const double error, compensation::error_um(unlimited, x, approach, temperatures));
      cut = std::max(cut, std::abs(error) - axis.max_um);
    }
  }
  return cut;
}

Status measure_loss(const ExportFormat& format, const Table& table, const ExportOptions& options,
                    const std::vector<std::string>& axes, Exported& exported) {
  const Temperatures state = state_of(table, options);
  ExportOptions at_state = options;
  at_state.temperatures = state;
  ZD_TRY(const Table rebuilt, format.read(exported.files.front().text, at_state));
  for (const auto& name : axes) {
    const auto at = rebuilt.axes.find(name);
    if (at == rebuilt.axes.end()) return unreadable(format.id, "the written file", "axis " + name);
    ZD_TRY(const double loss, largest_difference_um(name, table.axes.at(name), at->second, state));
    ZD_TRY(const double cut, cut_by_limit_um(name, table.axes.at(name), state));
    if (cut > 0.0) {
      exported.losses.push_back(fmt::format("axis {}: up to {:g} um beyond the table's own limit of {:g} um are cut",
                                            name, cut, table.axes.at(name).max_um));
    }
    exported.loss_um = std::max({exported.loss_um, loss, cut});
  }
  return {};
}

void tell_temperature(const AxisTable& axis, const std::string& name, const Temperatures& temperatures,
                      Exported& exported) {
  if (axis.terms.empty()) return;
  std::string state;
  for (const auto& term : axis.terms) {
    state += fmt::format("{}{} {:.1f} C", state.empty() ? "" : ", ", term.sensor, temperatures.at(term.sensor));
  }
  exported.losses.push_back(
      fmt::format("axis {}: the file does not follow temperatures; it holds for {}. Feed the thermal part at run time",
                  name, state));
}

void tell_directions(const Curve& curve, const std::string& name, const std::string& where, Exported& exported) {
  double sum = 0.0;
  double largest = 0.0;
  for (std::size_t i = 0; i < curve.x_mm.size(); ++i) {
    const double reversal = curve.up_um[i] - curve.down_um[i];
    sum += reversal;
    largest = std::max(largest, std::abs(reversal));
  }
  if (largest == 0.0) return;
  exported.losses.push_back(fmt::format(
      "axis {}: both directions are averaged (they differ by up to {:.2f} um); the mean reversal of {:.2f} um "
      "(up - down) belongs into {}",
      name, largest, sum / static_cast<double>(curve.x_mm.size()), where));
}

int limit_of(const ExportFormat& format, const ExportOptions& options) {
  return options.max_points > 0 ? std::max(options.max_points, 4) : format.capabilities.max_points;
}

std::optional<double> number_after(std::string_view line, std::string_view key) {
  const auto at = key.empty() ? 0 : line.rfind(key);
  if (at == std::string_view::npos) return std::nullopt;
  std::string_view rest = line.substr(at + key.size());
  while (!rest.empty() && (rest.front() == ' ' || rest.front() == '+')) rest.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<int> whole_after(std::string_view line, std::string_view key) {
  constexpr double largest = 1e9;
  const auto value = number_after(line, key);
  if (!value || std::abs(*value) > largest || *value != std::floor(*value)) return std::nullopt;
  return static_cast<int>(*value);
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const auto end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
    lines.push_back(line);
  }
  return lines;
}

tl::unexpected<Error> unreadable(std::string_view format, std::string_view line, std::string_view expected) {
  return fail(ErrorCode::wrong_format,
              {{"file", std::string(format)}, {"found", std::string(line)}, {"expected", std::string(expected)}});
}

Result<Table> checked(std::string_view format, Table table) {
  for (const auto& [name, axis] : table.axes) {
    double before_mm = -std::numeric_limits<double>::infinity();
    for (const auto& point : axis.points) {
      const bool number = std::isfinite(point.position_mm) && std::isfinite(point.error_up_um) &&
                          std::isfinite(point.error_down_um) && point.position_mm >= before_mm;
      if (!number) return unreadable(format, "axis " + name, "finite numbers, positions in order");
      before_mm = point.position_mm;
    }
  }
  return table;
}

}  // namespace zerodrift::controller::exports
