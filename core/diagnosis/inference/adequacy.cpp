#include "core/diagnosis/inference/adequacy.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace zerodrift::diagnosis::inference {
namespace {

/// Upper tail of chi-squared with n degrees of freedom (Wilson and Hilferty 1931).
double chi_squared_tail(double x, double n) {
  const double u = (std::cbrt(x / n) - (1.0 - 2.0 / (9.0 * n))) / std::sqrt(2.0 / (9.0 * n));
  return 0.5 * std::erfc(u / std::numbers::sqrt2);
}

}  // namespace

double p_of_blocks(const std::vector<double>& innovations, const std::vector<bool>& present, std::size_t block) {
  constexpr int fewest_blocks = 4;
  double sum = 0.0;
  int blocks = 0;
  for (std::size_t start = 0; start + block <= innovations.size(); start += block) {
    double total = 0.0;
    int count = 0;
    for (std::size_t k = start; k < start + block; ++k) {
      total += innovations[k];
      count += present[k] ? 1 : 0;
    }
    if (count == 0) continue;
    sum += total * total / count;
    ++blocks;
  }
  return blocks < fewest_blocks ? 1.0 : chi_squared_tail(sum, blocks);
}

double adequacy(const Fit& fit) {
  const Evidence& evidence = fit.model().evidence();
  double least = 1.0;
  int looks = 0;
  for (std::size_t c = 0; c < evidence.series(); ++c) {
    if (evidence.samples(c) == 0) continue;
    for (std::size_t r = 0; r < evidence.runs().size(); ++r) {
      const std::vector<double> innovations = fit.innovations(r, c);
      for (const std::size_t blocks : {12u, 36u}) {
        const std::size_t block = std::max<std::size_t>(2, innovations.size() / blocks);
        least = std::min(least, p_of_blocks(innovations, evidence.runs()[r].series[c].present, block));
        ++looks;
      }
    }
  }
  return std::min(1.0, least * looks);
}

double bending(const Fit& fit) {
  double squares = 0.0, count = 0.0;
  for (std::size_t i = 0; i < fit.model().unknowns(); ++i) {
    if (fit.model().unknown(i).effect >= 0) continue;
    const double z = fit.z()[static_cast<Eigen::Index>(i)];
    squares += z * z;
    count += 1.0;
  }
  return count > 0.0 ? chi_squared_tail(squares, count) : 1.0;
}

}  // namespace zerodrift::diagnosis::inference
