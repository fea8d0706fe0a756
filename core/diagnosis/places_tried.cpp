#include "core/diagnosis/places_tried.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string_view>

#include "core/diagnosis/refine.h"

namespace zerodrift::diagnosis {
namespace {

constexpr std::string_view joint_id = "contact_resistance";
constexpr double far = 0.1;  // of the length: what is nearer is a tape measure's error

struct Unit {
  const char* symbol;
  double mm;
};
constexpr std::array other_units{Unit{"cm", 10.0}, Unit{"in", 25.4}, Unit{"m", 1000.0}};

physics::Sensor& sensor_of(physics::Machine& machine, const std::string& channel) {
  return *std::find_if(machine.sensors.begin(), machine.sensors.end(),
                       [&](const auto& sensor) { return sensor.channel == channel; });
}

/// Sensors on rods, those that the model misses most first.
std::vector<physics::Sensor> missed_most(const Model& model) {
  struct Suspect {
    physics::Sensor sensor;
    double excess = 0.0;
  };
  const Excess excess = excess_of(model);
  std::vector<Suspect> list;
  for (std::size_t c = 0; c < model.data().channels.size(); ++c) {
    const MeasuredChannel& channel = model.data().channels[c];
    const physics::Sensor* sensor = model.machine().sensor(channel.name);
    if (channel.samples == 0 || sensor == nullptr) continue;
    const physics::Component* rod = model.machine().find(sensor->component);
    if (rod == nullptr || rod->lump) continue;
    list.push_back({*sensor, excess.per_channel[c]});
  }
  std::sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.excess > b.excess; });
  std::vector<physics::Sensor> sensors;
  for (const Suspect& one : list) sensors.push_back(one.sensor);
  return sensors;
}

/// Those that the base or what explains it best misses most, and those that are said to be at fault.
std::vector<physics::Sensor> suspects(const Model& base, const Model& best, const Model& sound) {
  constexpr std::size_t most_of_each = 2;
  std::vector<physics::Sensor> list;
  const auto take = [&](const physics::Sensor& sensor) {
    if (std::none_of(list.begin(), list.end(), [&](const auto& one) { return one.channel == sensor.channel; })) {
      list.push_back(sensor);
    }
  };
  for (const Model* model : {&base, &sound}) {
    std::vector<physics::Sensor> missed = missed_most(*model);
    missed.resize(std::min(most_of_each, missed.size()));
    std::for_each(missed.begin(), missed.end(), take);
  }
  for (const auto& spec : best.machine().effects) {
    if (!spec.candidate || !spec.id.starts_with("sensor_")) continue;
    const physics::Sensor* at_fault = best.machine().sensor(spec.word_or("channel", ""));
    const physics::Component* rod = at_fault == nullptr ? nullptr : best.machine().find(at_fault->component);
    if (rod != nullptr && !rod->lump) take(*at_fault);
  }
  return list;
}

void add_places(std::vector<Trial>& trials, const Model& base, const physics::Sensor& sensor) {
  const double length_mm = base.machine().find(sensor.component)->length_mm;
  const double here_mm = sensor.position_mm;
  for (int i = 0; i < tried_per_rod; ++i) {
    const double at_mm = (i + 0.5) / tried_per_rod * length_mm;
    if (std::abs(at_mm - here_mm) > far * length_mm)
      trials.push_back({{sensor.channel, here_mm, at_mm, {}, {}}, Mistake::another_place, {}});
  }
  for (const Unit& unit : other_units) {
    const double at_mm = here_mm * unit.mm;
    if (at_mm > length_mm || at_mm - here_mm <= far * length_mm) continue;
    trials.push_back({{sensor.channel, here_mm, at_mm, {}, {}}, Mistake::typical, {}});
  }
}

/// Any two of a rod that are not next to each other's places: of two exchanged cables a fit may miss others most.
void add_exchanges(std::vector<Trial>& trials, const Model& base, const std::vector<physics::Sensor>& all) {
  for (auto one = all.begin(); one != all.end(); ++one) {
    const double length_mm = base.machine().find(one->component)->length_mm;
    for (auto other = std::next(one); other != all.end(); ++other) {
      if (other->component != one->component) continue;
      if (std::abs(other->position_mm - one->position_mm) < far * length_mm) continue;
      trials.push_back(
          {{one->channel, one->position_mm, other->position_mm, other->channel, {}}, Mistake::typical, {}});
    }
  }
}

void add_a_little_aside(std::vector<Trial>& trials, const Model& best, const physics::Sensor& sensor) {
  const double length_mm = best.machine().find(sensor.component)->length_mm;
  for (const double aside : {-0.09, -0.06, -0.03, 0.03, 0.06, 0.09}) {
    const double at_mm = sensor.position_mm + aside * length_mm;
    if (at_mm < 0.0 || at_mm > length_mm) continue;
    trials.push_back({{sensor.channel, sensor.position_mm, at_mm, {}, {}}, Mistake::a_little_aside, {}});
  }
}

