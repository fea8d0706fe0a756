// Effects of a part that another part or a motor warms. Recordings simulated by the program itself: what is tested is
// the search.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <span>

#include "core/diagnosis/description/inner_bodies.h"
#include "core/diagnosis/diagnosis.h"
#include "core/physics/builder.h"
#include "core/physics/prediction.h"
#include "tests/diagnosis/answered.h"

namespace zerodrift::diagnosis {
namespace {

struct Stretch {
  double until_s;
  double rpm;
};

constexpr std::array first_plan = {Stretch{3180, 2750},  Stretch{5160, 2950},  Stretch{7200, 3200},
                                   Stretch{9240, 5450},  Stretch{12540, 0},    Stretch{14100, 1550},
                                   Stretch{15720, 4050}, Stretch{17400, 4350}, Stretch{20280, 0}};
constexpr std::array second_plan = {Stretch{2640, 4600},  Stretch{4800, 4250},  Stretch{6660, 1450},
                                    Stretch{9240, 0},     Stretch{11940, 6300}, Stretch{13680, 2500},
                                    Stretch{15780, 2300}, Stretch{18960, 0}};

physics::Machine spindle() {
  const auto machine = physics::machine_from_json(nlohmann::json::parse(R"({"format": "zerodrift-machine/1",
    "components": [{"id": "spindle", "length_mm": 400, "outer_diameter_mm": 160, "bore_diameter_mm": 20,
      "material": {"conductivity_W_mK": 44, "density_kg_m3": 7850, "expansion_1_K": 1.15e-05,
                   "heat_capacity_J_kgK": 460},
      "heat_sources": [
        {"id": "motor", "kind": "motor", "efficiency": 0.9965, "rated_power_W": 7500, "rated_speed_rpm": 8000,
         "from_mm": 80, "to_mm": 180},
        {"id": "rear_bearing", "kind": "bearing", "f0": 0.75, "f1": 0.001, "load_N": 220, "mean_diameter_mm": 67.5,
         "oil_viscosity_mm2_s": 18, "from_mm": 20, "to_mm": 40},
        {"id": "front_bearing", "kind": "bearing", "f0": 0.75, "f1": 0.001, "load_N": 420, "mean_diameter_mm": 77.5,
         "oil_viscosity_mm2_s": 18, "from_mm": 320, "to_mm": 355}]}],
    "displacements": [{"channel": "dZ_um", "component": "spindle", "direction": "Z"}],
    "sensors": [{"channel": "T1_C", "component": "spindle", "position_mm": 345, "accuracy_C": 0.1},
                {"channel": "T2_C", "component": "spindle", "position_mm": 260, "accuracy_C": 0.1},
                {"channel": "T3_C", "component": "spindle", "position_mm": 180, "accuracy_C": 0.1},
                {"channel": "T4_C", "component": "spindle", "position_mm": 100, "accuracy_C": 0.1},
                {"channel": "T5_C", "component": "spindle", "position_mm": 25, "accuracy_C": 0.1},
                {"channel": "ambient_C", "component": "ambient"}],
    "effects": ["convection"], "effect_parameters": {"convection": {"h_W_m2K": 14}},
    "tolerances": {"conductivity": 0.05, "film": 0.15, "heat_capacity": 0.04, "heat_source_power": 0.15}})"),
                                                  "spindle.json");
  EXPECT_TRUE(machine.has_value());
  return *machine;
}

/// Within its tolerances.
physics::Machine real_spindle() {
  physics::Machine real = with_inner_bodies(spindle());
  physics::Component& rod = real.components.front();
  rod.material.conductivity_W_mK = 42.2;
  rod.sources[1].scale = 0.93;
  rod.sources[2].scale = 1.12;
  real.effects.front().numbers = {{"h_W_m2K", 16.3}, {"film_tilt", -0.27}};
  return real;
}

recording::Recording run_of(const physics::Machine& real, std::span<const Stretch> plan, std::mt19937& random) {
  std::normal_distribution<double> noise(0.0, 1.0);
  recording::Recording run;
  run.name = "run.csv";
  recording::Channel speed{"spindle_rpm", {}}, room{"ambient_C", {}};
  for (const Stretch* now = plan.data(); now != plan.data() + plan.size(); ++now) {
    for (double t_s = 60.0 * static_cast<double>(run.rows()); t_s < now->until_s; t_s += 60.0) {
      run.time_s.push_back(t_s);
      speed.values.push_back(now->rpm);
      room.values.push_back(21.5 + 7e-5 * t_s + 0.2 * std::sin(t_s / 3000.0));
    }
  }
  run.channels = {std::move(speed), std::move(room)};
  if (real.find("gearbox") != nullptr) {  // warms by 12 K, slowly
    for (const double t_s : run.time_s) run.ensure("gearbox_C").values.push_back(33.5 - 12.0 * std::exp(-t_s / 5000.0));
  }
  const physics::Network network = physics::build_network(real, run);
  const auto shown = physics::predict(network, physics::make_inputs(network, run), network.start_values());
  for (const physics::PredictedChannel& channel : shown.channels) {
    recording::Channel& seen = run.ensure(channel.channel);
    seen.values = channel.values;
    for (double& value : seen.values) value += noise(random) * (channel.temperature ? 0.1 : 0.2);
  }
  return run;
}

std::vector<recording::Recording> runs_of(unsigned seed, const physics::Machine& real) {
  std::mt19937 random(seed);
  recording::Recording first = run_of(real, first_plan, random);
  recording::Recording second = run_of(real, second_plan, random);
  second.name = "second.csv";
  return {std::move(first), std::move(second)};
}

}  // namespace

