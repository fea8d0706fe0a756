#include "core/acquisition/sensor_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace zerodrift::acquisition {
namespace {

// A sensor that changes in a share p of its readings stays still n times with probability (1 - p)^n: this is once in
// nine million readings, some hundred runs of twenty sensors.
constexpr double log_chance = -16.0;
constexpr double most_changing = 0.95;  // even a noisy one repeats a value now and then
constexpr std::size_t fewest_readings = 15;

}  // namespace

SensorWatch::SensorWatch(std::vector<std::string> channels) {
  for (auto& channel : channels) {
    m_sensors.emplace_back();
    m_sensors.back().channel = std::move(channel);
  }
}

// What is usual among the sensors; for one that has never changed since the start, and so has no habit of its own.
double SensorWatch::usual_rate() const {
  std::vector<double> rates;
  for (const Sensor& sensor : m_sensors) {
    if (sensor.has_value) rates.push_back(sensor.change_rate());
  }
  if (rates.empty()) return 0.0;
  const auto middle = rates.begin() + static_cast<std::ptrdiff_t>(rates.size() / 2);
  std::nth_element(rates.begin(), middle, rates.end());
  return *middle;
}

bool SensorWatch::stuck(const Sensor& sensor, double usual) const {
  const double rate = sensor.changes >= 3 ? sensor.change_rate() : usual;
  return sensor.still >= fewest_readings &&
         static_cast<double>(sensor.still) * std::log1p(-std::min(rate, most_changing)) <= log_chance;
}

std::vector<SensorWatch::Change> SensorWatch::add(double time_s, const std::vector<double>& temperature_C) {
  const double usual = usual_rate();
  std::vector<Change> changes;
  for (std::size_t i = 0; i < m_sensors.size(); ++i) {
    Sensor& sensor = m_sensors[i];
    const double value = i < temperature_C.size() ? temperature_C[i] : std::nan("");
    State state = State::ok;
    if (std::isnan(value)) {
      state = State::dead;
    } else if (!sensor.has_value || value != sensor.value) {
      if (sensor.has_value) {
        sensor.readings += sensor.still + 1;
        ++sensor.changes;
      }
      sensor.still = 0;
      sensor.changed_s = time_s;
      sensor.value = value;
      sensor.has_value = true;
    } else {
      ++sensor.still;
      if (stuck(sensor, usual)) state = State::stuck;
    }
    if (state == sensor.state) continue;
    sensor.state = state;
    Change change{sensor.channel, state != State::ok, {}};
    if (state == State::dead) change.error = {ErrorCode::sensor_dead, {{"sensor", sensor.channel}}};
    if (state == State::stuck) {
      const std::string seconds = fmt::format("{:.0f}", time_s - sensor.changed_s);
      change.error = {ErrorCode::sensor_stuck, {{"sensor", sensor.channel}, {"seconds", seconds}}};
    }
    changes.push_back(std::move(change));
  }
  return changes;
}

}  // namespace zerodrift::acquisition
