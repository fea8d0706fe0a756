// Data that a diagnosis must not be fooled by: each is refused or named, and never a confident wrong effect.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/diagnosis/diagnosis.h"
#include "tests/proof/case_generator.h"

namespace zerodrift::diagnosis {
namespace {

Result<Diagnosis> answer_for(const proof::Case& one) {
  const auto machine = physics::machine_from_json(one.machine, one.name);
  EXPECT_TRUE(machine.has_value());
  return diagnose(*machine, one.recordings, {false});
}

void scale(recording::Recording& recording, char first_letter, double factor) {
  for (auto& channel : recording.channels) {
    if (channel.name[0] != first_letter) continue;
    for (double& value : channel.values) value *= factor;
  }
}

bool has_note(const Diagnosis& d, const std::string& beginning) {
  return std::any_of(d.notes.begin(), d.notes.end(), [&](const auto& note) { return note.rfind(beginning, 0) == 0; });
}

bool only_names(const Diagnosis& d, const std::string& id) {
  return !d.effects.empty() && std::all_of(d.effects.begin(), d.effects.end(), [&](auto& e) { return e.id == id; });
}

}  // namespace

TEST(BadInput, TemperaturesInMillidegreesAreRefused) {
  proof::Case one = proof::make_case(101, "none");
  scale(one.recordings[0], 'T', 1000.0);
  const auto answer = answer_for(one);
  ASSERT_FALSE(answer.has_value());
  EXPECT_EQ(answer.error().code, ErrorCode::data_does_not_fit);
}

TEST(BadInput, DisplacementsInMillimetresAreRefusedByName) {
  proof::Case one = proof::make_case(102, "none");
  scale(one.recordings[0], 'd', 1e-3);
  const auto answer = answer_for(one);
  ASSERT_FALSE(answer.has_value());
  EXPECT_EQ(answer.error().code, ErrorCode::data_does_not_fit);
  EXPECT_NE(describe(answer.error()).find("um"), std::string::npos);
}

TEST(BadInput, PowersInKilowattsAreRefused) {
  proof::Case one = proof::make_case(103, "none");
  for (auto& source : one.machine["components"][0]["heat_sources"]) {
    if (source["kind"] == "motor") source["rated_power_W"] = source["rated_power_W"].get<double>() / 1000.0;
    if (source["kind"] == "bearing") {
      for (const char* key : {"f0", "f1"}) source[key] = source[key].get<double>() / 1000.0;
    }
  }
  const auto machine = physics::machine_from_json(one.machine, one.name);
  if (!machine) return;  // the reader already refuses it
  const auto answer = diagnose(*machine, one.recordings, {false});
  ASSERT_FALSE(answer.has_value());
  EXPECT_EQ(answer.error().code, ErrorCode::data_does_not_fit);
}

TEST(BadInput, ChannelsMissingOnEitherSideAreNamed) {
  proof::Case one = proof::make_case(104, "cutting_heat");
  std::erase_if(one.recordings[0].channels, [](const auto& channel) { return channel.name == "T2_C"; });
  auto& sensors = one.machine["sensors"];
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    if (sensors[i]["channel"] == "T3_C") {
      sensors.erase(i);
      break;
    }
  }
  const auto answer = answer_for(one);
  ASSERT_TRUE(answer.has_value()) << describe(answer.error());
  EXPECT_TRUE(has_note(*answer, "the recording has no channel T2_C"));
  EXPECT_TRUE(only_names(*answer, "cutting_heat"));
}

TEST(BadInput, AWarmStartIsNoEffect) {
  proof::Case one = proof::make_case(105, "none");
  const auto& whole = one.recordings[0];
  one.recordings[0] = recording::slice(whole, whole.rows() / 3, whole.rows() - whole.rows() / 3);
  one.machine.erase("initial_temperature_C");
  const auto answer = answer_for(one);
  ASSERT_TRUE(answer.has_value()) << describe(answer.error());
  for (const auto& effect : answer->effects) EXPECT_LT(effect.confidence, 0.5) << effect.id;
}

TEST(BadInput, GapsAndSpikesDoNotChangeTheName) {
  proof::Case one = proof::make_case(106, "sensor_lag");
  auto& recording = one.recordings[0];
  for (auto& channel : recording.channels) {
    if (channel.name[0] != 'T' && channel.name[0] != 'd') continue;
    for (std::size_t k = 7; k < channel.values.size(); k += 41) channel.values[k] += 25.0;
    for (std::size_t k = channel.values.size() / 2; k < channel.values.size() / 2 + 30; ++k)
      channel.values[k] = std::nan("");
  }
  const auto answer = answer_for(one);
  ASSERT_TRUE(answer.has_value()) << describe(answer.error());
  EXPECT_TRUE(only_names(*answer, "sensor_lag"));
}

TEST(BadInput, ASecondRecordingOfAnotherMachineIsNamed) {
  proof::Case one = proof::make_case(107, "none");
  one.recordings[1] = proof::make_case(208, "coolant").recordings[0];
  one.recordings[1].name = "other";
  const auto answer = answer_for(one);
  ASSERT_TRUE(answer.has_value()) << describe(answer.error());
  EXPECT_EQ(answer->verdict, Verdict::consistent);
  EXPECT_TRUE(has_note(*answer, "held_out_differs:other"));
}

/// However wrong the description is, what is named has more evidence than the verdict asks for.
TEST(BadInput, NothingIsNamedAgainstItsOwnEvidence) {
  constexpr double least = 7.5;  // SelectionOptions::second_clean
  for (const double factor : {0.1, 0.4, 3.0}) {
    proof::Case one = proof::make_case(109, factor < 1.0 ? "none" : "sensor_lag");
    auto& rod = one.machine["components"][0];
    for (const char* key : {"outer_diameter_mm", "bore_diameter_mm"}) {
      if (rod.contains(key)) rod[key] = rod[key].get<double>() * factor;
    }
    const auto answer = answer_for(one);
    ASSERT_TRUE(answer.has_value()) << describe(answer.error());
    EXPECT_EQ(answer->verdict == Verdict::missing_effect, !answer->effects.empty() && !answer->refuted) << factor;
    for (const auto& effect : answer->effects) EXPECT_GT(effect.log_evidence_gain, least) << effect.id << factor;
  }
}

}  // namespace zerodrift::diagnosis
