// The non-linear sets of the NIST Statistical Reference Datasets, each from both of its starting points. Scored in
// correct digits; the certified values have eleven.

#include <gtest/gtest.h>

#include <complex>
#include <cstdio>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/analysis/nonlinear.h"

namespace zerodrift::analysis {
namespace {

using Complex = std::complex<double>;
using Parameters = std::vector<Complex>;
using Predictors = std::vector<double>;
/// Parameters are complex so that derivatives are exact (Squire and Trapp 1998: the imaginary part of f(b + ih) / h).
using ModelFunction = std::function<Complex(const Parameters& b, const Predictors& x)>;

constexpr double pi = std::numbers::pi;

Complex gauss_peaks(const Parameters& b, const Predictors& x) {
  const Complex first = (x[0] - b[3]) / b[4];
  const Complex second = (x[0] - b[6]) / b[7];
  return b[0] * exp(-b[1] * x[0]) + b[2] * exp(-first * first) + b[5] * exp(-second * second);
}

Complex three_decays(const Parameters& b, const Predictors& x) {
  return b[0] * exp(-b[1] * x[0]) + b[2] * exp(-b[3] * x[0]) + b[4] * exp(-b[5] * x[0]);
}

Complex chwirut(const Parameters& b, const Predictors& x) {
  return exp(-b[0] * x[0]) / (b[1] + b[2] * x[0]);
}

Complex saturation(const Parameters& b, const Predictors& x) {
  return b[0] * (1.0 - exp(-b[1] * x[0]));
}

Complex cubic_ratio(const Parameters& b, const Predictors& x) {
  const double t = x[0];
  return (b[0] + b[1] * t + b[2] * t * t + b[3] * t * t * t) / (1.0 + b[4] * t + b[5] * t * t + b[6] * t * t * t);
}

Complex enso(const Parameters& b, const Predictors& x) {
  const auto wave = [&](const Complex& period, const Complex& c, const Complex& s) {
    const Complex phase = 2.0 * pi * x[0] / period;
    return c * cos(phase) + s * sin(phase);
  };
  return b[0] + wave(12.0, b[1], b[2]) + wave(b[3], b[4], b[5]) + wave(b[6], b[7], b[8]);
}

const std::map<std::string, ModelFunction>& models() {
  static const std::map<std::string, ModelFunction> all{
      {"Misra1a", saturation},
      {"BoxBOD", saturation},
      {"Misra1b",
       [](const auto& b, const auto& x) {
         const Complex half = 1.0 + b[1] * x[0] / 2.0;
         return b[0] * (1.0 - 1.0 / (half * half));
       }},
      {"Misra1c", [](const auto& b, const auto& x) { return b[0] * (1.0 - 1.0 / sqrt(1.0 + 2.0 * b[1] * x[0])); }},
      {"Misra1d", [](const auto& b, const auto& x) { return b[0] * b[1] * x[0] / (1.0 + b[1] * x[0]); }},
      {"Chwirut1", chwirut},
      {"Chwirut2", chwirut},
      {"Lanczos1", three_decays},
      {"Lanczos2", three_decays},
      {"Lanczos3", three_decays},
      {"Gauss1", gauss_peaks},
      {"Gauss2", gauss_peaks},
      {"Gauss3", gauss_peaks},
      {"DanWood", [](const auto& b, const auto& x) { return b[0] * pow(Complex(x[0]), b[1]); }},
      {"Kirby2",
       [](const auto& b, const auto& x) {
         const double t = x[0];
         return (b[0] + b[1] * t + b[2] * t * t) / (1.0 + b[3] * t + b[4] * t * t);
       }},
      {"Hahn1", cubic_ratio},
      {"Thurber", cubic_ratio},
      {"Nelson", [](const auto& b, const auto& x) { return b[0] - b[1] * x[0] * exp(-b[2] * x[1]); }},
      {"MGH17",
       [](const auto& b, const auto& x) { return b[0] + b[1] * exp(-x[0] * b[3]) + b[2] * exp(-x[0] * b[4]); }},
      {"MGH09", [](const auto& b,
                   const auto& x) { return b[0] * (x[0] * x[0] + x[0] * b[1]) / (x[0] * x[0] + x[0] * b[2] + b[3]); }},
      {"MGH10", [](const auto& b, const auto& x) { return b[0] * exp(b[1] / (x[0] + b[2])); }},
      {"Roszman1", [](const auto& b, const auto& x) { return b[0] - b[1] * x[0] - atan(b[2] / (x[0] - b[3])) / pi; }},
      {"ENSO", enso},
      {"Rat42", [](const auto& b, const auto& x) { return b[0] / (1.0 + exp(b[1] - b[2] * x[0])); }},
      {"Rat43", [](const auto& b, const auto& x) { return b[0] / pow(1.0 + exp(b[1] - b[2] * x[0]), 1.0 / b[3]); }},
      {"Eckerle4",
       [](const auto& b, const auto& x) {
         const Complex t = (x[0] - b[2]) / b[1];
         return b[0] / b[1] * exp(-0.5 * t * t);
       }},
      {"Bennett5", [](const auto& b, const auto& x) { return b[0] * pow(b[1] + x[0], -1.0 / b[2]); }},
  };
  return all;
}

double correct_digits(double value, double certified) {
  return std::min(11.0, -std::log10(std::max(std::abs(value - certified) / std::abs(certified), 1e-16)));
}

ResidualFunction residuals_of(const std::string& name, const nlohmann::json& set) {
  return [name, x = set["x"].get<std::vector<Predictors>>(), y = set["y"].get<std::vector<double>>()](
             const Eigen::VectorXd& parameters, Eigen::VectorXd& residual, Eigen::MatrixXd* jacobian) {
    constexpr double imaginary = 1e-100;
    const ModelFunction& model = models().at(name);
    const auto rows = static_cast<Eigen::Index>(y.size());
    residual.resize(rows);
    if (jacobian != nullptr) jacobian->resize(rows, parameters.size());
    Parameters b(parameters.begin(), parameters.end());
    for (Eigen::Index i = 0; i < rows; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const double observed = name == "Nelson" ? std::log(y[at]) : y[at];
      residual(i) = observed - model(b, x[at]).real();
      for (std::size_t k = 0; jacobian != nullptr && k < b.size(); ++k) {
        b[k] += Complex(0.0, imaginary * std::abs(b[k]));
        (*jacobian)(i, static_cast<Eigen::Index>(k)) =
            -model(b, x[at]).imag() / (imaginary * std::abs(parameters(static_cast<Eigen::Index>(k))));
        b[k] = parameters(static_cast<Eigen::Index>(k));
      }
    }
  };
}

/// Worst parameter and worst standard error.
std::pair<double, double> digits_of(const NonlinearFit& fit, const nlohmann::json& set) {
  std::pair<double, double> worst{11.0, 11.0};
  for (Eigen::Index k = 0; k < fit.parameter.size(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    worst.first = std::min(worst.first, correct_digits(fit.parameter(k), set["certified"][at].get<double>()));
    worst.second =
        std::min(worst.second, correct_digits(fit.standard_error(k), set["standard_errors"][at].get<double>()));
  }
  return worst;
}

}  // namespace

TEST(Nist, NonlinearReferenceSets) {
  std::ifstream file(ZERODRIFT_SOURCE_DIR "/tests/golden/nist/nonlinear.json");
  const auto sets = nlohmann::json::parse(file);
  ASSERT_EQ(sets.size(), 27U);
  for (const auto& [name, set] : sets.items()) {
    const ResidualFunction function = residuals_of(name, set);
    const auto certified = set["certified"].get<std::vector<double>>();
    const Eigen::Map<const Eigen::VectorXd> minimum(certified.data(), static_cast<Eigen::Index>(certified.size()));
    Eigen::VectorXd residual;
    function(minimum, residual, nullptr);
    // The copy of the data is NIST's. (Sums of squares near 1e-25 are rounding of eleven-digit parameters.)
    if (set["square_sum"] > 1e-20) {
      EXPECT_NEAR(residual.squaredNorm() / set["square_sum"].get<double>(), 1.0, 1e-8) << name;
    }
    for (int start = 0; start < 2; ++start) {
      const auto from = set["starts"][static_cast<std::size_t>(start)].get<std::vector<double>>();
      const NonlinearFit fit = nonlinear_least_squares(
          function, Eigen::Map<const Eigen::VectorXd>(from.data(), static_cast<Eigen::Index>(from.size())));
      const auto [parameters, errors] = digits_of(fit, set);
      std::printf("%-9s %-8s start %d: parameters %5.1f digits, standard errors %5.1f, %4d steps%s\n", name.c_str(),
                  set["level"].get<std::string>().c_str(), start + 1, parameters, errors, fit.iterations,
                  fit.converged ? "" : ", no minimum");
      if (set["level"] == "higher") continue;
      EXPECT_TRUE(fit.converged) << name << " start " << start + 1;
      EXPECT_GE(parameters, 9.0) << name << " start " << start + 1;
      EXPECT_GE(correct_digits(fit.residual_deviation, set["residual_deviation"].get<double>()),
                set["square_sum"] > 1e-20 ? 9.0 : 0.0)
          << name;
    }
  }
}

}  // namespace zerodrift::analysis
