#pragma once
// Residual correction (C2). Measured while compensating, the error is what is left: residual = true error - predicted.
// With the thermal prediction e_T the true error is e_T + residual, so the coefficient kappa = 1 + residual / e_T
// corrects the temperature terms concerned; over several measurements by least squares with a prior round the model,
// since one verification says less than it seems: taken whole, the next one finds the opposite. A moved offset is that
// day's zero and does another day no harm; kappa stays, so it is touched only when the run shows that it must be:
// when it explains clearly more than the offset alone. Where the prediction is
// near zero kappa means nothing and an offset is corrected instead. kappa is bounded and smoothed, and one bad frame
// corrects nothing. Beside it a Bayesian update of the single coefficients (normal prior around the model) is offered.

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/compensation/table.h"

namespace zerodrift::compensation {

struct ResidualSample {
  double residual_um = 0.0;  // error measured with the compensation on; NaN is skipped
  double sigma_um = 0.5;
  double position_mm = 0.0;
  Temperatures temperatures;
};

struct ResidualOptions {
  double threshold_um = 3.0;   // correct only when residuals exceed it
  double resolution_um = 2.0;  // a smaller thermal prediction says nothing about kappa
  double kappa_low = 0.5;
  double kappa_high = 2.0;
  double smoothing = 1.0;             // 1: take the whole correction; smaller: a part of it
  int fewest_samples = 3;             // evidence needed
  double kappa_sigma = 0.05;          // how well kappa = 1 is believed beforehand
  double offset_sigma_um = 1.5;       // and the offset
  double kappa_evidence = 3.84;       // chi-squared that kappa must explain beyond the offset (95 %, one degree)
  double model_scatter_um = 1.0;      // least scatter that the model itself is taken to have
  double independent = 4.0;           // measurements that a verification counts for
  double prior_relative_sigma = 0.3;  // Bayesian update: how well the model's coefficients are trusted
};

enum class CorrectionKind {
  none,
  kappa,   // temperature terms scaled
  offset,  // constant moved
  both,
};

struct AxisCorrection {
  std::string axis;
  CorrectionKind kind = CorrectionKind::none;
  double kappa = 1.0;
  double offset_um = 0.0;  // added to the axis's error offset
  int samples = 0;         // used, outliers left out
  double rms_before_um = 0.0;
  double rms_after_um = 0.0;  // what these samples would have left with the corrected table
  double largest_before_um = 0.0;
  double largest_after_um = 0.0;
  std::string reason;  // one sentence: why this, or why nothing
};

struct Correction {
  Table table;  // version one higher when anything changed
  std::vector<AxisCorrection> axes;
};

/// Samples by axis, taken while `table` was compensating.
Result<Correction> correct_residual(const Table& table,
                                    const std::map<std::string, std::vector<ResidualSample>>& samples,
                                    const ResidualOptions& options = {});
/// The same with the coefficients updated one by one (normal prior, measured scatter).
Result<Correction> update_coefficients(const Table& table,
                                       const std::map<std::string, std::vector<ResidualSample>>& samples,
                                       const ResidualOptions& options = {});

}  // namespace zerodrift::compensation
