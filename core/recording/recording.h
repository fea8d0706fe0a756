#pragma once
// A recording: time series of one run on a common time axis, as in a warm-up test by ISO 230-3.
// time_s is strictly increasing and may have gaps; a missing sample is NaN. The unit of a channel is in its name:
// temperatures "<name>_C", errors "<name>_um" (error = actual - commanded), tilts "<name>_urad",
// "spindle_rpm", "feed_<axis>_mm_min", "coolant_on" (0 or 1), "spindle_load_W", "ambient_C", and free inputs.
// Inputs hold from their sample to the next one.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace zerodrift::recording {

enum class ChannelKind { temperature, ambient, error, tilt, speed, feed, coolant, load, input };

/// From the channel's name alone.
ChannelKind kind_of(std::string_view name);
/// "C", "um", "urad", "rpm", "mm/min", "W" or "".
std::string_view unit_of(ChannelKind kind);
/// speed, feed, coolant, load and free inputs: held from sample to sample.
bool is_input(ChannelKind kind);

struct Channel {
  std::string name;
  std::vector<double> values;  // NaN: missing

  ChannelKind kind() const { return kind_of(name); }
};

struct Recording {
  std::string name;            // file or series it came from
  std::vector<double> time_s;  // strictly increasing
  std::vector<Channel> channels;

  std::size_t rows() const { return time_s.size(); }
  const Channel* find(std::string_view channel) const;
  Channel* find(std::string_view channel);
  /// The channel, or channel_missing naming those that are there.
  Result<const Channel*> require(std::string_view channel) const;
  std::vector<std::string> names(ChannelKind kind) const;
  /// Adds a channel of NaN if it is not there yet.
  Channel& ensure(const std::string& channel);
};

/// Rows [first, first + count).
Recording slice(const Recording& recording, std::size_t first, std::size_t count);
/// Rows with from_s <= time < to_s.
Recording slice_time(const Recording& recording, double from_s, double to_s);
/// Linear between the neighbouring samples that are there; held at the ends; NaN if the channel is empty.
double value_at(const Recording& recording, const Channel& channel, double time_s);
/// Value held from the last sample at or before the time (the first sample before the start).
double held_value_at(const Recording& recording, const Channel& channel, double time_s);
/// Number of samples that are there.
std::size_t present_count(const Channel& channel);

}  // namespace zerodrift::recording
