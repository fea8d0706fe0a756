#pragma once
// From a recording to clean matrices: temperatures without holes, inputs held, errors where they were measured.
// Faulty channels are named in the findings; a faulty channel that was asked for by name is an error, one that was not
// is dropped. Temperatures leave in C whatever they came in.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/analysis/findings.h"
#include "core/base/result.h"
#include "core/recording/recording.h"

namespace zerodrift::analysis {

struct PrepareOptions {
  std::vector<std::string> sensors;  // empty: every temperature and the ambient
  std::vector<std::string> errors;   // empty: every error in um
  bool need_errors = true;
};

struct Prepared {
  std::string name;
  std::vector<double> time_s;
  std::vector<std::string> sensors;
  Eigen::MatrixXd temperature_C;  // rows x sensors, finite
  std::vector<std::string> inputs;
  Eigen::MatrixXd input;  // rows x inputs (speed, coolant, feeds, load, free ones), finite, held from sample to sample
  std::vector<std::string> errors;
  Eigen::MatrixXd error_um;  // rows x errors; NaN: not measured
  std::vector<Finding> findings;

  int rows() const { return static_cast<int>(time_s.size()); }
  /// -1 if absent.
  int sensor(const std::string& channel) const;
  int input_index(const std::string& channel) const;
};

Result<Prepared> prepare(const recording::Recording& recording, const PrepareOptions& options = {});

/// Measurements at which regression and correlation look: means over blocks of time of what was measured there.
/// Temperatures are first smoothed by a local straight line round each error sample: sensor noise in the regressors
/// would bias every coefficient towards zero (errors in variables).
struct Samples {
  std::vector<double> time_s;
  Eigen::MatrixXd temperature_C;       // samples x sensors
  Eigen::MatrixXd error_um;            // samples x errors; NaN where a direction was never measured in the block
  std::vector<std::vector<int>> rows;  // rows of the recording each sample is the mean of
};

/// Block length in s that suits the length of the run: 1/144 of it, at most ten minutes.
double block_length_s(const Prepared& data);
/// Rows where any error was measured, in blocks; `only_measured` false takes every row (for series without errors).
Samples sample(const Prepared& data, bool only_measured = true);
/// Half window in s of that straight line: 150 s, less in a short run.
double smoothing_half_window_s(const Prepared& data);
/// Local straight line over +-half_window_s, evaluated at each row.
Eigen::MatrixXd smooth(const std::vector<double>& time_s, const Eigen::MatrixXd& values, double half_window_s);

}  // namespace zerodrift::analysis
