#include "core/analysis/evaluate.h"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

namespace zerodrift::analysis {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

/// Textbook multiple linear regression in the clothes of the other methods.
RidgeFit multiple_linear(const Rows& rows) {
  RidgeFit fit;
  const auto n = static_cast<double>(rows.size());
  fit.mean = rows.x.colwise().mean().transpose();
  Eigen::MatrixXd z = rows.x.rowwise() - fit.mean.transpose();
  fit.scale = (z.colwise().squaredNorm().transpose() / n).cwiseSqrt();
  for (double& s : fit.scale) {
    if (!(s > 1e-9)) s = 1e9;
  }
  z = z * fit.scale.cwiseInverse().asDiagonal();
  fit.intercept = rows.y.mean();
  const LeastSquares solution = least_squares(z, Eigen::VectorXd(rows.y.array() - fit.intercept));
  fit.beta = solution.coefficient;
  const double residual = (rows.y.array() - fit.intercept - (z * fit.beta).array()).matrix().squaredNorm();
  fit.sigma_um = std::sqrt(residual / std::max(n - static_cast<double>(z.cols()) - 1.0, 1.0));
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(z, Eigen::ComputeThinV);
  const Eigen::ArrayXd s = svd.singularValues().array();
  const Eigen::ArrayXd inverse = (s > 1e-8 * s(0)).select(s.square().inverse(), 0.0);
  fit.covariance = svd.matrixV() * inverse.matrix().asDiagonal() * svd.matrixV().transpose();
  return fit;
}

/// What a fold's predictions add to the figures of one error.
struct FoldResult {
  std::vector<double> studentised;  // |residual| / deviation of the prediction
};

/// Predicts left-out rows; the slow noise is carried on from rows of the same run before them (never from after).
Eigen::VectorXd predict_left_out(const RidgeFit& fit, const Rows& train, const Rows& test) {
  Eigen::VectorXd predicted = fit.predict(test.x);
  if (fit.noise.memory_s <= 0.0) return predicted;
  const double from_s = test.time_s.front();
  const double amplitude = remembered_um(fit, train, from_s, test.run.front());
  for (Eigen::Index i = 0; i < predicted.size(); ++i) {
    predicted(i) += amplitude * std::exp(-(test.time_s[static_cast<std::size_t>(i)] - from_s) / fit.noise.memory_s);
  }
  return predicted;
}

Band band_of(const std::vector<FoldResult>& folds, const std::vector<double>& deviations,
             const std::vector<double>& studentised, double coverage, int cycles) {
  // Never narrower than the model's own claim; the worst cycle speaks for the next one.
  constexpr double own_claim = 1.645;
  Band band;
  band.stated_coverage = coverage;
  band.guaranteed_coverage = cycles >= 2 ? static_cast<double>(cycles) / (cycles + 1.0) : 0.0;
  band.factor = own_claim;
  for (const auto& fold : folds) band.factor = std::max(band.factor, upper_quantile(fold.studentised, coverage));
  band.half_width_um = band.factor * median(deviations);
  double inside = 0.0;
  for (const double s : studentised) inside += s <= band.factor ? 1.0 : 0.0;
  if (!studentised.empty()) band.measured_coverage = inside / static_cast<double>(studentised.size());
  return band;
}

}  // namespace

Recipe make_recipe(Method method, const std::vector<std::string>& sensors, const TrainingSet& set) {
  Recipe recipe{method, sensors, {}};
  recipe.features = method == Method::dynamic ? dynamic_features(sensors, set.runs.front()) : static_features(sensors);
  return recipe;
}

Result<RidgeFit> fit_rows(const Rows& rows, Method method, double duration_s) {
  const Eigen::Index needed = method == Method::mlr ? rows.x.cols() + 2 : 6;
  if (rows.size() < needed) {
    return fail(ErrorCode::not_enough_data, {{"what", "the regression"},
                                             {"found", fmt::format("{} measurements", rows.size())},
                                             {"needed", fmt::format("at least {}", needed)}});
  }
  return method == Method::mlr ? multiple_linear(rows) : fit_ridge(rows, default_choice(duration_s));
}

Result<Evaluation> evaluate(const TrainingSet& set, const Recipe& recipe, double coverage, const TaskContext& context) {
  ZD_TRY(const Eigen::MatrixXd x, design(set, recipe.features));
  Evaluation out;
  out.predicted_um = Eigen::MatrixXd::Constant(set.error_um.rows(), set.error_um.cols(), missing);
  for (Eigen::Index e = 0; e < set.error_um.cols(); ++e) {
    std::vector<int> which;
    const Rows rows = rows_of(set, x, e, which);
    std::vector<FoldResult> folds(static_cast<std::size_t>(set.folds.count));
    std::vector<double> deviations;
    std::vector<double> studentised;
    for (int k = 0; k < set.folds.count; ++k) {
      if (context.cancelled()) return fail(ErrorCode::cancelled);
      std::vector<int> in;
      std::vector<int> left_out;
      for (std::size_t i = 0; i < which.size(); ++i) {
        const bool out_now = set.folds.fold_of[static_cast<std::size_t>(which[i])] == k;
        (out_now ? left_out : in).push_back(static_cast<int>(i));
      }
      if (left_out.empty()) continue;
      const Rows train = pick(rows, in);
      const Rows test = pick(rows, left_out);
      ZD_TRY(const RidgeFit fit, fit_rows(train, recipe.method, set.duration_s()));
      const Eigen::VectorXd predicted =
          recipe.method == Method::dynamic ? predict_left_out(fit, train, test) : fit.predict(test.x);
      const Eigen::VectorXd deviation = fit.deviation(test.x);
      for (Eigen::Index i = 0; i < test.size(); ++i) {
        const int sample = which[static_cast<std::size_t>(left_out[static_cast<std::size_t>(i)])];
        out.predicted_um(sample, e) = predicted(i);
        deviations.push_back(deviation(i));
        studentised.push_back(std::abs(test.y(i) - predicted(i)) / std::max(deviation(i), 1e-9));
        folds[static_cast<std::size_t>(k)].studentised.push_back(studentised.back());
      }
    }
    out.held_out.push_back(residual_figures(set.error_um.col(e), out.predicted_um.col(e)));
    out.bands.push_back(band_of(folds, deviations, studentised, coverage, set.folds.cycles));
    out.rms_um += out.held_out.back().rms_um / static_cast<double>(set.error_um.cols());
    out.peak_um += out.held_out.back().peak_um / static_cast<double>(set.error_um.cols());
  }
  return out;
}

}  // namespace zerodrift::analysis
