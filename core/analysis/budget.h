#pragma once
// How many sensors are needed, and what each is worth: errors on left-out cycles for sets of sensors.

#include <string>
#include <vector>

#include "core/analysis/evaluate.h"
#include "core/analysis/training.h"
#include "core/base/result.h"
#include "core/base/task_context.h"

namespace zerodrift::analysis {

/// Sensors in the order in which each says most that those before it do not (pivoted QR of the temperature rises, in
/// K): chosen without looking at the errors, so a short recording cannot talk the choice into noise. For a dynamic
/// model it is the part of the rises that speed and the other inputs do not explain: what they say already needs no
/// sensor.
std::vector<std::string> spread_order(const TrainingSet& set, Method method = Method::ridge);

/// Sensors in the order in which a static model on so many of them comes nearest to the static model on all of them,
/// the noise of their readings included (projection onto a reference model: Goutis and Robert 1998; Piironen and
/// Vehtari 2017). The errors speak only through the full model, whose predictions carry little of their noise: a choice
/// among many sets by the errors themselves would fit that noise.
Result<std::vector<std::string>> nearest_order(const TrainingSet& set);

struct BudgetPoint {
  std::vector<std::string> sensors;
  double held_out_rms_um = 0.0;   // mean over the errors
  double held_out_peak_um = 0.0;  // mean over the errors
  std::vector<double> rms_um;     // of each error
};
/// For 1 .. most sensors in spread order.
Result<std::vector<BudgetPoint>> budget_curve(const TrainingSet& set, Method method, int most,
                                              const TaskContext& context = {});

struct Price {
  std::string sensor;
  double rms_without_um = 0.0;
  double lost_percent = 0.0;  // of the rms with all of them; negative: better without
};
/// What dropping each sensor of a set costs on left-out cycles.
Result<std::vector<Price>> price_of_dropping(const TrainingSet& set, Method method,
                                             const std::vector<std::string>& sensors, const TaskContext& context = {});

/// The figures of any set of sensors: what the engineer sees while dragging one in or out.
Result<BudgetPoint> price_set(const TrainingSet& set, Method method, const std::vector<std::string>& sensors,
                              const TaskContext& context = {});

/// Condition number of the ridge fit on these sensors with its penalty in it: how far its coefficients disturb one
/// another (1: not at all), the largest of the errors. Temperatures of one machine are always much alike; what counts
/// is what is solved.
Result<double> fitted_condition(const TrainingSet& set, const std::vector<std::string>& sensors);

}  // namespace zerodrift::analysis
