#pragma once
// One camera: scale, rotation, lens, focus, light and sensor. Pixel (x, y) is centred on (x, y): x right, y down.

#include <array>
#include <cstdint>
#include <string_view>

#include "app/machine/camera/scene.h"

namespace zerodrift::machine {

inline constexpr int view_count = 2;

constexpr std::string_view name_of(View view) {
  return view == View::front ? "front" : "side";
}

struct PixelPosition {
  double x_px = 0.0;
  double y_px = 0.0;
};

/// In the plane of the targets, from the point that the middle of the image sees.
struct ObjectPosition {
  double right_um = 0.0;
  double up_um = 0.0;
};

struct ViewOptions {
  int width_px = 640;
  int height_px = 480;
  double um_per_px = 12.0;
  double rotation_rad = 0.0;           // the picture's content appears turned counter-clockwise by this
  double distortion_per_px2 = 0.0;     // undistorted radius = radius (1 + distortion_per_px2 radius^2)
  double blur_px = 0.9;                // sigma of the point spread on the spindle target, lens and pixel area together
  double reference_blur_px = 1.15;     // the table's target stands a little out of focus
  double vignetting_per_px2 = 7.5e-7;  // light lost with the squared distance from the middle
  double light_slope_per_px = 1.5e-4;  // brighter to the right
  double gain_electrons_per_level = 40.0;  // 10 000 electrons fill 255 levels
  double read_noise_levels = 0.6;
  double lamp_drift = 0.02;  // amplitude of the lamp's slow brightness change
  std::uint64_t seed = 1;
  std::array<PixelPosition, 2> reference_marks_px = {{{99.5, 359.5}, {539.5, 359.5}}};  // where they are without drift
};

/// The two cameras of the machine: a few degrees of rotation, scales that differ, 0.1 % distortion at 400 px.
ViewOptions view_options(View view, std::uint64_t seed);

/// From the picture to the plane of the targets; the lens is defined in this direction, so it is exact for a pixel.
class ObjectFromPixel {
 public:
  explicit ObjectFromPixel(const ViewOptions& view);
  ObjectPosition operator()(double x_px, double y_px) const {
    const double x = x_px - m_middle_x;
    const double y = y_px - m_middle_y;
    const double stretch = 1.0 + m_distortion_per_px2 * (x * x + y * y);
    return {(m_cos_um * x - m_sin_um * y) * stretch, -(m_sin_um * x + m_cos_um * y) * stretch};
  }

 private:
  double m_middle_x;
  double m_middle_y;
  double m_distortion_per_px2;
  double m_cos_um;
  double m_sin_um;
};

ObjectPosition object_from_pixel(const ViewOptions& view, PixelPosition pixel);
PixelPosition pixel_from_object(const ViewOptions& view, ObjectPosition position);

}  // namespace zerodrift::machine
