// Where an effect stands: told as a point only where the recordings show one.
#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "core/physics/machine.h"
#include "tests/diagnosis/answered.h"

namespace zerodrift::diagnosis {
namespace {

Diagnosis answer_of(const proof::Case& one) {
  const auto machine = physics::machine_from_json(one.machine, one.name);
  const auto d = diagnosed_and_simulated(*machine, one.recordings, {false});
  EXPECT_TRUE(d);
  return d ? *d : Diagnosis{};
}

}  // namespace

/// The first recording runs at one speed all the time, and its fit had stopped on the way along a bent valley.
TEST(Place, IsTheSameWhicheverRecordingComesFirst) {
  proof::Case one = proof::make_case(372290522, "", proof::StrengthRule::shown);
  ASSERT_EQ(one.hidden.front().id, "extra_heat_source");
  for (int order = 0; order < 2; ++order) {
    const Diagnosis d = answer_of(one);
    ASSERT_EQ(ids_of(d), std::vector<std::string>{"extra_heat_source"});
    const FoundEffect& found = d.effects.front();
    EXPECT_EQ(found.id, "extra_heat_source");
    EXPECT_NEAR(*found.position_mm, one.hidden.front().position_mm, 1.5 * found.position_sigma_mm);
    EXPECT_LT(found.position_sigma_mm, 8.0);
    std::swap(one.recordings[0], one.recordings[1]);
  }
}

/// The first recording likes the square of the speed a little better; with it the place was 19 mm off.
TEST(Place, TheLawOfASourceIsToldByBothRecordings) {
  const proof::Case one = proof::make_case(620110020, "extra_heat_source");
  ASSERT_EQ(one.hidden.front().law, "n");
  const Diagnosis d = answer_of(one);
  ASSERT_EQ(ids_of(d), std::vector<std::string>{"extra_heat_source"});
  EXPECT_EQ(d.effects.front().words.at("law"), "n");
  EXPECT_FALSE(d.effects.front().between_mm);
  EXPECT_NEAR(*d.effects.front().position_mm, one.hidden.front().position_mm, 6.0);
}

}  // namespace zerodrift::diagnosis
