#pragma once
// Sensors that have stopped telling the truth, seen while the run goes on.
// Dead: no value. Stuck: no change for so long that a sensor with its noise would have changed many times.
// Spiking: single readings far off, again and again. Jumped: from one reading to the next further than heat can go, and
// it stays there. Swapped: two jumped at once, each to where the other was.

#include <cstddef>
#include <deque>
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
  enum class State { ok, dead, stuck, spiking };
  struct Sensor {
    std::string channel;
    State state = State::ok;
    bool has_value = false;
    double value = 0.0;
    double changed_s = 0.0;    // when it last changed
    std::size_t still = 0;     // readings since
    std::size_t readings = 0;  // up to the last change
    std::size_t changes = 0;
    std::deque<double> steps;  // sizes of the latest ordinary steps: what its noise is
    double level = 0.0;        // the latest reading that was no step too far
    double level_s = 0.0;
    bool has_level = false;
    std::deque<double> far;       // readings since, all too far from it
    std::deque<double> spikes_s;  // when it had one
    double change_rate() const { return readings == 0 ? 0.0 : double(changes) / double(readings); }
  };
  struct Jump {
    std::size_t sensor;
    double from;
    double to;
  };
  bool stuck(const Sensor& sensor, double usual_rate) const;
  static double too_far_K(const Sensor& sensor, double time_s);
  static void follow(Sensor& sensor, double time_s, double value, std::vector<Jump>& jumps, std::size_t index);
  static bool spiking(Sensor& sensor, double time_s);
  Change jumped(const std::vector<Jump>& jumps, std::size_t at) const;
  double usual_rate() const;

  std::vector<Sensor> m_sensors;
};

}  // namespace zerodrift::acquisition
