#include "core/diagnosis/answer/fitted_description.h"

#include <algorithm>

#include "core/diagnosis/refined.h"
#include "core/physics/builder.h"

namespace zerodrift::diagnosis::answer {
namespace {

bool is_prior(const std::string& key) {
  return key.ends_with("_prior_sigma");
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
