#include "core/diagnosis/refined.h"

#include <algorithm>
#include <cmath>

namespace zerodrift::diagnosis {
namespace {

using physics::Component;
using physics::Machine;

bool is_width(const std::string& key) {
  return key.size() > 12 && key.compare(key.size() - 12, 12, "_prior_sigma") == 0;
}

void take_inside(physics::InnerBody& inner, const physics::Parameter& p, double value) {
  const std::string& key = p.key;
  if (key == "near_field_K_W") inner.near_field_K_W[p.channel] = value;
  if (key == "inner_coupling_W_mK") inner.coupling_W_mK = value;
  if (key == "inner_coupling_rise") inner.coupling_rise = value;
  if (key == "inner_growth_share") inner.growth_share = value;
  for (auto& [id, share] : inner.heat_share) share = key == "inner_heat_share:" + id ? value : share;
  for (auto& [id, contact] : inner.contact_W_K) contact = key == "inner_contact_W_K:" + id ? value : contact;
}

/// What is new in each recording - start temperatures, offsets - as its first ten minutes tell it, with the priors of
/// the description. Nothing later is looked at. An error of 0.05 K here would stay in the growth for hours.
std::vector<double> values_at_start(const Machine& refined, const recording::Recording& recording,
                                    const physics::Network& network) {
  constexpr double start_s = 600.0;
  constexpr std::size_t least_rows = 6;
  const auto later = std::upper_bound(recording.time_s.begin(), recording.time_s.end(), recording.time_s[0] + start_s);
  const auto within = static_cast<std::size_t>(later - recording.time_s.begin());
  const recording::Recording start =
      recording::slice(recording, 0, std::min(recording.rows(), std::max(least_rows, within)));
  const Dataset whole = make_dataset(recording, network);
  Dataset data = make_dataset(start, network);
  // Noise and spikes are known from the whole: among twenty samples one spike looks like much noise.
  for (std::size_t c = 0; c < data.channels.size(); ++c) {
    MeasuredChannel& channel = data.channels[c];
    channel.white = whole.channels[c].white;
    channel.samples = 0;
    for (std::size_t k = 0; k < data.rows(); ++k) {
      channel.present[k] = whole.channels[c].present[k];
      channel.values[k] = whole.channels[c].values[k];
      channel.samples += channel.present[k] ? 1 : 0;
    }
  }
  data.prepare();
  Model own(refined, std::make_shared<Dataset>(std::move(data)), true);
  own.fit({});
  return own.values();
}

/// A room that nobody logged is new in each recording and has to be estimated from it, with the start and the offsets.
physics::Prediction predict_with_own_room(const Machine& refined, const recording::Recording& recording,
                                          const physics::Network& network, const physics::InputSet& inputs) {
  Dataset data = make_dataset(recording, network);
  set_timing_noise(data, network, inputs);
  Model own(refined, std::make_shared<Dataset>(with_drift(std::move(data), 4.0)), true);
  own.fit({});
  return own.prediction();
}

}  // namespace

void take_value(Machine& machine, const physics::Parameter& p, double value) {
  if (p.owner() != physics::Owner::description) return;  // an effect's own numbers stand in its specification
  for (auto& component : machine.components) {
    if (component.id != p.component) continue;
    if (p.key == "conductivity_W_mK") component.material.conductivity_W_mK = value;
    if (p.key == "heat_capacity_J_kgK") component.material.heat_capacity_J_kgK = value;
    if (p.key == "heat_capacity_J_K") component.heat_capacity_J_K = value, component.capacity_is_guessed = false;
    if (p.key == "area_mm2") component.area_mm2 = value, component.area_is_guessed = false;
    if (p.key == "expansion_1_K") component.material.expansion_1_K = value;
    if (component.inner) take_inside(*component.inner, p, value);
    for (auto& source : component.sources) {
      if (p.key == "scale:" + source.id) source.scale = value;
      for (const auto& law : source.law) {
        if (p.key == "watts_" + law + ":" + source.id) source.law_watts[law] = value;
      }
    }
  }
  for (auto& sensor : machine.sensors) {
    if (p.key == "sensor_lag_s" && p.channel == sensor.channel) sensor.lag_s = value;
  }
  for (std::size_t i = 0; i < machine.couplings.size(); ++i) {
    if (p.key == "conductance_W_K" && p.component == physics::coupling_name(machine.couplings, i)) {
      machine.couplings[i].conductance_W_K = value;
    }
  }
}

physics::EffectSpec fitted_effect(const Model& model, std::size_t index, std::map<std::string, double>* sigma) {
  physics::EffectSpec spec = model.machine().effects[index];
  for (auto it = spec.numbers.begin(); it != spec.numbers.end();) {
    it = is_width(it->first) ? spec.numbers.erase(it) : std::next(it);
  }
  for (std::size_t i = 0; i < model.unknowns(); ++i) {
    const auto& p = model.unknown(i);
    if (p.owner() != physics::Owner::effect || p.effect != static_cast<int>(index)) continue;
    spec.numbers[p.key] = model.value(i);
    if (sigma != nullptr) (*sigma)[p.key] = model.sigma(i);
  }
  return spec;
}

Machine refined_machine(const Model& model) {
  Machine machine = model.machine();
  for (std::size_t i = 0; i < model.unknowns(); ++i) take_value(machine, model.unknown(i), model.value(i));
  for (std::size_t e = 0; e < machine.effects.size(); ++e) {
    machine.effects[e] = fitted_effect(model, e);
    machine.effects[e].candidate = false;
  }
  for (auto& component : machine.components) {
    // Watts and conductances were fitted to this capacity; without it a reader would have to guess another.
    const bool open = component.lump && !component.prescribed && !component.heat_capacity_J_K;
    if (open) component.heat_capacity_J_K = physics::stand_in_capacity_J_K;
    for (auto& source : component.sources) {
      if (source.kind == physics::SourceKind::speed) source.full_speed_rpm = model.network().full_speed_rpm;
      if (!source.law_watts.empty()) source.power_unknown = false;
    }
  }
  return machine;
}

void state_room(Machine& refined, const Model& model) {
  if (!refined.room.channel.empty() || refined.room.temperature_C) return;
  const physics::Network& network = model.network();
  const auto room = std::find_if(network.environments.begin(), network.environments.end(),
                                 [](const auto& one) { return one.name == "room"; });
  if (room == network.environments.end() || room->series >= 0) return;
  double room_C = room->constant_C;
  for (std::size_t i = 0; i < model.unknowns(); ++i) {
    if (model.unknown(i).key == "room_temperature_K") room_C += model.value(i);
  }
  refined.room.temperature_C = room_C;
}

physics::Prediction predict_other(const Machine& refined, const recording::Recording& recording, double hold) {
  const physics::Network network = physics::build_network(refined, recording);
  const physics::InputSet inputs = physics::make_inputs(network, recording);
  const auto& notes = network.notes;
  if (std::find(notes.begin(), notes.end(), "room_is_initial_temperature") != notes.end()) {
    return predict_with_own_room(refined, recording, network, inputs);
  }
  std::vector<double> values = values_at_start(refined, recording, network);
  values[network.hold_parameter] = hold;
  return predict(network, inputs, values);
}

}  // namespace zerodrift::diagnosis
