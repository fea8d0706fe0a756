#include "core/physics/simulator.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/physics/builder.h"
#include "core/physics/heat.h"
#include "core/physics/initial_state.h"
#include "core/physics/prediction.h"
#include "core/physics/simulate.h"
#include "tests/physics/machines.h"

namespace zerodrift::physics {
namespace {

/// A rod coupled to a lump: the envelope is wider than a chain.
nlohmann::json coupled_json() {
  nlohmann::json document = test::spindle_json();
  document["components"].push_back(
      {{"id", "housing"}, {"kind", "lump"}, {"heat_capacity_J_K", 9000}, {"area_mm2", 200000}});
  document["couplings"] = nlohmann::json::parse(
      R"([{"between": [{"component": "spindle", "position_mm": 341}, {"component": "housing"}], "conductance_W_K": 4.0}])");
  document["sensors"].push_back({{"channel", "T7_C"}, {"component", "housing"}});
  return document;
}

/// The same rod as a shaft in its cartridge: two chains of cells, joined along their length and at the bearing.
nlohmann::json cartridge_json() {
  nlohmann::json document = test::spindle_json();
  document["components"][0]["inner_body"] = nlohmann::json::parse(
      R"({"section_share": 0.2, "coupling_W_mK": 25.0, "coupling_rise": 0.6, "growth_share": 0.8,
          "heat_share": {"motor": 0.4, "front_bearing": 0.3}, "contact_W_K": {"front_bearing": 30.0},
          "near_field_K_W": {"T5_C": 0.001}, "near_lag_s": 90.0, "shaft_in_cartridge": true})");
  return document;
}

/// Its stretches conduct differently, and it has a joint.
nlohmann::json uneven_json() {
  nlohmann::json document = cartridge_json();
  document["components"][0]["conduction_shares"] = {1.3, 0.6, 0.9, 1.1};
  document["effects"].push_back("contact_resistance");
  document["effect_parameters"]["contact_resistance"] = {
      {"component", "spindle"}, {"resistance_m2K_W", 2e-3}, {"position_mm", 210.3}, {"half_width_mm", 12.0}};
  return document;
}

/// The motor's heat goes through a body of its own into both.
nlohmann::json motor_body_json(double heat_capacity_J_K) {
  nlohmann::json document = cartridge_json();
  document["effects"].push_back("heater_body");
  document["effect_parameters"]["heater_body"] = {
      {"component", "spindle"}, {"source", "motor"}, {"heat_capacity_J_K", heat_capacity_J_K}, {"contact_W_K", 6.0}};
  return document;
}

void expect_conservation(const nlohmann::json& document) {
  const Machine machine = *machine_from_json(document, "m.json");
  const recording::Recording run = test::stepped_run();
  const Network network = build_network(machine, run);
  SimulateOptions options;
  options.keep_balance = true;
  const Trajectory t = run_network(network, make_inputs(network, run), network.start_values(), {}, options);
  EXPECT_GT(t.stored_J, 1e4);
  EXPECT_NEAR(t.stored_J / t.supplied_J, 1.0, 1e-10);
}

/// What comes from outside, at the simulated temperatures, is what the scheme supplied.
void expect_heat_from_outside(const nlohmann::json& document) {
  const Machine machine = *machine_from_json(document, "m.json");
  const recording::Recording run = test::stepped_run();
  const Network network = build_network(machine, run);
  const InputSet inputs = make_inputs(network, run);
  const std::vector<double> values = network.start_values();
  SimulateOptions options;
  options.keep_balance = options.keep_field = true;
  const Trajectory t = run_network(network, inputs, values, {}, options);
  const std::vector<double> heat_W = heat_from_outside_W(network, inputs, values, t.field_C);
  double heat_J = 0.0;
  for (std::size_t k = 0; k < heat_W.size(); ++k) heat_J += heat_W[k] * (inputs.time_s[k + 1] - inputs.time_s[k]);
  EXPECT_NEAR(heat_J / t.supplied_J, 1.0, 2e-3);
}

void expect_exact_derivatives(const nlohmann::json& document) {
  const Machine machine = *machine_from_json(document, "m.json");
  const recording::Recording run = test::stepped_run();
  const Network network = build_network(machine, run);
  const InputSet inputs = make_inputs(network, run);
  std::vector<double> values = network.start_values();
  values[network.hold_parameter] = 0.4;
  std::vector<int> all;
  for (std::size_t p = 0; p < values.size(); ++p) all.push_back(static_cast<int>(p));
  const Prediction exact = predict(network, inputs, values, all);
  for (const int p : all) {
    // Ten times smaller, and rounding in the length of a rod with a joint is larger than 1e-6 of the difference.
    const double h = 1e-3 * network.parameters[p].slope_at(values[p] == 0.0 ? network.parameters[p].sigma : values[p]);
    std::vector<double> up = values, down = values;
    up[p] += h;
    down[p] -= h;
    const Prediction above = predict(network, inputs, up);
    const Prediction below = predict(network, inputs, down);
    for (std::size_t c = 0; c < exact.channels.size(); ++c) {
      double largest = 1e-12;
      double worst = 0.0;
      for (std::size_t k = 0; k < exact.rows; ++k) {
        const double difference = (above.channels[c].values[k] - below.channels[c].values[k]) / (2.0 * h);
        const double derivative = exact.channels[c].derivatives[k * exact.columns + p];
        largest = std::max(largest, std::abs(difference));
        worst = std::max(worst, std::abs(derivative - difference));
      }
      EXPECT_LT(worst * network.parameters[p].sigma, 1e-6 * (1.0 + largest * network.parameters[p].sigma))
          << network.parameters[p].key << " on " << exact.channels[c].channel;
    }
  }
}

double largest_difference(const Prediction& a, const Prediction& b) {
  double largest = 0.0;
  for (std::size_t c = 0; c < a.channels.size(); ++c) {
    for (std::size_t k = 0; k < a.rows; ++k) {
      largest = std::max(largest, std::abs(a.channels[c].values[k] - b.channels[c].values[k]));
    }
  }
  return largest;
}

Prediction nominal(const nlohmann::json& document) {
  const Machine machine = *machine_from_json(document, "m.json");
  const recording::Recording run = test::stepped_run();
  const Network network = build_network(machine, run);
  return predict(network, make_inputs(network, run), network.start_values());
}

}  // namespace

