#include "core/analysis/budget.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/analysis/statistics.h"

namespace zerodrift::analysis {

namespace {

/// What the inputs do not explain of the temperatures: residual of a lightly penalised regression on their filter bank.
Eigen::MatrixXd beyond_inputs(const TrainingSet& set, const Eigen::MatrixXd& rise) {
  const auto specs = dynamic_features({}, set.runs.front());
  const auto inputs = design(set, specs);
  if (specs.empty() || !inputs) return rise;
  Eigen::MatrixXd z = inputs->rowwise() - inputs->colwise().mean();
  for (Eigen::Index c = 0; c < z.cols(); ++c) {
    const double length = z.col(c).norm();
    if (length > 0.0) z.col(c) /= length;
  }
  constexpr double light = 1e-4;  // of the weight of one feature
  Eigen::MatrixXd a = z.transpose() * z;
  a.diagonal().array() += light;
  return rise - z * a.llt().solve(z.transpose() * rise);
}

}  // namespace

std::vector<std::string> spread_order(const TrainingSet& set, Method method) {
  Eigen::Index total = 0;
  for (const auto& s : set.samples) total += s.temperature_C.rows();
  Eigen::MatrixXd rise(total, static_cast<Eigen::Index>(set.sensors.size()));
  for (std::size_t c = 0; c < set.sensors.size(); ++c) {
    Eigen::Index at = 0;
    for (std::size_t r = 0; r < set.runs.size(); ++r) {
      const auto& t = set.samples[r].temperature_C;
      const Eigen::VectorXd column = t.col(set.runs[r].sensor(set.sensors[c]));
      rise.block(at, static_cast<Eigen::Index>(c), t.rows(), 1) = column.array() - column.mean();
      at += t.rows();
    }
  }
  if (method == Method::dynamic) rise = beyond_inputs(set, rise);
  std::vector<std::string> order;
  for (const int c : spread_of(rise)) order.push_back(set.sensors[static_cast<std::size_t>(c)]);
  return order;
}

Result<std::vector<std::string>> nearest_order(const TrainingSet& set) {
  const Recipe all = make_recipe(Method::ridge, set.sensors, set);
  ZD_TRY(const Eigen::MatrixXd x, design(set, all.features));
  const Eigen::VectorXd noise_C = set.feature_noise_C(all.features);
  const Eigen::MatrixXd centred = x.rowwise() - x.colwise().mean();
  const Eigen::MatrixXd moment = centred.transpose() * centred / static_cast<double>(x.rows());
  Eigen::MatrixXd full(x.cols(), set.error_um.cols());  // um/K of every sensor, one column an error
  for (const auto& group : error_groups(set)) {
    const Rows rows = rows_of(set, x, group.samples, group.errors.front());
    ZD_TRY(const std::vector<RidgeFit> fits, fit_rows(rows, errors_at(set, group, group.samples), all, set));
    for (std::size_t g = 0; g < fits.size(); ++g) full.col(group.errors[g]) = fits[g].raw_coefficients();
  }
  const Eigen::MatrixXd covariance = moment * full;  // of every sensor with the full model's predictions
  std::vector<int> taken;
  std::vector<int> left(set.sensors.size());
  for (std::size_t c = 0; c < left.size(); ++c) left[c] = static_cast<int>(c);
  while (!left.empty()) {
    std::size_t best = 0;
    double most = -1.0;
    for (std::size_t k = 0; k < left.size(); ++k) {
      std::vector<int> tried = taken;
      tried.push_back(left[k]);
      Eigen::MatrixXd noisy = moment(tried, tried);
      for (std::size_t i = 0; i < tried.size(); ++i) {
        noisy(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)) +=
            noise_C(tried[i]) * noise_C(tried[i]) + 1e-12;
      }
      const Eigen::MatrixXd part = covariance(tried, Eigen::all);
      const double explained = part.cwiseProduct(noisy.llt().solve(part)).sum();
      if (explained > most) {
        most = explained;
        best = k;
      }
    }
    taken.push_back(left[best]);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
  }
  std::vector<std::string> order;
  for (const int c : taken) order.push_back(set.sensors[static_cast<std::size_t>(c)]);
  return order;
}

Result<BudgetPoint> price_set(const TrainingSet& set, Method method, const std::vector<std::string>& sensors,
                              const TaskContext& context) {
  ZD_TRY(const Evaluation evaluation, evaluate(set, make_recipe(method, sensors, set), 0.9, context));
  BudgetPoint point;
  point.sensors = sensors;
  point.held_out_rms_um = evaluation.rms_um;
  point.held_out_peak_um = evaluation.peak_um;
  for (const auto& f : evaluation.held_out) point.rms_um.push_back(f.rms_um);
  return point;
}

Result<std::vector<BudgetPoint>> budget_curve(const TrainingSet& set, Method method, int most,
                                              const TaskContext& context) {
  const std::vector<std::string> order = spread_order(set, method);
  const auto count = std::min(static_cast<std::size_t>(std::max(most, 1)), order.size());
  std::vector<BudgetPoint> curve;
  for (std::size_t n = 1; n <= count; ++n) {
    context.progress(static_cast<double>(n - 1) / static_cast<double>(count), "budget");
    ZD_TRY(BudgetPoint point,
           price_set(set, method, {order.begin(), order.begin() + static_cast<std::ptrdiff_t>(n)}, context));
    curve.push_back(std::move(point));
  }
  return curve;
}

Result<std::vector<Price>> price_of_dropping(const TrainingSet& set, Method method,
                                             const std::vector<std::string>& sensors, const TaskContext& context) {
  std::vector<Price> prices;
  if (sensors.size() < 2) return prices;
  ZD_TRY(const BudgetPoint all, price_set(set, method, sensors, context));
  for (const auto& sensor : sensors) {
    std::vector<std::string> rest;
    std::copy_if(sensors.begin(), sensors.end(), std::back_inserter(rest), [&](const auto& s) { return s != sensor; });
    ZD_TRY(const BudgetPoint without, price_set(set, method, rest, context));
    prices.push_back({sensor, without.held_out_rms_um,
                      100.0 * (without.held_out_rms_um / std::max(all.held_out_rms_um, 1e-9) - 1.0)});
  }
  return prices;
}

Result<double> fitted_condition(const TrainingSet& set, const std::vector<std::string>& sensors) {
  const Recipe recipe = make_recipe(Method::ridge, sensors, set);
  ZD_TRY(const Eigen::MatrixXd x, design(set, recipe.features));
  double largest = 1.0;
  for (const auto& group : error_groups(set)) {
    const Rows rows = rows_of(set, x, group.samples, group.errors.front());
    ZD_TRY(const std::vector<RidgeFit> fits, fit_rows(rows, errors_at(set, group, group.samples), recipe, set));
    for (const RidgeFit& fit : fits) {
      const Eigen::VectorXd s = fit.covariance.selfadjointView<Eigen::Lower>().eigenvalues();
      largest = std::max(largest, std::sqrt(s.maxCoeff() / std::max(s.minCoeff(), 1e-300)));
    }
  }
  return std::min(largest, 1e12);
}

}  // namespace zerodrift::analysis
