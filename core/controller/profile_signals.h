#pragma once
// What a profile reads and where: one row for each temperature sensor and each quantity of the machine, assigned or
// not, with its unit and what a value of it can be.

#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/controller/device_profile.h"

namespace zerodrift::controller {

enum class SignalUse {
  sensor,
  ambient,
  speed,
  load,
  coolant,
  compensation_state,
  position,
  probe,
};

struct SignalRow {
  std::string place;  // in the profile: "sensors[3]", "positions.X"
  SignalUse use = SignalUse::sensor;
  std::string name;     // the sensor's channel, the axis, the probe
  SignalSource source;  // as the profile names it; no device: the control's, where it has one
};

/// Sensors in the order of the profile, then the quantities. Of a document that need not be a valid profile.
std::vector<SignalRow> signal_rows(const nlohmann::json& document);
/// The control's own register of it; the n-th sensor is the n-th of its temperatures.
std::string control_signal(const SignalRow& row);

/// What values are believed.
struct SignalRange {
  const char* unit = "";
  double low = 0.0;
  double high = 0.0;
  bool varies = false;  // a measured value: one that never changes by a digit is not measured
};
SignalRange range_of(SignalUse use);

enum class Plausibility {
  unknown,  // nothing was read yet
  ok,
  unchanged,
  out_of_range,
  missing,
};

/// The values of one signal as they come.
class SignalWatch {
 public:
  explicit SignalWatch(SignalRange range) : m_range(range) {}
  /// Not a number: it was asked and had none.
  void add(double value);
  Plausibility judgement() const;
  double last() const { return m_last; }
  /// Since the first value: what a warm hand on the sensor shows.
  double change() const { return m_last - m_first; }

 private:
  SignalRange m_range;
  double m_first = std::numeric_limits<double>::quiet_NaN();
  double m_last = std::numeric_limits<double>::quiet_NaN();
  bool m_asked = false;
  bool m_changed = false;
  int m_values = 0;
};

}  // namespace zerodrift::controller
