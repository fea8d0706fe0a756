#pragma once
// A part of the rig that is read beside the control: a temperature module, a probe amplifier, the topics of a broker,
// an agent. A kind is one file here and one line in kinds.cpp; device_line.h asks devices in turn and keeps what they
// said.

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "core/base/clock.h"
#include "core/base/result.h"
#include "core/controller/device_profile.h"

namespace zerodrift::controller {

/// One value of a signal and when it was true.
struct Reading {
  double value = 0.0;  // in the unit of the signal (C, um, mm, 1/min, W); NaN: the device says that it has none
  Seconds at{0.0};     // steady time of this computer (HostClock); the middle of the request, or the message's arrival
};

class Device {
 public:
  virtual ~Device() = default;
  /// One round: a reading of each signal the device was opened with, in their order. Blocks until the answer or a
  /// time-out of its own; a failure names the device's fault and makes every reading of this round missing.
  virtual Result<std::vector<Reading>> read() = 0;
  /// What was met and overcome, for the page and the record; each once.
  virtual std::vector<std::string> remarks() const { return {}; }
};

/// The device of a profile, reading the signals `names` (addresses in the device's own words, docs/profile.md). Nothing
/// is connected before the first read(). data_does_not_fit for a signal that such a device cannot have.
Result<std::unique_ptr<Device>> open_device(const DeviceProfile& profile, const std::vector<std::string>& names);

}  // namespace zerodrift::controller
