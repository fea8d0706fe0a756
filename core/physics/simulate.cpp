#include "core/physics/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/physics/builder.h"
#include "core/physics/prediction.h"

namespace zerodrift::physics {
namespace {

std::string names_of(const recording::Recording& recording) {
  std::string list;
  for (const auto& channel : recording.channels) list += (list.empty() ? "" : ", ") + channel.name;
  return list;
}

/// Channels that drive the model and must be there.
std::vector<std::string> needed_inputs(const Machine& machine) {
  std::vector<std::string> needed;
  for (const auto& component : machine.components) {
    for (const auto& source : component.sources) {
      const bool by_speed = source.kind == SourceKind::motor || source.kind == SourceKind::bearing;
      needed.push_back(by_speed ? "spindle_rpm" : source.channel);
    }
  }
  return needed;
}

}  // namespace

Result<std::vector<std::string>> check_recording(const Machine& machine, const recording::Recording& recording) {
  std::vector<std::string> warnings;
  if (recording.rows() < 2) {
    return fail(ErrorCode::not_enough_data,
                {{"what", recording.name}, {"found", std::to_string(recording.rows())}, {"needed", "2 samples"}});
  }
  for (const auto& channel : needed_inputs(machine)) {
    if (recording.find(channel) == nullptr) {
      return fail(ErrorCode::channel_missing,
                  {{"channel", channel}, {"available", names_of(recording)}, {"file", recording.name}});
    }
  }
  for (const auto& sensor : machine.sensors) {
    const recording::Channel* channel = recording.find(sensor.channel);
    if (channel == nullptr) {
      warnings.push_back(recording.name + " has no channel " + sensor.channel);
      continue;
    }
    std::vector<double> present;
    for (const double value : channel->values) {
      if (std::isfinite(value)) present.push_back(value);
    }
    if (present.empty()) continue;
    // The median: a single spike is a fault of one sample, not of the unit.
    std::nth_element(present.begin(), present.begin() + std::ssize(present) / 2, present.end());
    const double middle = present[present.size() / 2];
    if (middle > 200.0 || middle < -80.0) {
      return fail(ErrorCode::data_does_not_fit, {{"what", recording.name + ", channel " + sensor.channel},
                                                 {"found", fmt::format("{:g} as its middle value", middle)},
                                                 {"expected", "degrees Celsius (is it in kelvin or millidegrees?)"}});
    }
  }
  return warnings;
}

Result<Simulation> simulate(const Machine& machine, const recording::Recording& inputs, const TaskContext& context) {
  ZD_TRY(auto notes, check_recording(machine, inputs));
  if (context.cancelled()) return fail(ErrorCode::cancelled);
  const Network network = build_network(machine, inputs);
  const InputSet set = make_inputs(network, inputs);
  const Prediction prediction = predict(network, set, network.start_values());
  context.progress(1.0, "simulating");
  Simulation result;
  result.notes = network.notes;
  result.prediction.name = inputs.name;
  result.prediction.time_s = inputs.time_s;
  for (const auto& channel : inputs.channels) {
    const bool measured = std::any_of(prediction.channels.begin(), prediction.channels.end(),
                                      [&](const auto& one) { return one.channel == channel.name; });
    if (measured) continue;
    const auto kind = channel.kind();
    if (recording::is_input(kind) || kind == recording::ChannelKind::ambient || channel.name == machine.room.channel) {
      result.prediction.channels.push_back(channel);
    } else {
      result.not_predicted.push_back(channel.name);
    }
  }
  for (const auto& channel : prediction.channels) {
    for (const double value : channel.values) {
      if (!std::isfinite(value)) return fail(ErrorCode::internal, {{"detail", "the simulation left all bounds"}});
    }
    result.predicted.push_back(channel.channel);
    result.prediction.channels.push_back({channel.channel, channel.values});
  }
  return result;
}

Result<recording::Recording> with_simulation(const Machine& machine, const recording::Recording& recording,
                                             const TaskContext& context) {
  auto simulation = simulate(machine, recording, context);
  if (!simulation) return fail(std::move(simulation).error().with("recording", recording.name));
  recording::Recording out = recording;
  for (const auto& channel : simulation->prediction.channels) {
    if (channel.kind() != recording::ChannelKind::error) continue;
    const std::string direction = channel.name.substr(0, channel.name.size() - std::string_view("_um").size());
    recording::Channel& added = out.ensure("simulated_" + direction);
    for (std::size_t i = 0; i < channel.values.size(); ++i) added.values[i] = channel.values[i] - channel.values[0];
  }
  return out;
}

std::vector<ChannelDifference> compare(const recording::Recording& prediction, const recording::Recording& measured) {
  std::vector<ChannelDifference> list;
  for (const auto& channel : prediction.channels) {
    const recording::Channel* seen = measured.find(channel.name);
    const auto kind = channel.kind();
    const bool temperature = kind == recording::ChannelKind::temperature;
    const bool error = kind == recording::ChannelKind::error || kind == recording::ChannelKind::tilt;
    if (seen == nullptr || (!temperature && !error) || seen->values.size() != channel.values.size()) continue;
    ChannelDifference d;
    d.channel = channel.name;
    d.temperature = temperature;
    double sum = 0.0;
    int count = 0;
    for (std::size_t k = 0; k < seen->values.size(); ++k) {
      const double e = seen->values[k] - channel.values[k];
      if (!std::isfinite(e)) continue;
      sum += e * e;
      ++count;
      if (std::abs(e) > std::abs(d.largest)) {
        d.largest = e;
        d.largest_at_s = measured.time_s[k];
      }
    }
    if (count > 0) d.rms = std::sqrt(sum / count);
    list.push_back(d);
  }
  return list;
}

}  // namespace zerodrift::physics
