#pragma once
// A warm-up run recorded by other means (another logger, displacement probes, an older visit) takes the place of one
// recorded here: makes the artefact "warmup" of warmup_step.h with "source": "file" and "file". Whether the
// compensation was off meanwhile cannot be checked any more; the artefact says so among its problems, and so does the
// report.

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/commissioning/job.h"
#include "core/recording/recording.h"

namespace zerodrift::flow {

/// What a recording must have to be a warm-up run: a temperature and an error, 20 rows of each, over a minute at least.
/// Without an error it serves for a question of heat alone (diagnose), where `errors_needed` is false.
Status fit_for_warmup(const recording::Recording& run, const std::string& file, bool errors_needed = true);

/// The run as a finished series of the job.
Result<commissioning::SeriesId> keep_run(commissioning::Job& job, const recording::Recording& run,
                                         const std::string& name, const nlohmann::json& details);

/// `how` is kept as "import": how the file was read, with the date of its start. Given it, errors are not needed.
Result<commissioning::NewArtefact> import_warmup(commissioning::Job& job, const recording::Recording& run,
                                                 const std::string& file, const nlohmann::json& how = nullptr);

}  // namespace zerodrift::flow
