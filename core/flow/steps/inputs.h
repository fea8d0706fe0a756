#pragma once
// What several steps read from a job: the latest artefact of a kind as JSON, the run it names.

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "core/base/result.h"
#include "core/commissioning/job.h"
#include "core/controller/profile.h"
#include "core/recording/recording.h"

namespace zerodrift::flow {

struct Input {
  commissioning::ArtefactId id = 0;
  nlohmann::json body;
};

/// step_blocked naming the step and what it needs when the job has none.
Result<Input> need(const commissioning::Job& job, const std::string& step, const std::string& kind);
/// The run of the latest artefact of this kind ("warmup", "verification").
Result<recording::Recording> run_of(const commissioning::Job& job, const Input& input);
/// The profile kept with the machine artefact.
Result<controller::Profile> profile_of(const commissioning::Job& job, const std::string& step);

/// Nothing of this job may be written into, or measured on, another machine than the one it was made on: neither the
/// one that was tested last nor the one of its warm-up run. data_does_not_fit with both serial numbers.
Status same_machine(const commissioning::Job& job, const std::string& step, std::uint32_t connected_serial);

/// Largest |value| and rms of each error channel, by direction ("Z" for dZ_um); directions never measured are left out.
struct ErrorSize {
  double peak_um = 0.0;
  double rms_um = 0.0;
  long long row = -1;  // of the peak
};
/// A channel that `axes` names is of that direction.
std::map<std::string, ErrorSize> error_sizes(const recording::Recording& run,
                                             const std::map<std::string, std::string>& axes = {});

/// The axis of each displacement that is not called by it, as the map of an imported run says (body of the artefact
/// "warmup").
std::map<std::string, std::string> assigned_axes(const nlohmann::json& warmup);
/// What an assigned axis is called in a table: "dZ_um" for Z; the channel's own name where none is assigned.
std::string error_by_axis(const std::string& channel, const std::map<std::string, std::string>& axes);

}  // namespace zerodrift::flow
