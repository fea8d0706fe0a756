#include "core/analysis/cleaning.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/analysis/checked.h"
#include "core/analysis/fit.h"
#include "core/analysis/prepare.h"
#include "tests/analysis/support.h"

namespace zerodrift::analysis {
namespace {

using test::machine_run;
using test::missing;
using testing::Contains;
using testing::Not;

bool names(const Prepared& data, FindingKind kind, const std::string& channel, FindingAction action) {
  for (const auto& f : data.findings) {
    if (f.kind == kind && f.channel == channel && f.action == action) return true;
  }
  return false;
}

std::vector<double>& values(recording::Recording& r, const char* channel) {
  return r.find(channel)->values;
}

}  // namespace

TEST(Cleaning, CleanRecordingHasNoFindings) {
  const auto data = prepare(machine_run({}));
  ASSERT_TRUE(data) << describe(data.error());
  EXPECT_TRUE(data->findings.empty()) << describe(data->findings.front());
  EXPECT_EQ(data->sensors.size(), 20U);
  EXPECT_EQ(data->errors.size(), 3U);
}

TEST(Cleaning, EveryFaultIsNamedAndTheRestIsFinite) {
  auto r = machine_run({});
  auto& dead = values(r, "T2_C");
  std::fill(dead.begin(), dead.end(), missing);
  auto& constant = values(r, "T3_C");
  std::fill(constant.begin(), constant.end(), 21.0);
  auto& frozen = values(r, "T4_C");
  std::fill(frozen.begin() + 700, frozen.end(), frozen[700]);
  auto& silent = values(r, "T5_C");
  std::fill(silent.begin() + 700, silent.end(), missing);
  values(r, "T7_C") = values(r, "T6_C");
  values(r, "T8_C")[100] += 30.0;
  values(r, "T8_C")[300] = std::numeric_limits<double>::infinity();
  for (std::size_t i = 400; i < 460; ++i) values(r, "T9_C")[i] = missing;
  for (double& v : values(r, "T10_C")) v = v * 1.8 + 32.0;
  for (double& v : values(r, "T11_C")) v += 273.15;
  for (double& v : values(r, "dY_um")) v = 0.0;
  const auto data = prepare(r);
  ASSERT_TRUE(data) << describe(data.error());
  EXPECT_TRUE(names(*data, FindingKind::dead_sensor, "T2_C", FindingAction::dropped));
  EXPECT_TRUE(names(*data, FindingKind::constant_sensor, "T3_C", FindingAction::dropped));
  EXPECT_TRUE(names(*data, FindingKind::sensor_died, "T4_C", FindingAction::dropped));
  EXPECT_TRUE(names(*data, FindingKind::sensor_died, "T5_C", FindingAction::dropped));
  EXPECT_TRUE(names(*data, FindingKind::duplicate_sensor, "T7_C", FindingAction::dropped));
  EXPECT_TRUE(names(*data, FindingKind::spikes, "T8_C", FindingAction::repaired));
  EXPECT_TRUE(names(*data, FindingKind::gaps, "T9_C", FindingAction::repaired));
  EXPECT_TRUE(names(*data, FindingKind::fahrenheit, "T10_C", FindingAction::noted));
  EXPECT_TRUE(names(*data, FindingKind::kelvin, "T11_C", FindingAction::noted));
  EXPECT_TRUE(names(*data, FindingKind::error_never_moves, "dY_um", FindingAction::dropped));
  EXPECT_EQ(data->findings.size(), 10U);
  EXPECT_TRUE(data->temperature_C.allFinite());
  EXPECT_THAT(data->sensors, Not(Contains("T4_C")));
}

TEST(Cleaning, AReadingThatIsNotRenewedForAWhileIsNamed) {
  auto r = machine_run({});
  auto& frozen = values(r, "T4_C");
  std::fill(frozen.begin() + 300, frozen.begin() + 600, frozen[300]);
  const auto data = prepare(r);
  ASSERT_TRUE(data) << describe(data.error());
  EXPECT_TRUE(names(*data, FindingKind::sensor_died, "T4_C", FindingAction::dropped));
  EXPECT_EQ(data->findings.size(), 1U);
}

TEST(Cleaning, ADropoutIsNamedAndLeftOutAndTheRestIsUsed) {
  auto r = machine_run({});
  for (const char* channel : {"T4_C", "dX_um"}) {
    auto& v = values(r, channel);
    std::fill(v.begin() + 500, v.begin() + 560, 0.0);
  }
  const auto data = prepare(r);
  ASSERT_TRUE(data) << describe(data.error());
  EXPECT_TRUE(names(*data, FindingKind::dropout, "T4_C", FindingAction::repaired));
  EXPECT_THAT(data->sensors, Contains("T4_C"));
  EXPECT_TRUE(names(*data, FindingKind::dropout, "dX_um", FindingAction::repaired));
  const Checked sound = checked(r);
  for (const char* channel : {"T4_C", "dX_um"}) {
    const auto& v = sound.recording.find(channel)->values;
    EXPECT_TRUE(std::all_of(v.begin() + 500, v.begin() + 560, [](double one) { return std::isnan(one); })) << channel;
    EXPECT_TRUE(std::any_of(v.begin() + 560, v.end(), [](double one) { return std::isfinite(one); })) << channel;
  }
}

TEST(Cleaning, AStepThatStaysIsNoDropout) {
  auto r = machine_run({});
  for (std::size_t i = 500; i < r.rows(); ++i) values(r, "dX_um")[i] += 60.0;
  for (std::size_t i = 500; i < 560; ++i) values(r, "T4_C")[i] += 15.0;  // it moves on while it is off
  EXPECT_TRUE(checked(r).findings.empty());
}

TEST(Cleaning, ACoarseSensorThatRestsIsSound) {
  auto r = machine_run({});
  auto& coarse = values(r, "T4_C");
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    coarse[i] = i < 400 ? 20.0 : 20.0 + 0.5 * static_cast<double>(i - 400);
  }
  const auto data = prepare(r);
  ASSERT_TRUE(data) << describe(data.error());
  EXPECT_FALSE(names(*data, FindingKind::sensor_died, "T4_C", FindingAction::dropped));
}

