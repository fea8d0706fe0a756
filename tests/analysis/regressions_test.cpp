#include "core/analysis/regressions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/analysis/fit.h"
#include "core/analysis/predict.h"
#include "tests/analysis/support.h"

namespace zerodrift::analysis {
namespace {

/// Six features of which the last two repeat the first two; y = 3 a - 2 b + 1 and a little noise.
Rows twins(double noise_um, std::uint64_t seed = 3) {
  Noise noise(seed);
  Rows rows;
  rows.x.resize(240, 6);
  rows.y.resize(240);
  for (int i = 0; i < 240; ++i) {
    for (int c = 0; c < 4; ++c) rows.x(i, c) = std::sin(0.05 * (c + 1) * i + c) + 0.2 * noise.normal();
    rows.x(i, 4) = rows.x(i, 0) + 0.01 * noise.normal();
    rows.x(i, 5) = rows.x(i, 1) + 0.01 * noise.normal();
    rows.y(i) = 3.0 * rows.x(i, 0) - 2.0 * rows.x(i, 1) + 1.0 + noise_um * noise.normal();
    rows.time_s.push_back(60.0 * i);
    rows.run.push_back(0);
  }
  return rows;
}

double rms(const Eigen::VectorXd& v) {
  return std::sqrt(v.squaredNorm() / static_cast<double>(v.size()));
}

FitOptions with(Method method) {
  FitOptions options;
  options.method = method;
  return options;
}

test::MachineCase stepped_case(std::uint64_t seed) {
  test::MachineCase c;
  c.speeds_rpm = {3000.0, 0.0, 1500.0, 4000.0};
  c.step_s = 3600.0;
  c.seed = seed;
  return c;
}

}  // namespace

TEST(Regressions, EachFindsTheLineBehindTwins) {
  const Rows rows = twins(0.1);
  for (const RidgeFit& fit :
       {fit_multiple(rows.x, rows.y), fit_components(rows.x, rows.y), fit_lasso(rows.x, rows.y), fit_robust(rows)}) {
    EXPECT_LT(rms(fit.predict(rows.x) - rows.y), 0.13);
    EXPECT_NEAR(fit.sigma_um, 0.1, 0.03);
    EXPECT_NEAR(fit.raw_coefficients()(0) + fit.raw_coefficients()(4), 3.0, 0.1);
    EXPECT_NEAR(fit.raw_coefficients()(1) + fit.raw_coefficients()(5), -2.0, 0.1);
  }
}

TEST(Regressions, LassoLeavesOutWhatSaysNothing) {
  const RidgeFit fit = fit_lasso(twins(0.1).x, twins(0.1).y);
  EXPECT_LT(std::abs(fit.beta(2)), 0.02 * std::abs(fit.beta(0) + fit.beta(4)));
  EXPECT_LT(std::abs(fit.beta(3)), 0.02 * std::abs(fit.beta(0) + fit.beta(4)));
}

TEST(Regressions, RobustIsNotPulledByWildMeasurements) {
  Rows rows = twins(0.1);
  for (int i = 5; i < 240; i += 12) rows.y(i) += 25.0;
  const RidgeFit plain = fit_multiple(rows.x, rows.y);
  const RidgeFit robust = fit_robust(rows);
  const Rows clean = twins(0.0);
  EXPECT_LT(rms(robust.predict(clean.x) - clean.y), 0.2);
  EXPECT_GT(rms(plain.predict(clean.x) - clean.y), 1.0);
}

TEST(Regressions, PolesAreFoundAndStable) {
  Rows rows = twins(0.05);
  const auto fits = fit_poles(rows, rows.y, {{2, 3}, {0, 1}, {4, 5}}, 14400.0);
  ASSERT_EQ(fits.size(), 1U);
  EXPECT_EQ(fits[0].beta(2), 0.0);
  EXPECT_EQ(fits[0].beta(4), 0.0);
  EXPECT_NEAR(fits[0].raw_coefficients()(0), 3.0, 0.05);
}

TEST(Regressions, EveryMethodFitsPredictsAndSurvivesItsFile) {
  const auto train = test::machine_run(stepped_case(1));
  auto other = stepped_case(2);
  other.speeds_rpm = {2500.0, 3500.0, 0.0, 1000.0};
  const auto unseen = test::machine_run(other);
  for (const Method m : {Method::pcr, Method::lasso, Method::robust, Method::arx, Method::greybox}) {
    const auto model = fit({train}, with(m));
    ASSERT_TRUE(model) << name_of(m) << ": " << describe(model.error());
    EXPECT_EQ(model->method, m);
    EXPECT_EQ(model->is_static(), is_static(m));
    const auto again = model_from_json(to_json(*model), "model.json");
    ASSERT_TRUE(again) << name_of(m) << ": " << describe(again.error());
    const auto p = predict(*again, unseen);
    ASSERT_TRUE(p) << name_of(m) << ": " << describe(p.error());
    for (const auto& e : p->errors) EXPECT_GT(e.residual.removed_percent, 70.0) << name_of(m) << " " << e.error;
  }
}

TEST(Regressions, PhysicsSaysWhatItNeeds) {
  const auto model = fit({test::machine_run({})}, with(Method::physics));
  ASSERT_FALSE(model);
  EXPECT_NE(describe(model.error()).find("--machine"), std::string::npos);
}

}  // namespace zerodrift::analysis
