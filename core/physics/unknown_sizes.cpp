#include "core/physics/unknown_sizes.h"

#include <algorithm>
#include <cmath>

namespace zerodrift::physics {
namespace {

// Steel and cast iron hold 3.6 MJ/(m3 K); walls of castings and parts bolted to them are some 30 mm thick.
constexpr double capacity_of_surface_J_Km2 = 3.6e6 * 0.03;
constexpr double m2_per_mm2 = 1e-6;

bool has_known_heat(const Component& component) {
  return std::any_of(component.sources.begin(), component.sources.end(), [](const HeatSource& source) {
    return !source.power_unknown && source.kind != SourceKind::speed;
  });
}

bool film_is_described(const Machine& machine, const Component& component) {
  return std::any_of(machine.effects.begin(), machine.effects.end(), [&](const EffectSpec& spec) {
    const std::string of = spec.word_or("component", "");
    return spec.id == "convection" && !spec.candidate && spec.numbers.count("conductance_W_K") == 0 &&
           (of.empty() || of == component.id);
  });
}

bool has_a_scale(const Machine& machine) {
  const bool joined = std::any_of(machine.couplings.begin(), machine.couplings.end(), [](const Coupling& coupling) {
    return coupling.conductance_W_K.value_or(0.0) > 0.0;
  });
  return joined || std::any_of(machine.components.begin(), machine.components.end(), [&](const Component& one) {
           if (one.prescribed) return false;
           return !one.lump || one.heat_capacity_J_K || has_known_heat(one) ||
                  (one.area_mm2 && film_is_described(machine, one));
         });
}

/// Of the lumps that are described, the mean of their logarithms; of the guessed size where there are none.
double usual_capacity_J_K(const Machine& machine) {
  double sum = 0.0;
  int count = 0;
  for (const auto& component : machine.components) {
    if (component.lump && component.heat_capacity_J_K) sum += std::log(*component.heat_capacity_J_K), ++count;
  }
  constexpr double of_a_part_J_K = 10000.0;  // twenty kilograms of steel
  return count > 0 ? std::exp(sum / count) : of_a_part_J_K;
}

}  // namespace

void guess_unknown_sizes(Machine& machine) {
  if (!has_a_scale(machine)) return;
  const double usual_J_K = usual_capacity_J_K(machine);
  for (auto& component : machine.components) {
    if (!component.lump || component.prescribed) continue;
    if (!component.heat_capacity_J_K) {
      component.heat_capacity_J_K =
          component.area_mm2 ? capacity_of_surface_J_Km2 * m2_per_mm2 * *component.area_mm2 : usual_J_K;
      component.capacity_is_guessed = true;
    }
    if (!component.area_mm2 && film_is_described(machine, component)) {
      component.area_mm2 = *component.heat_capacity_J_K / capacity_of_surface_J_Km2 / m2_per_mm2;
      component.area_is_guessed = true;
    }
  }
}

}  // namespace zerodrift::physics
