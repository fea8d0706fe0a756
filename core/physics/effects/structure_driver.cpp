// A displacement follows the temperature of another component directly: d += g lag(T_other - T_start, tau).
#include "core/physics/effects/sensor_effects.h"
#include "core/physics/inputs.h"

namespace zerodrift::physics {
namespace structure_driver {

void add(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  const Component* driver = builder.machine().find(spec.word_or("driver", ""));
  if (observation_of(builder, spec) == nullptr || driver == nullptr) return;
  StructureTerm term;
  term.gain = builder.effect_parameter(spec, index, "um_per_K");
  term.lag = builder.effect_parameter(spec, index, "lag_s", 600.0);
  if (driver->prescribed) {
    const std::vector<Environment>& known = builder.network().environments;
    for (const auto& environment : known) {
      if (environment.name != driver->id || environment.series < 0) continue;
      const int series = environment.series;
      // Its first sample, where the displacement is zero too: a heated part is elsewhere soon after.
      const auto* seen = builder.inputs().find(builder.network().linear_channels[series]);
      const double start_C = mended(seen->values, builder.inputs().time_s).front();
      term.signal = builder.signal({"rise of " + driver->id, [=](const double*, const double* linear, double) {
                                      return linear[series] - start_C;
                                    }});
      break;
    }
    if (term.signal < 0) return;
  } else {
    term.probe = builder.probe(builder.mean_probe(driver->id));
    term.probe_reference = builder.reference_C(driver->id);
  }
  observation_of(builder, spec)->structure.push_back(term);
}

std::vector<EffectSpec> candidates(const Machine& machine, const RunFacts&) {
  std::vector<EffectSpec> list;
  for (const auto& displacement : machine.displacements) {
    if (displacement.component.empty()) continue;
    for (const auto& component : machine.components) {
      if (component.id == displacement.component) continue;
      for (const double lag_s : {60.0, 900.0}) {
        list.push_back({"structure_driver",
                        true,
                        {{"um_per_K", 0.0}, {"lag_s", lag_s}},
                        {{"channel", displacement.channel}, {"driver", component.id}}});
      }
    }
  }
  return list;
}

}  // namespace structure_driver

extern const Effect structure_driver_effect;
const Effect structure_driver_effect = {
    "structure_driver",
    "a displacement that follows another part",
    "d += g lag(T_other - T_start, tau)",
    "thermal growth of parts outside the simulated chain: 1 to 12 um per K and metre of steel",
    "A displacement follows another part's temperature, heating and cooling alike",
    "structure_ambient structure_lag",
    {{"um_per_K", 5.0, -200.0, 200.0, true}, {"lag_s", 1.2, 1.0, 40000.0, false, 600.0, true}},
    {"um_per_K"},
    structure_driver::add,
    structure_driver::candidates};

}  // namespace zerodrift::physics
