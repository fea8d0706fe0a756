#include "core/diagnosis/misplaced.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/diagnosis/selection.h"

namespace zerodrift::diagnosis {
namespace {

constexpr int places_per_rod = 16;

struct Trial {
  Misplaced what;
  std::shared_ptr<Model> fit;
};

physics::Sensor& sensor_of(physics::Machine& machine, const std::string& channel) {
  return *std::find_if(machine.sensors.begin(), machine.sensors.end(),
                       [&](const auto& sensor) { return sensor.channel == channel; });
}

/// Sensors on rods, those that the base misses most first.
std::vector<physics::Sensor> suspects(const Model& base) {
  struct Suspect {
    physics::Sensor sensor;
    double excess = 0.0;
  };
  const Excess excess = excess_of(base);
  std::vector<Suspect> list;
  for (std::size_t c = 0; c < base.data().channels.size(); ++c) {
    const MeasuredChannel& channel = base.data().channels[c];
    const physics::Sensor* sensor = base.machine().sensor(channel.name);
    if (channel.samples == 0 || sensor == nullptr) continue;
    const physics::Component* rod = base.machine().find(sensor->component);
    if (rod == nullptr || rod->lump) continue;
    list.push_back({*sensor, excess.per_channel[c]});
  }
  std::sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.excess > b.excess; });
  std::vector<physics::Sensor> sensors;
  for (const Suspect& one : list) sensors.push_back(one.sensor);
  return sensors;
}

void add_trials(std::vector<Trial>& trials, const Model& base, const physics::Sensor& sensor,
                const std::vector<physics::Sensor>& all) {
  constexpr double far = 0.1;  // of the length: what is nearer is a tape measure's error
  const double length_mm = base.machine().find(sensor.component)->length_mm;
  for (int i = 0; i < places_per_rod; ++i) {
    const double at_mm = (i + 0.5) / places_per_rod * length_mm;
    if (std::abs(at_mm - sensor.position_mm) > far * length_mm) {
      trials.push_back({{sensor.channel, sensor.position_mm, at_mm, {}}, nullptr});
    }
  }
  for (const physics::Sensor& other : all) {
    if (other.component != sensor.component || std::abs(other.position_mm - sensor.position_mm) < far * length_mm) {
      continue;
    }
    trials.push_back({{sensor.channel, sensor.position_mm, other.position_mm, other.channel}, nullptr});
  }
}

/// The trial's places with the effects of `like`.
void fit(Trial& trial, const Model& like, const std::shared_ptr<const Dataset>& data) {
  physics::Machine machine = like.machine();
  sensor_of(machine, trial.what.channel).position_mm = trial.what.at_mm;
  if (!trial.what.exchanged_with.empty()) {
    sensor_of(machine, trial.what.exchanged_with).position_mm = trial.what.described_mm;
  }
  trial.fit = std::make_shared<Model>(std::move(machine), data);
  trial.fit->start_from(like, false);
  trial.fit->fit({8, 0.1, true});
}

/// What a wrong place looks like is often named as a fault of the sensor.
std::shared_ptr<Model> without_sensor_faults(const Model& best) {
  physics::Machine machine = best.machine();
  std::erase_if(machine.effects, [](const auto& spec) { return spec.candidate && spec.id.starts_with("sensor_"); });
  auto model = std::make_shared<Model>(std::move(machine), best.shared_data());
  return model;
}

bool likelier(const Trial& a, const Trial& b) {
  return a.fit->log_evidence() > b.fit->log_evidence();
}

bool reads_well(const Model& fit, const std::string& channel) {
  const Excess excess = excess_of(fit);
  for (std::size_t c = 0; c < fit.data().channels.size(); ++c) {
    if (fit.data().channels[c].name == channel) return excess.per_channel[c] <= least_evident;
  }
  return true;
}

/// Between two places that were tried.
void narrow(Trial& found, const Model& like, const std::shared_ptr<const Dataset>& data, double length_mm) {
  if (!found.what.exchanged_with.empty()) return;
  std::vector<Trial> nearer;
  for (const double steps : {-0.6, -0.3, 0.3, 0.6}) {
    nearer.push_back(found);
    nearer.back().what.at_mm = std::clamp(found.what.at_mm + steps * length_mm / places_per_rod, 0.0, length_mm);
  }
  in_parallel(nearer.size(), [&](std::size_t i) { fit(nearer[i], like, data); });
  for (Trial& one : nearer) {
    if (likelier(one, found)) found = std::move(one);
  }
}

}  // namespace

std::string note_of(const Misplaced& found) {
  return found.exchanged_with.empty() ? "misplaced:" + found.channel
                                      : "exchanged:" + found.channel + ":" + found.exchanged_with;
}

std::optional<Misplaced> misplaced_sensor(const Model& base, const Model& best,
                                          const std::shared_ptr<const Dataset>& data) {
  constexpr std::size_t most_suspects = 2;
  constexpr std::size_t most_refitted = 3;
  constexpr double clearly = 25.0;  // of log evidence: descriptions are mostly right about places
  const std::vector<physics::Sensor> sensors = suspects(base);
  std::vector<Trial> trials;
  for (std::size_t i = 0; i < std::min(most_suspects, sensors.size()); ++i) {
    add_trials(trials, base, sensors[i], sensors);
  }
  if (trials.empty()) return std::nullopt;
  in_parallel(trials.size(), [&](std::size_t i) { fit(trials[i], base, data); });
  std::sort(trials.begin(), trials.end(), likelier);
  trials.resize(std::min(most_refitted, trials.size()));
  // The machine may lack something besides.
  std::vector<Trial> beside = trials;
  const std::shared_ptr<Model> sound = without_sensor_faults(best);
  in_parallel(beside.size(), [&](std::size_t i) { fit(beside[i], *sound, data); });
  trials.insert(trials.end(), beside.begin(), beside.end());
  Trial& found = *std::min_element(trials.begin(), trials.end(), likelier);
  Model as_described(best.machine(), data);
  as_described.start_from(best, false);
  as_described.fit({8, 0.1, true});
  if (found.fit->log_evidence() < as_described.log_evidence() + clearly) return std::nullopt;
  if (!reads_well(*found.fit, found.what.channel)) return std::nullopt;
  if (!found.what.exchanged_with.empty() && !reads_well(*found.fit, found.what.exchanged_with)) return std::nullopt;
  narrow(found, *found.fit, data, base.machine().find(sensors.front().component)->length_mm);
  return found.what;
}

}  // namespace zerodrift::diagnosis
