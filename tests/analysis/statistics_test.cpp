#include "core/analysis/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/noise.h"

namespace zerodrift::analysis {
namespace {
constexpr double missing = std::numeric_limits<double>::quiet_NaN();
}

TEST(Statistics, PearsonByHand) {
  const Eigen::Vector4d a(1, 2, 3, 4);
  const Eigen::Vector4d b(2, 4, 5, 4);
  EXPECT_NEAR(pearson(a, b), 3.5 / std::sqrt(5.0 * 4.75), 1e-15);
  EXPECT_NEAR(pearson(a, -a), -1.0, 1e-15);
}

TEST(Statistics, PearsonLeavesMissingPairsOutAndIsNeverNan) {
  Eigen::VectorXd a(5);
  Eigen::VectorXd b(5);
  a << 1, 2, missing, 3, 4;
  b << 2, 4, 9, 5, 4;
  EXPECT_NEAR(pearson(a, b), 3.5 / std::sqrt(5.0 * 4.75), 1e-15);
  EXPECT_EQ(pearson(Eigen::VectorXd::Constant(5, 1.0), b), 0.0);
}

TEST(Statistics, LagOfADelayedSeries) {
  std::vector<double> t;
  Eigen::VectorXd sensor(300);
  Eigen::VectorXd error(300);
  for (int i = 0; i < 300; ++i) {
    t.push_back(60.0 * i);
    sensor(i) = std::sin(2e-3 * (t.back() - 600.0));
    error(i) = i % 3 == 0 ? std::sin(2e-3 * t.back()) : missing;
  }
  EXPECT_NEAR(lag_s(t, sensor, error, 60.0, 3000.0), 600.0, 60.0);
  EXPECT_NEAR(lag_s(t, -error, sensor, 60.0, 1200.0), -600.0, 60.0);
}

TEST(Statistics, VarianceInflationOfTwoColumnsIsFromTheirCorrelation) {
  Noise noise(2);
  Eigen::MatrixXd x(200, 2);
  for (int i = 0; i < 200; ++i) {
    x(i, 0) = noise.normal();
    x(i, 1) = x(i, 0) + 0.5 * noise.normal();
  }
  const double r = pearson(x.col(0), x.col(1));
  EXPECT_NEAR(variance_inflation(x)(0), 1.0 / (1.0 - r * r), 1e-9);
  EXPECT_NEAR(condition_number(x), std::sqrt((1.0 + r) / (1.0 - r)), 1e-9);
}

TEST(Statistics, ExactCollinearityStaysFinite) {
  Eigen::MatrixXd x(10, 2);
  for (int i = 0; i < 10; ++i) x.row(i) << i, 2.0 * i;
  EXPECT_TRUE(variance_inflation(x).allFinite());
  EXPECT_GT(variance_inflation(x)(0), 1e9);
  EXPECT_TRUE(std::isfinite(condition_number(x)));
}

TEST(Statistics, PrincipalComponentsKeepDistances) {
  Noise noise(4);
  Eigen::MatrixXd x(6, 40);
  for (double& v : x.reshaped()) v = noise.normal();
  const auto pc = principal_components(x);
  EXPECT_NEAR((pc.scores.row(1) - pc.scores.row(4)).norm(), (x.row(1) - x.row(4)).norm(), 1e-9);
  EXPECT_NEAR(pc.explained.sum(), 1.0, 1e-12);
  EXPECT_GE(pc.explained(0), pc.explained(1));
}

TEST(Statistics, ResidualFigures) {
  const Eigen::Vector4d e(0, 10, missing, -20);
  const Eigen::Vector4d p(1, 9, 3, -18);
  const auto f = residual_figures(e, p);
  EXPECT_EQ(f.count, 3);
  EXPECT_DOUBLE_EQ(f.peak_um, 2.0);
  EXPECT_DOUBLE_EQ(f.p90_um, 2.0);
  EXPECT_DOUBLE_EQ(f.removed_percent, 90.0);
  EXPECT_NEAR(f.rms_um, std::sqrt(2.0), 1e-15);
  Eigen::VectorXd ten(10);
  for (int i = 0; i < 10; ++i) ten(i) = i % 2 == 0 ? i : -i;
  EXPECT_DOUBLE_EQ(residual_figures(ten, Eigen::VectorXd::Zero(10)).p90_um, 8.0);
}

}  // namespace zerodrift::analysis
