#pragma once
// The figures behind the plots of the Sensors and Fit pages, as plain numbers.

#include <string>
#include <vector>

#include "core/analysis/model.h"
#include "core/base/result.h"
#include "core/recording/recording.h"

namespace zerodrift::analysis {

/// Pearson's r of every pair of sensors and errors (sensors first); symmetric, ones on the diagonal.
struct CorrelationMatrix {
  std::vector<std::string> names;
  std::size_t sensors = 0;
  std::vector<std::vector<double>> r;
};
Result<CorrelationMatrix> correlation_matrix(const recording::Recording& recording,
                                             const std::vector<std::string>& errors = {});

struct Histogram {
  double low_um = 0.0;
  double bin_um = 0.0;
  std::vector<int> counts;
};

/// Measured against predicted, at the times where this error was measured (blocks of the fit).
struct FitFigure {
  std::string error;
  std::vector<double> time_s;
  std::vector<int> cycle;  // which left-out stretch the sample belongs to; -1: always in the training
  std::vector<double> measured_um;
  std::vector<double> predicted_um;  // by the model
  std::vector<double> left_out_um;   // by the fit that did not see this stretch; NaN where it was never left out
  std::vector<double> half_width_um;
  std::vector<double> residual_um;  // measured - predicted by the fit that did not see it, where there is one
  std::vector<double> hottest_C;    // warmest sensor of the model then, to plot residuals over temperature
  Histogram histogram;              // of the residuals
};
/// From the recordings the model was fitted to (or others of the same machine).
Result<std::vector<FitFigure>> fit_figures(const Model& model, const std::vector<recording::Recording>& recordings);

}  // namespace zerodrift::analysis
