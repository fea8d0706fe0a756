#include "core/diagnosis/description/corrected_value.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/analysis/nonlinear.h"

namespace zerodrift::diagnosis::description {

using Eigen::Index;
using Eigen::VectorXd;
using inference::Evidence;
using inference::Fit;
using inference::Hypothesis;
using inference::JointModel;
using inference::RowMatrix;

namespace {

std::shared_ptr<Fit> started(const Fit& from, Hypothesis hypothesis) {
  auto fit = std::make_shared<Fit>(std::make_shared<JointModel>(std::move(hypothesis), from.model().shared_evidence()),
                                   from.sizes());
  fit->start_from(from, false);
  return fit;
}

Hypothesis with_last(const Fit& fit, DescriptionError error) {
  Hypothesis hypothesis = fit.model().hypothesis();
  hypothesis.log_prior -= hypothesis.errors.back().log_prior();
  hypothesis.errors.pop_back();
  return with_error(fit.model().evidence().machine(), std::move(hypothesis), std::move(error));
}

/// [run][series][row], the unknowns as in `fit`; empty where the network is another.
std::vector<std::vector<std::vector<double>>> shown_with(const Fit& fit, const DescriptionError& error) {
  const std::shared_ptr<Fit> there = started(fit, with_last(fit, error));
  if (there->model().unknowns() != fit.model().unknowns()) return {};
  std::vector<std::vector<std::vector<double>>> shown;
  for (std::size_t r = 0; r < fit.model().evidence().runs().size(); ++r)
    shown.push_back(there->model().predict(r, there->z(), {}, nullptr));
  return shown;
}

struct ValueStep {
  bool known = false;
  double by = 0.0;
  double sigma = 0.0;
};

/// How far the data want the last error's value from where it is, everything else re-optimised.
ValueStep value_step(const Fit& fit) {
  constexpr double share = 0.01;  // of the spread: far above rounding, far below any curvature
  const Evidence& evidence = fit.model().evidence();
  const DescriptionError error = fit.model().hypothesis().errors.back();
  if (!is_sought(error)) return {};
  DescriptionError more = error, less = error;
  more.value = std::min(error.high, error.value + share * error.spread);
  less.value = std::max(error.low, error.value - share * error.spread);
  auto after = shown_with(fit, more), before = shown_with(fit, less);
  if (after.empty()) more.value = error.value, after = fit.predicted();
  if (before.empty()) less.value = error.value, before = fit.predicted();
  const double apart = (more.value - less.value) / error.spread;
  if (!(apart > 0.0)) return {};
  const auto n = static_cast<Index>(fit.model().unknowns());
  std::vector<inference::SeriesStatistics> statistics(evidence.series());
  std::vector<const inference::SeriesStatistics*> all(evidence.series(), nullptr);
  for (std::size_t c = 0; c < evidence.series(); ++c) {
    if (evidence.samples(c) == 0) continue;
    std::vector<std::vector<double>> shown;
    std::vector<RowMatrix> columns;
    for (std::size_t r = 0; r < evidence.runs().size(); ++r) {
      const auto rows = static_cast<Index>(evidence.runs()[r].rows());
      shown.push_back(fit.predicted()[r][c]);
      RowMatrix wide(rows, n + 1);
      wide.leftCols(n) = fit.columns(r).middleRows(static_cast<Index>(c) * rows, rows);
      for (Index k = 0; k < rows; ++k) {
        const auto at = static_cast<std::size_t>(k);
        wide(k, n) = (after[r][c][at] - before[r][c][at]) / apart;
      }
      columns.push_back(std::move(wide));
    }
    statistics[c] = statistics_of(evidence, c, fit.sizes(), shown, columns);
    all[c] = &statistics[c];
  }
  VectorXd z = VectorXd::Zero(n + 1), low(n + 1), high(n + 1);
  z.head(n) = fit.z();
  low << fit.model().low(), -1e9;
  high << fit.model().high(), 1e9;
  const inference::Quadratic q = quadratic_of(evidence, fit.sizes(), z, all);
  const VectorXd step = analysis::damped_step(q.curvature, q.slope, VectorXd::Zero(n + 1), z, low, high);
  const double variance = q.curvature.ldlt().solve(VectorXd::Unit(n + 1, n))[n];
  if (!std::isfinite(step[n]) || !(variance > 0.0)) return {};
  return {true, step[n] * error.spread, std::sqrt(variance) * error.spread};
}

/// A clock is off by rows: simulated at ever smaller steps to either side.
std::shared_ptr<Fit> with_finer_clock(std::shared_ptr<Fit> fit) {
  double row_s = 0.0;
  for (const auto& run : fit->model().evidence().runs()) {
    const auto& time_s = run.recording.time_s;
    row_s = std::max(row_s, (time_s.back() - time_s.front()) / static_cast<double>(time_s.size()));
  }
  const double from_s = fit->model().hypothesis().errors.back().value;
  for (double step_s = 0.5 * std::abs(from_s); step_s > 0.4 * row_s; step_s *= 0.5) {
    const std::shared_ptr<Fit> here = fit;
    for (const double way : {-1.0, 1.0}) {
      DescriptionError next = here->model().hypothesis().errors.back();
      next.value += way * step_s;
      next.sigma = 0.3 * row_s;
      if (next.value * from_s <= 0.0) continue;
      auto moved = started(*here, with_last(*here, next));
      moved->fit({4, true});
      if (moved->log_evidence() > fit->log_evidence()) fit = std::move(moved);
    }
  }
  return fit;
}

}  // namespace

Hypothesis with_error(const physics::Machine& described, Hypothesis hypothesis, DescriptionError error) {
  hypothesis.log_prior += error.log_prior();
  hypothesis.errors.push_back(std::move(error));
  hypothesis.machine = set_right(described, hypothesis.errors);
  return hypothesis;
}

std::shared_ptr<Fit> fitted_with(const Fit& parent, const DescriptionError& error) {
  constexpr int most_steps = 5;
  constexpr double close = 0.3;     // standard deviations of the value: nothing to gain
  constexpr double longest = 0.25;  // of the spread: the model is linear near by alone
  auto fit = started(parent, with_error(parent.model().evidence().machine(), parent.model().hypothesis(), error));
  fit->fit({6, true});
  if (error.kind == ErrorKind::clock) return with_finer_clock(std::move(fit));
  for (int i = 0; i < most_steps; ++i) {
    const ValueStep step = value_step(*fit);
    if (!step.known) break;
    DescriptionError next = fit->model().hypothesis().errors.back();
    const double value = next.value;
    const double by = std::clamp(step.by, -longest * next.spread, longest * next.spread);
    next.sigma = step.sigma;
    next.value_log_prior = std::log(std::min(1.0, step.sigma / next.spread));
    bool there = std::abs(by) < close * step.sigma;
    if (!there) next.value = std::clamp(value + by, next.low, next.high);
    auto moved = started(*fit, with_last(*fit, next));
    moved->fit({3, true});
    if (!there && moved->log_evidence() < fit->log_evidence()) {  // as far as a step can tell
      next.value = value;
      moved = started(*fit, with_last(*fit, next));
      moved->fit({1, true});
      there = true;
    }
    fit = std::move(moved);
    if (there) break;
  }
  return fit;
}

DescriptionError fitted_error(const Fit& fit, std::size_t index) {
  DescriptionError error = fit.model().hypothesis().errors[index];
  for (std::size_t i = 0; i < fit.model().unknowns(); ++i) {
    const physics::Parameter& parameter = fit.model().unknown(i).parameter;
    if (fit.model().unknown(i).effect >= 0 || !is_about(error, parameter)) continue;
    error.value = fit.value(i) / parameter.mean;
    error.sigma = fit.sigma(i) / parameter.mean;
  }
  return error;
}

}  // namespace zerodrift::diagnosis::description
