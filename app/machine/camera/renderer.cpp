#include "app/machine/camera/renderer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "app/machine/camera/sensor_noise.h"

namespace zerodrift::machine {
namespace {

constexpr double white_level = 238.0;  // grey levels of a perfect diffuser in the middle of the picture
constexpr double ground = 0.20;        // reflectances
constexpr double plate = 0.86;
constexpr double ink = 0.07;
constexpr double chip = 0.13;

constexpr double target_half_um = 900.0;
constexpr double mark_half_um = 620.0;

constexpr double edge_reach = 6.0;  // sigma; 1e-9 of the contrast is left out
constexpr int edge_steps = 512;     // a sigma: a straight line between two of them is right to 1e-7 of the contrast

std::vector<double> make_edge_profile() {
  std::vector<double> profile;
  for (int i = 0; i <= 2 * static_cast<int>(edge_reach) * edge_steps + 1; ++i) {
    profile.push_back(0.5 * std::erfc((edge_reach - static_cast<double>(i) / edge_steps) / std::numbers::sqrt2));
  }
  return profile;
}

const std::vector<double> edge_profile = make_edge_profile();

/// A half plane's edge at distance d, blurred by a Gaussian: 0 far below, 1 far above.
double edge(double d, double sigma) {
  if (d > edge_reach * sigma) return 1.0;
  if (d < -edge_reach * sigma) return 0.0;
  const double at = (d / sigma + edge_reach) * edge_steps;
  const auto below = static_cast<int>(at);
  return edge_profile[below] + (at - below) * (edge_profile[below + 1] - edge_profile[below]);
}

double distance(double x, double y) {
  return std::sqrt(x * x + y * y);
}

double band(double d, double low, double high, double sigma) {
  return edge(d - low, sigma) - edge(d - high, sigma);
}

double either(double a, double b) {
  return a + b - a * b;
}
double exactly_one(double a, double b) {
  return a + b - 2.0 * a * b;
}

double square(double x, double y, double half, double sigma) {
  return band(x, -half, half, sigma) * band(y, -half, half, sigma);
}

struct Paint {
  double coverage;     // of the plate over the ground
  double reflectance;  // of the plate at this place
};

Paint spindle_target(double x, double y, double sigma) {
  const double r = distance(x, y);
  const double rings = (1.0 - edge(r - 100.0, sigma)) + band(r, 250.0, 370.0, sigma) + band(r, 510.0, 620.0, sigma) +
                       band(r, 730.0, 820.0, sigma);
  const double across = band(y, -22.0, 22.0, sigma) * band(x, -820.0, 820.0, sigma);
  const double upright = band(x, -22.0, 22.0, sigma) * band(y, -820.0, 820.0, sigma);
  const double dark = exactly_one(rings, either(across, upright));
  return {square(x, y, target_half_um, sigma), plate + (ink - plate) * dark};
}

Paint reference_mark(double x, double y, double sigma) {
  const double r = distance(x, y);
  const double right = edge(x, sigma);
  const double up = edge(y, sigma);
  const double quadrants = right * up + (1.0 - right) * (1.0 - up);
  const double dark = (1.0 - edge(r - 380.0, sigma)) * quadrants + band(r, 470.0, 560.0, sigma);
  return {square(x, y, mark_half_um, sigma), plate + (ink - plate) * dark};
}

struct Placement {
  ObjectPosition centre;
  double roll_rad;
  double scale;
  double half_um;
  double sigma_um;
};

/// Calls at(pixel index, x, y) for every pixel that can see the plate; x, y in um on the plate.
template <class At>
void over_pixels(const ViewOptions& view, const Placement& place, At&& at) {
  const PixelPosition middle = pixel_from_object(view, place.centre);
  const double reach_px = 1.02 * (std::numbers::sqrt2 * place.half_um + 6.0 * place.sigma_um) / view.um_per_px + 1.0;
  const auto clamp_to = [](double value, int size) { return std::clamp(static_cast<int>(value), 0, size); };
  const int x0 = clamp_to(middle.x_px - reach_px, view.width_px);
  const int x1 = clamp_to(middle.x_px + reach_px + 1.0, view.width_px);
  const int y0 = clamp_to(middle.y_px - reach_px, view.height_px);
  const int y1 = clamp_to(middle.y_px + reach_px + 1.0, view.height_px);
  const double c = std::cos(place.roll_rad) / place.scale;
  const double s = std::sin(place.roll_rad) / place.scale;
  const ObjectFromPixel seen_by(view);
  const double limit_um = place.half_um + 6.0 * place.sigma_um;
  for (int row = y0; row < y1; ++row) {
    for (int column = x0; column < x1; ++column) {
      const ObjectPosition seen = seen_by(column, row);
      const double right = seen.right_um - place.centre.right_um;
      const double up = seen.up_um - place.centre.up_um;
      const double x = c * right + s * up;
      const double y = -s * right + c * up;
      if (std::abs(x) > limit_um || std::abs(y) > limit_um) continue;
      at(static_cast<std::size_t>(row) * view.width_px + column, x, y);
    }
  }
}

template <class Shape>
void draw(const ViewOptions& view, const Placement& place, Shape shape, std::vector<float>& reflectance) {
  over_pixels(view, place, [&](std::size_t index, double x, double y) {
    const Paint paint = shape(x, y, place.sigma_um);
    reflectance[index] =
        static_cast<float>(reflectance[index] + paint.coverage * (paint.reflectance - reflectance[index]));
  });
}

/// Where the camera sees what stands at this place: it has shifted, turned and changed its scale by itself.
ObjectPosition seen_from_bracket(const CameraScene& scene, const ObjectPosition& at) {
  const double scale = 1.0 + 1e-6 * scene.camera_scale_ppm;
  const double c = scale * std::cos(1e-6 * scene.camera_roll_urad);
  const double s = scale * std::sin(1e-6 * scene.camera_roll_urad);
  const double right = at.right_um - scene.camera_drift_right_um;
  const double up = at.up_um - scene.camera_drift_up_um;
  return {c * right + s * up, -s * right + c * up};
}

/// A dark lump with a soft edge that leaves less than half of the spindle target to be seen, and little of a mark.
Paint chip_on_target(double x, double y, double sigma) {
  const double r = distance((x - 140.0) / 1.15, y + 90.0);
  return {1.0 - edge(r - 720.0, 4.0 * sigma), chip};
}

struct Lamp {
  double level;
  double right_per_px;
  double down_per_px;
};

/// The lamp warms up and its light wanders a little: two slow swings, their phases by the seed.
Lamp lamp_at(const ViewOptions& view, double machine_time_s) {
  const double phase = static_cast<double>(view.seed % 1000) * 2.399963;  // the golden angle spreads neighbouring seeds
  const double slow = std::sin(2.0 * std::numbers::pi * machine_time_s / 5400.0 + phase);
  const double fast = std::sin(2.0 * std::numbers::pi * machine_time_s / 1300.0 + 2.0 * phase);
  return {1.0 + view.lamp_drift * (slow + 0.5 * fast), view.lamp_drift * 1e-3 * fast, view.lamp_drift * 1.5e-3 * slow};
}

}  // namespace

CameraRenderer::CameraRenderer(const ViewOptions& options)
    : m_options(options),
      m_light(static_cast<std::size_t>(m_options.width_px) * m_options.height_px),
      m_marks{object_from_pixel(m_options, m_options.reference_marks_px[0]),
              object_from_pixel(m_options, m_options.reference_marks_px[1])} {
  std::size_t index = 0;
  for (int row = 0; row < m_options.height_px; ++row) {
    for (int column = 0; column < m_options.width_px; ++column, ++index) {
      const double x = column - (m_options.width_px - 1) / 2.0;
      const double y = row - (m_options.height_px - 1) / 2.0;
      m_light[index] = static_cast<float>(white_level * (1.0 - m_options.vignetting_per_px2 * (x * x + y * y)) *
                                          (1.0 + m_options.light_slope_per_px * x));
    }
  }
}

std::vector<float> CameraRenderer::render_levels(const CameraScene& scene, std::uint64_t frame,
                                                 RenderSwitches switches) const {
  std::vector<float> levels(m_light.size(), static_cast<float>(ground));
  const double scale = 1.0 + 1e-6 * scene.camera_scale_ppm;
  const double mark_sigma_um = m_options.reference_blur_px * m_options.um_per_px;
  for (const ObjectPosition& mark : m_marks) {
    const ObjectPosition seen = seen_from_bracket(scene, mark);
    draw(m_options, {seen, -1e-6 * scene.camera_roll_urad, scale, mark_half_um, mark_sigma_um}, reference_mark, levels);
  }
  if (switches.mark_occluded) {
    const ObjectPosition seen = seen_from_bracket(scene, m_marks[1]);
    draw(m_options, {seen, 0.0, 1.0, 1.3 * target_half_um, mark_sigma_um}, chip_on_target, levels);
  }
  const ObjectPosition target = seen_from_bracket(scene, {scene.target_right_um, scene.target_up_um});
  const double sigma_um = m_options.blur_px * m_options.um_per_px;
  const double roll_rad = 1e-6 * (scene.roll_urad - scene.camera_roll_urad);
  draw(m_options, {target, roll_rad, scale, target_half_um, sigma_um}, spindle_target, levels);
  if (switches.occluded) draw(m_options, {target, 0.0, 1.0, 1.3 * target_half_um, sigma_um}, chip_on_target, levels);

  const Lamp lamp = switches.lamp_drift ? lamp_at(m_options, scene.machine_time_s) : Lamp{1.0, 0.0, 0.0};
  const auto slope = static_cast<float>(lamp.right_per_px);
  for (int row = 0; row < m_options.height_px; ++row) {
    const auto left_edge = static_cast<float>(lamp.level + lamp.down_per_px * (row - (m_options.height_px - 1) / 2.0) -
                                              lamp.right_per_px * (m_options.width_px - 1) / 2.0);
    float* level = &levels[static_cast<std::size_t>(row) * m_options.width_px];
    const float* light = &m_light[static_cast<std::size_t>(row) * m_options.width_px];
    for (int column = 0; column < m_options.width_px; ++column) {
      level[column] *= light[column] * (left_edge + slope * static_cast<float>(column));
    }
  }
  if (switches.noise) {
    add_sensor_noise(levels, m_options.read_noise_levels, m_options.gain_electrons_per_level,
                     m_options.seed * 0x9E3779B97F4A7C15ULL + frame * 0xD1B54A32D192ED03ULL);
  }
  return levels;
}

vision::GrayImage CameraRenderer::render(const CameraScene& scene, std::uint64_t frame, RenderSwitches switches) const {
  const std::vector<float> levels = render_levels(scene, frame, switches);
  vision::GrayImage image{m_options.width_px, m_options.height_px, std::vector<std::uint8_t>(levels.size())};
  std::transform(levels.begin(), levels.end(), image.pixels.begin(),
                 [](float level) { return static_cast<std::uint8_t>(std::clamp(level, 0.0F, 255.0F) + 0.5F); });
  return image;
}

}  // namespace zerodrift::machine
