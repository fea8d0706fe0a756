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
  ASSERT_FALSE(d.mismatch.channels.empty());
  EXPECT_EQ(d.mismatch.channels.front(), "dZ_um");
}

}  // namespace zerodrift::diagnosis
