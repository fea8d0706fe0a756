// Data that a diagnosis must not be fooled by: each is refused or named, and never a confident wrong effect.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/diagnosis/answer/explain.h"
#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/input/channels.h"
#include "core/diagnosis/input/checked_runs.h"
#include "core/physics/simulate.h"
#include "tests/diagnosis/answered.h"

namespace zerodrift::diagnosis {
namespace {

Result<Diagnosis> answer_for(const proof::Case& one) {
  const auto machine = physics::machine_from_json(one.machine, one.name);
  EXPECT_TRUE(machine.has_value());
  return diagnosed_and_simulated(*machine, one.recordings, {false});
}

void scale(recording::Recording& recording, char first_letter, double factor) {
  for (auto& channel : recording.channels) {
    if (channel.name[0] != first_letter) continue;
    for (double& value : channel.values) value *= factor;
  }
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
  const auto answer = diagnosed_and_simulated(*machine, one.recordings, {false});
  ASSERT_FALSE(answer.has_value());
  EXPECT_EQ(answer.error().code, ErrorCode::data_does_not_fit);
}

TEST(BadInput, ARoomSensorThatIsAlwaysZeroIsNotUsed) {
  proof::Case one = proof::make_case(105, "none");
  for (auto& recording : one.recordings) {
    auto* room = recording.find("ambient_C");
    ASSERT_NE(room, nullptr);
    std::fill(room->values.begin(), room->values.end(), 0.0);
  }
  const auto runs = checked(one);
  ASSERT_TRUE(runs.has_value()) << describe(runs.error());
  ASSERT_FALSE(runs->findings.empty());
  EXPECT_EQ(runs->findings[0].finding.channel, "ambient_C");
  EXPECT_EQ(runs->findings[0].finding.action, analysis::FindingAction::dropped);
  EXPECT_EQ(runs->recordings[0].find("ambient_C"), nullptr);
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
  std::erase_if(one.recordings[0].channels, [](const auto& channel) { return channel.name == "dY_um"; });
  const auto runs = checked(one);
  ASSERT_TRUE(runs.has_value()) << describe(runs.error());
  EXPECT_TRUE(notes(runs->notes, "missing_channel:T2_C"));
  EXPECT_TRUE(notes(runs->notes, "missing_channel:dY_um"));
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

// What a machine does while nothing is measured is not known: no effect may be named for it.
TEST(BadInput, AnHourWithoutMeasurementsIsNoEffect) {
  for (const unsigned seed : {105u}) {
    proof::Case one = proof::make_case(seed, "none");
    recording::Recording& whole = one.recordings[0];
    const recording::Channel* speed = whole.find("spindle_rpm");
    ASSERT_NE(speed, nullptr);
    // Around the change of speed that is nearest to a third of the run.
    std::size_t change = 0;
    for (std::size_t k = 1; k < whole.rows(); ++k) {
      const auto away = [&](std::size_t row) {
        return std::abs(static_cast<double>(row) - static_cast<double>(whole.rows()) / 3.0);
      };
      if (std::abs(speed->values[k] - speed->values[k - 1]) > 500.0 && away(k) < away(change)) change = k;
    }
    ASSERT_GT(change, 0u);
    const double from_s = whole.time_s[change] - 900.0;
    const double to_s = whole.time_s[change] + 2700.0;
    recording::Recording left;
    left.name = whole.name;
    for (const auto& channel : whole.channels) left.channels.push_back({channel.name, {}});
    for (std::size_t k = 0; k < whole.rows(); ++k) {
      if (whole.time_s[k] > from_s && whole.time_s[k] < to_s) continue;
      left.time_s.push_back(whole.time_s[k]);
      for (std::size_t c = 0; c < left.channels.size(); ++c) {
        left.channels[c].values.push_back(whole.channels[c].values[k]);
      }
    }
    one.recordings[0] = left;
    const auto answer = answer_for(one);
    ASSERT_TRUE(answer.has_value()) << describe(answer.error());
    EXPECT_TRUE(answer->effects.empty()) << seed << ' ' << answer->effects.front().id;
    EXPECT_TRUE(notes(*answer, "left_out")) << seed;
  }
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

TEST(BadInput, TheSameRunTwiceIsRefused) {
  proof::Case one = proof::make_case(107, "none");
  one.recordings[1] = one.recordings[0];
  one.recordings[1].name = "a copy";
  const auto answer = answer_for(one);
  ASSERT_FALSE(answer.has_value());
  EXPECT_EQ(answer.error().code, ErrorCode::bad_argument);
  EXPECT_NE(describe(answer.error()).find("a copy"), std::string::npos);
}

TEST(BadInput, AColumnThatASecondRecordingLacksIsNamed) {
  proof::Case one = proof::make_case(118, "coolant");
  ASSERT_NE(one.recordings[1].find("coolant_on"), nullptr);
  std::erase_if(one.recordings[1].channels, [](const auto& channel) { return channel.name == "coolant_on"; });
  const auto runs = checked(one);
  ASSERT_TRUE(runs.has_value()) << describe(runs.error());
  EXPECT_EQ(runs->recordings.size(), 1U);
  EXPECT_TRUE(notes(runs->notes, "lacks_column:coolant_on"));
}

// Nothing is converted by its look: the values are taken as they are named, and the doubt is said with its remedy.
TEST(BadInput, ValuesThatMayBeFahrenheitAreNamedAndNotConverted) {
  proof::Case one = proof::make_case(110, "none");
  for (auto& channel : one.recordings[0].channels) {
    if (!channel.name.ends_with("_C")) continue;
    for (double& value : channel.values) value = 1.8 * value + 32.0;
  }
  one.machine.erase("initial_temperature_C");
  one.recordings.resize(1);
  const auto machine = physics::machine_from_json(one.machine, "machine.json");
  ASSERT_TRUE(machine.has_value()) << describe(machine.error());
  const auto runs = checked_runs(*machine, one.recordings);
  ASSERT_TRUE(runs.has_value()) << describe(runs.error());
  ASSERT_FALSE(runs->findings.empty());
  EXPECT_EQ(runs->findings.front().finding.kind, analysis::FindingKind::fahrenheit);
  EXPECT_EQ(runs->findings.front().finding.action, analysis::FindingAction::noted);
  for (const auto& channel : runs->recordings.front().channels) {
    if (channel.kind() != recording::ChannelKind::temperature) continue;
    EXPECT_DOUBLE_EQ(channel.values.front(), one.recordings[0].find(channel.name)->values.front()) << channel.name;
  }
  const std::vector<Sentence> told = explain_findings(runs->findings, runs->notes);
  EXPECT_TRUE(
      std::any_of(told.begin(), told.end(), [](const Sentence& sentence) { return sentence.id == "run_fahrenheit"; }));
}

/// Speed in revolutions a second is heat a tenth to a hundredth of what there is: whatever seems to be missing beside
/// that stands for the unit.
TEST(BadInput, NothingIsNamedBesideAUnitThatIsWrong) {
  proof::Case one = proof::make_case(114, "coolant");
  one.recordings.resize(1);
  for (auto& recording : one.recordings) {
    for (double& rpm : recording.find("spindle_rpm")->values) rpm /= 60.0;
  }
  const auto answer = answer_for(one);
  if (!answer) {
    EXPECT_EQ(answer.error().code, ErrorCode::data_does_not_fit);
    return;
  }
  EXPECT_NE(answer->verdict, Verdict::missing_effect);
  EXPECT_TRUE(answer->effects.empty());
}

TEST(BadInput, MinutesForSecondsAreRefused) {
  for (const char* hidden : {"none", "coolant"}) {
    proof::Case one = proof::make_case(115, hidden);
    for (double& t : one.recordings[0].time_s) t /= 60.0;
    one.recordings.resize(1);
    const auto answer = answer_for(one);
    ASSERT_FALSE(answer.has_value()) << hidden;
    EXPECT_EQ(answer.error().code, ErrorCode::data_does_not_fit) << hidden;
    EXPECT_NE(describe(answer.error()).find("minutes"), std::string::npos) << describe(answer.error());
  }
}

/// A reading that is not renewed is no physics, for good or for an hour.
TEST(BadInput, AFrozenSensorIsLeftOutAndSaid) {
  for (const bool for_good : {true, false}) {
    proof::Case one = proof::make_case(116, "none");
    one.recordings.resize(1);
    auto& values = one.recordings[0].find("T3_C")->values;
    const std::size_t from = values.size() / 3;
    const std::size_t to = for_good ? values.size() : values.size() * 2 / 3;
    std::fill(values.begin() + static_cast<std::ptrdiff_t>(from), values.begin() + static_cast<std::ptrdiff_t>(to),
              values[from]);
    const auto runs = checked(one);
    ASSERT_TRUE(runs.has_value()) << describe(runs.error());
    ASSERT_EQ(runs->findings.size(), 1U) << for_good;
    EXPECT_EQ(runs->findings[0].finding.channel, "T3_C");
    EXPECT_EQ(runs->findings[0].finding.kind, analysis::FindingKind::sensor_died);
  }
}

TEST(BadInput, AMachineThatIsNeverDrivenIsNamed) {
  proof::Case one = proof::make_case(111, "none");
  auto& run = one.recordings[0];
  std::size_t still = 0;  // rows before anything turns
  while (still < run.rows() && run.find("spindle_rpm")->values[still] == 0.0) ++still;
  run = recording::slice(run, 0, std::max<std::size_t>(still, 30));
  for (auto& channel : run.channels) {
    if (channel.name == "ambient_C") {
      for (std::size_t k = 0; k < run.rows(); ++k) channel.values[k] += 0.05 * static_cast<double>(k);
    } else if (!channel.name.ends_with("_C") && !channel.name.ends_with("_um")) {
      channel.values.assign(run.rows(), 0.0);
    }
  }
  one.recordings.resize(1);
  const auto machine = physics::machine_from_json(one.machine, one.name);
  EXPECT_TRUE(notes(limits_of(*machine, one.recordings), "no_excitation"));
}

}  // namespace zerodrift::diagnosis
