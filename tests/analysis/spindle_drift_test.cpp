// A real spindle: sixteen temperatures, five displacement channels, four cycles at rising speed.

#include <gtest/gtest.h>

#include <cstdio>

#include "core/analysis/fit.h"
#include "core/analysis/predict.h"
#include "core/recording/csv.h"
#include "tests/analysis/real_data.h"

namespace zerodrift::analysis {
namespace {

constexpr double split_s = 24.1 * 3600.0;

/// Means over the channels.
struct Figures {
  double rms_um = 0.0;
  double peak_um = 0.0;
  double worst_coverage = 1.0;
  double half_width_um = 0.0;
};

Figures figures_of(const Prediction& prediction) {
  Figures f;
  const auto n = static_cast<double>(prediction.errors.size());
  for (const auto& e : prediction.errors) {
    f.rms_um += e.residual.rms_um / n;
    f.peak_um += e.residual.peak_um / n;
    f.worst_coverage = std::min(f.worst_coverage, e.coverage);
    double mean = 0.0;
    for (const double w : e.half_width_um) mean += w / static_cast<double>(e.half_width_um.size());
    f.half_width_um += mean / n;
    std::printf("  %s rms %.2f peak %.2f coverage %.0f %% half-width %.1f\n", e.error.c_str(), e.residual.rms_um,
                e.residual.peak_um, 100.0 * e.coverage, mean);
  }
  std::printf("  mean rms %.2f, peak %.2f\n", f.rms_um, f.peak_um);
  return f;
}

}  // namespace

TEST(SpindleDrift, FirstThreeCyclesPredictTheFastest) {
  const auto path = test::spindle_drift();
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "recording not here: " << path;
  const auto whole = recording::read_recording(path);
  ASSERT_TRUE(whole) << describe(whole.error());
  const auto model = fit({recording::slice_time(*whole, 0.0, split_s)});
  ASSERT_TRUE(model) << describe(model.error());
  std::printf("%s\n", model->reason.c_str());
  for (const auto& c : model->candidates)
    std::printf("  %s %.2f %.2f\n", c.label.c_str(), c.held_out_rms_um, c.held_out_peak_um);
  const auto prediction = predict(*model, recording::slice_time(*whole, split_s, 1e9));
  ASSERT_TRUE(prediction) << describe(prediction.error());
  EXPECT_TRUE(prediction->continued);
  EXPECT_GT(prediction->extrapolation_share, 0.4);  // 5000 rpm was never trained
  const Figures f = figures_of(*prediction);
  EXPECT_LT(f.rms_um, 4.3);
  EXPECT_LT(f.peak_um, 7.5);
  EXPECT_GT(f.worst_coverage, 0.85);
}

TEST(SpindleDrift, FourSensorsAndTheSpeedAreEnough) {
  const auto path = test::spindle_drift();
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "recording not here: " << path;
  const auto whole = recording::read_recording(path);
  ASSERT_TRUE(whole) << describe(whole.error());
  FitOptions options;
  options.max_sensors = 4;
  const auto model = fit({recording::slice_time(*whole, 0.0, split_s)}, options);
  ASSERT_TRUE(model) << describe(model.error());
  std::printf("%s\n", model->reason.c_str());
  EXPECT_EQ(model->method, Method::dynamic);
  EXPECT_EQ(model->sensors.size(), 4U);
  const auto prediction = predict(*model, recording::slice_time(*whole, split_s, 1e9));
  ASSERT_TRUE(prediction);
  EXPECT_LT(figures_of(*prediction).rms_um, 4.3);
}

}  // namespace zerodrift::analysis
