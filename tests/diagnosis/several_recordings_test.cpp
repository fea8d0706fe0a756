// What several recordings of one machine show together.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/physics/machine.h"
#include "tests/diagnosis/answered.h"

namespace zerodrift::diagnosis {
namespace {

/// Nothing is cut in the rows that are kept.
recording::Recording before_the_first_cut(const recording::Recording& whole) {
  const auto& load = whole.find("spindle_load_W")->values;
  const auto first = std::find_if(load.begin(), load.end(), [](double watts) { return watts > 0.0; });
  return recording::slice(whole, 0, static_cast<std::size_t>(first - load.begin()));
}

}  // namespace

TEST(SeveralRecordings, AnEffectThatOnlyTheSecondCanShowIsNamed) {
  const proof::Case one = proof::make_case(42, "cutting_heat");
  const auto machine = physics::machine_from_json(one.machine, one.name);
  const recording::Recording idle = before_the_first_cut(one.recordings[0]);
  ASSERT_GT(idle.rows(), 100u);
  const auto alone = diagnosed_and_simulated(*machine, {idle}, {false});
  ASSERT_TRUE(alone.has_value());
  EXPECT_EQ(alone->verdict, Verdict::consistent);
  const auto both = diagnosed_and_simulated(*machine, {idle, one.recordings[1]}, {false});
  ASSERT_TRUE(both.has_value());
  ASSERT_FALSE(both->effects.empty());
  EXPECT_EQ(both->effects[0].id, "cutting_heat");
}

/// What settles slowly looks like a structure out of balance, until another run is asked.
TEST(SeveralRecordings, AnExplanationThatMakesTheOtherRecordingWorseIsNone) {
  const proof::Case one = proof::make_case(31, "unlisted:creep");
  const auto machine = physics::machine_from_json(one.machine, one.name);
  const auto both = diagnosed_and_simulated(*machine, one.recordings, {false});
  ASSERT_TRUE(both.has_value());
  EXPECT_EQ(both->verdict, Verdict::unexplained);
}

/// A movement of the nose that only the other recording has: something is missing, whatever it is.
TEST(SeveralRecordings, AMovementThatOnlyTheOtherRecordingHasIsNotConsistent) {
  proof::Case one = proof::make_case(5, "none");
  const auto machine = physics::machine_from_json(one.machine, one.name);
  const auto before = diagnosed_and_simulated(*machine, one.recordings, {false});
  ASSERT_TRUE(before.has_value());
  EXPECT_EQ(before->verdict, Verdict::consistent);
  recording::Recording& other = one.recordings[1];
  for (std::size_t k = 0; k < other.rows(); ++k) {
    other.find("dZ_um")->values[k] += 8.0 * std::sin(2.0 * 3.14159265 * other.time_s[k] / 5000.0);
  }
  const auto both = diagnosed_and_simulated(*machine, one.recordings, {false});
  ASSERT_TRUE(both.has_value());
  EXPECT_EQ(both->verdict, Verdict::unexplained);
  EXPECT_EQ(both->mismatch.channels.front(), "dZ_um");
}

/// What jumps to and fro in the other recording did not slip, even if it only jumped once in the first.
TEST(SeveralRecordings, WhatJumpsToAndFroInTheOtherRecordingDidNotSlip) {
  proof::Case one = proof::make_case(5, "none");
  const auto machine = physics::machine_from_json(one.machine, one.name);
  const auto shift = [](recording::Recording& run, double from_s, double to_s) {
    for (std::size_t k = 0; k < run.rows(); ++k) {
      if (run.time_s[k] >= from_s && run.time_s[k] < to_s) run.find("dZ_um")->values[k] += 6.0;
    }
  };
  shift(one.recordings[0], 6000.0, 1e9);
  const auto slipped = diagnosed_and_simulated(*machine, one.recordings, {false});
  ASSERT_TRUE(slipped.has_value());
  ASSERT_FALSE(slipped->effects.empty());
  EXPECT_EQ(slipped->effects[0].id, "bracket_slip");
  for (const double from_s : {2000.0, 6000.0, 10000.0}) shift(one.recordings[1], from_s, from_s + 2000.0);
  const auto loose = diagnosed_and_simulated(*machine, one.recordings, {false});
  ASSERT_TRUE(loose.has_value());
  EXPECT_EQ(loose->verdict, Verdict::unexplained);
}

}  // namespace zerodrift::diagnosis