/// The sensors next to the joints that are named, a little to either side of their places: one that sits elsewhere
/// reads too much or too little in proportion to what flows past it, as beside a joint.
std::vector<Trial> aside_of_joints(const Model& best, const std::vector<physics::Sensor>& all) {
  std::vector<Trial> trials;
  for (const auto& joint : best.machine().effects) {
    if (!joint.candidate || joint.id != joint_id) continue;
    const std::string rod = joint.word_or("component", "");
    const double joint_mm = joint.number_or("position_mm", 0.0);
    for (const double side : {-1.0, 1.0}) {
      const physics::Sensor* next = nullptr;
      for (const physics::Sensor& one : all) {
        const double away_mm = side * (one.position_mm - joint_mm);
        if (one.component != rod || away_mm < 0.0) continue;
        if (next == nullptr || away_mm < side * (next->position_mm - joint_mm)) next = &one;
      }
      if (next != nullptr) add_a_little_aside(trials, best, *next);
    }
  }
  return trials;
}

/// The sensors that are said to answer late or by another gain, likewise: so does one that sits farther from the heat.
std::vector<Trial> aside_of_faults(const Model& best, const std::vector<physics::Sensor>& all) {
  std::vector<Trial> trials;
  for (const auto& fault : best.machine().effects) {
    if (!fault.candidate || (fault.id != "sensor_lag" && fault.id != "sensor_gain")) continue;
    for (const physics::Sensor& one : all) {
      if (one.channel == fault.word_or("channel", "")) add_a_little_aside(trials, best, one);
    }
  }
  return trials;
}

/// All places of a rod in another unit, told by the sensor that is farthest from the fixed end.
void add_units(std::vector<Trial>& trials, const Model& base, const std::vector<physics::Sensor>& all) {
  constexpr double most_of_length = 0.15;  // a rod whose sensors are all at its one end is no usual one
  for (const physics::Sensor& sensor : all) {
    const bool farthest = std::none_of(all.begin(), all.end(), [&](const physics::Sensor& other) {
      return other.component == sensor.component && other.position_mm > sensor.position_mm;
    });
    const double length_mm = base.machine().find(sensor.component)->length_mm;
    if (!farthest || sensor.position_mm > most_of_length * length_mm) continue;
    for (const Unit& unit : other_units) {
      const double at_mm = sensor.position_mm * unit.mm;
      if (at_mm <= length_mm)
        trials.push_back({{sensor.channel, sensor.position_mm, at_mm, {}, unit.symbol}, Mistake::typical, {}});
    }
  }
}

physics::Machine without_joints(physics::Machine machine) {
  std::erase_if(machine.effects, [](const auto& spec) { return spec.candidate && spec.id == joint_id; });
  return machine;
}

}  // namespace

bool is_exchange(const Trial& trial) {
  return !trial.what.exchanged_with.empty();
}

const physics::Component& rod_of(const Trial& trial) {
  const physics::Machine& machine = trial.fit->machine();
  return *machine.find(machine.sensor(trial.what.channel)->component);
}

bool same_place(const Trial& a, const Trial& b) {
  const auto& [channel, described_mm, at_mm, exchanged_with, all_in] = a.what;
  if (!all_in.empty() || !b.what.all_in.empty()) return all_in == b.what.all_in;
  const bool swapped = channel == b.what.exchanged_with && exchanged_with == b.what.channel;
  if (!exchanged_with.empty() || !b.what.exchanged_with.empty()) {
    return swapped || (channel == b.what.channel && exchanged_with == b.what.exchanged_with);
  }
  constexpr double near = 0.15;  // of the length
  return channel == b.what.channel && std::abs(at_mm - b.what.at_mm) < near * rod_of(a).length_mm;
}

physics::Machine placed(physics::Machine machine, const Misplaced& what) {
  if (!what.all_in.empty()) {
    const std::string component = sensor_of(machine, what.channel).component;
    for (physics::Sensor& sensor : machine.sensors) {
      if (sensor.component == component) sensor.position_mm *= what.at_mm / what.described_mm;
    }
  }
  sensor_of(machine, what.channel).position_mm = what.at_mm;
  if (!what.exchanged_with.empty()) sensor_of(machine, what.exchanged_with).position_mm = what.described_mm;
  return machine;
}

std::vector<Trial> places_anywhere(const Model& base, const Model& best, const Model& sound) {
  std::vector<Trial> trials;
  for (const physics::Sensor& sensor : suspects(base, best, sound)) add_places(trials, base, sensor);
  const std::vector<physics::Sensor> all = missed_most(base);
  add_exchanges(trials, base, all);
  add_units(trials, base, all);
  return trials;
}

physics::Machine without_sensor_faults(physics::Machine machine) {
  std::erase_if(machine.effects, [](const auto& spec) { return spec.candidate && spec.id.starts_with("sensor_"); });
  return machine;
}

std::vector<Suspicion> aside_of_what_is_named(const Model& base, const Model& best) {
  const std::vector<physics::Sensor> all = missed_most(base);
  std::vector<Suspicion> list;
  list.push_back({aside_of_joints(best, all), without_joints(best.machine())});
  list.push_back({aside_of_faults(best, all), without_sensor_faults(best.machine())});
  std::erase_if(list, [](const Suspicion& one) { return one.trials.empty(); });
  return list;
}

}  // namespace zerodrift::diagnosis
