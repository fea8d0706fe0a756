#pragma once
// A recording prepared for comparison with a simulation: of each channel that the machine's description predicts the
// samples without spikes, the white noise they have, and the size of the slow discrepancy that is usual.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/diagnosis/inference/settings.h"
#include "core/physics/inputs.h"
#include "core/physics/network.h"
#include "core/recording/recording.h"

namespace zerodrift::diagnosis::inference {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct MeasuredSeries {
  std::string channel;
  bool temperature = true;
  std::vector<double> values;  // 0 where absent
  std::vector<bool> present;
  int samples = 0;
  double range = 0.0;          // K or um, between the 2nd and the 98th percentile
  double white = 0.0;          // standard deviation of a sample's noise
  double slow = 0.0;           // standard deviation of the slow discrepancy at size 1
  std::vector<double> timing;  // variance that unknown moments of switching add at each sample
};

struct Run {
  recording::Recording recording;
  std::vector<MeasuredSeries> series;  // in the order of the network's observations

  std::size_t rows() const { return recording.time_s.size(); }
};

/// `nominal`: the network of the machine as described, for this recording.
Run make_run(recording::Recording recording, const physics::Network& nominal, const DiagnosisSettings& settings);

/// Whitens a series whose noise is white plus timing plus a slow, smooth process (Matern 3/2): what a form gets wrong
/// in a field that conducts is smooth; a rough process (Ornstein-Uhlenbeck) would take every smooth remainder for an
/// effect. The innovations of its Kalman filter, whose gains do not depend on the data, so that residuals and
/// derivatives go through the same linear filter.
class Whitener {
 public:
  Whitener() = default;
  /// `size`: of the slow discrepancy.
  Whitener(const MeasuredSeries& series, const std::vector<double>& time_s, double size, double correlation_time_s);

  /// sum of ln(innovation variance): the filter's part of the log determinant.
  double log_determinant() const { return m_log_determinant; }
  /// out[k] = innovation of value[k], 0 where nothing was measured.
  void apply(const double* value, double* out) const;
  /// Many series side by side: rows of `value` are samples.
  void apply(const Eigen::Ref<const RowMatrix>& value, Eigen::Ref<RowMatrix> out) const;

 private:
  struct Step {
    double f00 = 1.0, f01 = 0.0, f10 = 0.0, f11 = 1.0;  // transition of level and slope since the sample before
    double inverse = 0.0;                               // 1 / sqrt(innovation variance)
    double gain0 = 0.0, gain1 = 0.0;                    // Kalman gains
    bool present = false;
  };
  std::vector<Step> m_steps;
  double m_log_determinant = 0.0;
};

}  // namespace zerodrift::diagnosis::inference
