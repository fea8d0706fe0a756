#pragma once
// A recording prepared for comparison with a simulation: the channels both have, cleaned of spikes, with the noise each
// is expected to show. The difference between a right simulation and a recording is not white: it is a slow drift (what
// a one-dimensional model cannot know; Ornstein-Uhlenbeck, 1500 s) plus white sensor noise plus, where inputs switch
// between samples, timing noise (physics: Schisler 1979 finds ARMA(1,1) in heat conduction residuals). Residuals and
// Jacobian columns are whitened by the same Kalman filter, whose gains do not depend on the data; then least squares is
// exact.

#include <Eigen/Core>
#include <stop_token>
#include <string>
#include <vector>

#include "core/physics/prediction.h"
#include "core/recording/recording.h"

namespace zerodrift::diagnosis {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// One step of the scalar Kalman filter, whose gains do not depend on what is measured.
struct Gain {
  double fade = 1.0;     // of the mean since the sample before
  double inverse = 0.0;  // 1 / sqrt(S)
  double update = 0.0;   // Kalman gain
  bool present = false;
};

struct MeasuredChannel {
  std::string name;
  bool temperature = true;
  std::vector<double> values;  // 0 where absent
  std::vector<bool> present;
  double white = 0.0;  // sigma of the sensor noise
  double drift = 0.0;  // sigma of the slow drift
  double drift_time_s = 1500.0;
  std::vector<double> timing;  // variance added at each sample by unknown switching times
  int samples = 0;
  std::vector<Gain> gains;       // of white, drift and timing: set by prepare()
  double log_determinant = 0.0;  // sum(ln S)
};

struct Dataset {
  const recording::Recording* recording = nullptr;
  std::vector<double> time_s;
  std::stop_token stop;                   // asks every fit to it to end where it is
  std::vector<MeasuredChannel> channels;  // in the order of the network's observations; no samples: not measured

  std::size_t rows() const { return time_s.size(); }
  std::size_t stacked() const { return rows() * channels.size(); }
  int samples() const;
  /// Computes the channels' gains; to be called after noise widths were changed.
  void prepare();
};

/// The most that a good description leaves, K or um, of a movement over this range; how much a description leaves, the
/// evidence says (ordinary_discrepancy).
double ordinary_drift(bool temperature, double range);
/// Samples that no fit looks at.
std::vector<bool> spikes_of(const std::vector<double>& values, bool temperature);
Dataset make_dataset(const recording::Recording& recording, const physics::Network& network);
/// The same with the slow drift of every channel times a factor.
Dataset with_drift(Dataset data, double factor);
/// The discrepancy that a channel seems to have: its size relative to the default and how slowly it wanders.
struct Discrepancy {
  double factor = 1.0;
  double time_s = 1500.0;
  double log_likelihood = 0.0;
  double gain = 0.0;  // of it, against the default
  /// Do the data ask for more than what is ordinary? Twenty to one is the least that counts.
  bool asks_for_more() const { return factor > 1.0 && gain > 3.0; }
};

/// The ordinary slow misfit of a model, by evidence: between a quarter of the default and a little more than it,
/// temperatures alike but for a share of their own, each displacement by itself. A machine that is nearly what its
/// description says shows weak effects, one that is not accuses nobody.
std::vector<Discrepancy> ordinary_discrepancy(const Dataset& data, const physics::Prediction& prediction);
/// For each channel the discrepancy under which its difference to the prediction is most likely: a latent process that
/// any named effect has to beat, and what is left when one did.
std::vector<Discrepancy> likely_discrepancy(const Dataset& data, const physics::Prediction& prediction);
/// The data with those discrepancies (relative to the widths they have).
Dataset with_discrepancy(Dataset data, const std::vector<Discrepancy>& channels);
/// Sets the timing noise from how much the switching times, each unknown by the width of the network's hold parameter,
/// move the nominal prediction.
void set_timing_noise(Dataset& data, const physics::Network& network, const physics::InputSet& inputs);

/// Whitens measured - predicted. Row = channel * rows + sample, 0 where nothing was measured. Returns the log
/// determinant sum(ln S).
double whiten(const Dataset& data, const physics::Prediction& prediction, Eigen::VectorXd* residual);
/// The prediction's derivatives, times `slopes`, into these columns of a matrix that has its rows already.
void whiten_columns(const Dataset& data, const physics::Prediction& prediction, const std::vector<double>& slopes,
                    RowMatrix& jacobian, const std::vector<int>& target_columns);

}  // namespace zerodrift::diagnosis
