#pragma once
// Step "sensors" (S1, S2): clusters the temperature series of the warm-up run and compares the sensitive points with
// other sets of sensors; the one with the least error to expect is kept. Makes the artefact "sensors": the clustering's
// own JSON (core/analysis/clustering.h) and
//   "clusters_asked": 0 as suggested, "chosen": [...], "chosen_by": kind of the set|"hand", "choice": {reason, sets
//   (core/analysis/sensor_choice.h), one_cycle, flat {left: [...] of the best set, since the error hardly grows without
//   them, cost_um}, condition: null where the set holds the limit of the condition number, else {without: what it would
//   be, left: [...] that a set within the limit does without, cost_um, fewer_than_clusters, held: it is proposed, since
//   it costs little and no cluster is without a sensor}}, "price": {held_out_rms_um, held_out_peak_um (of the chosen),
//   all_rms_um, change_um {sensor: change of the rms when a kept one is dropped or a left one is added}}, "budget":
//   [{sensors, added, held_out_rms_um, held_out_peak_um}], "condition_number": {..., chosen (of the fit, its penalty
//   included), chosen_temperatures}, "table": [{channel, label, note, cluster, correlation_sum, kept}], "left_out":
//   [{channel, label, reason}]: sensors whose fault the run named; taken only by hand

#include <string>
#include <vector>

#include "core/base/task_context.h"
#include "core/commissioning/job.h"

namespace zerodrift::flow {

struct SensorsOptions {
  int clusters = 5;                 // 0: as suggested
  std::vector<std::string> chosen;  // by hand; empty: the set with the least error to expect
};

Result<commissioning::NewArtefact> choose_sensors(const commissioning::Job& job, const SensorsOptions& options,
                                                  const TaskContext& context);

/// What the latest choice was asked for, so that it can be made again from another run: sensors chosen by hand stay
/// chosen. Without one the defaults.
Result<SensorsOptions> sensors_asked_for(const commissioning::Job& job);

}  // namespace zerodrift::flow
