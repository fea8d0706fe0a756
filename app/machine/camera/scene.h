#pragma once
// What a camera of the virtual machine looks at: where the spindle's target stands in the view at one moment.
// Displacements are from the place the target has at the measuring position of a cold machine.

#include <functional>

namespace zerodrift::machine {

enum class View {
  front,  // right = X, up = Z
  side,   // right = Y, up = Z
};

struct CameraScene {
  double target_right_um = 0.0;  // axis motion from the measuring position (compensation included) + thermal error
  double target_up_um = 0.0;
  double roll_urad = 0.0;  // of the target about the viewing direction, counter-clockwise
  double machine_time_s = 0.0;
  double camera_drift_right_um = 0.0;  // how far the camera's own bracket has moved: all plates shift against it
  double camera_drift_up_um = 0.0;
  double camera_roll_urad = 0.0;  // of the camera, counter-clockwise: its picture turns the other way about the middle
  double camera_scale_ppm = 0.0;  // by which its picture has grown about the middle
};

/// The machine's answer for one view, now. May be called from any thread.
using SceneSource = std::function<CameraScene(View)>;

}  // namespace zerodrift::machine
