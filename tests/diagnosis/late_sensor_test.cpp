// Heat takes its time across a part that the description takes as even: a sensor on it is late, and not at fault.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/diagnosis/description/inner_bodies.h"
#include "core/physics/simulate.h"

namespace zerodrift::diagnosis {
namespace {

/// A screw between a cast housing and a motor of unknown capacity; a bar beside them that touches nothing.
nlohmann::json screw() {
  return nlohmann::json::parse(R"({"format": "zerodrift-machine/1", "initial_temperature_C": 20,
    "components": [
      {"id": "housing", "kind": "lump", "heat_capacity_J_K": 28700},
      {"id": "motor", "kind": "lump", "heat_sources": [{"id": "heater", "kind": "input", "channel": "heater_on",
                                                        "watts_per_unit": 50}]},
      {"id": "screw", "length_mm": 600, "outer_diameter_mm": 40, "bore_diameter_mm": 0,
       "material": {"conductivity_W_mK": 45, "density_kg_m3": 7850, "heat_capacity_J_kgK": 460,
                    "expansion_1_K": 1.15e-5}},
      {"id": "bar", "length_mm": 600, "outer_diameter_mm": 40, "bore_diameter_mm": 0,
       "material": {"conductivity_W_mK": 45, "density_kg_m3": 7850, "heat_capacity_J_kgK": 460,
                    "expansion_1_K": 1.15e-5}}],
    "couplings": [{"between": [{"component": "housing"}, {"component": "screw", "position_mm": 20}],
                   "conductance_W_K": 20},
                  {"between": [{"component": "motor"}, {"component": "housing"}], "conductance_W_K": 5}],
    "sensors": [{"channel": "housing_C", "component": "housing"}, {"channel": "motor_C", "component": "motor"},
                {"channel": "screw_C", "component": "screw", "position_mm": 300},
                {"channel": "bar_C", "component": "bar", "position_mm": 300},
                {"channel": "ambient_C", "component": "ambient"}]})");
}

recording::Recording heated() {
  recording::Recording run;
  run.channels = {{"heater_on", {}}, {"ambient_C", {}}};
  for (double t = 0.0; t <= 7200.0; t += 30.0) {
    run.time_s.push_back(t);
    run.channels[0].values.push_back(t < 3600.0 ? 1.0 : 0.0);
    run.channels[1].values.push_back(20.0);
  }
  return run;
}

TEST(LateSensor, MayBeAsLateAsHeatTakesAcrossItsPart) {
  const auto described = physics::machine_from_json(screw(), "machine.json");
  ASSERT_TRUE(described.has_value());
  const physics::Machine machine = with_inner_bodies(*described);
  // 28.7 kJ/K of iron are a cube of 0.2 m.
  EXPECT_NEAR(machine.sensor("housing_C")->lag_sigma_s, 289.0, 2.0);
  EXPECT_EQ(machine.sensor("motor_C")->lag_sigma_s, 0.0);  // nobody knows how large it is
  EXPECT_NEAR(machine.sensor("screw_C")->lag_sigma_s, 13.0, 0.2);
  EXPECT_EQ(machine.sensor("bar_C")->lag_sigma_s, 0.0);  // heated as drawn
}

TEST(LateSensor, IsDescribedWithItsLag) {
  nlohmann::json late = screw();
  late["sensors"][0]["lag_s"] = 240.0;
  const auto prompt = physics::machine_from_json(screw(), "machine.json");
  const auto machine = physics::machine_from_json(late, "machine.json");
  ASSERT_TRUE(prompt.has_value() && machine.has_value());
  EXPECT_EQ(physics::to_json(*machine)["sensors"][0]["lag_s"], 240.0);
  const auto shown = physics::simulate(*machine, heated());
  const auto true_one = physics::simulate(*prompt, heated());
  ASSERT_TRUE(shown.has_value() && true_one.has_value());
  const auto& slow = shown->prediction.find("housing_C")->values;
  const auto& fast = true_one->prediction.find("housing_C")->values;
  // Behind a ramp a first-order lag reads what was there 240 s ago.
  EXPECT_NEAR(slow[100], fast[92], 0.02);
  EXPECT_LT(slow[100], fast[100] - 0.05);
}

}  // namespace
}  // namespace zerodrift::diagnosis
