// The structure bends under a temperature difference or a heat flow and moves the nose across the axis:
// d += g lag(u, tau) + g_room lag(T_room - T0, tau), or g [lag(u, tau1) - lag(lag(u, tau1), tau2)] for a housing whose
// sides warm one after the other. u: heat of the bearings or the motor, or a temperature of the rod over the room.
#include "core/physics/effects/sensor_effects.h"

namespace zerodrift::physics {
namespace structure_bending {

/// Nominal heat of all sources of a kind, in W.
int heat_signal(NetworkBuilder& builder, SourceKind kind) {
  std::vector<HeatSource> sources;
  for (const auto& component : builder.machine().components) {
    for (const auto& source : component.sources) {
      if (source.kind == kind) sources.push_back(source);
    }
  }
  const int speed = builder.held_speed();
  const double full_rpm = builder.network().full_speed_rpm;
  return builder.signal({"heat", [=](const double* held, const double*, double) {
                           double watts = 0.0;
                           for (const auto& source : sources) watts += nominal_heat_W(source, held[speed], full_rpm);
                           return watts;
                         }});
}

bool by_heat(const std::string& driver) {
  return driver == "bearing_heat" || driver == "motor_heat";
}

/// What carries the rod touches it at the bearings; without any, near its ends. "difference_of_ends": near the ends.
std::pair<double, double> rear_and_front_mm(const Component& rod, const std::string& driver) {
  double rear_mm = rod.length_mm;
  double front_mm = 0.0;
  for (const auto& source : rod.sources) {
    if (source.kind != SourceKind::bearing) continue;
    const double middle_mm = 0.5 * (source.from_mm + source.to_mm);
    rear_mm = std::min(rear_mm, middle_mm);
    front_mm = std::max(front_mm, middle_mm);
  }
  if (front_mm - rear_mm > 0.3 * rod.length_mm && driver != "difference_of_ends") return {rear_mm, front_mm};
  return {0.05 * rod.length_mm, 0.95 * rod.length_mm};
}

void add(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  const std::vector<std::string> rods = builder.rods();
  if (observation_of(builder, spec) == nullptr || rods.empty()) return;
  const std::string driver = spec.word_or("driver", "bearing_heat");
  const bool heat = by_heat(driver);
  const std::string& rod = rods.front();
  const auto [rear_mm, front_mm] = rear_and_front_mm(*builder.machine().find(rod), driver);
  const bool difference = driver == "difference" || driver == "difference_of_ends";
  const int gain = builder.effect_parameter(spec, index, heat ? "um_per_W" : "um_per_K");
  const int lag = builder.effect_parameter(spec, index, "lag_s", 3000.0);
  const int second =
      spec.numbers.count("second_lag_s") != 0 ? builder.effect_parameter(spec, index, "second_lag_s") : -1;
  std::vector<StructureTerm> terms;
  StructureTerm term;
  term.gain = gain;
  term.lag = lag;
  term.second_lag = second;
  const int start = second < 0 ? unknown_start(builder, spec, index) : -1;
  const auto temperature = [&](double position_mm, double factor) {
    StructureTerm one = term;
    one.probe = builder.probe(builder.probe_at(rod, position_mm));
    one.probe_reference = builder.reference_C(rod);
    one.factor = factor;
    terms.push_back(one);
  };
  if (heat) {
    term.signal = heat_signal(builder, driver == "motor_heat" ? SourceKind::motor : SourceKind::bearing);
    terms.push_back(term);
  } else {
    if (driver == "front" || difference) temperature(front_mm, 1.0);
    if (driver == "rear" || difference) temperature(rear_mm, difference ? -1.0 : 1.0);
    if (driver == "mean") {
      StructureTerm one = term;
      one.probe = builder.probe(builder.mean_probe(rod));
      one.probe_reference = builder.reference_C(rod);
      terms.push_back(one);
    }
    if (!difference) {
      StructureTerm over_room = term;
      over_room.signal = room_rise_signal(builder);
      over_room.factor = -1.0;
      over_room.initial = start;
      terms.push_back(over_room);
    }
  }
  if (spec.numbers.count("room_um_per_K") != 0) {
    StructureTerm room;
    room.gain = builder.effect_parameter(spec, index, "room_um_per_K");
    room.lag = lag;
    room.initial = start;
    room.signal = room_rise_signal(builder);
    terms.push_back(room);
  }
  Observation* seen = observation_of(builder, spec);
  seen->structure.insert(seen->structure.end(), terms.begin(), terms.end());
}

std::vector<EffectSpec> candidates(const Machine& machine, const RunFacts& facts) {
  std::vector<EffectSpec> list;
  const double watts = std::max(10.0, facts.typical_heat_W);
  for (const auto& displacement : machine.displacements) {
    const Component* component = machine.find(displacement.component);
    if (!is_across(machine, displacement) || component == nullptr || component->lump) continue;
    for (const char* driver :
         {"bearing_heat", "motor_heat", "front", "rear", "mean", "difference", "difference_of_ends"}) {
      const bool heat = by_heat(driver);
      if (heat && !facts.has_speed) continue;
      const std::string gain = heat ? "um_per_W" : "um_per_K";
      const double sigma = heat ? 30.0 / watts : 3.0;
      EffectSpec spec{"structure_bending",
                      true,
                      {{gain, 0.0}, {gain + "_prior_sigma", sigma}, {"lag_s", 3000.0}},
                      {{"channel", displacement.channel}, {"driver", driver}}};
      EffectSpec two_sides = spec;
      two_sides.numbers["lag_s"] = 1200.0;
      two_sides.numbers["second_lag_s"] = 4000.0;
      if (facts.room_logged) spec.numbers["room_um_per_K"] = 0.0;
      for (const double lag_s : {600.0, 3000.0, 9000.0}) {
        spec.numbers["lag_s"] = lag_s;
        list.push_back(spec);
      }
      list.push_back(two_sides);
    }
  }
  return list;
}

}  // namespace structure_bending

extern const Effect structure_bending_effect;
const Effect structure_bending_effect = {
    "structure_bending",
    "bending of the structure",
    "d += g lag(u, tau) + g_room lag(T_room - T0, tau)",
    "head stock and column of machining centres: 1 to 10 um per K of difference, 5 min to 5 h",
    "Only the displacement across the axis is off; it follows a heat source or a temperature difference with a delay",
    "structure_ambient",
    {{"um_per_K", 3.0, -100.0, 100.0, true},
     {"um_per_W", 0.1, -100.0, 100.0, true},
     {"lag_s", 0.9, 30.0, 40000.0, false, 3000.0, true},
     {"second_lag_s", 0.9, 100.0, 60000.0, false, 4000.0, true},
     {"room_um_per_K", 1.5, -30.0, 30.0, true}},
    {"um_per_K", "um_per_W"},
    structure_bending::add,
    structure_bending::candidates};

}  // namespace zerodrift::physics
