#pragma once
// Step "calibrate" (V1, V2): the latency of the cameras by a few moves; at rest, for each camera the template of the
// target and of the fixed marks, then the moves that give um per px. Makes the artefact "calibration":
//   {"source": "camera", "reference_target": true,
//    "cameras": [{"id", "axes", "roi", "reference_roi", "um_per_px", "rotation_deg", "rms_um", "positions",
//                 "latency": {"mean_s", "spread_s", "observations"}, "calibration": {...contract...},
//                 "device": {"kind", "vendor", "model", "serial", "exposure_us", "gain_db"}}]}
// "device" is who the camera is and how it was set, as far as it tells; a stream over the network has none.
// with one fixed mark "reference_roi": [x, y, w, h]; with several a list of such, and "takes_off": "shift" | "turn",
// what of the camera's own motion they take off (turn: shift, turn and scale).
// with the blobs "<camera>-template.png" and "<camera>-view-<n>.png" (the views teach the target's mask).

#include <array>
#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/base/task_context.h"
#include "core/commissioning/job.h"
#include "core/flow/devices.h"
#include "core/vision/calibration_run.h"
#include "core/vision/camera_identity.h"
#include "core/vision/error_view.h"

namespace zerodrift::flow {

struct CalibrationProgress {
  std::string camera;
  int done = 0;
  int of = 0;
  const vision::GrayImage* frame = nullptr;
  const vision::Location* location = nullptr;
};

struct CalibrateOptions {
  int per_side = 3;
  std::map<std::string, std::array<int, 4>> regions;             // of the target, by camera; absent: the profile's
  std::map<std::string, std::vector<std::array<int, 4>>> marks;  // fixed ones, by camera; absent: the profile's
  double span_mm = 0.0;                                          // of the positions; 0: the profile's
  bool keep_views = true;  // false: a job a fifth as large, in which the target's mask is not learned
  std::function<void(const CalibrationProgress&)> watcher;
  /// Asked before each sequence of moves, with the camera it is for; it may wait for a person. An error ends the step
  /// with nothing moved any more. Absent: whoever starts the step has agreed to all of them (command line).
  std::function<Status(const std::string& camera, const TaskContext&)> may_move;
};

/// The fixed marks of a camera in the artefact; may be none.
std::vector<std::array<int, 4>> marks_of(const nlohmann::json& camera);
/// What marks in these regions take off of the camera's own motion.
vision::TakenOff taken_off_by(const std::vector<std::array<int, 4>>& marks);

/// What the artefact keeps of a camera's identity; null of one that tells nothing.
nlohmann::json device_json(const vision::CameraIdentity& identity);
/// Whether `now` is the camera that `kept` describes, set alike. What one of both does not tell is not compared, but
/// for a serial number that was told when it was calibrated. calibration_of_another_camera.
Status same_device(const std::string& camera, const nlohmann::json& kept, const vision::CameraIdentity& now);

/// Moves the machine. Refused while it is compensating: the moves would be falsified.
Result<commissioning::NewArtefact> calibrate(const commissioning::Job& job, Devices& devices,
                                             const CalibrateOptions& options, const TaskContext& context);

/// The views of the job's latest calibration on the open cameras. A camera that tells its serial number or its exposure
/// is asked whether it is the calibrated one: calibration_of_another_camera.
Result<std::vector<vision::ErrorView>> calibrated_views(const commissioning::Job& job, Devices& devices);

}  // namespace zerodrift::flow
