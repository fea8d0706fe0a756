#pragma once
// Judges a way of fitting on what it did not see: each cycle in turn is left out, penalties and noise model are chosen
// inside the rest, and the left-out cycle is predicted.

#include <string>
#include <vector>

#include "core/analysis/model.h"
#include "core/analysis/training.h"
#include "core/base/task_context.h"

namespace zerodrift::analysis {

struct Recipe {
  Method method = Method::ridge;
  std::vector<std::string> sensors;
  std::vector<FeatureSpec> features;
  std::vector<std::size_t> nested = {};  // static: the mean of fits on the first so many sensors; empty: one fit on all
};
Recipe make_recipe(Method method, const std::vector<std::string>& sensors, const TrainingSet& set);

struct Evaluation {
  std::vector<ResidualFigures> held_out;  // of each error, all left-out samples together
  std::vector<Band> bands;                // of each error
  Eigen::MatrixXd predicted_um;  // samples x errors, each from the fit that did not see it; NaN: never left out
  std::vector<double> noise_um;  // of each error: what the noise of single readings adds when the model runs
  double mean_noise_um = 0.0;    // mean over the errors
  double expected_um = 0.0;      // rms of left-out errors and that noise together, mean over the errors
  std::vector<double> fold_um;   // the same of each left-out stretch alone
  double rms_um = 0.0;           // mean over the errors
  double peak_um = 0.0;          // mean over the errors
};

/// Every error of a group (one column each) as the recipe says. Too few rows for it is not_enough_data. Static models
/// but the textbook's are made for a controller, which multiplies single noisy readings.
Result<std::vector<RidgeFit>> fit_rows(const Rows& rows, const Eigen::MatrixXd& errors_um, const Recipe& recipe,
                                       const TrainingSet& set);
/// The errors of a group at some of its samples, one column each.
Eigen::MatrixXd errors_at(const TrainingSet& set, const ErrorGroup& group, const std::vector<int>& samples);

Result<Evaluation> evaluate(const TrainingSet& set, const Recipe& recipe, double coverage,
                            const TaskContext& context = {});

}  // namespace zerodrift::analysis
