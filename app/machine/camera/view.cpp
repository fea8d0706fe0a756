#include "app/machine/camera/view.h"

#include <cmath>
#include <numbers>

namespace zerodrift::machine {

ViewOptions view_options(View view, std::uint64_t seed) {
  constexpr double degree = std::numbers::pi / 180.0;
  ViewOptions options;
  options.distortion_per_px2 = 0.001 / (400.0 * 400.0);
  if (view == View::front) {
    options.um_per_px = 12.0;
    options.rotation_rad = 2.3 * degree;
    options.seed = seed * 2;
  } else {
    options.um_per_px = 11.6;
    options.rotation_rad = -3.1 * degree;
    options.blur_px = 1.0;
    options.light_slope_per_px = -1.1e-4;
    options.distortion_per_px2 *= -0.8;
    options.seed = seed * 2 + 1;
  }
  return options;
}

ObjectFromPixel::ObjectFromPixel(const ViewOptions& view)
    : m_middle_x((view.width_px - 1) / 2.0),
      m_middle_y((view.height_px - 1) / 2.0),
      m_distortion_per_px2(view.distortion_per_px2),
      m_cos_um(std::cos(view.rotation_rad) * view.um_per_px),
      m_sin_um(std::sin(view.rotation_rad) * view.um_per_px) {}

ObjectPosition object_from_pixel(const ViewOptions& view, PixelPosition pixel) {
  return ObjectFromPixel(view)(pixel.x_px, pixel.y_px);
}

PixelPosition pixel_from_object(const ViewOptions& view, ObjectPosition position) {
  const double c = std::cos(view.rotation_rad) / view.um_per_px;
  const double s = std::sin(view.rotation_rad) / view.um_per_px;
  const double ideal_x = c * position.right_um - s * position.up_um;
  const double ideal_y = -s * position.right_um - c * position.up_um;
  double x = ideal_x;
  double y = ideal_y;
  for (int i = 0; i < 12; ++i) {  // contracts by 2 distortion r^2, some 1e-3 a round
    const double scale = 1.0 + view.distortion_per_px2 * (x * x + y * y);
    x = ideal_x / scale;
    y = ideal_y / scale;
  }
  return {x + (view.width_px - 1) / 2.0, y + (view.height_px - 1) / 2.0};
}

}  // namespace zerodrift::machine
