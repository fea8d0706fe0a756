#pragma once
// The values of every signal of a profile that is being set up, read as a run reads them: one row each, the control
// among the devices. Reads only.

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/controller/device_readings.h"
#include "core/controller/profile_signals.h"

namespace zerodrift::controller {

struct LiveValue {
  double value = 0.0;  // not a number: there is none
  long rounds = 0;     // that its device has answered: the same number is the same reading
};

class LiveSignals {
 public:
  /// Starts asking. Rows without a source have no value.
  static Result<std::shared_ptr<LiveSignals>> open(const Profile& profile, const std::vector<SignalRow>& rows);

  /// By the rows' places. Those of a device that was not asked yet are not in it.
  std::map<std::string, LiveValue> values() const;
  std::vector<DeviceState> states() const;

 private:
  LiveSignals() = default;

  std::vector<std::pair<std::string, std::string>> m_rows;  // place and device
  std::shared_ptr<DeviceReadings> m_readings;
};

/// What a test of one device found: it was reached and asked once.
struct DeviceTest {
  double round_trip_s = 0.0;
  std::vector<std::pair<std::string, double>> values;  // of each signal of its map or those that were named
  std::vector<std::string> remarks;
};
/// Of a Modbus device the values of its map, of an agent its samples; of a broker `signals`.
Result<DeviceTest> test_device(const DeviceProfile& device, std::vector<std::string> signals,
                               const std::stop_token& stop);

}  // namespace zerodrift::controller
