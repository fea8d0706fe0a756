#include "core/diagnosis/diagnosis.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/diagnosis/answer/explain.h"
#include "core/diagnosis/answer/regime.h"
#include "core/diagnosis/search/run_facts.h"
#include "core/physics/simulate.h"
#include "tests/diagnosis/answered.h"

namespace zerodrift::diagnosis {
namespace {

Diagnosis diagnosed(const proof::Case& one, const TaskContext& context = {}) {
  const auto machine = physics::machine_from_json(one.machine, one.name);
  auto result = diagnosed_and_simulated(*machine, one.recordings, {}, context);
  EXPECT_TRUE(result.has_value());
  return result ? *result : Diagnosis{};
}

}  // namespace

/// A spindle that warms up grows as much in a minute as a bracket slips; a kink where the speed changes is no slip.
TEST(Diagnosis, ASlipIsSeenWhileTheSpindleGrows) {
  const proof::Case one = proof::make_case(5, "none");
  const auto machine = physics::machine_from_json(one.machine, one.name);
  recording::Recording run = one.recordings[0];
  auto& growth_um = run.find("dZ_um")->values;
  constexpr std::size_t kink = 150;
  constexpr std::size_t slip = 250;
  for (std::size_t k = 0; k < growth_um.size(); ++k) {
    const double noise_um = 0.1 * std::sin(12.9898 * static_cast<double>(k * k));
    growth_um[k] = (k < kink ? 2.5 : 0.5) * (static_cast<double>(k) - kink) + (k < slip ? 0.0 : 2.0) + noise_um;
  }
  const auto times_s = search::run_facts(*machine, run).jump_times_s["dZ_um"];
  ASSERT_FALSE(times_s.empty());
  EXPECT_EQ(times_s.front(), run.time_s[slip]);
}

TEST(Diagnosis, NamesAHiddenEffectAndFitsTheSecondRun) {
  const proof::Case one = proof::make_case(11, "contact_resistance");
  const Diagnosis d = diagnosed(one);
  EXPECT_EQ(d.verdict, Verdict::missing_effect);
  ASSERT_FALSE(d.effects.empty());
  EXPECT_EQ(d.effects[0].id, "contact_resistance");
  ASSERT_TRUE(d.effects[0].position_mm.has_value());
  EXPECT_NEAR(*d.effects[0].position_mm, one.hidden[0].position_mm, 12.0);
  ASSERT_TRUE(d.heat.has_value());  // of the run, not of half an hour more
  EXPECT_EQ(d.heat->time_s.front(), one.recordings[0].time_s.front());
  EXPECT_EQ(d.heat->time_s.back(), one.recordings[0].time_s.back());
  ASSERT_EQ(d.heat->watts.size(), d.heat->position_mm.size());
  EXPECT_EQ(d.heat->watts.front().size(), d.heat->time_s.size());
  ASSERT_EQ(d.held_out.size(), 1u);
  for (const auto& [channel, rms] : d.held_out[0].explained) {
    if (channel[0] != 'T') continue;
    EXPECT_LT(rms, 0.2) << channel;
  }
  // The refined description predicts the machine without noise.
  const auto again = physics::machine_from_json(physics::to_json(d.refined), "refined.json");
  ASSERT_TRUE(again.has_value());
  const auto simulation = physics::simulate(*again, one.recordings[1]);
  ASSERT_TRUE(simulation.has_value());
  for (const auto& difference : physics::compare(simulation->prediction, one.clean[1])) {
    if (!difference.temperature) continue;
    EXPECT_LT(difference.rms, 0.3) << difference.channel;
  }
  // What the sentence of a lone effect says stands in the table of the channels.
  const Sentence& s = d.effects[0].explanation;
  const auto channel = std::find_if(d.channels.begin(), d.channels.end(),
                                    [&](const auto& seen) { return seen.channel == s.facts.at("channel"); });
  ASSERT_NE(channel, d.channels.end());
  EXPECT_EQ(s.facts.at("before"), fmt::format("{:.2g}", channel->rms_refitted));
}

/// By another discretisation with its own edges: the film coefficient may be off, the watts are what the sensors saw.
TEST(Diagnosis, SaysHowManyWattsTheCoolantTakes) {
  for (const std::uint64_t seed : {4u}) {
    const proof::Case one = proof::make_case(seed, "coolant", proof::StrengthRule::shown);
    const Diagnosis d = diagnosed(one);
    ASSERT_EQ(d.effects.size(), 1u) << one.name;
    const FoundEffect& coolant = d.effects.front();
    ASSERT_EQ(coolant.id, "coolant");
    ASSERT_TRUE(coolant.heat.has_value());
    const double truth_W = one.hidden.front().heat_W;
    ASSERT_LT(truth_W, 0.0);
    EXPECT_LT(coolant.heat->sigma_W, -0.3 * truth_W);
    EXPECT_NEAR(coolant.heat->mean_W, truth_W, 3.0 * coolant.heat->sigma_W) << one.name;
    EXPECT_NE(coolant.explanation.english.find("it takes away"), std::string::npos) << coolant.explanation.english;
  }
}

TEST(Diagnosis, SaysWhenNothingIsMissing) {
  const Diagnosis d = diagnosed(proof::make_case(21, "none"));
  EXPECT_EQ(d.verdict, Verdict::consistent);
  EXPECT_TRUE(d.effects.empty());
  EXPECT_TRUE(d.mismatch.channels.empty());
}

/// A heat that nothing logged and that follows no input: it is named as that or not at all.
TEST(Diagnosis, AHeatThatComesAndGoesIsNoOtherEffect) {
  proof::Case one = proof::make_case(31, "unlisted:wandering_heat");
  one.recordings.resize(1);
  const Diagnosis d = diagnosed(one);
  EXPECT_NE(d.verdict, Verdict::consistent);
  for (const std::string& id : ids_of(d)) EXPECT_EQ(id, "switched_heat");
}

/// A camera sees the whole machine. How much of a displacement the description leaves to parts it does not hold is said
/// in it, and is then no physics that the simulation lacks.
TEST(Diagnosis, ADisplacementIsExplainedAsFarAsTheDescriptionSpeaksOfIt) {
  proof::Case one = proof::make_case(32, "unlisted:creep");
  EXPECT_EQ(diagnosed(one).verdict, Verdict::unexplained);
  for (auto& displacement : one.machine["displacements"]) displacement["accuracy_um"] = 15.0;
  const Diagnosis d = diagnosed(one);
  EXPECT_EQ(d.verdict, Verdict::consistent);
  EXPECT_EQ(physics::to_json(d.refined).at("displacements"), one.machine.at("displacements"));
}

TEST(Diagnosis, JsonHasTheContractsKeys) {
  const nlohmann::json j = to_json(diagnosed(proof::make_case(51, "sensor_lag")));
  for (const char* key : {"verdict", "mismatch", "effects", "ambiguous_with", "suggested_experiment", "rmse"}) {
    EXPECT_TRUE(j.contains(key)) << key;
  }
  for (const char* key : {"channels", "component", "position_mm", "time_s", "regime", "missing_heat_W"}) {
    EXPECT_TRUE(j["mismatch"].contains(key)) << key;
  }
  for (const char* key :
       {"id", "component", "position_mm", "channel", "parameters", "sigma", "confidence", "explanation"}) {
    EXPECT_TRUE(j["effects"].at(0).contains(key)) << key;
  }
  for (const char* key : {"before", "after", "held_out_before", "held_out_after"})
    EXPECT_TRUE(j["rmse"].contains(key)) << key;
}

TEST(Diagnosis, CanBeCancelled) {
  const proof::Case one = proof::make_case(61, "none");
  const auto machine = physics::machine_from_json(one.machine, one.name);
  std::stop_source stop;
  stop.request_stop();
  TaskContext context;
  context.stop = stop.get_token();
  const auto result = diagnosed_and_simulated(*machine, one.recordings, {}, context);
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, ErrorCode::cancelled);
}

