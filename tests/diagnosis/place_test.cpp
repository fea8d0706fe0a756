// Where an effect stands: told as a point only where the recordings show one.
#include "core/diagnosis/place.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "core/physics/machine.h"
#include "tests/diagnosis/simulated.h"
#include "tests/proof/case_generator.h"

namespace zerodrift::diagnosis {
namespace {

Diagnosis answer_of(const proof::Case& one) {
  const auto machine = physics::machine_from_json(one.machine, one.name);
  const auto d = diagnosed_and_simulated(*machine, one.recordings, {false});
  EXPECT_TRUE(d);
  return d ? *d : Diagnosis{};
}

}  // namespace

TEST(Place, WhereTheEvidenceIsFlatEveryPlaceIsAsLikely) {
  const Place place = place_from({100.0, 120.0, 200.0}, {-3.0, -3.0, -3.0});
  EXPECT_NEAR(place.mean_mm, 150.0, 0.5);
  EXPECT_NEAR(place.sigma_mm, 100.0 / std::sqrt(12.0), 0.5);
  EXPECT_NEAR(place.from_mm, 102.5, 2.0);
  EXPECT_NEAR(place.to_mm, 197.5, 2.0);
}

TEST(Place, APeakHasItsMiddleAndItsWidth) {
  std::vector<double> at_mm, evidence;
  for (double x = 40.0; x <= 160.0; x += 4.0) {
    at_mm.push_back(x);
    evidence.push_back(1e4 - 0.5 * std::pow((x - 101.0) / 8.0, 2));
  }
  const Place place = place_from(at_mm, evidence);
  EXPECT_NEAR(place.mean_mm, 101.0, 0.2);
  EXPECT_NEAR(place.sigma_mm, 8.0, 0.3);
  EXPECT_NEAR(place.to_mm - place.from_mm, 2.0 * 1.96 * 8.0, 2.0);
}

TEST(Place, TwoPeaksAreOneStretch) {
  const Place place = place_from({0.0, 10.0, 20.0, 90.0, 100.0, 110.0}, {-40.0, 0.0, -40.0, -40.0, 0.0, -40.0});
  EXPECT_NEAR(place.mean_mm, 55.0, 1.0);
  EXPECT_LT(place.from_mm, 12.0);
  EXPECT_GT(place.to_mm, 98.0);
}

/// The first recording runs at one speed all the time, and its fit had stopped on the way along a bent valley.
TEST(Place, IsTheSameWhicheverRecordingComesFirst) {
  proof::Case one = proof::make_case(372290522, "", proof::StrengthRule::shown);
  ASSERT_EQ(one.hidden.front().id, "extra_heat_source");
  for (int order = 0; order < 2; ++order) {
    const Diagnosis d = answer_of(one);
    ASSERT_EQ(d.effects.size(), 1u);
    const FoundEffect& found = d.effects.front();
    EXPECT_EQ(found.id, "extra_heat_source");
    EXPECT_NEAR(*found.position_mm, one.hidden.front().position_mm, 1.5 * found.position_sigma_mm);
    EXPECT_LT(found.position_sigma_mm, 8.0);
    std::swap(one.recordings[0], one.recordings[1]);
  }
}

/// 0.7 W at the rear: from there to 75 mm every place explains the recordings within a log evidence of 2.
TEST(Place, AWeakHeatWhosePlaceHardlyMattersIsToldAsAStretch) {
  const proof::Case one = proof::make_case(909436864);
  ASSERT_EQ(one.hidden.front().id, "extra_heat_source");
  const Diagnosis d = answer_of(one);
  ASSERT_EQ(d.effects.size(), 1u);
  const FoundEffect& found = d.effects.front();
  ASSERT_TRUE(found.between_mm);
  EXPECT_LT(found.between_mm->first, one.hidden.front().position_mm);
  EXPECT_GT(found.between_mm->second, one.hidden.front().position_mm);
  EXPECT_NEAR(*found.position_mm, one.hidden.front().position_mm, 2.5 * found.position_sigma_mm);
  EXPECT_EQ(found.explanation.facts.at("where"), "where_between");
  EXPECT_EQ(d.mismatch.position_mm, found.between_mm);
}

/// The first recording likes the square of the speed a little better; with it the place was 19 mm off.
TEST(Place, TheLawOfASourceIsToldByBothRecordings) {
  const proof::Case one = proof::make_case(620110020, "extra_heat_source");
  ASSERT_EQ(one.hidden.front().law, "n");
  const Diagnosis d = answer_of(one);
  ASSERT_EQ(d.effects.size(), 1u);
  EXPECT_EQ(d.effects.front().words.at("law"), "n");
  EXPECT_FALSE(d.effects.front().between_mm);
  EXPECT_NEAR(*d.effects.front().position_mm, one.hidden.front().position_mm, 6.0);
}

}  // namespace zerodrift::diagnosis
