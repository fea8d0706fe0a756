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

// A sensor in metal or on its surface follows heat in tens of seconds, coolant that sets in by some kelvin at most;
// what goes further within a reading is a plug or a wire.
constexpr double heat_K = 3.0;
constexpr double heat_K_per_s = 0.05;
constexpr double noise_multiple = 12.0;  // of the median step
constexpr std::size_t steps_kept = 31;
constexpr std::size_t readings_to_stay = 3;  // so many at the new level are no spike any more
constexpr std::size_t spikes_to_tell = 2;
constexpr double spikes_within_s = 1800.0;
constexpr double same_place_K = 1.0;  // where the other was, within noise and a reading's drift

double median_of(std::deque<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

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

double SensorWatch::too_far_K(const Sensor& sensor, double time_s) {
  return std::max(heat_K + heat_K_per_s * (time_s - sensor.level_s), noise_multiple * median_of(sensor.steps));
}

void SensorWatch::follow(Sensor& sensor, double time_s, double value, std::vector<Jump>& jumps, std::size_t index) {
  const auto settle = [&] {
    sensor.level = value;
    sensor.level_s = time_s;
    sensor.has_level = true;
    sensor.far.clear();
  };
  if (!sensor.has_level) return settle();
  const double step = std::abs(value - sensor.level);
  if (step <= too_far_K(sensor, time_s)) {
    if (!sensor.far.empty()) sensor.spikes_s.push_back(time_s);
    sensor.steps.push_back(step);
    if (sensor.steps.size() > steps_kept) sensor.steps.pop_front();
    return settle();
  }
  sensor.far.push_back(value);
  if (sensor.far.size() < readings_to_stay) return;
  const auto [low, high] = std::minmax_element(sensor.far.begin(), sensor.far.end());
  if (*high - *low < heat_K) {
    jumps.push_back({index, sensor.level, value});
  } else {
    sensor.spikes_s.push_back(time_s);  // it does not come to rest anywhere
  }
  settle();
}

bool SensorWatch::spiking(Sensor& sensor, double time_s) {
  while (!sensor.spikes_s.empty() && time_s - sensor.spikes_s.front() > spikes_within_s) sensor.spikes_s.pop_front();
  return sensor.spikes_s.size() >= spikes_to_tell;
}

SensorWatch::Change SensorWatch::jumped(const std::vector<Jump>& jumps, std::size_t at) const {
  const Jump& jump = jumps[at];
  Change change{m_sensors[jump.sensor].channel, true, {}};
  for (const Jump& other : jumps) {
    const bool crossed = std::abs(other.to - jump.from) < same_place_K && std::abs(jump.to - other.from) < same_place_K;
    if (other.sensor == jump.sensor || !crossed) continue;
    change.error = {ErrorCode::sensor_swapped,
                    {{"sensor", change.channel}, {"other", m_sensors[other.sensor].channel}}};
    return change;
  }
  change.error = {ErrorCode::sensor_jumped,
                  {{"sensor", change.channel}, {"kelvin", fmt::format("{:+.1f}", jump.to - jump.from)}}};
  return change;
}

std::vector<SensorWatch::Change> SensorWatch::add(double time_s, const std::vector<double>& temperature_C) {
  std::vector<Jump> jumps;
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
    if (state != State::dead) {
      follow(sensor, time_s, value, jumps, i);
      if (state == State::ok && spiking(sensor, time_s)) state = State::spiking;
    }
    if (state == sensor.state) continue;
    sensor.state = state;
    Change change{sensor.channel, state != State::ok, {}};
    if (state == State::dead) change.error = {ErrorCode::sensor_dead, {{"sensor", sensor.channel}}};
    if (state == State::stuck) {
      const std::string seconds = fmt::format("{:.0f}", time_s - sensor.changed_s);
      change.error = {ErrorCode::sensor_stuck, {{"sensor", sensor.channel}, {"seconds", seconds}}};
    }
    if (state == State::spiking) {
      change.error = {ErrorCode::sensor_spiking,
                      {{"sensor", sensor.channel}, {"count", std::to_string(sensor.spikes_s.size())}}};
    }
    changes.push_back(std::move(change));
  }
  for (std::size_t at = 0; at < jumps.size(); ++at) changes.push_back(jumped(jumps, at));
  return changes;
}

}  // namespace zerodrift::acquisition
