// What moves by itself, and what blows at one end only.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/diagnosis/diagnosis.h"
#include "core/physics/machine.h"
#include "tests/diagnosis/simulated.h"
#include "tests/proof/case_generator.h"

namespace zerodrift::diagnosis {
namespace {

Diagnosis diagnosed(const proof::Case& one) {
  const auto machine = physics::machine_from_json(one.machine, one.name);
  auto d = diagnosed_and_simulated(*machine, one.recordings, {false});
  EXPECT_TRUE(d.has_value());
  return d ? std::move(*d) : Diagnosis{};
}

}  // namespace

/// Creep passes for a structure that was out of balance when the recording began.
TEST(Settling, AStructureHasToShowThatItFollowsTheRoom) {
  const Diagnosis d = diagnosed(proof::make_case(1638217249, "unlisted:creep"));
  EXPECT_EQ(d.verdict, Verdict::unexplained);
  EXPECT_EQ(std::count(d.notes.begin(), d.notes.end(), "settles_by_itself:dZ_um"), 1);
  ASSERT_FALSE(d.mismatch.channels.empty());
  EXPECT_EQ(d.mismatch.channels.front(), "dZ_um");
}

/// An expansion and an offset hide most of it from each effect of the list.
TEST(Settling, ASmallCreepIsNotConsistent) {
  const Diagnosis d = diagnosed(proof::make_case(1638217245, "unlisted:creep"));
  EXPECT_EQ(d.verdict, Verdict::unexplained);
}

/// A room that warms all day passes for what a probe drifts by.
TEST(Settling, AProbeThatDriftsDoesNotFollowTheRoom) {
  for (const unsigned seed : {1638217301U, 1638217302U}) {
    proof::Case one = proof::make_case(seed, "none");
    one.recordings.resize(1);
    auto& run = one.recordings[0];
    auto& moved = run.find("dZ_um")->values;
    for (std::size_t k = 0; k < moved.size(); ++k) moved[k] += 0.9 / 3600.0 * run.time_s[k];
    const Diagnosis d = diagnosed(one);
    EXPECT_NE(d.verdict, Verdict::consistent) << seed;
    for (const FoundEffect& found : d.effects) EXPECT_LE(found.confidence, 0.6) << seed << found.id;
  }
}

/// The film of an open door grows towards the nose from none at the rear.
TEST(Draught, BlowsAtOneEnd) {
  const Diagnosis d = diagnosed(proof::make_case(3897549530, "draught"));
  ASSERT_EQ(d.verdict, Verdict::missing_effect);
  ASSERT_EQ(d.effects.size(), 1u);
  EXPECT_EQ(d.effects[0].id, "draught");
  EXPECT_GT(d.effects[0].parameters.at("film_tilt"), 1.5);
}

}  // namespace zerodrift::diagnosis
