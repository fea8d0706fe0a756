#include "core/diagnosis/search/run_facts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/physics/builder.h"
#include "core/physics/inputs.h"

namespace zerodrift::diagnosis::search {
namespace {

constexpr std::size_t fewest_samples = 10;

bool acts(const recording::Recording& recording, const char* name) {
  const recording::Channel* channel = recording.find(name);
  return channel != nullptr &&
         std::any_of(channel->values.begin(), channel->values.end(), [](double v) { return std::abs(v) > 1e-9; });
}

std::pair<double, double> limits(const recording::Channel& channel) {
  double low = 1e300, high = -1e300;
  for (const double v : channel.values) {
    if (!std::isfinite(v)) continue;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  return {low, high};
}

/// The moments of the largest single-sample jumps, each at the first sample after it.
std::vector<double> jumps(const recording::Channel& channel, const std::vector<double>& time_s) {
  std::vector<std::pair<double, double>> list;
  const double noise = physics::noise_width(channel.values, 0.05);
  constexpr std::size_t at_the_ends = 5;  // samples: a step there is no more than a disturbed start or end
  const auto& v = channel.values;
  const auto slope = [&](std::size_t from, std::size_t to) { return (v[to] - v[from]) / (time_s[to] - time_s[from]); };
  const auto middle = [](double a, double b) { return 0.5 * (a + b); };
  for (std::size_t k = at_the_ends; k + at_the_ends < time_s.size(); ++k) {
    // Beside what the slope before and after lets expect: a spindle that warms up grows by micrometres a minute.
    const double apart_s = middle(time_s[k], time_s[k + 1]) - middle(time_s[k - 1], time_s[k - 2]);
    const double grown = apart_s * middle(slope(k - 4, k - 1), slope(k, k + 3));
    const double jump = std::abs(middle(v[k], v[k + 1]) - middle(v[k - 1], v[k - 2]) - grown);
    if (std::isfinite(jump) && jump > 4.0 * noise) list.emplace_back(jump, time_s[k]);
  }
  std::sort(list.rbegin(), list.rend());
  std::vector<double> times_s;
  for (const auto& [jump, at_s] : list) {
    const bool near =
        std::any_of(times_s.begin(), times_s.end(), [&, t = at_s](double s) { return std::abs(s - t) < 300.0; });
    if (!near) times_s.push_back(at_s);
    if (times_s.size() == 3) break;
  }
  return times_s;
}

/// Logged inputs that neither a source nor a fluid of the description uses, nor an effect of its own.
std::map<std::string, double> unused_inputs(const physics::Machine& machine, const recording::Recording& recording) {
  std::set<std::string> used{"spindle_rpm", "coolant_on", "spindle_load_W"};
  for (const auto& component : machine.components) {
    for (const auto& source : component.sources) used.insert(source.channel);
  }
  for (const auto& fluid : machine.fluids) used.insert(fluid.flow_channel);
  for (const auto& effect : machine.effects) used.insert(effect.word_or("driver", ""));
  std::map<std::string, double> list;
  for (const auto& channel : recording.channels) {
    if (!recording::is_input(channel.kind()) || used.count(channel.name) != 0 ||
        recording::present_count(channel) < fewest_samples)
      continue;
    const auto [low, high] = limits(channel);
    if (high - low > 1e-9) list[channel.name] = std::max(std::abs(low), std::abs(high));
  }
  return list;
}

}  // namespace

physics::RunFacts run_facts(const physics::Machine& machine, const recording::Recording& recording) {
  physics::RunFacts facts;
  facts.duration_s = recording.time_s.back() - recording.time_s.front();
  facts.has_speed = acts(recording, "spindle_rpm");
  facts.has_coolant = acts(recording, "coolant_on");
  facts.has_load = acts(recording, "spindle_load_W");
  facts.room_logged = !machine.room.channel.empty() && recording.find(machine.room.channel) != nullptr;
  facts.full_speed_rpm = machine.rated_speed_rpm();
  if (const auto* speed = recording.find("spindle_rpm"); speed != nullptr && facts.full_speed_rpm <= 0.0)
    facts.full_speed_rpm = std::max(1.0, limits(*speed).second);
  for (const auto& component : machine.components) {
    for (const auto& source : component.sources) {
      double input = facts.full_speed_rpm;
      const bool by_speed = source.kind == physics::SourceKind::motor || source.kind == physics::SourceKind::bearing;
      if (const auto* channel = recording.find(source.channel); !by_speed && channel != nullptr)
        input = limits(*channel).second;
      facts.typical_heat_W += physics::nominal_heat_W(source, input, std::max(1.0, facts.full_speed_rpm));
    }
  }
  for (const auto& sensor : machine.sensors) {
    const auto* channel = recording.find(sensor.channel);
    if (channel == nullptr || recording::present_count(*channel) < fewest_samples) continue;
    facts.channels.push_back(sensor.channel);
    const auto [low, high] = limits(*channel);
    facts.temperature_rise_K = std::max(facts.temperature_rise_K, high - low);
  }
  for (const auto& displacement : machine.displacements) {
    const auto* channel = recording.find(displacement.channel);
    if (channel == nullptr || recording::present_count(*channel) < fewest_samples) continue;
    const auto [low, high] = limits(*channel);
    facts.displacement_range_um = std::max(facts.displacement_range_um, high - low);
    facts.jump_times_s[displacement.channel] = jumps(*channel, recording.time_s);
  }
  facts.unused_inputs = unused_inputs(machine, recording);
  return facts;
}

physics::RunFacts merged(const std::vector<physics::RunFacts>& facts) {
  physics::RunFacts all = facts.front();
  for (const physics::RunFacts& one : facts) {
    all.duration_s = std::max(all.duration_s, one.duration_s);
    all.full_speed_rpm = std::max(all.full_speed_rpm, one.full_speed_rpm);
    all.has_speed |= one.has_speed;
    all.has_coolant |= one.has_coolant;
    all.has_load |= one.has_load;
    all.room_logged |= one.room_logged;
    all.typical_heat_W = std::max(all.typical_heat_W, one.typical_heat_W);
    all.temperature_rise_K = std::max(all.temperature_rise_K, one.temperature_rise_K);
    all.displacement_range_um = std::max(all.displacement_range_um, one.displacement_range_um);
    all.unused_inputs.insert(one.unused_inputs.begin(), one.unused_inputs.end());
    for (const std::string& channel : one.channels) {
      if (std::find(all.channels.begin(), all.channels.end(), channel) == all.channels.end())
        all.channels.push_back(channel);
    }
  }
  return all;
}

}  // namespace zerodrift::diagnosis::search
