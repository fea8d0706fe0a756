#pragma once
// The training data of a fit: one or several runs, cleaned, in blocks, with the cycles that can be left out.

#include <string>
#include <vector>

#include "core/analysis/features.h"
#include "core/analysis/folds.h"
#include "core/analysis/linear.h"
#include "core/analysis/prepare.h"
#include "core/recording/recording.h"

namespace zerodrift::analysis {

struct TrainingSet {
  std::vector<Prepared> runs;
  std::vector<Eigen::MatrixXd> smoothed_C;  // temperatures of each run, smoothed against sensor noise
  std::vector<Samples> samples;
  Folds folds;                       // over the samples of all runs, one after the other
  std::vector<std::string> sensors;  // usable in every run
  std::vector<std::string> errors;   // measured in every run
  std::vector<double> time_s;        // of each sample
  std::vector<int> run;              // of each sample
  Eigen::MatrixXd error_um;          // samples x errors; NaN: not measured
  std::vector<double> noise_C;       // of each sensor: deviation of one reading from the course of its temperature
  std::vector<Finding> findings;

  double duration_s() const;  // of the longest run
  /// Deviation of each feature's reading as a controller multiplies it; 0 for filtered features and inputs.
  Eigen::VectorXd feature_noise_C(const std::vector<FeatureSpec>& specs) const;
};

/// A recording that goes on where the one before ended (time and temperatures) is joined to it; filters and slow noise
/// then run through.
std::vector<recording::Recording> join_continuing(const std::vector<recording::Recording>& recordings);

Result<TrainingSet> make_training(const std::vector<recording::Recording>& recordings, const PrepareOptions& options);

/// samples x features. Temperatures are rises over the start of their own run.
Result<Eigen::MatrixXd> design(const TrainingSet& set, const std::vector<FeatureSpec>& specs);

/// Errors that were measured at the same times, with the samples where they were.
struct ErrorGroup {
  std::vector<Eigen::Index> errors;
  std::vector<int> samples;
};
std::vector<ErrorGroup> error_groups(const TrainingSet& set);

/// Those samples of the design, and of one error, as rows of a regression.
Rows rows_of(const TrainingSet& set, const Eigen::MatrixXd& design, const std::vector<int>& samples,
             Eigen::Index error);

}  // namespace zerodrift::analysis
