#include "core/physics/placement.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/physics/machines.h"

namespace zerodrift::physics {

TEST(Placement, ConstantFluxIsFollowedBestAtLengthOverRootThree) {
  // Insulated fixed end, constant flux at the free end: once the profile stands, the point x = L / sqrt(3) follows the
  // mean.
  Machine machine = test::spindle();
  machine.effects.clear();
  HeatSource heater;
  heater.id = "end";
  heater.kind = SourceKind::input;
  heater.channel = "flux";
  heater.from_mm = 390;
  heater.to_mm = 400;
  heater.watts_per_unit = 50;
  machine.components[0].sources = {heater};
  recording::Recording run = test::stepped_run(4.0);
  run.channels = {{"flux", std::vector<double>(run.rows(), 1.0)}};
  const auto placement = place_sensor(machine, run);
  ASSERT_TRUE(placement.has_value());
  EXPECT_NEAR(placement->to_mm - placement->from_mm, 12.5, 1e-9);
  EXPECT_EQ(placement->steps.size(), 5u);
  EXPECT_NEAR(0.5 * (placement->from_mm + placement->to_mm), 400 / std::sqrt(3.0), 20.0);
  for (const auto& place : placement->along) EXPECT_GT(place.correlation, 0.99);  // why correlation alone cannot choose
}

TEST(Placement, SaysWhenNothingMoves) {
  recording::Recording run = test::stepped_run(1.0);
  run.channels[0].values.assign(run.rows(), 0.0);
  run.channels[3].values.assign(run.rows(), 20.0);
  EXPECT_EQ(place_sensor(test::spindle(), run).error().code, ErrorCode::no_variation);
}

}  // namespace zerodrift::physics