TEST(Cleaning, ErrorsInMillimetresAreRefusedAndHoursNamed) {
  auto r = machine_run({});
  for (const char* e : {"dX_um", "dY_um", "dZ_um"}) {
    for (double& v : values(r, e)) v /= 1000.0;
  }
  const auto refused = fit({r}, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::data_does_not_fit);
  EXPECT_NE(refused.error().context.at("expected").find("mm"), std::string::npos);
  EXPECT_TRUE(check_error_unit(machine_run({})));
  auto hasty = machine_run({});
  EXPECT_FALSE(doubtful_times(hasty));
  for (double& t : hasty.time_s) t /= 3600.0;
  EXPECT_TRUE(doubtful_times(hasty));
}

TEST(Cleaning, ARunIsNotTrainedOnTwice) {
  auto copy = machine_run({});
  copy.name = "a copy";
  const auto refused = fit({machine_run({}), copy}, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::bad_argument);
}

TEST(Cleaning, ValuesThatMayBeFahrenheitAreNamedAndNotConverted) {
  auto r = machine_run({});
  for (int s = 1; s <= 20; ++s) {
    for (double& v : values(r, ("T" + std::to_string(s) + "_C").c_str())) v = v * 1.8 + 32.0;
  }
  const double before = values(r, "T1_C")[0];
  const auto data = prepare(r);
  ASSERT_TRUE(data);
  EXPECT_DOUBLE_EQ(data->temperature_C(0, 0), before);
  ASSERT_EQ(data->findings.size(), 20U);
  EXPECT_EQ(data->findings.front().kind, FindingKind::fahrenheit);
  EXPECT_EQ(data->findings.front().action, FindingAction::noted);
}

// A spindle that was shut down hot, without a room column: as measured, with a warning.
TEST(Cleaning, AMachineThatStartsHotStaysAsMeasured) {
  auto r = machine_run({});
  std::erase_if(r.channels, [](const auto& c) { return c.kind() == recording::ChannelKind::ambient; });
  for (auto& channel : r.channels) {
    if (channel.kind() != recording::ChannelKind::temperature) continue;
    for (double& v : channel.values) v += 55.0 - 20.0;
  }
  const Checked sound = checked(r, {});
  for (const auto& channel : r.channels) {
    ASSERT_NE(sound.recording.find(channel.name), nullptr) << channel.name;
    EXPECT_DOUBLE_EQ(sound.recording.find(channel.name)->values.front(), channel.values.front()) << channel.name;
  }
  EXPECT_TRUE(std::any_of(sound.findings.begin(), sound.findings.end(),
                          [](const auto& f) { return f.kind == FindingKind::fahrenheit; }));
}

TEST(Cleaning, FaultySensorAskedForByNameIsRefused) {
  auto r = machine_run({});
  for (double& v : values(r, "T2_C")) v = missing;
  const auto data = prepare(r, {{"T1_C", "T2_C"}, {}, true});
  ASSERT_FALSE(data);
  EXPECT_EQ(data.error().code, ErrorCode::sensor_dead);
  EXPECT_EQ(data.error().context.at("sensor"), "T2_C");
}

TEST(Cleaning, WildErrorMeasurementIsNamedAndLeftOut) {
  auto r = test::machine_run({});
  auto& dz = r.channels.back();
  ASSERT_EQ(dz.name, "dZ_um");
  ASSERT_TRUE(prepare(r)->findings.empty());
  dz.values[600] = 500.0;  // measured every sixth row
  const auto data = prepare(r);
  ASSERT_TRUE(data) << describe(data.error());
  ASSERT_EQ(data->findings.size(), 1U);
  EXPECT_EQ(data->findings[0].kind, FindingKind::spikes);
  EXPECT_EQ(data->findings[0].channel, "dZ_um");
  EXPECT_FALSE(std::isfinite(data->error_um(600, 2)));
}

TEST(Cleaning, RecordingWithoutMovingErrorsIsRefused) {
  auto r = machine_run({});
  for (const char* e : {"dX_um", "dY_um", "dZ_um"}) {
    for (double& v : values(r, e)) v = 0.0;
  }
  const auto data = prepare(r);
  ASSERT_FALSE(data);
  EXPECT_EQ(data.error().code, ErrorCode::no_variation);
}

TEST(Cleaning, SmoothingKeepsAStraightLineAndSuppressesNoise) {
  std::vector<double> t;
  Eigen::MatrixXd v(400, 2);
  Noise noise(3);
  for (int i = 0; i < 400; ++i) {
    t.push_back(10.0 * i);
    v(i, 0) = 20.0 + 0.003 * t.back();
    v(i, 1) = v(i, 0) + 0.1 * noise.normal();
  }
  const Eigen::MatrixXd s = smooth(t, v, 150.0);
  EXPECT_LT((s.col(0) - v.col(0)).cwiseAbs().maxCoeff(), 1e-9);
  const double left = std::sqrt((s.col(1) - v.col(0)).middleRows(20, 360).squaredNorm() / 360.0);
  EXPECT_LT(left, 0.025);  // 0.1 / sqrt(31) = 0.018
}

}  // namespace zerodrift::analysis
