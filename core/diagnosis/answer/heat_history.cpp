#include "core/diagnosis/answer/heat_history.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/diagnosis/inference/parallel.h"
#include "core/diagnosis/search/hat_scores.h"

namespace zerodrift::diagnosis::answer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int places_of_a_rod = 13;
constexpr std::size_t hats = 24;  // for the eye: edges are found by search/intervals.h
constexpr std::size_t rows_of_a_hat = 4;

struct Smoothed {
  double log_evidence = -1e300;
  std::vector<double> watts;
};

/// First differences are as large as the evidence asks: each size is as likely.
Smoothed smoothed(const search::HatScores& scores) {
  const Index n = scores.slope.size();
  MatrixXd smooth = 0.05 * MatrixXd::Identity(n, n);  // and the level itself, weakly
  for (Index i = 0; i + 1 < n; ++i) {
    smooth(i, i) += 1.0;
    smooth(i + 1, i + 1) += 1.0;
    smooth(i, i + 1) -= 1.0;
    smooth(i + 1, i) -= 1.0;
  }
  const double smooth_log = smooth.llt().matrixL().toDenseMatrix().diagonal().array().log().sum() * 2.0;
  Smoothed best;
  constexpr int sizes = 10;
  for (int level = 0; level < sizes; ++level) {
    const double watts = std::pow(10.0, -2.0 + 0.5 * level);
    const Eigen::LLT<MatrixXd> factors(scores.information + smooth / (watts * watts));
    const VectorXd solution = factors.solve(scores.slope);
    const double log_evidence = 0.5 * scores.slope.dot(solution) - factors.matrixLLT().diagonal().array().log().sum() +
                                0.5 * (smooth_log - 2.0 * static_cast<double>(n) * std::log(watts));
    if (log_evidence <= best.log_evidence) continue;
    best.log_evidence = log_evidence;
    best.watts.assign(solution.data(), solution.data() + n);
  }
  return best;
}

}  // namespace

std::vector<HeatHistory> heat_histories(const inference::Fit& fit, std::size_t run) {
  const inference::Run& data = fit.model().evidence().runs()[run];
  const std::vector<double> centres = search::hat_centres(data, hats, rows_of_a_hat);
  std::vector<HeatHistory> list;
  if (centres.size() < 4) return list;
  const search::WhitenedFit whole = search::whitened(fit);
  for (const auto& part : fit.model().hypothesis().machine.components) {
    if (part.prescribed) continue;
    HeatHistory history;
    history.component = part.id;
    history.time_s = centres;
    const int places = part.lump ? 1 : places_of_a_rod;
    for (int i = 0; i < places; ++i) {
      history.position_mm.push_back(part.lump ? 0.0 : part.length_mm * (0.03 + 0.94 * i / (places - 1)));
    }
    history.log_evidence.assign(history.position_mm.size(), -1e300);
    history.watts.assign(history.position_mm.size(), {});
    in_parallel(history.position_mm.size(), [&](std::size_t place) {
      const double at_mm = history.position_mm[place];
      const double half_mm = 0.02 * part.length_mm;
      const auto response = search::hat_responses(fit, run, centres, [&](physics::NetworkBuilder& builder) {
        return part.lump ? builder.source_over(part.id, 0.0, 0.0)
                         : builder.source_over(part.id, std::max(0.0, at_mm - half_mm),
                                               std::min(part.length_mm, at_mm + half_mm));
      });
      Smoothed best = smoothed(search::hat_scores(fit, whole, run, centres, response));
      history.log_evidence[place] = best.log_evidence;
      history.watts[place] = std::move(best.watts);
    });
    history.best = static_cast<std::size_t>(std::max_element(history.log_evidence.begin(), history.log_evidence.end()) -
                                            history.log_evidence.begin());
    list.push_back(std::move(history));
  }
  return list;
}

}  // namespace zerodrift::diagnosis::answer
