// Recordings of real hardware, read from where the user keeps them (ZERODRIFT_DATA_DIR); skipped where they are absent.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "core/diagnosis/diagnosis.h"
#include "core/recording/csv.h"
#include "tests/diagnosis/simulated.h"

namespace zerodrift::diagnosis {
namespace {

std::filesystem::path data_folder() {
  const char* given = std::getenv("ZERODRIFT_DATA_DIR");
  return given != nullptr ? std::filesystem::path(given)
                          : std::filesystem::path(ZERODRIFT_SOURCE_DIR).parent_path() / "shared" / "data";
}

Diagnosis diagnosed(const std::string& set, const std::vector<std::string>& files) {
  const auto machine = physics::read_machine(data_folder() / set / "machine.json");
  std::vector<recording::Recording> recordings;
  for (const auto& file : files) recordings.push_back(*recording::read_recording(data_folder() / set / file));
  auto result = diagnosed_and_simulated(*machine, recordings, {false});
  EXPECT_TRUE(result.has_value());
  return result ? *result : Diagnosis{};
}

recording::Recording part_of(const recording::Recording& run, double from_s, double to_s) {
  recording::Recording part;
  part.name = run.name;
  for (const auto& channel : run.channels) part.channels.push_back({channel.name, {}});
  for (std::size_t k = 0; k < run.rows(); ++k) {
    if (run.time_s[k] <= from_s || run.time_s[k] > to_s) continue;
    part.time_s.push_back(run.time_s[k]);
    for (std::size_t c = 0; c < part.channels.size(); ++c) part.channels[c].values.push_back(run.channels[c].values[k]);
  }
  return part;
}

bool names(const Diagnosis& d, const std::string& id) {
  return std::any_of(d.effects.begin(), d.effects.end(), [&](const auto& e) { return e.id == id; });
}

double largest(const std::map<std::string, double>& rms) {
  double value = 0.0;
  for (const auto& [channel, r] : rms) value = std::max(value, r);
  return value;
}

#define NEEDS(set) \
  if (!std::filesystem::exists(data_folder() / (set))) GTEST_SKIP() << "no recordings in " << data_folder()

}  // namespace

TEST(RealRecordings, AluminiumRodLosesHeatToTheRoom) {
  NEEDS("aluminium-rod");
  const Diagnosis d = diagnosed("aluminium-rod", {"rod_6_9.csv", "rod_6_7.csv"});
  EXPECT_TRUE(names(d, "convection"));
  EXPECT_LT(largest(d.held_out[0].explained), 2.0);
  EXPECT_GT(largest(d.held_out[0].refitted), 4.0);
}

/// Radiation is a part of the film that no such rise tells apart; and what is proposed is a run that this rod can do.
TEST(RealRecordings, AluminiumRodSaysWhatItCannotTellAndWhichRunWould) {
  NEEDS("aluminium-rod");
  const auto machine = physics::read_machine(data_folder() / "aluminium-rod" / "machine.json");
  const auto run = recording::read_recording(data_folder() / "aluminium-rod" / "rod_6_7.csv");
  const auto d = diagnosed_and_simulated(*machine, {*run});
  ASSERT_TRUE(d.has_value()) << describe(d.error());
  EXPECT_TRUE(std::any_of(d->sentences.begin(), d->sentences.end(), [](const Sentence& said) {
    return said.english.find("cannot tell whether there is radiation") != std::string::npos;
  }));
  ASSERT_TRUE(d->suggested.has_value());
  EXPECT_NE(d->suggested->text.english.find("full power"), std::string::npos) << d->suggested->text.english;
  EXPECT_TRUE(d->suggested->plan_json.empty());
}

TEST(RealRecordings, HeaterBoardHasThreeEffects) {
  NEEDS("heater-board");
  const Diagnosis d = diagnosed("heater-board", {"board_step_first_400s.csv", "board_step_rest.csv"});
  EXPECT_TRUE(names(d, "convection"));
  EXPECT_TRUE(names(d, "neighbour_heat"));
  EXPECT_TRUE(names(d, "sensor_lag"));
  EXPECT_LT(largest(d.held_out[0].explained), 1.0);
  const auto heat = std::find_if(d.effects.begin(), d.effects.end(), [](auto& e) { return e.id == "neighbour_heat"; });
  EXPECT_EQ(heat->component, "heater2");
  EXPECT_EQ(heat->words.at("neighbour"), "heater1");
}

TEST(RealRecordings, GantryLosesHeatAndFollowsBedAndFrame) {
  NEEDS("gantry-drift");
  const auto run = recording::read_recording(data_folder() / "gantry-drift" / "gantry_B.csv");
  const auto machine = physics::read_machine(data_folder() / "gantry-drift" / "machine.json");
  const auto heating = part_of(*run, 0.0, 10000.0), cooling = part_of(*run, 10000.0, 1e9);
  for (const auto& recordings : {std::vector{*run}, std::vector{heating, cooling}}) {
    const auto d = diagnosed_and_simulated(*machine, recordings, {false});
    ASSERT_TRUE(d.has_value()) << describe(d.error());
    EXPECT_EQ(d->verdict, Verdict::missing_effect);
    EXPECT_EQ(d->tried, (std::vector<std::string>{"convection", "structure_driver", "structure_lag"}));
    for (const auto& channel : d->channels) {
      if (!channel.temperature) {
        EXPECT_LT(channel.rms_explained, 8.0);
      }
    }
    for (const auto& other : d->held_out) EXPECT_LT(other.explained.at("dZ_um"), 8.0);
  }
}

TEST(RealRecordings, SpindlePartsHaveWhatAStudyByHandFinds) {
  NEEDS("spindle-drift");
  const Diagnosis d = diagnosed("spindle-drift", {"spindle_drift.csv"});
  std::set<std::string> cooled, heated, late, felt;
  for (const auto& effect : d.effects) {
    if (effect.id == "coolant") cooled.insert(effect.component);
    if (effect.id == "standing_heat") heated.insert(effect.component);
    if (effect.id == "convection") felt.insert(effect.component);
    if (effect.parameters.count("room_lag_s") != 0) late.insert(effect.component);
  }
  EXPECT_EQ(felt.size(), 13U);
  EXPECT_EQ(felt.count("L4") + felt.count("L5"), 0U);
  EXPECT_TRUE(late.count("L7") == 1U && late.count("L11") == 1U);
  EXPECT_EQ(late.count("L1") + late.count("L2") + late.count("L3"), 0U);
  EXPECT_EQ(std::count(d.notes.begin(), d.notes.end(), "unexplained:t5_C"), 1);
  EXPECT_EQ(std::count(d.notes.begin(), d.notes.end(), "heat_falls_with_speed:t5_C"), 1);
  EXPECT_EQ(cooled, (std::set<std::string>{"L1", "L2"}));
  EXPECT_EQ(heated, (std::set<std::string>{"L9"}));
  EXPECT_LT(d.seconds, 60.0);
}

/// What three of its four cycles show is found whether or not the fourth is given beside them.
TEST(RealRecordings, SpindlePartsAreNamedAlikeBesideAnotherRecording) {
  NEEDS("spindle-drift");
  const auto run = recording::read_recording(data_folder() / "spindle-drift" / "spindle_drift.csv");
  const auto machine = physics::read_machine(data_folder() / "spindle-drift" / "machine.json");
  const auto first = part_of(*run, -1.0, 24 * 3600.0), last = part_of(*run, 24 * 3600.0, 1e9);
  const auto d = diagnosed_and_simulated(*machine, {first, last}, {false});
  ASSERT_TRUE(d.has_value()) << describe(d.error());
  std::set<std::string> cooled, felt;
  for (const auto& effect : d->effects) {
    if (effect.id == "coolant") cooled.insert(effect.component);
    if (effect.id == "convection") felt.insert(effect.component);
  }
  EXPECT_GE(felt.size(), 12U);  // of t2 three cycles show the chiller only
  EXPECT_EQ(felt.count("L4") + felt.count("L5"), 0U);
  EXPECT_EQ(cooled, (std::set<std::string>{"L1", "L2"}));
  EXPECT_EQ(std::count(d->notes.begin(), d->notes.end(), "heat_falls_with_speed:t5_C"), 1);
  for (const auto* channel : {"t1_C", "t2_C", "t3_C"}) EXPECT_LT(d->held_out[0].explained.at(channel), 1.0) << channel;
}

}  // namespace zerodrift::diagnosis
