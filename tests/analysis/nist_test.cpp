// The linear sets of the NIST Statistical Reference Datasets, scored in correct digits: -log10 of the relative error.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/analysis/linear.h"

namespace zerodrift::analysis {
namespace {

double digits(double value, double certified) {
  if (value == certified) return 15.0;
  const double scale = certified != 0.0 ? std::abs(certified) : 1.0;
  return std::min(15.0, -std::log10(std::abs(value - certified) / scale));
}

struct Score {
  double coefficient = 15.0;
  double standard_error = 15.0;
  double deviation = 15.0;
};

Score score_of(const nlohmann::json& set) {
  const auto n = static_cast<Eigen::Index>(set["y"].size());
  const bool polynomial = !set["degree"].is_null();
  const auto width = static_cast<Eigen::Index>(polynomial ? set["degree"].get<std::size_t>() : set["x"][0].size());
  const Eigen::Index first = set["intercept"].get<bool>() ? 1 : 0;
  Eigen::MatrixXd x = Eigen::MatrixXd::Ones(n, width + first);
  Eigen::VectorXd y(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& row = set["x"][static_cast<std::size_t>(i)];
    y(i) = std::strtod(set["y"][static_cast<std::size_t>(i)].get<std::string>().c_str(), nullptr);
    for (Eigen::Index k = 0; k < width; ++k) {
      const auto at = static_cast<std::size_t>(polynomial ? 0 : k);
      const double value = std::strtod(row[at].get<std::string>().c_str(), nullptr);
      x(i, first + k) = polynomial ? std::pow(value, static_cast<double>(k + 1)) : value;
    }
  }
  const LeastSquares fit = least_squares(x, y, set["intercept"].get<bool>());
  Score score;
  for (Eigen::Index k = 0; k < fit.coefficient.size(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    score.coefficient = std::min(score.coefficient, digits(fit.coefficient(k), set["coefficients"][at].get<double>()));
    score.standard_error =
        std::min(score.standard_error, digits(fit.standard_error(k), set["standard_errors"][at].get<double>()));
  }
  score.deviation = digits(fit.residual_deviation, set["residual_deviation"].get<double>());
  EXPECT_NEAR(fit.r_squared, set["r_squared"].get<double>(), 1e-8);
  return score;
}

}  // namespace

TEST(Nist, LinearReferenceSets) {
  std::ifstream file(ZERODRIFT_SOURCE_DIR "/tests/golden/nist/linear.json");
  const auto sets = nlohmann::json::parse(file);
  ASSERT_EQ(sets.size(), 11U);
  for (const auto& [name, set] : sets.items()) {
    const Score s = score_of(set);
    std::printf("%-9s %-8s coefficients %4.1f digits, standard errors %4.1f, deviation %4.1f\n", name.c_str(),
                set["level"].get<std::string>().c_str(), s.coefficient, s.standard_error, s.deviation);
    if (set["level"] != "higher") {
      EXPECT_GE(s.coefficient, 9.0) << name;
      EXPECT_GE(s.standard_error, 9.0) << name;
      EXPECT_GE(s.deviation, 9.0) << name;
    } else {
      EXPECT_GE(s.coefficient, 6.0) << name;
    }
  }
}

}  // namespace zerodrift::analysis
