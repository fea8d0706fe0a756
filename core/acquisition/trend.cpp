#include "core/acquisition/trend.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace zerodrift::acquisition {
namespace {

constexpr double hour_s = 3600.0;
constexpr double window_s = 900.0;
constexpr double shortest_span_s = 240.0;
// Temperatures are taken so far apart for the slopes: enough for a line, and cheap at any sample rate.
constexpr double temperature_spacing_s = 15.0;
constexpr double steady_share = 0.15;
constexpr double steady_floor_um = 1.0;

/// Least squares slope per second of the values that are there; nothing from fewer than four.
std::optional<double> slope(std::span<const double> times, std::span<const double> values) {
  double n = 0, st = 0, sv = 0;
  double first = 0, last = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (std::isnan(values[i])) continue;
    if (n == 0) first = times[i];
    last = times[i];
    ++n;
    st += times[i];
    sv += values[i];
  }
  if (n < 4 || last - first < shortest_span_s) return std::nullopt;
  double stt = 0, stv = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (std::isnan(values[i])) continue;
    stt += (times[i] - st / n) * (times[i] - st / n);
    stv += (times[i] - st / n) * (values[i] - sv / n);
  }
  return stv / stt;
}

}  // namespace

Trend::Trend(double measure_period_s) : m_window_s(std::max(window_s, 5.0 * measure_period_s)) {}

void Trend::conditions_changed(double time_s) {
  m_steady_from_s = time_s;
  std::erase_if(m_errors, [&](const ErrorPoint& p) { return p.time_s < time_s - m_window_s; });
  m_now.steady = false;
  m_now.change_first_hour_um.reset();
  m_now.change_last_hour_um.reset();
}

void Trend::add_temperatures(double time_s, std::span<const double> temperature_C) {
  if (!m_times_s.empty() && time_s < m_times_s.back() + temperature_spacing_s) return;
  m_times_s.push_back(time_s);
  m_temperatures.resize(temperature_C.size());
  for (std::size_t i = 0; i < temperature_C.size(); ++i) m_temperatures[i].push_back(temperature_C[i]);
  while (m_times_s.front() < time_s - window_s) {
    m_times_s.erase(m_times_s.begin());
    for (auto& series : m_temperatures) series.erase(series.begin());
  }
  m_now.slope_K_per_h.reset();
  for (std::size_t i = 0; i < m_temperatures.size(); ++i) {
    const auto rate = slope(m_times_s, m_temperatures[i]);
    if (!rate || (m_now.slope_K_per_h && std::abs(*rate * hour_s) <= std::abs(*m_now.slope_K_per_h))) continue;
    m_now.slope_K_per_h = *rate * hour_s;
    m_now.slope_sensor = static_cast<int>(i);
  }
}

void Trend::add_error(double time_s, const std::array<double, 3>& error_um) {
  m_errors.push_back({time_s, error_um});
  for (int axis = 0; axis < 3; ++axis) {
    const double size = std::abs(error_um[static_cast<std::size_t>(axis)]);
    if (size > m_now.largest_error_um) {
      m_now.largest_error_um = size;
      m_now.largest_axis = axis;
    }
  }
  update_errors();
}

void Trend::update_errors() {
  const double now_s = m_errors.back().time_s;
  const auto first = std::find_if(m_errors.begin(), m_errors.end(),
                                  [&](const ErrorPoint& p) { return p.time_s >= now_s - m_window_s; });
  m_now.slope_um_per_h.reset();
  std::vector<double> times;
  std::vector<double> values;
  for (auto at = first; at != m_errors.end(); ++at) times.push_back(at->time_s);
  for (int axis = 0; axis < 3; ++axis) {
    values.clear();
    for (auto at = first; at != m_errors.end(); ++at) values.push_back(at->error_um[static_cast<std::size_t>(axis)]);
    const auto rate = slope(times, values);
    if (!rate || (m_now.slope_um_per_h && std::abs(*rate * hour_s) <= std::abs(*m_now.slope_um_per_h))) continue;
    m_now.slope_um_per_h = *rate * hour_s;
    m_now.slope_axis = axis;
  }
  if (now_s < m_steady_from_s + 2.0 * hour_s) return;  // the first and the last hour must not overlap
  m_now.change_first_hour_um = change_within(m_steady_from_s, m_steady_from_s + hour_s);
  m_now.change_last_hour_um = change_within(now_s - hour_s, now_s);
  if (!m_now.change_first_hour_um || !m_now.change_last_hour_um) return;
  m_now.steady = *m_now.change_last_hour_um < std::max(steady_floor_um, steady_share * *m_now.change_first_hour_um);
}

std::optional<double> Trend::change_within(double from_s, double to_s) const {
  std::optional<double> largest;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    int count = 0;
    for (const ErrorPoint& p : m_errors) {
      if (p.time_s < from_s || p.time_s > to_s || std::isnan(p.error_um[axis])) continue;
      low = std::min(low, p.error_um[axis]);
      high = std::max(high, p.error_um[axis]);
      ++count;
    }
    if (count >= 2) largest = std::max(largest.value_or(0.0), high - low);
  }
  return largest;
}

}  // namespace zerodrift::acquisition
