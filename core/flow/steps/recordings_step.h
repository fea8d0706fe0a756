#pragma once
// Further recordings beside the warm-up run: other runs of the same machine, all from files. Makes the artefact
// "recordings": {"recordings": [{"name", "role", "series", "file", "import", "rows", "duration_s", "temperatures",
// "errors"}]}. Each change of the list keeps a new one, so an earlier list can be brought back. A job without one holds
// its warm-up run alone, as the jobs of earlier versions do.
//
// The fit takes those for training and those of a cooling that have the channels of the warm-up run; it is tested on
// those of another day. The physics explains all of them together.

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/commissioning/job.h"
#include "core/recording/recording.h"

namespace zerodrift::flow {

enum class RecordingRole {
  training,
  other_day,  // never fitted: what the model leaves on it is what to expect
  cooling,    // nothing heats: it separates the heat that goes from the heat that comes
};
std::string_view name_of(RecordingRole role);
/// bad_argument for another word.
Result<RecordingRole> recording_role_from(std::string_view name);

struct FurtherRecording {
  std::string name;
  RecordingRole role = RecordingRole::training;
  commissioning::SeriesId series = 0;
  std::string file;
  nlohmann::json import = nullptr;  // how it was read
  long long rows = 0;
  double duration_s = 0.0;
  int temperatures = 0;
  int errors = 0;
};

/// Empty when there is none.
Result<std::vector<FurtherRecording>> further_recordings(const commissioning::Job& job);
nlohmann::json to_json(const std::vector<FurtherRecording>& recordings);
Result<std::vector<FurtherRecording>> recordings_from_json(const nlohmann::json& body);

/// The list with this run at its end. step_blocked without a warm-up run; the errors of fit_for_warmup;
/// data_does_not_fit when it has no temperature of the warm-up run.
Result<commissioning::NewArtefact> add_recording(commissioning::Job& job, const recording::Recording& run,
                                                 const std::string& file, RecordingRole role,
                                                 const nlohmann::json& how = nullptr);
/// Another list of recordings that the job holds: renamed, of other roles, fewer, or an earlier one again.
commissioning::NewArtefact with_recordings(const std::vector<FurtherRecording>& recordings);

/// What the model is fitted to: the warm-up run and the further runs that serve for it, under the names of the list.
Result<std::vector<recording::Recording>> training_runs(const commissioning::Job& job,
                                                        const recording::Recording& warmup);
/// Every further run, for the physics.
Result<std::vector<recording::Recording>> further_runs(const commissioning::Job& job);
/// Those of another day that have the channels of the warm-up run.
Result<std::vector<recording::Recording>> test_runs(const commissioning::Job& job, const recording::Recording& warmup);
/// Why the run cannot serve beside this warm-up run for a fit: the first temperature or error that it lacks. Empty: it
/// can.
std::string lacks_for_fit(const recording::Recording& run, const recording::Recording& warmup);

}  // namespace zerodrift::flow
