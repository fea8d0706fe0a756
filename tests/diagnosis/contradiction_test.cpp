// Held-out recordings judge what one recording alone says.
#include "core/diagnosis/contradiction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/physics/machine.h"
#include "tests/proof/case_generator.h"

namespace zerodrift::diagnosis {
namespace {

/// Nothing is cut in the rows that are kept.
recording::Recording before_the_first_cut(const recording::Recording& whole) {
  const auto& load = whole.find("spindle_load_W")->values;
  const auto first = std::find_if(load.begin(), load.end(), [](double watts) { return watts > 0.0; });
  return recording::slice(whole, 0, static_cast<std::size_t>(first - load.begin()));
}

bool noted(const Diagnosis& d, const std::string& beginning) {
  return std::any_of(d.notes.begin(), d.notes.end(), [&](const auto& note) { return note.rfind(beginning, 0) == 0; });
}

}  // namespace

TEST(Contradiction, TheOtherRecordingIsFittedWhereTheFirstCannotShowTheEffect) {
  const proof::Case one = proof::make_case(42, "cutting_heat");
  const auto machine = physics::machine_from_json(one.machine, one.name);
  const recording::Recording idle = before_the_first_cut(one.recordings[0]);
  ASSERT_GT(idle.rows(), 100u);
  const auto alone = diagnose(*machine, {idle}, {false});
  ASSERT_TRUE(alone.has_value());
  EXPECT_EQ(alone->verdict, Verdict::consistent);
  const auto both = diagnose(*machine, {idle, one.recordings[1]}, {false});
  ASSERT_TRUE(both.has_value());
  ASSERT_FALSE(both->effects.empty());
  EXPECT_EQ(both->effects[0].id, "cutting_heat");
  EXPECT_TRUE(noted(*both, "fitted_instead:"));
  EXPECT_LT(missed_by(*both), 3.0);
}

TEST(Contradiction, AFittedFirstRecordingThatPredictsTheSecondStays) {
  const proof::Case one = proof::make_case(11, "contact_resistance");
  const auto machine = physics::machine_from_json(one.machine, one.name);
  const auto both = diagnose(*machine, one.recordings, {false});
  ASSERT_TRUE(both.has_value());
  EXPECT_FALSE(noted(*both, "fitted_instead:"));
  EXPECT_LT(missed_by(*both), 3.0);
}

/// What settles slowly looks like a structure out of balance, until another run is asked.
TEST(Contradiction, AnExplanationThatMakesTheOtherRecordingWorseIsNone) {
  const proof::Case one = proof::make_case(31, "unlisted:creep");
  const auto machine = physics::machine_from_json(one.machine, one.name);
  const auto both = diagnose(*machine, one.recordings, {false});
  ASSERT_TRUE(both.has_value());
  EXPECT_EQ(both->verdict, Verdict::unexplained);
}

}  // namespace zerodrift::diagnosis
