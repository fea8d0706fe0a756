#pragma once
// What several steps read from a job: the latest artefact of a kind as JSON, the run it names.

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
std::map<std::string, ErrorSize> error_sizes(const recording::Recording& run);

}  // namespace zerodrift::flow
