#include "core/compensation/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/compensation/sign.h"

namespace zerodrift::compensation {
namespace {

Result<double> temperature_of(const std::string& sensor, const Temperatures& temperatures) {
  const auto at = temperatures.find(sensor);
  if (at == temperatures.end()) {
    std::string available;
    for (const auto& [name, value] : temperatures) available += (available.empty() ? "" : ", ") + name;
    return fail(ErrorCode::channel_missing, {{"channel", sensor}, {"available", available}});
  }
  if (!std::isfinite(at->second)) return fail(ErrorCode::sensor_dead, {{"sensor", sensor}});
  return at->second;
}

double value_of(const TablePoint& point, Approach approach, double first_difference_K) {
  return (approach == Approach::up ? point.error_up_um : point.error_down_um) + point.um_per_K * first_difference_K;
}

double interpolated_um(const std::vector<TablePoint>& points, double position_mm, Approach approach,
                       double first_difference_K) {
  if (points.empty()) return 0.0;
  const auto above = std::lower_bound(points.begin(), points.end(), position_mm,
                                      [](const TablePoint& point, double x) { return point.position_mm < x; });
  if (above == points.begin()) return value_of(points.front(), approach, first_difference_K);
  if (above == points.end()) return value_of(points.back(), approach, first_difference_K);
  const TablePoint& low = *(above - 1);
  const double fraction = (position_mm - low.position_mm) / (above->position_mm - low.position_mm);
  const double low_um = value_of(low, approach, first_difference_K);
  return low_um + fraction * (value_of(*above, approach, first_difference_K) - low_um);
}

Status check_axis(const std::string& name, const AxisTable& axis) {
  const auto reject = [&](const std::string& what, double found, const std::string& expected) -> Status {
    return fail(ErrorCode::bad_argument,
                {{"what", "axis " + name + ", " + what}, {"found", fmt::format("{}", found)}, {"expected", expected}});
  };
  if (name != "X" && name != "Y" && name != "Z") {
    return fail(ErrorCode::bad_argument, {{"what", "axis"}, {"found", name}, {"expected", "X, Y or Z"}});
  }
  for (std::size_t i = 0; i < axis.points.size(); ++i) {
    const TablePoint& point = axis.points[i];
    for (const double value : {point.position_mm, point.error_up_um, point.error_down_um, point.um_per_K}) {
      if (!std::isfinite(value)) return reject(fmt::format("point {}", i + 1), value, "a finite number");
    }
    if (i > 0 && point.position_mm <= axis.points[i - 1].position_mm) {
      return reject(fmt::format("point {}", i + 1), point.position_mm, "a position above the one before");
    }
  }
  for (const auto& term : axis.terms) {
    for (const double value : {term.um_per_K, term.reference_C, term.slope_um_per_m_per_K}) {
      if (!std::isfinite(value)) return reject("term of " + term.sensor, value, "a finite number");
    }
    if (term.sensor.empty()) return reject("a term's sensor", 0.0, "a channel name");
  }
  if (!std::isfinite(axis.offset_um)) return reject("offset_um", axis.offset_um, "a finite number");
  if (!std::isfinite(axis.reference_position_mm)) return reject("x0", axis.reference_position_mm, "a finite number");
  if (!(axis.max_um > 0.0)) return reject("limits.max_um", axis.max_um, "a number above 0");
  if (!(axis.max_um_per_K > 0.0)) return reject("limits.max_um_per_K", axis.max_um_per_K, "a number above 0");
  if (!(axis.max_um_per_s > 0.0)) return reject("limits.max_um_per_s", axis.max_um_per_s, "a number above 0");
  return {};
}

}  // namespace

Result<double> error_um(const AxisTable& axis, double position_mm, Approach approach,
                        const Temperatures& temperatures) {
  double sum_um = axis.offset_um;
  double first_difference_K = 0.0;
  for (std::size_t i = 0; i < axis.terms.size(); ++i) {
    const TemperatureTerm& term = axis.terms[i];
    ZD_TRY(const double temperature_C, temperature_of(term.sensor, temperatures));
    const double difference_K = temperature_C - term.reference_C;
    if (i == 0) first_difference_K = difference_K;
    const double distance_m = (position_mm - axis.reference_position_mm) / 1000.0;
    sum_um += (term.um_per_K + term.slope_um_per_m_per_K * distance_m) * difference_K;
  }
  sum_um += interpolated_um(axis.points, position_mm, approach, first_difference_K);
  return std::clamp(sum_um, -axis.max_um, axis.max_um);
}

Result<double> compensation_um(const AxisTable& axis, double position_mm, Approach approach,
                               const Temperatures& temperatures) {
  return error_um(axis, position_mm, approach, temperatures).map(compensation_from_error_um);
}

Result<double> error_um(const Table& table, const std::string& axis, double position_mm, Approach approach,
                        const Temperatures& temperatures) {
  const auto at = table.axes.find(axis);
  if (at == table.axes.end()) return 0.0;
  return error_um(at->second, position_mm, approach, temperatures);
}

std::vector<std::string> sensors_of(const Table& table) {
  std::set<std::string> names;
  for (const auto& [name, axis] : table.axes) {
    for (const auto& term : axis.terms) names.insert(term.sensor);
  }
  return {names.begin(), names.end()};
}

std::vector<std::string> outside_valid_range(const Table& table, const Temperatures& temperatures) {
  std::vector<std::string> outside;
  for (const auto& [sensor, range] : table.valid) {
    const auto at = temperatures.find(sensor);
    if (at == temperatures.end() || (at->second >= range.low_C && at->second <= range.high_C)) continue;
    outside.push_back(
        fmt::format("{} {:.2f} C (valid {:.2f} to {:.2f})", sensor, at->second, range.low_C, range.high_C));
  }
  return outside;
}

Status check_steepness(const Table& table, double max_um_per_K) {
  for (const auto& [name, axis] : table.axes) {
    const double limit = std::min(axis.max_um_per_K, max_um_per_K);
    const auto steep = [&, &name = name](const std::string& what, double um_per_K) -> Status {
      if (std::abs(um_per_K) <= limit) return {};
      return fail(ErrorCode::limit_exceeded, {{"what", fmt::format("the coefficient of {} in axis {}", what, name)},
                                              {"found", fmt::format("{:.1f} um/K", um_per_K)},
                                              {"limit", fmt::format("{:g} um/K", limit)}});
    };
    for (const auto& term : axis.terms) ZD_CHECK(steep(term.sensor, term.um_per_K));
    for (const auto& point : axis.points) {
      ZD_CHECK(steep(fmt::format("the point at {:g} mm", point.position_mm), point.um_per_K));
    }
  }
  return {};
}

Temperatures reference_temperatures(const Table& table) {
  Temperatures temperatures;
  for (const auto& [name, axis] : table.axes) {
    for (const auto& term : axis.terms) temperatures.try_emplace(term.sensor, term.reference_C);
  }
  return temperatures;
}

Status check(const Table& table) {
  for (const auto& [name, axis] : table.axes) ZD_CHECK(check_axis(name, axis));
  return {};
}

Result<std::vector<AxisDifference>> difference(const Table& old_table, const Table& new_table,
                                               const Temperatures& temperatures,
                                               const std::map<std::string, double>& positions) {
  std::set<std::string> names;
  for (const Table* table : {&old_table, &new_table}) {
    for (const auto& [name, axis] : table->axes) names.insert(name);
  }
  std::vector<AxisDifference> out;
  for (const auto& name : names) {
    AxisDifference one{name, {}, 0.0, 0.0};
    std::set<double> where;
    for (const Table* table : {&old_table, &new_table}) {
      const auto at = table->axes.find(name);
      if (at == table->axes.end()) continue;
      where.insert(at->second.reference_position_mm);
      for (const auto& point : at->second.points) where.insert(point.position_mm);
    }
    if (const auto now = positions.find(name); now != positions.end()) where.insert(now->second);
    for (const double x : where) {
      DifferenceRow row{x, 0.0, 0.0, 0.0, 0.0};
      ZD_TRY(row.old_up_um, error_um(old_table, name, x, Approach::up, temperatures).map(compensation_from_error_um));
      ZD_TRY(row.old_down_um,
             error_um(old_table, name, x, Approach::down, temperatures).map(compensation_from_error_um));
      ZD_TRY(row.new_up_um, error_um(new_table, name, x, Approach::up, temperatures).map(compensation_from_error_um));
      ZD_TRY(row.new_down_um,
             error_um(new_table, name, x, Approach::down, temperatures).map(compensation_from_error_um));
      const double change_um =
          std::max(std::abs(row.new_up_um - row.old_up_um), std::abs(row.new_down_um - row.old_down_um));
      if (change_um > one.largest_um) {
        one.largest_um = change_um;
        one.largest_at_mm = x;
      }
      one.curve.push_back(row);
    }
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace zerodrift::compensation
