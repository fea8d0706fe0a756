#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "core/physics/effects/effect.h"

namespace zerodrift::physics {

extern const Effect convection_effect;
extern const Effect speed_convection_effect;
extern const Effect radiation_effect;
extern const Effect coolant_effect;
extern const Effect bearing_viscosity_effect;
extern const Effect bearing_preload_effect;
extern const Effect extra_heat_source_effect;
extern const Effect contact_resistance_effect;
extern const Effect structure_ambient_effect;
extern const Effect structure_bending_effect;
extern const Effect sensor_lag_effect;
extern const Effect sensor_offset_effect;
extern const Effect cutting_heat_effect;
extern const Effect draught_effect;
extern const Effect chiller_cycle_effect;
extern const Effect bearing_run_in_effect;
extern const Effect conductivity_temperature_effect;
extern const Effect room_sensor_fault_effect;
extern const Effect bracket_slip_effect;
extern const Effect neighbour_heat_effect;
extern const Effect heater_body_effect;
extern const Effect sensor_gain_effect;
extern const Effect casting_core_effect;
extern const Effect standing_heat_effect;
extern const Effect speed_heat_curve_effect;
extern const Effect structure_driver_effect;
extern const Effect structure_lag_effect;
extern const Effect switched_heat_effect;
extern const Effect film_driver_effect;

const std::vector<const Effect*>& all_effects() {
  static const std::vector<const Effect*> effects = {
      &convection_effect,
      &speed_convection_effect,
      &radiation_effect,
      &coolant_effect,
      &bearing_viscosity_effect,
      &bearing_preload_effect,
      &extra_heat_source_effect,
      &contact_resistance_effect,
      &structure_ambient_effect,
      &structure_bending_effect,
      &sensor_lag_effect,
      &sensor_offset_effect,
      &cutting_heat_effect,
      &draught_effect,
      &chiller_cycle_effect,
      &bearing_run_in_effect,
      &conductivity_temperature_effect,
      &room_sensor_fault_effect,
      &bracket_slip_effect,
      &neighbour_heat_effect,
      &heater_body_effect,
      &sensor_gain_effect,
      &casting_core_effect,
      &standing_heat_effect,
      &speed_heat_curve_effect,
      &structure_driver_effect,
      &structure_lag_effect,
      &switched_heat_effect,
      &film_driver_effect,
  };
  return effects;
}

const Effect* find_effect(std::string_view id) {
  for (const Effect* effect : all_effects()) {
    if (effect->id == id) return effect;
  }
  return nullptr;
}

const Effect& effect_of_event(Event event) {
  for (const Effect* effect : all_effects()) {
    if (effect->traits.event == event) return *effect;
  }
  throw std::logic_error("no effect for this event");
}

std::string effect_ids() {
  std::string list;
  for (const Effect* effect : all_effects()) list += (list.empty() ? "" : ", ") + std::string(effect->id);
  return list;
}

const EffectParameter& Effect::parameter(std::string_view key) const {
  for (const auto& one : parameters) {
    if (one.key == key) return one;
  }
  throw std::logic_error("effect " + std::string(id) + " has no parameter " + std::string(key));
}

}  // namespace zerodrift::physics
