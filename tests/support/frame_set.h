#pragma once
// Sessions of frames as a camera at a machine would record them: a template, calibration views at recorded machine
// positions, and frames with one kind of disturbance, each with its exact truth. The same seed gives the same bytes.

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/frame_renderer.h"

namespace zerodrift::test_support {

enum class Disturbance {
  clean,
  noise,
  light,
  rotation,
  defocus,
  occluded,
  glare,
  motion_blur,
  large_motion,
  missing,
  wrong_target,
  camera_drift,
};
inline constexpr std::array<Disturbance, 12> disturbances = {
    Disturbance::clean,        Disturbance::noise,    Disturbance::light,        Disturbance::rotation,
    Disturbance::defocus,      Disturbance::occluded, Disturbance::glare,        Disturbance::motion_blur,
    Disturbance::large_motion, Disturbance::missing,  Disturbance::wrong_target, Disturbance::camera_drift};
std::string name_of(Disturbance disturbance);

struct PixelRegion {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
  Vector2 centre() const { return {x + (width - 1) / 2.0, y + (height - 1) / 2.0}; }
};

/// A calibration image: the controller says `recorded_um`, the target stands where `spec` says (repeatability 1 um).
struct CalibrationView {
  Vector2 recorded_um;
  FrameSpec spec;
};

struct FrameTruth {
  bool valid = true;              // the target is there and is the right one
  Vector2 shift_px;               // of the session's point in the picture since the template
  Vector2 shift_um;               // of the same material point along the machine's axes, without the camera's movement
  std::vector<Vector2> marks_px;  // shift of each fixed mark's centre in the picture
};

struct Session {
  PatternKind kind;
  Disturbance disturbance;
  std::uint64_t seed;
  FrameRenderer renderer;
  PixelRegion roi;
  Vector2 point_px;  // whose displacement is asked: the centre of the region
  std::vector<PixelRegion> mark_rois;
  FrameSpec template_spec;
  std::vector<FrameSpec> frames;
  std::vector<CalibrationView> grid_views;      // 3 x 3
  std::vector<CalibrationView> two_move_views;  // home, right, up
};

/// The calibration's positions reach `half_span_px` from the middle; 0: as far as the calibrate page proposes, 0.8 mm
/// or half as much again as the drift.
Session make_session(PatternKind kind, Disturbance disturbance, std::uint64_t seed, int frame_count,
                     double half_span_px = 0.0);
FrameTruth truth_of(const Session& session, const FrameSpec& spec);

/// Smallest standard deviation per axis, in px, that an unbiased estimate of the shift of this frame against the
/// template can have: Cramer-Rao bound with gain and offset unknown and the noise of both pictures counted.
Vector2 cramer_rao_px(const Session& session, const FrameSpec& spec);

}  // namespace zerodrift::test_support
