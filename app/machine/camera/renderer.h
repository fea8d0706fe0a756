#pragma once
// The picture that one camera of the virtual machine sees, computed from formulas: every edge is an error function of
// its signed distance (a sharp edge blurred by a Gaussian point spread), evaluated where each pixel looks. Nothing is
// resampled, so a displacement of the target is exact to the rounding of the grey levels.
// In the picture: the target on the spindle (a light square plate of 1.8 mm with dark rings and a cross-hair) and, on
// the table, two fixed marks (square plates with a ring and two dark quadrants), all in front of a plain dark ground.

#include <cstdint>
#include <vector>

#include "app/machine/camera/view.h"
#include "core/vision/image.h"

namespace zerodrift::machine {

struct RenderSwitches {
  bool noise = true;
  bool lamp_drift = true;
  bool occluded = false;       // a chip covers the larger part of the spindle target
  bool mark_occluded = false;  // another one lies on the right one of the marks
};

class CameraRenderer {
 public:
  explicit CameraRenderer(const ViewOptions& options);

  const ViewOptions& options() const { return m_options; }
  /// Grey levels before rounding and saturation, row by row; the same for the same arguments.
  std::vector<float> render_levels(const CameraScene& scene, std::uint64_t frame, RenderSwitches switches = {}) const;
  vision::GrayImage render(const CameraScene& scene, std::uint64_t frame, RenderSwitches switches = {}) const;

 private:
  ViewOptions m_options;
  std::vector<float> m_light;  // grey levels of a white surface, vignetting and slope included
  std::array<ObjectPosition, 2> m_marks;
};

}  // namespace zerodrift::machine
