#pragma once
// Which sensors a static model (a controller's table) should run on: the sensitive points as published, against sets
// chosen for the spread of the temperatures and for nearness to the model on all sensors. The measure is what is to be
// expected on data not seen, with the noise that single readings bring through the coefficients.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/analysis/training.h"
#include "core/base/result.h"
#include "core/base/task_context.h"

namespace zerodrift::analysis {

enum class SetKind {
  sensitive_points,       // one of each cluster, as published
  spread,                 // pivoted QR of the temperatures: what differs most
  nearest,                // nearest to the model on all sensors
  sensitive_plus_spread,  // the sensitive points and what differs most from them
  all,
};
/// "sensitive_points", "spread", ...
std::string_view name_of(SetKind kind);
/// In words, for a sentence: "sensitive points of the clusters".
std::string_view in_words(SetKind kind);

struct SensorSet {
  SetKind kind = SetKind::spread;
  std::vector<std::string> sensors;
  double held_out_rms_um = 0.0;   // mean over the errors
  double held_out_peak_um = 0.0;  // mean over the errors
  double noise_um = 0.0;          // rms that single readings add, mean over the errors
  double expected_um = 0.0;       // both together
  std::vector<double> fold_um;    // the same of each left-out stretch
};

struct SensorChoice {
  std::vector<SensorSet> sets;  // from few sensors to many
  std::size_t chosen = 0;
  std::string reason;  // one sentence
  bool one_cycle = false;

  /// With one cycle: the numbers of the chosen sensors, from the first on, whose fits are averaged; else empty.
  std::vector<std::size_t> nested() const;
};

/// Of so many sensors, those nearest first: the numbers whose fits are averaged when one cycle cannot rank them.
std::vector<std::size_t> averaged_counts(std::size_t sensors);

struct ChoiceOptions {
  std::vector<std::string> sensitive_points;  // may be empty
  std::size_t few = 5;                        // size of the small sets
  std::size_t most = 0;                       // 0: no limit; else no set is larger
};

/// One cycle ranks nothing: all usable sensors are taken (as many as allowed, nearest to the model on all first), since
/// bodies that rose together in it need not do so at other speeds; fits on the first two to eight are averaged and
/// joined with the structural fit on all (structural.h). With more cycles: the largest set whose error is not told
/// apart from the least one: a few left-out stretches do not rank sets of sensors, and the mean of many sensors is
/// quieter and stays right when a slow body goes where it was never seen.
Result<SensorChoice> choose_sensor_set(const TrainingSet& set, const ChoiceOptions& options,
                                       const TaskContext& context = {});

/// {"reason", "sets": [{"kind", "in_words", "sensors", "held_out_rms_um", "held_out_peak_um", "noise_um",
/// "expected_um", "chosen"}]}
nlohmann::json to_json(const SensorChoice& choice);

}  // namespace zerodrift::analysis
