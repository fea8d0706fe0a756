// What decides whether a picture counts: the latency of its camera, standstill in the pictures, what heat can make.

#include "core/acquisition/standstill.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/acquisition/drift_limit.h"
#include "core/acquisition/latency.h"
#include "core/acquisition/stand.h"

namespace zerodrift::acquisition {
namespace {

TEST(LatencyWatch, AnUnknownLatencyIsNeverNothing) {
  EXPECT_GE(Latency().settle().count(), assumed_latency_s);
  EXPECT_EQ(Latency().observations, 0);
}

TEST(LatencyWatch, LearnsFromMovesWhatWasAssumed) {
  LatencyWatch watch;
  for (int i = 0; i < 6; ++i) watch.add({0.3, 0.4});
  EXPECT_NEAR(watch.now().mean_s, 0.35, 1e-9);
  EXPECT_GE(watch.now().settle().count(), 0.4);
  EXPECT_EQ(watch.now().observations, 6);
}

TEST(LatencyWatch, IsWidenedByAPictureThatWasOlder) {
  LatencyWatch watch({0.3, 0.1, 8});
  EXPECT_FALSE(watch.add({0.2, 0.5}));
  EXPECT_NEAR(watch.now().settle().count(), 0.4, 1e-9);
  EXPECT_TRUE(watch.add({1.2, 1.3}));
  EXPECT_GE(watch.now().settle().count(), 1.2);
  EXPECT_FALSE(watch.add({0.2, 0.5})) << "and never narrowed by one that was younger";
  EXPECT_GE(watch.now().settle().count(), 1.2);
}

std::vector<Sighting> sightings(double um_per_s, double step_um = 0.0) {
  std::vector<Sighting> all;
  for (int i = 0; i < 5; ++i) {
    const double t = 0.2 * i;
    all.push_back({Seconds(t), {um_per_s * t + (i > 2 ? step_um : 0.0), 0.01 * (i % 2)}, {0.05, 0.05}});
  }
  return all;
}

TEST(Standstill, PicturesThatAgreeStandStill) {
  EXPECT_TRUE(standstill(sightings(0.0), {}).stands);
  EXPECT_EQ(standstill(sightings(0.0), {}).trend_um[0], 0.0);
}

TEST(Standstill, ATrendBeyondHeatMoves) {
  const auto verdict = standstill(sightings(2.0), {});
  EXPECT_FALSE(verdict.stands);
  EXPECT_FALSE(verdict.reason.empty());
  StandstillRule fast;
  fast.drift_um_per_s = 5.0;  // a machine whose time runs fast warms fast
  EXPECT_TRUE(standstill(sightings(2.0), fast).stands);
}

TEST(Standstill, AStepMoves) {
  EXPECT_FALSE(standstill(sightings(0.0, 4.0), {}).stands);
}

TEST(Standstill, WhatRemainsOfATrendIsStated) {
  const auto verdict = standstill(sightings(0.48), {});
  EXPECT_TRUE(verdict.stands);
  EXPECT_GT(verdict.trend_um[0], 0.01);
}

const std::array<double, 3> sigma{0.1, 0.1, 0.1};

TEST(DriftLimit, TakesWhatHeatCanMake) {
  DriftLimit limit({20.0, 3.0});
  limit.know(0.0, {0.0, 0.0, 0.0}, {});
  EXPECT_FALSE(limit.judge(60.0, {10.0, -5.0, 20.0}, sigma));
  EXPECT_FALSE(limit.judge(120.0, {10.0, -5.0, 40.0}, sigma));
}

TEST(DriftLimit, RefusesALeapAndForgetsItWhenItIsGone) {
  DriftLimit limit({20.0, 3.0});
  limit.know(0.0, {0.0, 0.0, 0.0}, {});
  const auto leap = limit.judge(60.0, {0.0, 0.0, -70.0}, sigma);
  ASSERT_TRUE(leap);
  EXPECT_EQ(leap->axis, "Z");
  EXPECT_EQ(leap->change_um, -70.0);
  EXPECT_FALSE(leap->confirmed);
  EXPECT_FALSE(limit.judge(120.0, {0.0, 0.0, 1.0}, sigma));
  EXPECT_TRUE(limit.judge(180.0, {0.0, 0.0, -70.0}, sigma)) << "counted anew";
}

// However long it is open: time alone does not make it heat.
TEST(DriftLimit, TakesALeapThatStaysByNameOnly) {
  DriftLimit limit({20.0, 3.0});
  limit.know(0.0, {0.0, 0.0, 0.0}, {});
  ASSERT_FALSE(limit.judge(60.0, {30.0, 0.0, 0.0}, sigma)->confirmed);
  ASSERT_TRUE(limit.judge(120.0, {31.0, 0.0, 0.0}, sigma)) << "within what heat can make in two minutes";
  const auto third = limit.judge(180.0, {32.0, 0.0, 0.0}, sigma);
  ASSERT_TRUE(third);
  EXPECT_TRUE(third->confirmed);
  EXPECT_EQ(third->change_um, 30.0);
  EXPECT_FALSE(limit.judge(240.0, {33.0, 0.0, 0.0}, sigma));
}

TEST(DriftLimit, LeapsThatDoNotAgreeAreNeverTaken) {
  DriftLimit limit({20.0, 3.0});
  limit.know(0.0, {0.0, 0.0, 0.0}, {});
  for (int i = 1; i < 20; ++i) {
    const auto leap = limit.judge(10.0 * i, {i % 2 == 0 ? 300.0 : -300.0, 0.0, 0.0}, sigma);
    ASSERT_TRUE(leap) << i;
    EXPECT_FALSE(leap->confirmed) << i;
  }
}

TEST(Stand, ReadsWhereTheMachineIs) {
  const std::map<std::string, double> position{{"X", 1.0}, {"Z", 2.0}};
  MachineSample sample;
  sample.axes = {{"X", 1.0}, {"Y", 55.0}, {"Z", 2.0}};
  EXPECT_TRUE(stands_at(sample, position));
  sample.axes["Z"] = 2.1;
  EXPECT_FALSE(stands_at(sample, position));
  sample.applied_um[2] = 120.0;  // its own compensation moved it there
  EXPECT_TRUE(stands_at(sample, position));
  sample.cycling = true;
  EXPECT_FALSE(stands_at(sample, position));
}

}  // namespace
}  // namespace zerodrift::acquisition
