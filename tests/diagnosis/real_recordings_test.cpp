// Recordings of real hardware, read from where the user keeps them (ZERODRIFT_DATA_DIR); skipped where they are absent.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/diagnosis/diagnosis.h"
#include "core/recording/csv.h"
#include "tests/diagnosis/answered.h"

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
  EXPECT_LT(largest(d.held_out[0].explained), 0.6 * largest(d.held_out[0].refitted));
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

TEST(RealRecordings, HeaterBoardLacksEffects) {
  NEEDS("heater-board");
  const Diagnosis d = diagnosed("heater-board", {"board_step_first_400s.csv", "board_step_rest.csv"});
  EXPECT_NE(d.verdict, Verdict::consistent);
}

TEST(RealRecordings, GantryLosesHeatAndFollowsBedAndFrame) {
  NEEDS("gantry-drift");
  const Diagnosis d = diagnosed("gantry-drift", {"gantry_B.csv"});
  EXPECT_EQ(ids_of(d), (std::vector<std::string>{"convection", "structure_driver", "structure_lag"}));
  for (const auto& channel : d.channels) EXPECT_TRUE(channel.temperature || channel.rms_explained < 8.0);
}

}  // namespace zerodrift::diagnosis
