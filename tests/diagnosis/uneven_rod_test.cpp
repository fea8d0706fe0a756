// A rod that carries other parts is not the even bar that is described, and no joint is as good as its faces: neither
// is a physical effect that was left out.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/diagnosis/description/inner_bodies.h"
#include "core/physics/simulate.h"

namespace zerodrift::diagnosis {
namespace {

/// A lantern bolted to a wall, heated at its front; a bar beside it that touches nothing.
nlohmann::json lantern() {
  return nlohmann::json::parse(R"({"format": "zerodrift-machine/1", "initial_temperature_C": 20,
    "components": [
      {"id": "wall", "kind": "lump", "heat_capacity_J_K": 28700},
      {"id": "lantern", "length_mm": 400, "outer_diameter_mm": 100, "bore_diameter_mm": 60,
       "material": {"conductivity_W_mK": 45, "density_kg_m3": 7850, "heat_capacity_J_kgK": 460,
                    "expansion_1_K": 1.15e-5},
       "heat_sources": [{"id": "heater", "kind": "input", "channel": "heater_on", "watts_per_unit": 100,
                         "from_mm": 350, "to_mm": 390}]},
      {"id": "bar", "length_mm": 600, "outer_diameter_mm": 40, "bore_diameter_mm": 0,
       "material": {"conductivity_W_mK": 45, "density_kg_m3": 7850, "heat_capacity_J_kgK": 460,
                    "expansion_1_K": 1.15e-5}}],
    "couplings": [{"between": [{"component": "wall"}, {"component": "lantern", "position_mm": 5}],
                   "conductance_W_K": 20}],
    "sensors": [{"channel": "T1_C", "component": "lantern", "position_mm": 50},
                {"channel": "T2_C", "component": "lantern", "position_mm": 150},
                {"channel": "T3_C", "component": "lantern", "position_mm": 250},
                {"channel": "T4_C", "component": "lantern", "position_mm": 330},
                {"channel": "ambient_C", "component": "ambient"}]})");
}

recording::Recording heated() {
  recording::Recording run;
  run.channels = {{"heater_on", {}}, {"ambient_C", {}}};
  for (double t = 0.0; t <= 28800.0; t += 60.0) {
    run.time_s.push_back(t);
    run.channels[0].values.push_back(1.0);
    run.channels[1].values.push_back(20.0);
  }
  return run;
}

/// Slope between the outer two sensors over that between the inner two, at the end.
double steeper_outside(const physics::Machine& machine) {
  const auto shown = physics::simulate(machine, heated());
  if (!shown) return 0.0;
  const auto last = [&](const char* channel) { return shown->prediction.find(channel)->values.back(); };
  return (last("T4_C") - last("T3_C")) / 80.0 / ((last("T2_C") - last("T1_C")) / 100.0);
}

TEST(UnevenRod, IsOneThatTouchesALump) {
  const auto described = physics::machine_from_json(lantern(), "machine.json");
  ASSERT_TRUE(described.has_value());
  const physics::Machine machine = with_inner_bodies(*described);
  EXPECT_EQ(machine.find("lantern")->conduction_shares, std::vector<double>(8, 1.0));  // each half a diameter
  EXPECT_GT(machine.find("lantern")->conduction_sigma, 0.0);
  EXPECT_TRUE(machine.find("bar")->conduction_shares.empty());  // heated as drawn
}

TEST(UnevenRod, IsDescribedWithItsShares) {
  nlohmann::json document = lantern();
  document["components"][1]["conduction_shares"] = {1.0, 0.5};
  const auto machine = physics::machine_from_json(document, "machine.json");
  ASSERT_TRUE(machine.has_value());
  EXPECT_EQ(physics::to_json(*machine)["components"][1]["conduction_shares"], nlohmann::json({1.0, 0.5}));
  // In the end all parts warm at one rate, and what the rod takes up on the way is the same in both.
  const auto even = physics::machine_from_json(lantern(), "machine.json");
  EXPECT_NEAR(steeper_outside(*machine) / steeper_outside(*even), 2.0, 0.02);

  document["components"][1]["conduction_shares"] = {1.0, 0.0};
  EXPECT_EQ(physics::machine_from_json(document, "machine.json").error().code, ErrorCode::json_bad_value);
}

}  // namespace
}  // namespace zerodrift::diagnosis
