#pragma once
// Sensors that have stopped telling the truth, seen while the run goes on.
// Dead: no value. Stuck: no change for so long that a sensor with its noise would have changed many times.

#include <cstddef>
#include <string>
#include <vector>

#include "core/base/error.h"

namespace zerodrift::acquisition {

class SensorWatch {
 public:
  explicit SensorWatch(std::vector<std::string> channels);

  struct Change {
    std::string channel;
    bool failed = false;  // else it is well again
    Error error;
  };
  /// One reading of all sensors; returns what has changed.
  std::vector<Change> add(double time_s, const std::vector<double>& temperature_C);

 private:
  enum class State { ok, dead, stuck };
  struct Sensor {
    std::string channel;
    State state = State::ok;
    bool has_value = false;
    double value = 0.0;
    double changed_s = 0.0;    // when it last changed
    std::size_t still = 0;     // readings since
    std::size_t readings = 0;  // up to the last change
    std::size_t changes = 0;
    double change_rate() const { return readings == 0 ? 0.0 : double(changes) / double(readings); }
  };
  bool stuck(const Sensor& sensor, double usual_rate) const;
  double usual_rate() const;

  std::vector<Sensor> m_sensors;
};

}  // namespace zerodrift::acquisition