TEST(Diagnosis, ARecordingWithoutExcitationIsNeverAConfidentEffect) {
  proof::Case one = proof::make_case(71, "none");
  recording::Recording still = one.recordings[0];
  for (auto& channel : still.channels) {
    if (channel.name[0] == 'T' || channel.name == "ambient_C") channel.values.assign(still.rows(), 20.0);
    if (channel.name[0] == 'd' || channel.name[0] == 's' || channel.name == "coolant_on")
      channel.values.assign(still.rows(), 0.0);
  }
  one.machine["initial_temperature_C"] = 20.0;
  one.recordings = {still};
  const Diagnosis d = diagnosed(one);
  EXPECT_EQ(d.verdict, Verdict::consistent);
  EXPECT_TRUE(notes(d, "no_excitation"));
}

/// A displacement that went its own way for a while: when is told, and no place, as no heat moved it.
TEST(Diagnosis, WhatIsUnexplainedIsToldWithItsTimesAndHeatWithItsPlace) {
  Diagnosis answer;
  answer.verdict = Verdict::unexplained;
  for (int minute = 0; minute <= 300; ++minute) answer.time_s.push_back(60.0 * minute);
  answer.channels.resize(2);
  answer.channels[0].channel = "T1_C";
  answer.channels[1].channel = "dZ_um";
  answer.channels[1].temperature = false;
  Mismatch& off = answer.mismatch;
  off.component = "spindle";
  off.scan_position_mm = {0.0, 200.0, 400.0};
  off.position_mm = {150.0, 190.0};
  off.time_s = {{1200.0, 3600.0}, {7200.0, 7260.0}, {9000.0, 12000.0}};
  off.channels = {"dZ_um"};
  std::vector<Sentence> told = explain_unexplained(answer);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].english, "It shows most at 20–60 and 150–200 min.");
  off.channels = {"T1_C"};
  told = explain_unexplained(answer);
  ASSERT_EQ(told.size(), 2u);
  EXPECT_EQ(told[1].english, "As heat it would come in between 150 and 190 mm of spindle.");
  off.position_mm = {0.0, 390.0};
  off.time_s = {{0.0, 18000.0}};
  EXPECT_TRUE(explain_unexplained(answer).empty());
  answer.verdict = Verdict::missing_effect;
  off.time_s = {{1200.0, 3600.0}};
  EXPECT_TRUE(explain_unexplained(answer).empty());
}

/// A load that follows the speed is no cutting.
TEST(Diagnosis, TheRegimeIsThatOfTheInputThatIsFollowedBest) {
  History heat;
  recording::Recording run;
  recording::Channel speed{"spindle_rpm", {}}, coolant{"coolant_on", {}}, load{"spindle_load_W", {}};
  for (int minute = 0; minute < 360; ++minute) {
    const double rpm = minute < 90 ? 0.0 : minute < 180 ? 3000.0 : minute < 270 ? 6000.0 : 0.0;
    run.time_s.push_back(60.0 * minute);
    speed.values.push_back(rpm);
    coolant.values.push_back(rpm > 0.0 ? 1.0 : 0.0);
    load.values.push_back(30.0 + 0.1 * rpm);
    if (minute % 30 == 0) {
      heat.time_s.push_back(60.0 * minute);
      heat.value.push_back(-1e-6 * rpm * rpm);
    }
  }
  run.channels = {speed, coolant, load};
  EXPECT_NE(regime_of(heat, run).find("spindle speed"), std::string::npos);
}

}  // namespace zerodrift::diagnosis
