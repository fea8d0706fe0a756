#pragma once
// Machines age: bearings run in, preload settles, a chiller is serviced. A short new run corrects an old model without
// starting over, and verified residuals say when it is time.

#include <string>
#include <vector>

#include "core/analysis/model.h"
#include "core/analysis/predict.h"
#include "core/base/result.h"
#include "core/recording/recording.h"

namespace zerodrift::analysis {

/// Bayesian update: the prior of each coefficient is the old one, as uncertain as it was left, plus aged_share of its
/// size (1 sigma) for what may have aged; the new run is the evidence. What it does not excite stays as it was. The new
/// run counts from its own start. Table terms and figures on the new run are those of the updated model; held-out
/// figures are kept from the old one.
Result<Model> update(const Model& old, const recording::Recording& run, double aged_share = 0.3);

/// Two-sided CUSUM (Page 1954) on verified residuals in units of their expected deviation.
class DriftDetector {
 public:
  /// `slack`: half the shift worth finding; `limit`: the sum that raises the alarm. 0.5 and 5 find a shift of one
  /// deviation after about ten checks and give a false alarm about once in 470 (Montgomery).
  explicit DriftDetector(double slack = 0.5, double limit = 5.0) : m_slack(slack), m_limit(limit) {}

  /// One verified residual over its expected deviation; true once the model should be measured again. A value that is
  /// not a number is passed over.
  bool add(double standardised);
  double high() const { return m_high; }
  double low() const { return m_low; }
  bool alarm() const { return m_alarm; }
  /// After a re-fit.
  void reset();

 private:
  double m_slack;
  double m_limit;
  double m_high = 0.0;
  double m_low = 0.0;
  bool m_alarm = false;
};

struct DriftCheck {
  std::string error;
  int checks = 0;  // one an hour, each the mean of what was measured in it
  bool alarm = false;
  double at_s = 0.0;  // when it was raised
};

/// Whether the measured errors of a recording have left what the model states: CUSUM of hourly mean residuals over the
/// deviation that the band stands for (90 %: 1.645 of them). An hour, because residuals of a thermal model are slow:
/// neighbouring minutes are one observation.
std::vector<DriftCheck> check_drift(const Prediction& prediction, const recording::Recording& recording);

}  // namespace zerodrift::analysis