/// The start of a rod is even unless its first samples differ by more than offsets and noise.
TEST(InitialState, OffsetsAndNoiseMakeNoUnevenStart) {
  const Machine machine = test::spindle();
  recording::Recording run = test::stepped_run();
  const auto tilt_width_K = [&] {
    const Network network = build_network(machine, run);
    for (const Parameter& parameter : network.parameters) {
      if (parameter.key == "initial_tilt_K") return parameter.sigma;
    }
    return 0.0;
  };
  for (const auto& sensor : machine.sensors) {
    if (sensor.component == "spindle") {
      run.ensure(sensor.channel).values.assign(run.rows(), 20.0 + 4e-4 * sensor.position_mm);
    }
  }
  EXPECT_EQ(uneven_start_K(machine, "spindle", run), 0.0);
  EXPECT_DOUBLE_EQ(tilt_width_K(), 0.05);
  for (double& value_C : run.find("T1_C")->values) value_C -= 0.5;
  EXPECT_NEAR(uneven_start_K(machine, "spindle", run), 0.648 - 0.24, 0.001);
  EXPECT_DOUBLE_EQ(tilt_width_K(), 0.15);
}

TEST(Simulator, ConservesHeat) {
  expect_conservation(coupled_json());
  expect_conservation(cartridge_json());
  expect_conservation(motor_body_json(1500.0));
}

TEST(Simulator, TellsTheHeatThatComesFromOutside) {
  expect_heat_from_outside(coupled_json());
  expect_heat_from_outside(cartridge_json());
}

TEST(Simulator, DerivativesAgreeWithCentralDifferences) {
  expect_exact_derivatives(coupled_json());
  expect_exact_derivatives(cartridge_json());
  expect_exact_derivatives(motor_body_json(1500.0));
  expect_exact_derivatives(uneven_json());
}

TEST(Simulator, AShaftTightInItsCartridgeIsOneBody) {
  nlohmann::json tight = cartridge_json();
  nlohmann::json one = tight;
  one["components"][0].erase("inner_body");
  nlohmann::json& inner = tight["components"][0]["inner_body"];
  inner["near_field_K_W"] = nlohmann::json::object();
  EXPECT_GT(largest_difference(nominal(tight), nominal(one)), 0.5);
  inner["coupling_W_mK"] = 1e7;
  EXPECT_LT(largest_difference(nominal(tight), nominal(one)), 0.01);
}

/// Between a motor and its rod stands a contact: however badly it conducts, all heat comes through, where it did
/// before.
TEST(Simulator, AMotorsBodyWithoutCapacityChangesNothing) {
  EXPECT_LT(largest_difference(nominal(motor_body_json(0.0)), nominal(cartridge_json())), 1e-7);
  EXPECT_GT(largest_difference(nominal(motor_body_json(1500.0)), nominal(cartridge_json())), 0.1);
}

