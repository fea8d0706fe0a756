#pragma once
// What the devices beside the control say, kept as it comes: each line (a serial port, a socket) has a thread of its
// own that asks its devices in turn, so that one that is dead delays none on other lines. A value is held until the
// next one; one that was not renewed in its device's stale_after_s is missing.

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/acquisition/machine_io.h"
#include "core/controller/devices/device.h"
#include "core/controller/profile.h"

namespace zerodrift::controller {

/// How a device does, for the page and the record.
struct DeviceState {
  std::string id;
  long rounds = 0;              // that were answered
  long faults = 0;              // that were not
  std::optional<Error> fault;   // of the last round; nothing: it answers
  std::optional<double> age_s;  // of its last answer
  double round_trip_s = 0.0;    // of its last answer
  double mean_age_s = 0.0;      // of the values that were taken over into samples
  double largest_age_s = 0.0;
  std::vector<std::string> remarks;
};

class DeviceReadings {
 public:
  /// Starts asking. Null for a profile whose control has all of it.
  static Result<std::shared_ptr<DeviceReadings>> open(const Profile& profile);
  ~DeviceReadings();
  DeviceReadings(const DeviceReadings&) = delete;
  DeviceReadings& operator=(const DeviceReadings&) = delete;

  /// Waits until each device has answered or failed once, at most its time-out and a second.
  void wait_for_first();
  /// Puts what the devices say into a reading of the control: values, the age of each, and the faults by device.
  void put_into(acquisition::MachineSample& sample) const;
  std::vector<DeviceState> states() const;
  /// "module-1: 3 of 120 rounds were not answered", and what the devices remark.
  std::vector<std::string> remarks() const;

 private:
  struct Entry;
  struct Line;
  DeviceReadings() = default;
  static void ask_in_turn(Line& line, const std::stop_token& stop);
  static void ask(Entry& entry);
  Reading latest(const SignalSource& source) const;

  std::vector<SignalSource> m_temperatures;  // in the order of the profile's sensors
  SignalSources m_sources;
  std::vector<std::unique_ptr<Entry>> m_entries;
  std::vector<std::unique_ptr<Line>> m_lines;  // after the entries: their threads end first
};

}  // namespace zerodrift::controller
