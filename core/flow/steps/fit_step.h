#pragma once
// Step "fit" (S4): regression from the sensors kept to the errors of the warm-up run, with figures on data left out.
// Makes the artefact "model": {"model": {...zerodrift-model/1...}, "summary", "runs_on_controller",
//   "figures": [{channel, rms_fit_um, rms_held_out_um, peak_held_out_um}],
//   "table": [{axis, sensor, um_per_K, reference_C}], "offset_um": {"X": ...}, "candidates": [...]}
// With further recordings also "fitted_too": [names] and "tests": [{"recording", "errors": [{channel, rms_um, peak_um,
// removed_percent}]}] on those of another day.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/analysis/model.h"
#include "core/base/task_context.h"
#include "core/commissioning/job.h"
#include "core/compensation/table.h"
#include "core/controller/profile.h"
#include "core/recording/recording.h"

namespace zerodrift::flow {

struct FitStepOptions {
  std::string method = "auto";
};

Result<commissioning::NewArtefact> fit_model(const commissioning::Job& job, const FitStepOptions& options,
                                             const TaskContext& context);

/// What the latest model was asked for, so that it can be fitted again; without one the defaults.
Result<FitStepOptions> fit_asked_for(const commissioning::Job& job);

/// The latest model corrected by a short newer run of the machine instead of fitted anew (core/analysis/ageing.h): what
/// the run does not excite stays as it was.
Result<commissioning::NewArtefact> update_model(const commissioning::Job& job, const recording::Recording& run);

/// The model with its errors called by the axes that the channels of the warm-up run are of (body of the artefact
/// "warmup"): what a table and the host compensator are made from.
analysis::Model by_axes(analysis::Model model, const nlohmann::json& warmup);

/// The table of the job's latest model. step_blocked without one.
Result<compensation::Table> table_of_job(const commissioning::Job& job);

/// The model of an artefact "model".
Result<analysis::Model> model_of(const commissioning::Artefact& artefact);

}  // namespace zerodrift::flow
