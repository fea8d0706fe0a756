#include "core/analysis/ageing.h"

#include <gtest/gtest.h>

#include "core/analysis/fit.h"
#include "core/analysis/predict.h"
#include "core/base/noise.h"
#include "tests/analysis/support.h"

namespace zerodrift::analysis {
namespace {

/// The machine after its front bearing has run in: dZ follows T1's body less than before.
recording::Recording aged(test::MachineCase c) {
  auto r = test::machine_run(c);
  auto quiet = c;
  quiet.noise_C = 0.0;
  quiet.resolution_C = 0.0;
  const auto truth = test::machine_run(quiet);
  const auto& t1 = truth.find("T1_C")->values;
  auto& dz = r.find("dZ_um")->values;
  for (std::size_t i = 0; i < dz.size(); ++i) dz[i] -= 0.7 * (t1[i] - t1[0]);
  return r;
}

}  // namespace

TEST(Ageing, AShortRunCorrectsAnOldModel) {
  FitOptions options;
  options.sensors = {"T1_C", "T5_C", "T9_C", "T13_C", "T17_C"};
  options.method = Method::ridge;
  const auto old = fit({test::machine_run({})}, options);
  ASSERT_TRUE(old) << describe(old.error());
  test::MachineCase brief;
  brief.speeds_rpm = {4000.0, 0.0};
  brief.step_s = 2400.0;
  brief.seed = 5;
  const auto corrected = update(*old, aged(brief));
  ASSERT_TRUE(corrected) << describe(corrected.error());
  test::MachineCase later;
  later.speeds_rpm = {2000.0, 5000.0};
  later.step_s = 2.0 * 3600.0;
  later.seed = 9;
  const auto before = predict(*old, aged(later));
  const auto after = predict(*corrected, aged(later));
  ASSERT_TRUE(before && after);
  EXPECT_LT(after->errors[2].residual.peak_um, 0.4 * before->errors[2].residual.peak_um);
  // What has not aged is not spoilt.
  EXPECT_LT(after->errors[1].residual.rms_um, 1.3 * before->errors[1].residual.rms_um + 0.1);
  EXPECT_DOUBLE_EQ(corrected->table[2].terms[0].um_per_K, corrected->errors[2].regression.raw_coefficients()(0));
}

TEST(Ageing, DriftDetectorStaysQuietThenSpeaks) {
  Noise noise(3);
  int false_alarms = 0;
  int found = 0;
  for (int trial = 0; trial < 200; ++trial) {
    DriftDetector quiet;
    for (int i = 0; i < 40; ++i) quiet.add(noise.normal());
    false_alarms += quiet.alarm() ? 1 : 0;
    DriftDetector shifted;
    for (int i = 0; i < 20; ++i) shifted.add(-1.5 + noise.normal());
    found += shifted.alarm() ? 1 : 0;
  }
  EXPECT_LT(false_alarms, 40);
  EXPECT_GT(found, 195);
  DriftDetector detector;
  while (!detector.alarm()) detector.add(2.0);
  detector.reset();
  EXPECT_FALSE(detector.add(0.0));
  EXPECT_FALSE(detector.add(std::nan("")));
}

TEST(Ageing, DriftOfAPredictionIsFoundHourByHour) {
  recording::Recording r;
  Prediction p;
  PredictedError e;
  e.error = "dZ_um";
  for (int minute = 0; minute < 12 * 60; ++minute) {
    r.time_s.push_back(60.0 * minute);
    e.value_um.push_back(1.0);
    e.half_width_um.push_back(1.645);
  }
  p.time_s = r.time_s;
  p.errors.push_back(e);
  auto& measured = r.ensure("dZ_um").values;
  for (std::size_t i = 0; i < measured.size(); ++i) measured[i] = i % 2 == 0 ? 1.4 : 0.6;
  EXPECT_FALSE(check_drift(p, r).front().alarm);
  EXPECT_EQ(check_drift(p, r).front().checks, 12);
  for (std::size_t i = 4 * 60; i < measured.size(); ++i) measured[i] += 2.0;  // two deviations from 4 h on
  const DriftCheck check = check_drift(p, r).front();
  EXPECT_TRUE(check.alarm);
  EXPECT_GT(check.at_s, 6.0 * 3600.0);
  EXPECT_LT(check.at_s, 9.0 * 3600.0);
}

}  // namespace zerodrift::analysis
