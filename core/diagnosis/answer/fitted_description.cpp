#include "core/diagnosis/answer/fitted_description.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/physics/builder.h"

namespace zerodrift::diagnosis::answer {
namespace {

using physics::Machine;

void take_inside(physics::InnerBody& inner, const physics::Parameter& p, double value) {
  const std::string& key = p.key;
  if (key == "near_field_K_W") inner.near_field_K_W[p.channel] = value;
  if (key == "inner_coupling_W_mK") inner.coupling_W_mK = value;
  if (key == "inner_coupling_rise") inner.coupling_rise = value;
  if (key == "inner_growth_share") inner.growth_share = value;
  for (auto& [id, share] : inner.heat_share) share = key == "inner_heat_share:" + id ? value : share;
  for (auto& [id, contact] : inner.contact_W_K) contact = key == "inner_contact_W_K:" + id ? value : contact;
}

bool is_prior(const std::string& key) {
  return key.ends_with("_prior_sigma");
}

/// A room that nobody logged is where this recording showed it to be, so that a simulation gives what was fitted.
void state_room(Machine& machine, const inference::Fit& fit, int run) {
  if (run < 0 || !machine.room.channel.empty() || machine.room.temperature_C) return;
  const inference::JointModel& model = fit.model();
  const physics::Network& network = model.network(static_cast<std::size_t>(run));
  const auto room = std::find_if(network.environments.begin(), network.environments.end(),
                                 [](const auto& one) { return one.name == "room"; });
  if (room == network.environments.end() || room->series >= 0) return;
  double room_C = room->constant_C;
  for (std::size_t i = 0; i < model.unknowns(); ++i) {
    const inference::Unknown& unknown = model.unknown(i);
    if (unknown.parameter.key == "room_temperature_K" && (unknown.run < 0 || unknown.run == run))
      room_C += fit.value(i);
  }
  machine.room.temperature_C = room_C;
}

/// "from_s:2" -> 2
std::size_t index_of(const std::string& key) {
  return static_cast<std::size_t>(std::stoul(key.substr(key.find(':') + 1)));
}

/// A share is never outside its bounds by the arithmetic's last digit.
double within(const physics::Parameter& p, double value) {
  return std::clamp(value, p.low, p.high);
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
    for (std::size_t i = 0; i < component.conduction_shares.size(); ++i) {
      if (p.key == fmt::format("conduction_share:{}", i)) component.conduction_shares[i] = value;
    }
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

physics::EffectSpec fitted_effect(const inference::Fit& fit, std::size_t effect, std::map<std::string, double>* sigma) {
  physics::EffectSpec spec = fit.model().hypothesis().effects[effect].spec;
  std::erase_if(spec.numbers, [](const auto& number) { return is_prior(number.first); });
  spec.candidate = false;
  spec.log_prior = 0.0;
  for (std::size_t i = 0; i < fit.model().unknowns(); ++i) {
    const inference::Unknown& unknown = fit.model().unknown(i);
    if (unknown.effect != static_cast<int>(effect)) continue;
    // What an effect has anew in each recording, a start, is no number of the description.
    const bool once = fit.model().hypothesis().effects[effect].run >= 0;
    if (unknown.run >= 0 && !once) continue;
    const std::string& key = unknown.parameter.key;
    const double value = within(unknown.parameter, fit.value(i));
    if (key.starts_with("from_s:")) {
      spec.intervals_s[index_of(key)].first = value;
    } else if (key.starts_with("to_s:")) {
      spec.intervals_s[index_of(key)].second = value;
    } else {
      spec.numbers[key] = value;
    }
    if (sigma != nullptr) (*sigma)[key] = fit.sigma(i);
  }
  return spec;
}

physics::Machine fitted_description(const inference::Fit& fit, int run) {
  const inference::JointModel& model = fit.model();
  physics::Machine machine = model.hypothesis().machine;
  for (std::size_t i = 0; i < model.unknowns(); ++i) {
    const inference::Unknown& unknown = model.unknown(i);
    if (unknown.effect >= 0 || unknown.run >= 0) continue;
    const double value = within(unknown.parameter, fit.value(i));
    if (unknown.parameter.effect < 0) {
      take_value(machine, unknown.parameter, value);
    } else {  // of an effect that is described
      physics::EffectSpec& spec = machine.effects[static_cast<std::size_t>(unknown.parameter.effect)];
      spec.numbers[unknown.parameter.key] = value;
    }
  }
  state_room(machine, fit, run);
  for (std::size_t e = 0; e < model.hypothesis().effects.size(); ++e) {
    const int happened = model.hypothesis().effects[e].run;
    if (happened < 0 || happened == run) machine.effects.push_back(fitted_effect(fit, e));
  }
  for (auto& component : machine.components) {
    // Watts and conductances were fitted to this capacity; without it a reader would have to guess another.
    const bool open = component.lump && !component.prescribed && !component.heat_capacity_J_K;
    if (open) component.heat_capacity_J_K = physics::stand_in_capacity_J_K;
    for (auto& source : component.sources) {
      if (source.kind == physics::SourceKind::speed) source.full_speed_rpm = model.network(0).full_speed_rpm;
      if (!source.law_watts.empty()) source.power_unknown = false;
    }
  }
  return machine;
}

}  // namespace zerodrift::diagnosis::answer
