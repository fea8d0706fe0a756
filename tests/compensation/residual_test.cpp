#include "core/compensation/residual.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/noise.h"

namespace zerodrift::compensation {
namespace {

Table model() {
  Table table;
  table.version = 4;
  table.axes["Z"].terms = {{"T1_C", 2.0, 20.0, 0.0}, {"T2_C", 1.0, 20.0, 0.0}};
  return table;
}

/// A machine that does `factor` times what the model says, plus a constant.
std::vector<ResidualSample> measured(double factor, double constant_um, double from_K, double to_K, int count = 20) {
  Noise noise(7);
  std::vector<ResidualSample> samples;
  for (int i = 0; i < count; ++i) {
    const double rise = from_K + (to_K - from_K) * i / (count - 1);
    ResidualSample one;
    one.temperatures = {{"T1_C", 20.0 + rise}, {"T2_C", 20.0 + 0.5 * rise}};
    one.residual_um = (factor - 1.0) * 2.5 * rise + constant_um + 0.2 * noise.normal();
    samples.push_back(one);
  }
  return samples;
}

}  // namespace

TEST(Residual, KappaIsFoundWhenTheStateVaries) {
  const auto out = correct_residual(model(), {{"Z", measured(1.3, 4.0, 0.0, 12.0)}});
  ASSERT_TRUE(out) << describe(out.error());
  const AxisCorrection& row = out->axes.front();
  EXPECT_EQ(row.kind, CorrectionKind::both);
  EXPECT_GT(row.kappa, 1.2);  // pulled a little towards the model
  EXPECT_LT(row.kappa, 1.35);
  EXPECT_GT(row.offset_um, 2.5);
  EXPECT_LT(row.offset_um, 5.0);
  EXPECT_LT(row.rms_after_um, 0.15 * row.rms_before_um);
  EXPECT_EQ(out->table.version, 5);
  EXPECT_NEAR(out->table.axes.at("Z").terms[0].um_per_K, 2.0 * row.kappa, 1e-9);
}

/// Of a model that is right on the whole, one verification shows a slow wave of model error: it is not a slope.
TEST(Residual, ASlowWaveOfModelErrorIsNotTakenForASlope) {
  auto samples = measured(1.0, 0.0, 0.0, 12.0);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i].residual_um += 2.5 * std::sin(4.0 * static_cast<double>(i) / 19.0);
  }
  ResidualOptions options;
  options.threshold_um = 1.0;
  const auto out = correct_residual(model(), {{"Z", samples}}, options);
  ASSERT_TRUE(out);
  EXPECT_NEAR(out->axes.front().kappa, 1.0, 0.05);
}

/// A day's zero is no fault of the model: the next day would suffer for it.
TEST(Residual, AnOffsetLeavesTheTemperatureTermsAlone) {
  const auto out = correct_residual(model(), {{"Z", measured(1.0, 4.0, 0.0, 12.0)}});
  ASSERT_TRUE(out);
  const AxisCorrection& row = out->axes.front();
  EXPECT_EQ(row.kind, CorrectionKind::offset);
  EXPECT_DOUBLE_EQ(row.kappa, 1.0);
  EXPECT_DOUBLE_EQ(out->table.axes.at("Z").terms[0].um_per_K, 2.0);
  EXPECT_NEAR(out->table.axes.at("Z").offset_um, 4.0, 1.0);
  EXPECT_NE(row.reason.find("they stay"), std::string::npos) << row.reason;
}

TEST(Residual, OneStateGivesThePublishedCoefficient) {
  // C = 25 um of prediction, residual 5 um: kappa = 1 + 5 / 25.
  const auto out = correct_residual(model(), {{"Z", measured(1.2, 0.0, 10.0, 10.0)}});
  ASSERT_TRUE(out);
  EXPECT_EQ(out->axes.front().kind, CorrectionKind::kappa);
  EXPECT_NEAR(out->axes.front().kappa, 1.2, 0.01);
}

TEST(Residual, NearZeroPredictionMovesTheOffset) {
  const auto out = correct_residual(model(), {{"Z", measured(1.0, 6.0, 0.0, 0.2)}});
  ASSERT_TRUE(out);
  EXPECT_EQ(out->axes.front().kind, CorrectionKind::offset);
  EXPECT_NEAR(out->axes.front().offset_um, 6.0, 0.3);
}

TEST(Residual, KappaIsBounded) {
  const auto out = correct_residual(model(), {{"Z", measured(5.0, 0.0, 0.0, 10.0)}});
  ASSERT_TRUE(out);
  EXPECT_DOUBLE_EQ(out->axes.front().kappa, 2.0);
}

TEST(Residual, NothingToCorrectChangesNothing) {
  const auto small = correct_residual(model(), {{"Z", measured(1.02, 0.0, 0.0, 10.0)}});
  ASSERT_TRUE(small);
  EXPECT_EQ(small->axes.front().kind, CorrectionKind::none);
  EXPECT_EQ(small->table.version, 4);
  auto one_bad = measured(1.0, 0.0, 0.0, 10.0);
  one_bad[4].residual_um = 60.0;
  one_bad[5].residual_um = std::numeric_limits<double>::quiet_NaN();
  const auto bad = correct_residual(model(), {{"Z", one_bad}});
  ASSERT_TRUE(bad);
  EXPECT_EQ(bad->axes.front().kind, CorrectionKind::none) << bad->axes.front().reason;
  const auto few = correct_residual(model(), {{"Z", measured(1.5, 0.0, 9.0, 10.0, 2)}});
  EXPECT_EQ(few->axes.front().kind, CorrectionKind::none);
}

TEST(Residual, BayesianUpdateLowersTheResidualToo) {
  const auto out = update_coefficients(model(), {{"Z", measured(1.3, 2.0, 0.0, 12.0)}});
  ASSERT_TRUE(out) << describe(out.error());
  EXPECT_LT(out->axes.front().rms_after_um, 0.5);
  const auto& terms = out->table.axes.at("Z").terms;
  EXPECT_NEAR(terms[0].um_per_K + 0.5 * terms[1].um_per_K, 1.3 * 2.5, 0.1);
}

}  // namespace zerodrift::compensation