/// Looked for in the middle of the rod alone, it was taken for a sensor at another place.
TEST(Forms, ANeighbourTouchesARodWhereItDoes) {
  const auto with_gearbox = [](physics::Machine machine) {
    physics::Component gearbox;
    gearbox.id = "gearbox";
    gearbox.lump = gearbox.prescribed = true;
    machine.components.push_back(gearbox);
    machine.sensors.push_back({"gearbox_C", "gearbox"});
    return machine;
  };
  constexpr double touched_mm = 300.0;
  physics::Machine real = with_gearbox(real_spindle());
  real.effects.push_back({"neighbour_heat",
                          false,
                          {{"conductance_W_K", 1.5}, {"position_mm", touched_mm}},
                          {{"component", "spindle"}, {"neighbour", "gearbox"}}});
  const auto d = diagnosed_and_simulated(with_gearbox(spindle()), runs_of(5, real), {false});
  ASSERT_TRUE(d) << describe(d.error());
  ASSERT_EQ(ids_of(*d), std::vector<std::string>{"neighbour_heat"});
  EXPECT_EQ(d->verdict, Verdict::missing_effect);
  EXPECT_NEAR(*d->effects.front().position_mm, touched_mm, 2.0 * d->effects.front().position_sigma_mm);
  EXPECT_LT(d->effects.front().position_sigma_mm, 6.0);
}

/// What warms late where the motor sits is no joint beside it.
TEST(Forms, AMotorMayHaveABodyOfItsOwn) {
  physics::Machine real = real_spindle();
  real.effects.push_back({"heater_body",
                          false,
                          {{"heat_capacity_J_K", 2500.0}, {"contact_W_K", 7.0}},
                          {{"component", real.components.front().id}, {"source", "motor"}}});
  const auto d = diagnosed_and_simulated(spindle(), runs_of(8, real), {false});
  ASSERT_TRUE(d) << describe(d.error());
  ASSERT_EQ(ids_of(*d), std::vector<std::string>{"heater_body"});
  EXPECT_EQ(d->verdict, Verdict::missing_effect);
  const FoundEffect& body = d->effects.front();
  EXPECT_NEAR(body.parameters.at("heat_capacity_J_K"), 2500.0, 3.0 * body.sigma.at("heat_capacity_J_K"));
  EXPECT_LT(body.sigma.at("heat_capacity_J_K"), 600.0);
}

}  // namespace zerodrift::diagnosis
