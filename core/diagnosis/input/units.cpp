#include "core/diagnosis/input/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/diagnosis/description/inner_bodies.h"
#include "core/diagnosis/input/samples.h"
#include "core/physics/builder.h"
#include "core/physics/initial_state.h"
#include "core/physics/prediction.h"

namespace zerodrift::diagnosis {
namespace {

/// What is missing changes a rise by tens of percent, heat that nobody described by a few times; no effect makes it a
/// hundred times larger or smaller.
constexpr double beyond_any_effect = 100.0;

struct Movement {
  double measured = 0.0;
  double simulated = 0.0;
};

double spread(std::vector<double> values) {
  if (values.size() < 3) return 0.0;
  std::sort(values.begin(), values.end());
  return values[values.size() * 98 / 100] - values[values.size() * 2 / 100];
}

Movement movement(const ChannelSamples& channel, const std::vector<double>& simulated) {
  std::vector<double> measured, predicted;
  for (std::size_t k = 0; k < channel.values.size(); ++k) {
    if (!channel.present[k]) continue;
    measured.push_back(channel.values[k]);
    predicted.push_back(simulated[k]);
  }
  return {spread(std::move(measured)), spread(std::move(predicted))};
}

/// Of all temperatures' movement, rms, what the rise of the machine as described, times one number, does not follow:
/// its shape, not its size.
double shape_missed(const physics::Machine& machine, const recording::Recording& recording) {
  const physics::Network network = physics::build_network(machine, recording);
  const std::vector<ChannelSamples> data = samples_of(recording, network);
  const physics::Prediction nominal =
      physics::predict(network, physics::make_inputs(network, recording), network.start_values());
  double spread = 0.0, measured2 = 0.0, product = 0.0, nominal2 = 0.0;
  for (std::size_t c = 0; c < data.size(); ++c) {
    const ChannelSamples& channel = data[c];
    if (channel.count == 0 || !channel.temperature) continue;
    const std::vector<double>& simulated = nominal.channels[c].values;
    const auto first = static_cast<std::size_t>(std::find(channel.present.begin(), channel.present.end(), true) -
                                                channel.present.begin());
    double sum = 0.0, squares = 0.0;
    for (std::size_t k = first; k < recording.rows(); ++k) {
      if (!channel.present[k]) continue;
      const double x = simulated[k] - simulated[first];
      const double y = channel.values[k] - channel.values[first];
      sum += y;
      squares += y * y;
      product += x * y / channel.count;
      nominal2 += x * x / channel.count;
    }
    measured2 += squares / channel.count;
    spread += squares / channel.count - std::pow(sum / channel.count, 2);
  }
  const double followed = nominal2 > 0.0 ? product * product / nominal2 : 0.0;
  return spread > 0.0 ? std::sqrt(std::max(0.0, measured2 - followed) / spread) : 0.0;
}

double largest_of(const recording::Recording& recording, const std::string& column) {
  const recording::Channel* channel = recording.find(column);
  double most = 0.0;
  if (channel == nullptr) return most;
  for (const double value : channel->values) most = std::max(most, std::isfinite(value) ? std::abs(value) : 0.0);
  return most;
}

double rated_power_W(const physics::Machine& machine) {
  double rated_W = 0.0;
  for (const auto& component : machine.components) {
    for (const auto& source : component.sources) {
      if (source.kind == physics::SourceKind::motor) rated_W = std::max(rated_W, source.rated_power_W);
    }
  }
  return rated_W;
}

/// A spindle that turns, but never with one two-hundredth of its motor's rated speed, is told in another unit.
Status check_speed(const physics::Machine& machine, const recording::Recording& recording) {
  constexpr double hardly = 0.005;  // in 1000 rpm it is at most a thousandth
  const double rated_rpm = machine.rated_speed_rpm();
  const double most_rpm = largest_of(recording, "spindle_rpm");
  constexpr double some_load = 0.05;  // of the rated power
  const double load_W = largest_of(recording, "spindle_load_W");
  const double rated_W = rated_power_W(machine);
  if (most_rpm == 0.0 && rated_W > 0.0 && load_W > some_load * rated_W) {
    return fail(ErrorCode::data_does_not_fit,
                {{"what", recording.name + ", column spindle_rpm"},
                 {"found", fmt::format("0 rpm all the time beside a load of up to {:.4g} W", load_W)},
                 {"expected", "the spindle's speed (was it logged?)"}});
  }
  constexpr double beyond_any = 20.0;  // of the rated speed: no spindle is so much faster than its motor
  if (rated_rpm > 0.0 && most_rpm > beyond_any * rated_rpm) {
    return fail(ErrorCode::data_does_not_fit,
                {{"what", recording.name + ", column spindle_rpm"},
                 {"found", fmt::format("up to {:.4g} rpm", most_rpm)},
                 {"expected", fmt::format("speeds of a motor rated at {:g} rpm", rated_rpm)}});
  }
  if (most_rpm == 0.0 || most_rpm > hardly * rated_rpm) return {};
  return fail(ErrorCode::data_does_not_fit,
              {{"what", recording.name + ", column spindle_rpm"},
               {"found", fmt::format("at most {:.3g} rpm", most_rpm)},
               {"expected", fmt::format("speeds of a motor rated at {:g} rpm (are they in 1000 rpm?)", rated_rpm)}});
}

/// Of all temperatures' movement, rms in K, what the machine as described leaves.
double left_K(const physics::Machine& machine, const recording::Recording& recording) {
  const physics::Network network = physics::build_network(machine, recording);
  const std::vector<ChannelSamples> data = samples_of(recording, network);
  const physics::Prediction nominal =
      physics::predict(network, physics::make_inputs(network, recording), network.start_values());
  double squares = 0.0, count = 0.0;
  for (std::size_t c = 0; c < data.size(); ++c) {
    const ChannelSamples& channel = data[c];
    for (std::size_t k = 0; channel.temperature && k < channel.values.size(); ++k) {
      if (!channel.present[k]) continue;
      squares += std::pow(channel.values[k] - nominal.channels[c].values[k], 2);
      count += 1.0;
    }
  }
  return count > 0.0 ? std::sqrt(squares / count) : 0.0;
}

double left_at_speed(const physics::Machine& machine, recording::Recording recording, double times) {
  for (double& speed : recording.find("spindle_rpm")->values) speed *= times;
  return left_K(machine, recording);
}

/// The room's column and a sensor's exchanged: the room warms as the machine does, and the machine as the room.
Status check_room(const physics::Machine& machine, const recording::Recording& recording) {
  constexpr double much_K = 1.0;
  constexpr double like = 0.2;  // of what is left with the columns as they are
  const std::string& room = machine.room.channel;
  if (room.empty() || recording.find(room) == nullptr || has_unknown_heat(machine)) return {};
  const double as_it_is_K = left_K(machine, recording);
  if (as_it_is_K < much_K) return {};
  const physics::Sensor* other = nullptr;
  double least_K = like * as_it_is_K;
  for (const physics::Sensor& sensor : machine.sensors) {
    if (sensor.channel == room || recording.find(sensor.channel) == nullptr) continue;
    recording::Recording turned = recording;
    std::swap(turned.find(room)->values, turned.find(sensor.channel)->values);
    const double turned_K = left_K(machine, turned);
    if (turned_K > least_K) continue;
    least_K = turned_K;
    other = &sensor;
  }
  if (other == nullptr) return {};
  return fail(ErrorCode::data_does_not_fit, {{"what", recording.name + ", columns " + room + " and " + other->channel},
                                             {"found", fmt::format("{} warming as {} should", room, other->channel)},
                                             {"expected", "the room in the room's column (are the two exchanged?)"}});
}

/// A machine that hardly turns, and warms as described if it turned as fast as in another unit.
Status check_turns(const physics::Machine& machine, const recording::Recording& recording) {
  struct Turns {
    double rpm;
    const char* symbol;
  };
  constexpr Turns others[] = {{60.0, "1/s"}, {30.0 / std::numbers::pi, "rad/s"}};
  constexpr double over_rated = 1.2;
  constexpr double like = 0.2;    // of what is left with the speeds as they are
  constexpr double much_K = 1.0;  // that is left so: of less nothing can be said
  const double rated_rpm = machine.rated_speed_rpm();
  const double most_rpm = largest_of(recording, "spindle_rpm");
  if (most_rpm == 0.0 || has_unknown_heat(machine) || physics::starts_warm(machine, recording)) return {};
  for (const Turns& unit : others) {
    if (unit.rpm * most_rpm > over_rated * rated_rpm) continue;
    const double as_it_is_K = left_at_speed(machine, recording, 1.0);
    if (as_it_is_K < much_K || left_at_speed(machine, recording, unit.rpm) > like * as_it_is_K) continue;
    return fail(ErrorCode::data_does_not_fit,
                {{"what", recording.name + ", column spindle_rpm"},
                 {"found", fmt::format("at most {:.3g} rpm", most_rpm)},
                 {"expected", fmt::format("the speed in rpm (by {} it is in {})", machine.file, unit.symbol)}});
  }
  return {};
}

/// Speeds of at most 100 that say how the machine warms if they are taken for percent of the rated one.
Status check_percent(const physics::Machine& machine, const recording::Recording& recording, double missed_at_most) {
  constexpr double whole = 100.0;
  const double rated_rpm = machine.rated_speed_rpm();
  const double most_rpm = largest_of(recording, "spindle_rpm");
  if (most_rpm == 0.0 || most_rpm > whole || rated_rpm < 10.0 * whole) return {};
  recording::Recording other = recording;
  for (double& speed : other.find("spindle_rpm")->values) speed *= rated_rpm / whole;
  if (shape_missed(machine, other) > missed_at_most) return {};
  return fail(ErrorCode::data_does_not_fit,
              {{"what", recording.name + ", column spindle_rpm"},
               {"found", fmt::format("at most {:.3g} rpm", most_rpm)},
               {"expected", fmt::format("speeds of a motor rated at {:g} rpm (are they in % of that?)", rated_rpm)}});
}

}  // namespace

std::optional<LoadUnit> load_in_other_unit(const physics::Machine& machine, const recording::Recording& recording) {
  const double rated_W = rated_power_W(machine);
  const double most = largest_of(recording, "spindle_load_W");
  if (rated_W == 0.0) return std::nullopt;
  constexpr double least_share = 0.05, most_share = 2.0;  // of the rated power
  const bool kilowatts = 1000.0 * most >= least_share * rated_W && 1000.0 * most <= most_share * rated_W;
  constexpr double least_percent = 5.0, most_percent = 150.0;
  const bool percent = most >= least_percent && most <= most_percent && most < least_share * rated_W;
  if (!kilowatts && !percent) return std::nullopt;
  return LoadUnit{kilowatts && percent ? "kW / %" : kilowatts ? "kW" : "%", most};
}

Status check_units(const physics::Machine& machine, const recording::Recording& recording) {
  ZD_CHECK(check_speed(machine, recording));
  ZD_CHECK(check_turns(machine, recording));
  ZD_CHECK(check_room(machine, recording));
  if (physics::starts_warm(machine, recording)) return {};  // what it was on its way to, nobody knows
  // A right description whose machine misses its main cooling leaves 0.8, times off by 60 leave more than 1.
  constexpr double nothing_like = 0.9;  // of the movement, rms
  constexpr double like = 0.75;         // of what is left with the times as they are
  struct Unit {
    double seconds;
    const char* plural;
  };
  constexpr Unit units[] = {{60.0, "minutes"}, {3600.0, "hours"}, {1e-3, "milliseconds"}};
  constexpr double hardly_turns = 0.02;  // of the rated speed
  constexpr double longest_row_s = 3600.0;
  constexpr double shortest_run_s = 600.0;  // what is shorter warms nothing: it is the description that is off
  const bool has_driven_rod = std::any_of(machine.components.begin(), machine.components.end(),
                                          [](const auto& one) { return !one.lump && !one.sources.empty(); });
  if (has_unknown_heat(machine) || !has_driven_rod) return {};  // nothing says how fast it warms
  const double as_it_is = shape_missed(machine, recording);
  if (!(as_it_is > nothing_like)) return {};
  ZD_CHECK(check_percent(machine, recording, like * as_it_is));
  // Of a spindle that hardly turns nothing says how fast it warms.
  if (largest_of(recording, "spindle_rpm") < hardly_turns * machine.rated_speed_rpm()) return {};
  const double whole_s = recording.time_s.back() - recording.time_s.front();
  for (const Unit& unit : units) {
    const double told_s = unit.seconds * whole_s;
    if (told_s > longest_row_s * static_cast<double>(recording.rows()) || told_s < shortest_run_s) continue;
    recording::Recording other = recording;
    for (double& t : other.time_s) t *= unit.seconds;
    if (shape_missed(machine, other) > like * as_it_is) continue;
    return fail(ErrorCode::data_does_not_fit,
                {{"what", recording.name + ", column time_s"},
                 {"found", fmt::format("{:.4g} s in all", whole_s)},
                 {"expected", fmt::format("seconds (by {} they are {})", machine.file, unit.plural)}});
  }
  return {};
}

/// A displacement that would move as described were it in another unit, while others are in the right one.
static Status check_millimetres(const physics::Machine& machine, const recording::Recording& recording,
                                const std::vector<ChannelSamples>& data, const physics::Prediction& nominal) {
  constexpr double much_um = 20.0;
  constexpr double um_per_mm = 1000.0;
  constexpr double about = 3.0;
  for (std::size_t c = 0; c < data.size(); ++c) {
    const ChannelSamples& channel = data[c];
    if (channel.count == 0 || channel.temperature) continue;
    const Movement moved = movement(channel, nominal.channels[c].values);
    const double times = moved.simulated / std::max(moved.measured, 1e-12);
    if (moved.simulated < much_um || times < um_per_mm / about || times > um_per_mm * about) continue;
    return fail(ErrorCode::data_does_not_fit,
                {{"what", recording.name + ", channel " + channel.channel},
                 {"found", fmt::format("a movement of {:.3g} um", moved.measured)},
                 {"expected", fmt::format("about {:.3g} um for {} (is it in mm?)", moved.simulated, machine.file)}});
  }
  return {};
}

namespace {

/// Whatever is off by a factor has noise that is off by it.
Status check_noise(const recording::Recording& recording, const std::vector<ChannelSamples>& data) {
  constexpr double absurd_um = 50.0;  // cameras and gauges have 0.05 to 5
  for (const ChannelSamples& channel : data) {
    if (channel.temperature || channel.count == 0 || channel.noise < absurd_um) continue;
    return fail(ErrorCode::data_does_not_fit, {{"what", recording.name + ", channel " + channel.channel},
                                               {"found", fmt::format("noise of {:.3g} um", channel.noise)},
                                               {"expected", "less than 50 um: is it in nm?"}});
  }
  return {};
}

}  // namespace

Status check_scale(const physics::Machine& machine, const recording::Recording& recording) {
  if (has_unknown_heat(machine)) return {};  // nothing to compare with
  const physics::Network network = physics::build_network(machine, recording);
  const std::vector<ChannelSamples> data = samples_of(recording, network);
  const physics::Prediction nominal =
      physics::predict(network, physics::make_inputs(network, recording), network.start_values());
  ZD_CHECK(check_millimetres(machine, recording, data, nominal));
  ZD_CHECK(check_noise(recording, data));
  for (const bool temperature : {true, false}) {
    struct Named {
      std::string channel;
      Movement movement;
    };
    Named moved, expected;  // the channel that moved most, and that of which most was expected
    for (std::size_t c = 0; c < data.size(); ++c) {
      const ChannelSamples& channel = data[c];
      if (channel.count == 0 || channel.temperature != temperature) continue;
      const Movement here = movement(channel, nominal.channels[c].values);
      if (here.measured > moved.movement.measured) moved = {channel.channel, here};
      if (here.simulated > expected.movement.simulated) expected = {channel.channel, here};
    }
    // Both have to move by more than noise and a changing room would explain.
    constexpr double little = 0.01;
    const double much = temperature ? 5.0 : 20.0;
    const double measured = moved.movement.measured, simulated = expected.movement.simulated;
    const bool too_large = measured > much && simulated > little && measured > beyond_any_effect * simulated;
    // No machine tool warms by so much: less than a hundredfold tells then (sizes in cm heat by ninety times as much).
    constexpr double absurd_K = 150.0;
    constexpr double beyond_most_effects = 20.0;
    const bool absurd = temperature && simulated > absurd_K;
    const bool too_small =
        simulated > much && simulated > measured * (absurd ? beyond_most_effects : beyond_any_effect);
    if (!too_large && !too_small) continue;
    const char* unit = temperature ? "K" : "um";
    const Named& told = too_large ? moved : expected;
    return fail(ErrorCode::data_does_not_fit,
                {{"what", recording.name + (told.channel.empty() ? "" : ", channel " + told.channel)},
                 {"found", fmt::format("a movement of {:.3g} {}", told.movement.measured, unit)},
                 {"expected", fmt::format("about {:.3g} {} for {}; check units, geometry and powers", simulated, unit,
                                          machine.file)}});
  }
  return {};
}

}  // namespace zerodrift::diagnosis
