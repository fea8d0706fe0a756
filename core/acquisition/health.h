#pragma once
// The health list of a connected machine, before a commissioning begins: every sensor's value and noise, the state of
// the machine, and how the link and the clock behave. Looks only; nothing is commanded.

#include <optional>
#include <string>
#include <vector>

#include "core/acquisition/machine_io.h"
#include "core/base/clock.h"
#include "core/base/task_context.h"

namespace zerodrift::acquisition {

enum class SensorState { ok, dead, stuck, out_of_range };
std::string_view name_of(SensorState state);

struct SensorHealth {
  SensorInfo info;
  SensorState state = SensorState::ok;
  std::optional<double> value_C;  // mean of the readings; nothing when dead
  std::optional<double> noise_C;  // standard deviation of the readings
};

struct MachineHealth {
  MachineIdentity identity;
  MachineSample last;  // the newest reading
  std::vector<SensorHealth> sensors;
  int sensors_alive = 0;
  double spread_K = 0.0;       // spread_of(sensors): small at an isothermal start
  double round_trip_ms = 0.0;  // median of the readings, wall time
  double slowest_round_trip_ms = 0.0;
  double clock_difference_s = 0.0;  // machine clock gained on the host's (times the time factor) while looking
  double observed_s = 0.0;          // machine time between the first and the last reading
  /// Why a commissioning cannot start now, the worst first; empty when it can.
  std::vector<Error> obstacles;
};

struct HealthOptions {
  int readings = 20;
  double interval_s = 0.2;   // wall
  double time_factor = 1.0;  // the clock given runs at this rate
};

/// From a sensor's readings, the oldest first; whose newest is not a number is dead. `by_sensor` is in the sensors'
/// order, all of the same length.
std::vector<SensorHealth> judged(const std::vector<SensorInfo>& sensors,
                                 const std::vector<std::vector<double>>& by_sensor);
/// The spread wherever page, job and report tell one, K: the warmest less the coldest of the sensors that are ok, each
/// by the mean of its readings; 0 without a sensor.
double spread_of(const std::vector<SensorHealth>& sensors);

Result<MachineHealth> machine_health(MachineIo& machine, Clock& clock, const HealthOptions& options,
                                     const TaskContext& context);

}  // namespace zerodrift::acquisition
