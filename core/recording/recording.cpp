#include "core/recording/recording.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace zerodrift::recording {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

}  // namespace

ChannelKind kind_of(std::string_view name) {
  if (name == "spindle_rpm") return ChannelKind::speed;
  if (name == "coolant_on") return ChannelKind::coolant;
  if (name == "spindle_load_W") return ChannelKind::load;
  if (name == "ambient_C") return ChannelKind::ambient;
  if (name.starts_with("feed_") && name.ends_with("_mm_min")) return ChannelKind::feed;
  if (name.ends_with("_C")) return ChannelKind::temperature;
  if (name.ends_with("_um")) return ChannelKind::error;
  if (name.ends_with("_urad")) return ChannelKind::tilt;
  return ChannelKind::input;
}

std::string_view unit_of(ChannelKind kind) {
  switch (kind) {
    case ChannelKind::temperature:
    case ChannelKind::ambient:
      return "C";
    case ChannelKind::error:
      return "um";
    case ChannelKind::tilt:
      return "urad";
    case ChannelKind::speed:
      return "rpm";
    case ChannelKind::feed:
      return "mm/min";
    case ChannelKind::load:
      return "W";
    case ChannelKind::coolant:
    case ChannelKind::input:
      return "";
  }
  return "";
}

bool is_input(ChannelKind kind) {
  return kind == ChannelKind::speed || kind == ChannelKind::feed || kind == ChannelKind::coolant ||
         kind == ChannelKind::load || kind == ChannelKind::input;
}

const Channel* Recording::find(std::string_view channel) const {
  const auto at = std::find_if(channels.begin(), channels.end(), [&](const Channel& c) { return c.name == channel; });
  return at == channels.end() ? nullptr : &*at;
}

Channel* Recording::find(std::string_view channel) {
  return const_cast<Channel*>(std::as_const(*this).find(channel));
}

Result<const Channel*> Recording::require(std::string_view channel) const {
  if (const Channel* found = find(channel)) return found;
  std::string available;
  for (const auto& c : channels) available += (available.empty() ? "" : ", ") + c.name;
  return fail(ErrorCode::channel_missing,
              {{"channel", std::string(channel)}, {"available", available}, {"file", name}});
}

std::vector<std::string> Recording::names(ChannelKind kind) const {
  std::vector<std::string> out;
  for (const auto& c : channels) {
    if (c.kind() == kind) out.push_back(c.name);
  }
  return out;
}

Channel& Recording::ensure(const std::string& channel) {
  if (Channel* found = find(channel)) return *found;
  return channels.emplace_back(Channel{channel, std::vector<double>(time_s.size(), missing)});
}

Recording slice(const Recording& recording, std::size_t first, std::size_t count) {
  first = std::min(first, recording.rows());
  count = std::min(count, recording.rows() - first);
  const auto cut = [&](const std::vector<double>& v) {
    const auto from = v.begin() + static_cast<std::ptrdiff_t>(first);
    return std::vector<double>(from, from + static_cast<std::ptrdiff_t>(count));
  };
  Recording out{recording.name, cut(recording.time_s), {}};
  for (const auto& c : recording.channels) out.channels.push_back({c.name, cut(c.values)});
  return out;
}

Recording slice_time(const Recording& recording, double from_s, double to_s) {
  const auto& t = recording.time_s;
  const auto first = std::lower_bound(t.begin(), t.end(), from_s);
  const auto last = std::lower_bound(first, t.end(), to_s);
  return slice(recording, static_cast<std::size_t>(first - t.begin()), static_cast<std::size_t>(last - first));
}

double value_at(const Recording& recording, const Channel& channel, double time_s) {
  const auto& t = recording.time_s;
  const auto& v = channel.values;
  const auto upper = static_cast<std::size_t>(std::upper_bound(t.begin(), t.end(), time_s) - t.begin());
  std::size_t left = upper;
  while (left > 0 && std::isnan(v[left - 1])) --left;
  std::size_t right = upper;
  while (right < v.size() && std::isnan(v[right])) ++right;
  if (left == 0) return right < v.size() ? v[right] : missing;
  if (right >= v.size()) return v[left - 1];
  const double share = (time_s - t[left - 1]) / (t[right] - t[left - 1]);
  return v[left - 1] + share * (v[right] - v[left - 1]);
}

double held_value_at(const Recording& recording, const Channel& channel, double time_s) {
  const auto& t = recording.time_s;
  const auto& v = channel.values;
  auto at = static_cast<std::size_t>(std::upper_bound(t.begin(), t.end(), time_s) - t.begin());
  while (at > 0) {
    if (!std::isnan(v[at - 1])) return v[at - 1];
    --at;
  }
  const auto first = std::find_if(v.begin(), v.end(), [](double x) { return !std::isnan(x); });
  return first == v.end() ? missing : *first;
}

std::size_t present_count(const Channel& channel) {
  return static_cast<std::size_t>(
      std::count_if(channel.values.begin(), channel.values.end(), [](double x) { return !std::isnan(x); }));
}

}  // namespace zerodrift::recording
