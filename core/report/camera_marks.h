#pragma once
// What the fixed marks beside the target took off of the cameras' own motion, as the calibration tells it.

#include <nlohmann/json_fwd.hpp>

namespace zerodrift::report {

struct CameraMarks {
  enum class TakenOff {
    nothing,
    shift,
    shift_turn_scale,
  };
  TakenOff taken_off = TakenOff::nothing;  // in every view
  double distance_mm = 0.0;                // largest, of the target from its marks; NaN: not known
};

CameraMarks camera_marks(const nlohmann::json& calibration);

}  // namespace zerodrift::report
