#include "core/diagnosis/input/long_gaps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace zerodrift::diagnosis {
namespace {

constexpr double always_s = 1800.0;
constexpr double with_change_s = 600.0;
constexpr double usual_intervals = 10.0;
constexpr double change = 0.1;  // of an input's range

double usual_interval_s(const std::vector<double>& time_s) {
  std::vector<double> intervals;
  for (std::size_t k = 1; k < time_s.size(); ++k) intervals.push_back(time_s[k] - time_s[k - 1]);
  const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
  std::nth_element(intervals.begin(), middle, intervals.end());
  return *middle;
}

bool input_changes(const recording::Recording& recording, std::size_t row) {
  return std::any_of(recording.channels.begin(), recording.channels.end(), [row](const recording::Channel& channel) {
    if (!recording::is_input(channel.kind())) return false;
    double low = 1e300, high = -1e300;
    for (const double v : channel.values) {
      if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
    }
    return std::abs(channel.values[row] - channel.values[row - 1]) > change * (high - low);
  });
}

/// Displacements count from the recording's start, so here from the part's.
void set_to_zero(std::vector<double>& values) {
  constexpr int first_samples = 3;
  double sum = 0.0;
  int count = 0;
  for (std::size_t k = 0; k < values.size() && count < first_samples; ++k) {
    if (std::isfinite(values[k])) sum += values[k], ++count;
  }
  for (double& value : values) value -= count > 0 ? sum / count : 0.0;
}

}  // namespace

std::optional<LongestPart> longest_part(const recording::Recording& recording) {
  const std::vector<double>& time_s = recording.time_s;
  if (time_s.size() < 3) return std::nullopt;
  const double least_s = usual_intervals * usual_interval_s(time_s);
  std::vector<std::size_t> starts{0};
  for (std::size_t k = 1; k < time_s.size(); ++k) {
    const double gap_s = time_s[k] - time_s[k - 1];
    if (gap_s <= std::max(with_change_s, least_s)) continue;
    if (gap_s > always_s || input_changes(recording, k)) starts.push_back(k);
  }
  if (starts.size() == 1) return std::nullopt;
  starts.push_back(time_s.size());
  std::size_t best = 0;
  const auto length_s = [&](std::size_t part) { return time_s[starts[part + 1] - 1] - time_s[starts[part]]; };
  for (std::size_t part = 1; part + 1 < starts.size(); ++part) {
    if (length_s(part) > length_s(best)) best = part;
  }
  const auto from = static_cast<std::ptrdiff_t>(starts[best]);
  const auto to = static_cast<std::ptrdiff_t>(starts[best + 1]);
  LongestPart out;
  out.recording = recording::slice(recording, starts[best], starts[best + 1] - starts[best]);
  out.recording.name = recording.name;
  for (recording::Channel& channel : out.recording.channels) {
    if (from > 0 && channel.kind() == recording::ChannelKind::error) set_to_zero(channel.values);
  }
  out.note = fmt::format(
      "{}: {} of {} samples were used, from {:.0f} to {:.0f} min, for nothing was measured for {:.0f} min before or "
      "after "
      "them",
      recording.name, to - from, time_s.size(), out.recording.time_s.front() / 60.0, out.recording.time_s.back() / 60.0,
      std::max(from > 0 ? time_s[starts[best]] - time_s[starts[best] - 1] : 0.0,
               starts[best + 1] < time_s.size() ? time_s[starts[best + 1]] - time_s[starts[best + 1] - 1] : 0.0) /
          60.0);
  return out;
}

}  // namespace zerodrift::diagnosis