TEST(Simulator, TheInsideOfARodIsKeptInTheDescription) {
  const Machine machine = *machine_from_json(cartridge_json(), "m.json");
  const nlohmann::json written = to_json(machine);
  EXPECT_EQ(largest_difference(nominal(written), nominal(cartridge_json())), 0.0);
  ASSERT_TRUE(machine.components[0].inner.has_value());
  EXPECT_EQ(machine.components[0].inner->contact_W_K.at("front_bearing"), 30.0);
}

/// A bearing of 40 mm on a screw of 1500 mm: in forty cells its heat is spread over twice its width.
TEST(Simulator, ASourceHasTwoCellsAtLeast) {
  nlohmann::json document = test::spindle_json();
  nlohmann::json& screw = document["components"][0];
  screw["length_mm"] = 1500;
  document["sensors"][0]["position_mm"] = 40;
  screw["heat_sources"] = {{{"id", "fixed_bearing"},
                            {"kind", "input"},
                            {"channel", "spindle_load_W"},
                            {"watts_per_unit", 0.02},
                            {"from_mm", 20},
                            {"to_mm", 60}}};
  const Machine machine = *machine_from_json(document, "screw.json");
  const recording::Recording run = test::stepped_run();
  const auto rise_K = [&](int cells) {
    const Network network = build_network(machine, run, {cells});
    const Prediction seen = predict(network, make_inputs(network, run), network.start_values());
    return *std::max_element(seen.channels[0].values.begin(), seen.channels[0].values.end()) - 20.0;
  };
  const double fine_K = rise_K(600);
  EXPECT_GT(std::abs(rise_K(40) / fine_K - 1.0), 0.03);
  EXPECT_LT(std::abs(rise_K(0) / fine_K - 1.0), 0.015);
}

/// Edges anywhere between the faces: beside the source forty cells are as good as six hundred.
TEST(Simulator, ASourcesHeatKeepsItsCentre) {
  nlohmann::json document = test::spindle_json();
  const recording::Recording run = test::stepped_run();
  for (const double from_mm : {200.0, 202.0, 204.0, 206.0, 208.0}) {
    document["components"][0]["heat_sources"] = {{{"id", "nut"},
                                                  {"kind", "input"},
                                                  {"channel", "spindle_load_W"},
                                                  {"watts_per_unit", 0.05},
                                                  {"from_mm", from_mm},
                                                  {"to_mm", from_mm + 33.0}}};
    const Machine machine = *machine_from_json(document, "screw.json");
    const auto rise_K = [&](int cells) {
      const Network network = build_network(machine, run, {cells});
      const Prediction seen = predict(network, make_inputs(network, run), network.start_values());
      std::vector<double> rise;
      for (const auto& channel : seen.channels)
        rise.push_back(*std::max_element(channel.values.begin(), channel.values.end()) - 20.0);
      return rise;
    };
    const std::vector<double> fine_K = rise_K(600);
    const std::vector<double> coarse_K = rise_K(40);
    for (const std::size_t beside : {1, 3}) EXPECT_NEAR(coarse_K[beside] / fine_K[beside], 1.0, 4e-4) << from_mm;
  }
}

TEST(Simulate, PredictsTheChannelsOfTheRecordingAndNamesTheRest) {
  const Machine machine = test::spindle();
  recording::Recording run = test::stepped_run(1.0);
  run.ensure("T1_C").values.assign(run.rows(), 20.0);
  run.ensure("T99_C").values.assign(run.rows(), 20.0);
  const auto result = simulate(machine, run);
  ASSERT_TRUE(result.has_value());
  EXPECT_NE(result->prediction.find("dZ_um"), nullptr);
  EXPECT_EQ(result->not_predicted, std::vector<std::string>{"T99_C"});
  EXPECT_GT(result->prediction.find("dZ_um")->values.back(), 5.0);
  const auto differences = compare(result->prediction, run);
  ASSERT_EQ(differences.size(), 1u);
  EXPECT_GT(differences[0].rms, 1.0);
}

TEST(Simulate, RefusesKelvinAndMissingInputs) {
  const Machine machine = test::spindle();
  recording::Recording run = test::stepped_run(1.0);
  run.ensure("T1_C").values.assign(run.rows(), 293.15);
  EXPECT_EQ(simulate(machine, run).error().code, ErrorCode::data_does_not_fit);
  recording::Recording blind = test::stepped_run(1.0);
  blind.channels.erase(blind.channels.begin());
  EXPECT_EQ(simulate(machine, blind).error().context.at("channel"), "spindle_rpm");
}

}  // namespace zerodrift::physics
