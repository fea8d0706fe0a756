// The refined machine is the description with what was fitted, and nothing else changed.

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/diagnosis/answer/fitted_description.h"
#include "core/physics/builder.h"
#include "tests/diagnosis/simulated.h"

namespace zerodrift::diagnosis {
namespace {

physics::Machine machine_of(const char* text) {
  const auto machine = physics::machine_from_json(nlohmann::json::parse(text), "machine.json");
  EXPECT_TRUE(machine.has_value()) << describe(machine.error());
  return machine ? *machine : physics::Machine{};
}

}  // namespace

// A body before a heater and the box it heats both have a heat capacity: two numbers of two owners.
TEST(Refined, ANumberOfAnEffectLeavesTheComponentAlone) {
  physics::Machine machine = machine_of(R"({"format": "zerodrift-machine/1", "components": [
    {"id": "box", "kind": "lump", "heat_capacity_J_K": 900, "heat_sources": [
      {"id": "heater", "kind": "input", "channel": "heater_on", "watts_per_unit": 50}]}],
    "sensors": [{"channel": "T1_C", "component": "box"}]})");
  physics::Parameter own;
  own.key = "heat_capacity_J_K";
  own.component = "box";
  physics::Parameter of_effect = own;
  of_effect.effect = 0;
  answer::take_value(machine, of_effect, 13.5);
  EXPECT_DOUBLE_EQ(*machine.components[0].heat_capacity_J_K, 900.0);
  answer::take_value(machine, own, 950.0);
  EXPECT_DOUBLE_EQ(*machine.components[0].heat_capacity_J_K, 950.0);
}

// A share at its bound is 0, not -5.6e-17, which the reader refuses.
TEST(Refined, AValueAtItsBoundIsTheBound) {
  for (const double mean : {0.35, 0.3, 0.1, 0.7}) {
    for (const double sigma : {0.3, 0.25, 0.17}) {
      physics::Parameter share;
      share.mean = mean;
      share.sigma = sigma;
      share.low = 0.0;
      share.high = 1.0;
      EXPECT_GE(share.value_of(share.z_of(0.0)), 0.0) << mean << " " << sigma;
      EXPECT_LE(share.value_of(share.z_of(1.0)), 1.0) << mean << " " << sigma;
    }
  }
}

// Its numbers are relative to a capacity that the description leaves open, and to a room that nobody logged.
TEST(Refined, APartOfUnknownCapacityIsSimulatedAsFitted) {
  const physics::Machine machine = machine_of(R"({"format": "zerodrift-machine/1", "components": [
    {"id": "chamber", "kind": "lump", "prescribed": true}, {"id": "frame", "kind": "lump"}],
    "couplings": [{"between": [{"component": "chamber"}, {"component": "frame"}], "conductance_W_K": null}],
    "room": {"channel": null, "temperature_C": null, "sigma_C": 2.0},
    "sensors": [{"channel": "frame_C", "component": "frame", "accuracy_C": 0.2},
                {"channel": "chamber_C", "component": "chamber", "accuracy_C": 0.2}]})");
  recording::Recording run;
  run.name = "run.csv";
  run.channels = {{"frame_C", {}}, {"chamber_C", {}}};
  double frame_C = 22.0;
  for (int k = 0; k <= 720; ++k) {
    const double time_s = 30.0 * k;
    const double chamber_C = time_s < 10800.0 ? 60.0 : 24.0;
    run.time_s.push_back(time_s);
    run.channels[0].values.push_back(frame_C + 0.02 * std::sin(12.9898 * k * k));
    run.channels[1].values.push_back(chamber_C);
    frame_C += 30.0 * ((chamber_C - frame_C) / 2500.0 - (frame_C - 20.0) / 4000.0);
  }
  const auto found = diagnosed_and_simulated(machine, {run}, {false});
  ASSERT_TRUE(found.has_value()) << describe(found.error());
  EXPECT_EQ(found->refined.find("frame")->heat_capacity_J_K, physics::stand_in_capacity_J_K);
}

TEST(Refined, AMachineOfSensorsAloneIsReadBack) {
  const physics::Machine machine =
      machine_of(R"({"format": "zerodrift-machine/1", "sensors": [{"channel": "T1_C"}, {"channel": "T2_C"}]})");
  const auto back = physics::machine_from_json(physics::to_json(machine), "refined.json");
  ASSERT_TRUE(back.has_value()) << describe(back.error());
  EXPECT_EQ(back->components.size(), 2U);
  EXPECT_EQ(back->sensors[1].component, "T2_C");
}

}  // namespace zerodrift::diagnosis
