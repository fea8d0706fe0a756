#include "core/acquisition/health.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace zerodrift::acquisition {
namespace {

// Outside of this no workshop sensor can be right.
constexpr double lowest_C = -20.0;
constexpr double highest_C = 120.0;
// The share of sensors that must move before one that does not is called stuck, and how many readings that takes.
constexpr std::size_t readings_for_stuck = 15;

struct Readings {
  std::vector<std::vector<double>> by_sensor;
  std::vector<double> round_trips_ms;
};

SensorHealth judge(const SensorInfo& info, const std::vector<double>& values) {
  SensorHealth health;
  health.info = info;
  double sum = 0.0;
  double count = 0.0;
  for (const double v : values) {
    if (std::isnan(v)) continue;
    sum += v;
    ++count;
  }
  if (values.empty() || std::isnan(values.back())) {
    health.state = SensorState::dead;
    return health;
  }
  const double mean = sum / count;
  double squares = 0.0;
  for (const double v : values) {
    if (!std::isnan(v)) squares += (v - mean) * (v - mean);
  }
  health.value_C = mean;
  if (count > 1) health.noise_C = std::sqrt(squares / (count - 1));
  if (mean < lowest_C || mean > highest_C) health.state = SensorState::out_of_range;
  return health;
}

bool is_ok(const SensorHealth& sensor) {
  return sensor.state == SensorState::ok;
}

// Without any change where most others change: stuck. On a machine whose sensors are all quiet nothing can be said.
void find_stuck(std::vector<SensorHealth>& sensors, const std::vector<std::vector<double>>& by_sensor) {
  const auto moving =
      std::count_if(sensors.begin(), sensors.end(), [](const SensorHealth& s) { return s.noise_C > 0.0; });
  if (2 * moving <= static_cast<std::ptrdiff_t>(sensors.size())) return;
  for (std::size_t s = 0; s < sensors.size(); ++s) {
    const bool enough = by_sensor[s].size() >= readings_for_stuck;
    if (enough && sensors[s].state == SensorState::ok && sensors[s].noise_C == 0.0) {
      sensors[s].state = SensorState::stuck;
    }
  }
}

void summarize(MachineHealth& health) {
  health.sensors_alive = static_cast<int>(
      std::count_if(health.sensors.begin(), health.sensors.end(), [](const SensorHealth& s) { return is_ok(s); }));
  health.spread_K = spread_of(health.sensors);
  const auto obstacle = [&](ErrorCode code, std::map<std::string, std::string> context) {
    health.obstacles.push_back({code, std::move(context)});
  };
  const std::string& name = health.identity.name;
  if (health.last.compensation_on) obstacle(ErrorCode::interlock_compensation_on, {{"operation", "commissioning"}});
  if (health.last.alarm) obstacle(ErrorCode::machine_not_ready, {{"what", name}, {"reason", "alarm"}});
  if (!health.last.referenced) {
    obstacle(ErrorCode::machine_not_ready, {{"what", name}, {"reason", "axes are not referenced"}});
  }
  if (health.sensors_alive == 0) {
    obstacle(ErrorCode::not_enough_data, {{"what", "temperature sensors"}, {"found", "0"}, {"needed", "1"}});
  }
}

}  // namespace

std::string_view name_of(SensorState state) {
  switch (state) {
    case SensorState::ok:
      return "ok";
    case SensorState::dead:
      return "dead";
    case SensorState::stuck:
      return "stuck";
    case SensorState::out_of_range:
      return "out_of_range";
  }
  return "";
}

std::vector<SensorHealth> judged(const std::vector<SensorInfo>& sensors,
                                 const std::vector<std::vector<double>>& by_sensor) {
  std::vector<SensorHealth> out;
  for (std::size_t s = 0; s < by_sensor.size(); ++s) {
    out.push_back(judge(s < sensors.size() ? sensors[s] : SensorInfo{}, by_sensor[s]));
  }
  find_stuck(out, by_sensor);
  return out;
}

double spread_of(const std::vector<SensorHealth>& sensors) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const SensorHealth& sensor : sensors) {
    if (!is_ok(sensor)) continue;
    low = std::min(low, *sensor.value_C);
    high = std::max(high, *sensor.value_C);
  }
  return high >= low ? high - low : 0.0;
}

Result<MachineHealth> machine_health(MachineIo& machine, Clock& clock, const HealthOptions& options,
                                     const TaskContext& context) {
  MachineHealth health;
  ZD_TRY(health.identity, machine.identify());
  Readings readings;
  readings.by_sensor.resize(health.identity.sensors.size());
  std::vector<Seconds> read_at(health.identity.sensors.size(), Seconds(-1.0));
  double first_machine_s = 0.0;
  Seconds first_host{0.0};
  Seconds last_host{0.0};
  for (int i = 0; i < options.readings; ++i) {
    if (i > 0 && !clock.wait_for(Seconds(options.interval_s * options.time_factor), context.stop)) {
      return fail(ErrorCode::cancelled);
    }
    const auto sent = std::chrono::steady_clock::now();
    ZD_TRY(health.last, machine.read());
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - sent;
    readings.round_trips_ms.push_back(took.count());
    last_host = clock.steady();
    if (i == 0) {
      first_machine_s = health.last.machine_time_s;
      first_host = last_host;
    }
    for (std::size_t s = 0; s < readings.by_sensor.size(); ++s) {
      const bool there = s < health.last.temperature_C.size();
      const Seconds at = s < health.last.temperature_at.size() ? health.last.temperature_at[s] : host_clock().steady();
      // A value that a device has not renewed is not another reading.
      if (there && at == read_at[s]) continue;
      read_at[s] = at;
      readings.by_sensor[s].push_back(there ? health.last.temperature_C[s] : std::nan(""));
    }
    context.progress((i + 1.0) / options.readings, "health");
  }
  health.sensors = judged(health.identity.sensors, readings.by_sensor);
  std::sort(readings.round_trips_ms.begin(), readings.round_trips_ms.end());
  health.round_trip_ms = readings.round_trips_ms[readings.round_trips_ms.size() / 2];
  health.slowest_round_trip_ms = readings.round_trips_ms.back();
  health.observed_s = health.last.machine_time_s - first_machine_s;
  health.clock_difference_s = health.observed_s - (last_host - first_host).count();
  summarize(health);
  return health;
}

}  // namespace zerodrift::acquisition
