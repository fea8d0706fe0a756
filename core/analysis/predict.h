#pragma once
// A model at work: over a whole recording (predict), or sample by sample beside a running machine (LivePredictor).

#include <map>
#include <string>
#include <vector>

#include "core/analysis/model.h"
#include "core/base/result.h"
#include "core/recording/recording.h"

namespace zerodrift::analysis {

/// What the errors of the recording are relative to.
enum class Zero {
  automatic,  // continuation of the training, its very recording, or a new run
  training,   // the zero of the training run
  start,      // the recording's own start: error 0 there
};

struct PredictedError {
  std::string error;
  std::vector<double> value_um;       // one for each row
  std::vector<double> half_width_um;  // of the band; wider in proportion outside the training
  ResidualFigures residual;           // against the recording's own errors, count 0 if there are none
  double coverage = 0.0;              // share of its errors inside the band
};

struct Prediction {
  std::vector<double> time_s;
  std::vector<PredictedError> errors;
  std::vector<double> extrapolation;  // above 1: outside what the training saw
  std::string extrapolation_channel;  // what is farthest outside; "sensors together" for an unseen combination
  double extrapolation_share = 0.0;   // of the rows
  Zero zero = Zero::training;         // what was used
  bool continued = false;             // went on from the end of the training
  std::vector<Finding> findings;

  /// time_s; for each error its column, "<error>_low" and "<error>_high"; extrapolation.
  recording::Recording to_recording() const;
};

Result<Prediction> predict(const Model& model, const recording::Recording& recording, Zero zero = Zero::automatic);

/// Sample by sample: for the host compensator. Temperatures are relative to the training's references, as in a table.
class LivePredictor {
 public:
  struct Value {
    std::string error;
    double predicted_um = 0.0;
    double half_width_um = 0.0;
  };
  struct Sample {
    std::vector<Value> errors;
    double extrapolation = 0.0;
    std::string extrapolation_channel;
  };

  explicit LivePredictor(Model model);
  /// `channels`: every channel of the model. A channel that is missing or not a number is held for up to 30 s and then
  /// refused (sensor_dead). Time must not go back.
  Result<Sample> update(double time_s, const std::map<std::string, double>& channels);
  const Model& model() const { return m_model; }

 private:
  Result<double> value_of(const std::string& channel, double time_s, const std::map<std::string, double>& channels);

  Model m_model;
  bool m_started = false;
  double m_time_s = 0.0;
  std::vector<double> m_filtered;
  std::vector<double> m_driving;
  std::map<std::string, std::pair<double, double>> m_last;  // channel -> time, value
};

/// How far outside the training a state is: 1 at its edge. `rise_K` of the model's sensors over their start, `values`
/// by the domain's channels.
double extrapolation_of(const Domain& domain, const Eigen::VectorXd& rise_K, const std::vector<double>& values,
                        std::string* channel = nullptr);

}  // namespace zerodrift::analysis
