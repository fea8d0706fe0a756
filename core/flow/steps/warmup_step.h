#pragma once
// Step "warm-up" (R2, R3): records the uncompensated run, or goes on with one that was broken off. Makes the artefact
// "warmup":
//   {"series", "plan", "source", "zero_um", "rows", "lost_samples", "measurements", "refused", "gaps", "duration_s",
//    "peak_um": {"X", ...}, "happened": [{"name", "what", "count", "overcome"}], "problems": [in words]}

#include <functional>
#include <nlohmann/json_fwd.hpp>

#include "core/acquisition/recorder.h"
#include "core/base/task_context.h"
#include "core/commissioning/job.h"
#include "core/flow/devices.h"

namespace zerodrift::flow {

struct RunOptions {
  acquisition::Plan plan;       // without a measuring position the profile's counts
  bool refuse_too_few = false;  // a run that will end with too few measurements ends in its first tenth
  bool anew = false;            // a run that was broken off is closed as aborted instead of gone on with
  std::function<void(const acquisition::RunUpdate&)> observer;
  /// Told the control of the run when it starts, and null when it has ended.
  std::function<void(acquisition::RunControl*)> control;
  /// Told the camera source, for the picture; null at the end.
  std::function<void(vision::CameraErrorSource*)> cameras;
};

Result<commissioning::NewArtefact> record_warmup(commissioning::Job& job, Devices& devices, const RunOptions& options,
                                                 const TaskContext& context);

/// The interrupted warm-up run as far as it went, without its machine: the series is closed and what it holds is the
/// artefact. Whether the spindle stands is for somebody at the machine to see. warmup blocked: nothing was interrupted.
Result<commissioning::NewArtefact> end_interrupted_warmup(commissioning::Job& job);

/// What warm-up and verification share: runs the recorder into the job and describes what was recorded.
struct RecordedRun {
  commissioning::SeriesId series = 0;
  acquisition::RunSummary summary;
  nlohmann::json body() const;
  std::string source;
  std::optional<std::array<double, 3>> zero_um;
  acquisition::Plan plan;
  std::vector<acquisition::Happening> happened;
  std::vector<controller::DeviceState> devices;  // beside the control
};
/// The run of this name that was broken off, as far as it is on the disk; nothing when the last one was ended.
Result<std::optional<RecordedRun>> interrupted_recording(const commissioning::Job& job, const std::string& name);
Result<std::optional<RecordedRun>> interrupted_warmup(const commissioning::Job& job);

Result<RecordedRun> record_run(commissioning::Job& job, Devices& devices, const RunOptions& options,
                               acquisition::RecorderOptions recorder_options, const TaskContext& context);

}  // namespace zerodrift::flow
