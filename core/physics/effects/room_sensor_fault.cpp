// The room sensor reads wrong (sun, exhaust air, drift): the true surroundings are T_room + b + d t.
#include "core/physics/effects/laws.h"

namespace zerodrift::physics {
namespace room_sensor_fault {

void add(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  const int room = builder.room();
  if (spec.numbers.count("offset_K") != 0) {
    builder.network().environments[room].parts.push_back({builder.effect_parameter(spec, index, "offset_K"), -1});
  }
  if (spec.numbers.count("drift_K_per_h") != 0) {
    const int hours =
        builder.signal({"hours", [](const double*, const double*, double time_s) { return time_s / 3600.0; }});
    builder.network().environments[room].parts.push_back(
        {builder.effect_parameter(spec, index, "drift_K_per_h"), hours});
  }
}

std::vector<EffectSpec> candidates(const Machine& machine, const RunFacts& facts) {
  if (!facts.room_logged || machine.effect("room_sensor_fault") != nullptr) return {};
  return {{"room_sensor_fault", true, {{"offset_K", 0.0}}, {}},
          {"room_sensor_fault", true, {{"drift_K_per_h", 0.0}}, {}}};
}

}  // namespace room_sensor_fault

extern const Effect room_sensor_fault_effect;
const Effect room_sensor_fault_effect = {
    "room_sensor_fault",
    "a wrong room sensor",
    "T_surrounding = T_room + b + d t",
    "room sensors in the sun or in exhaust air: 1 to 5 K",
    "All temperatures tend to another level than the logged room, also while the machine stands",
    "standing_heat convection draught",
    {{"offset_K", 1.5, -15.0, 15.0, true}, {"drift_K_per_h", 0.5, -5.0, 5.0, true}},
    {"offset_K", "drift_K_per_h"},
    room_sensor_fault::add,
    room_sensor_fault::candidates,
    "ambient_C",
    {.log_rarity = -3.0, .room_reads_wrong = true}};

}  // namespace zerodrift::physics
