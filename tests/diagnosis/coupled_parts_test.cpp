// Lumps that are joined: what their description leaves out is identified, and a joint that conducts otherwise than
// described is said. Recordings integrated here, apart from the program's own simulation.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <random>

#include "core/diagnosis/diagnosis.h"
#include "core/physics/machine.h"
#include "tests/diagnosis/answered.h"

namespace zerodrift::diagnosis {
namespace {

using Json = nlohmann::json;

constexpr std::array capacity_J_K = {7000.0, 45000.0, 120000.0};  // motor, head, bed
constexpr std::array area_m2 = {0.15, 0.7, 1.5};
constexpr double motor_head_W_K = 9.0;
constexpr double head_bed_W_K = 7.0;
constexpr double film_W_m2K = 9.0;

Json described() {
  return Json::parse(R"({"format": "zerodrift-machine/1", "name": "head on its bed",
    "components": [
      {"id": "motor", "kind": "lump", "heat_capacity_J_K": 7000, "area_mm2": 150000, "heat_sources": [
        {"id": "loss", "kind": "input", "channel": "spindle_load_W", "watts_per_unit": 0.08}]},
      {"id": "head", "kind": "lump", "heat_capacity_J_K": 45000, "area_mm2": 700000},
      {"id": "bed", "kind": "lump", "heat_capacity_J_K": 120000, "area_mm2": 1500000}],
    "couplings": [
      {"between": [{"component": "motor"}, {"component": "head"}], "conductance_W_K": 9},
      {"between": [{"component": "head"}, {"component": "bed"}], "conductance_W_K": 7}],
    "effects": ["convection"], "effect_parameters": {"convection": {"h_W_m2K": 9.6}},
    "sensors": [
      {"channel": "motor_C", "component": "motor", "accuracy_C": 0.1},
      {"channel": "head_C", "component": "head", "accuracy_C": 0.1},
      {"channel": "bed_C", "component": "bed", "accuracy_C": 0.1},
      {"channel": "ambient_C", "component": "ambient"}]})");
}

recording::Recording run_of(unsigned seed) {
  recording::Recording run;
  run.name = "run.csv";
  for (const char* name : {"spindle_load_W", "ambient_C", "motor_C", "head_C", "bed_C"})
    run.channels.push_back({name, {}});
  std::mt19937 random(seed);
  std::normal_distribution<double> noise_K(0.0, 0.05);
  std::array state_C = {21.0, 21.0, 21.0};
  constexpr double step_s = 5.0;
  constexpr double period_s = 30.0;
  for (double t_s = 0.0; t_s <= 5.0 * 3600.0; t_s += step_s) {
    const double hours = t_s / 3600.0;
    const double load_W = hours < 0.2 ? 0.0 : hours < 2.0 ? 4000.0 : hours < 3.0 ? 0.0 : 6000.0;
    if (std::fmod(t_s, period_s) == 0.0) {
      run.time_s.push_back(t_s);
      run.channels[0].values.push_back(load_W);
      run.channels[1].values.push_back(21.0);
      for (std::size_t i = 0; i < 3; ++i) run.channels[2 + i].values.push_back(state_C[i] + noise_K(random));
    }
    const double up_W = motor_head_W_K * (state_C[0] - state_C[1]);
    const double down_W = head_bed_W_K * (state_C[1] - state_C[2]);
    const std::array heat_W = {0.08 * load_W - up_W, up_W - down_W, down_W};
    for (std::size_t i = 0; i < 3; ++i) {
      state_C[i] += step_s * (heat_W[i] - film_W_m2K * area_m2[i] * (state_C[i] - 21.0)) / capacity_J_K[i];
    }
  }
  return run;
}

Diagnosis answer_for(const Json& machine) {
  const auto read = physics::machine_from_json(machine, "machine.json");
  EXPECT_TRUE(read.has_value());
  auto result = diagnosed_and_simulated(*read, {run_of(1), run_of(2)}, {false});
  EXPECT_TRUE(result.has_value());
  return result ? *result : Diagnosis{};
}

const Sentence* said(const Diagnosis& diagnosis, const std::string& id) {
  const auto found = std::find_if(diagnosis.sentences.begin(), diagnosis.sentences.end(),
                                  [&](const Sentence& sentence) { return sentence.id == id; });
  return found == diagnosis.sentences.end() ? nullptr : &*found;
}

}  // namespace

TEST(CoupledParts, AnUnknownCapacityIsIdentified) {
  for (std::size_t i = 0; i < 3; ++i) {
    Json machine = described();
    machine["components"][i].erase("heat_capacity_J_K");
    const Diagnosis d = answer_for(machine);
    EXPECT_EQ(d.verdict, Verdict::consistent) << i;
    ASSERT_TRUE(d.refined.components[i].heat_capacity_J_K);
    EXPECT_NEAR(*d.refined.components[i].heat_capacity_J_K / capacity_J_K[i], 1.0, 0.1) << i;
  }
}

TEST(CoupledParts, AnUnknownSurfaceIsIdentifiedByItsFilm) {
  for (std::size_t i = 0; i < 3; ++i) {
    Json machine = described();
    machine["components"][i].erase("area_mm2");
    const Diagnosis d = answer_for(machine);
    EXPECT_EQ(d.verdict, Verdict::consistent) << i;
    ASSERT_TRUE(d.refined.components[i].area_mm2);
    // The film's own tolerance is in it.
    EXPECT_NEAR(1e-6 * *d.refined.components[i].area_mm2 / area_m2[i], 1.0, 0.3) << i;
  }
}

/// Not known, it is not written as if it were.
TEST(CoupledParts, AGuessStaysOutOfTheDescription) {
  Json machine = described();
  machine["components"][1].erase("heat_capacity_J_K");
  machine["components"][1].erase("area_mm2");
  const auto read = physics::machine_from_json(machine, "machine.json");
  ASSERT_TRUE(read.has_value());
  const Json written = physics::to_json(*read);
  EXPECT_FALSE(written["components"][1].contains("heat_capacity_J_K"));
  EXPECT_FALSE(written["components"][1].contains("area_mm2"));
  EXPECT_TRUE(physics::to_json(answer_for(machine).refined)["components"][1].contains("heat_capacity_J_K"));
}

TEST(CoupledParts, AJointThatConductsOtherwiseIsSaid) {
  EXPECT_EQ(said(answer_for(described()), "far_joint"), nullptr);
  for (const double times : {4.0, 0.25}) {
    Json machine = described();
    machine["tolerances"]["conductance"] = 0.15;
    machine["couplings"][0]["conductance_W_K"] = times * motor_head_W_K;
    const Diagnosis d = answer_for(machine);
    EXPECT_TRUE(d.effects.empty());
    EXPECT_FALSE(d.doubtful);
    const Sentence* joint = said(d, "far_joint");
    ASSERT_NE(joint, nullptr) << times;
    EXPECT_EQ(joint->facts.at("part"), "motor-head");
    EXPECT_NEAR(std::stod(joint->facts.at("factor")) * times, 1.0, 0.15);
    EXPECT_TRUE(notes(d, "far_from_description:conductance:motor-head"));
  }
}

}  // namespace zerodrift::diagnosis
