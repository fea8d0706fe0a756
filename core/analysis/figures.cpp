#include "core/analysis/figures.h"

#include <algorithm>
#include <cmath>

#include "core/analysis/evaluate.h"
#include "core/analysis/statistics.h"
#include "core/analysis/training.h"

namespace zerodrift::analysis {
namespace {

Histogram histogram_of(const std::vector<double>& residual_um) {
  constexpr int bins = 21;
  Histogram h;
  double largest = 0.0;
  for (const double r : residual_um) largest = std::max(largest, std::abs(r));
  h.bin_um = std::max(2.0 * largest / bins, 1e-6);
  h.low_um = -0.5 * bins * h.bin_um;
  h.counts.assign(bins, 0);
  for (const double r : residual_um) {
    ++h.counts[static_cast<std::size_t>(std::clamp(static_cast<int>((r - h.low_um) / h.bin_um), 0, bins - 1))];
  }
  return h;
}

}  // namespace

Result<CorrelationMatrix> correlation_matrix(const recording::Recording& recording,
                                             const std::vector<std::string>& errors) {
  PrepareOptions options;
  options.errors = errors;
  ZD_TRY(const Prepared data, prepare(recording, options));
  const Samples samples = sample(data);
  CorrelationMatrix out;
  out.names = data.sensors;
  out.sensors = data.sensors.size();
  out.names.insert(out.names.end(), data.errors.begin(), data.errors.end());
  Eigen::MatrixXd all(samples.temperature_C.rows(), static_cast<Eigen::Index>(out.names.size()));
  all << samples.temperature_C, samples.error_um;
  for (Eigen::Index i = 0; i < all.cols(); ++i) {
    std::vector<double> row;
    for (Eigen::Index j = 0; j < all.cols(); ++j) row.push_back(i == j ? 1.0 : pearson(all.col(i), all.col(j)));
    out.r.push_back(std::move(row));
  }
  return out;
}

Result<std::vector<FitFigure>> fit_figures(const Model& model, const std::vector<recording::Recording>& recordings) {
  PrepareOptions options;
  options.sensors = model.sensors;
  for (const auto& e : model.errors) options.errors.push_back(e.error);
  ZD_TRY(const TrainingSet set, make_training(recordings, options));
  ZD_TRY(const Eigen::MatrixXd x, design(set, model.features));
  ZD_TRY(const Evaluation evaluation,
         evaluate(set, {model.method, model.sensors, model.features, model.averaged}, 0.9));
  ZD_TRY(const Eigen::MatrixXd hot, design(set, static_features(model.sensors)));
  std::vector<FitFigure> out;
  for (std::size_t e = 0; e < model.errors.size(); ++e) {
    const auto column = static_cast<Eigen::Index>(e);
    const Eigen::VectorXd predicted = model.errors[e].regression.predict(x);
    const Eigen::VectorXd half_width = model.half_width_um(model.errors[e], x);
    FitFigure figure;
    figure.error = model.errors[e].error;
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
      const double measured = set.error_um(i, column);
      if (!std::isfinite(measured)) continue;
      const auto at = static_cast<std::size_t>(i);
      const double left_out = evaluation.predicted_um(i, column);
      figure.time_s.push_back(set.time_s[at]);
      figure.cycle.push_back(set.folds.fold_of[at]);
      figure.measured_um.push_back(measured);
      figure.predicted_um.push_back(predicted(i));
      figure.left_out_um.push_back(left_out);
      figure.half_width_um.push_back(half_width(i));
      figure.residual_um.push_back(measured - (std::isfinite(left_out) ? left_out : predicted(i)));
      Eigen::Index hottest = 0;
      hot.row(i).maxCoeff(&hottest);
      figure.hottest_C.push_back(model.start_C[static_cast<std::size_t>(hottest)] + hot(i, hottest));
    }
    figure.histogram = histogram_of(figure.residual_um);
    out.push_back(std::move(figure));
  }
  return out;
}

}  // namespace zerodrift::analysis
