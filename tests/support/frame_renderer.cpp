#include "tests/support/frame_renderer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/noise.h"
#include "tests/support/blurred_edge.h"

namespace zerodrift::test_support {
namespace {

Vector2 turned(Vector2 v, double angle_rad) {
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  return {c * v.x - s * v.y, s * v.x + c * v.y};
}

bool stands_still(const CameraShift& shift) {
  return shift.shift_px.x == 0.0 && shift.shift_px.y == 0.0 && shift.roll_rad == 0.0 && shift.scale == 1.0;
}

double gaussian(double squares, double sigma) {
  return std::exp(-0.5 * squares / (sigma * sigma));
}

void add_light(const Camera& camera, const Light& light, std::vector<double>& levels) {
  std::size_t index = 0;
  for (int row = 0; row < camera.height_px; ++row) {
    for (int column = 0; column < camera.width_px; ++column, ++index) {
      const double x = column - (camera.width_px - 1) / 2.0;
      const double y = row - (camera.height_px - 1) / 2.0;
      const double squares = x * x + y * y;
      const double lit =
          light.gain * (1.0 + light.slope_per_px.x * x + light.slope_per_px.y * y + light.curvature_per_px2 * squares);
      levels[index] =
          levels[index] * camera.white_level * (1.0 - camera.vignetting_per_px2 * squares) * std::max(lit, 0.0) +
          light.offset_levels;
    }
  }
}

void add_glare(const Camera& camera, const Glare& glare, std::vector<double>& levels) {
  std::size_t index = 0;
  for (int row = 0; row < camera.height_px; ++row) {
    for (int column = 0; column < camera.width_px; ++column, ++index) {
      const double x = column - glare.centre_px.x;
      const double y = row - glare.centre_px.y;
      const double squares = x * x + y * y;
      levels[index] += glare.core_levels * gaussian(squares, glare.core_sigma_px) +
                       glare.halo_levels * gaussian(squares, glare.halo_sigma_px);
    }
  }
}

void cover(const Camera& camera, const Chip& chip, std::vector<double>& levels) {
  std::size_t index = 0;
  for (int row = 0; row < camera.height_px; ++row) {
    for (int column = 0; column < camera.width_px; ++column, ++index) {
      const double away = std::hypot(column - chip.centre_px.x, row - chip.centre_px.y) - chip.radius_px;
      levels[index] += (1.0 - edge(away, 1.5)) * (chip.reflectance - levels[index]);
    }
  }
}

}  // namespace

ObjectFromPixel::ObjectFromPixel(const Camera& camera, const CameraShift& shift)
    : m_camera(camera),
      m_shift(shift),
      m_cos(std::cos(camera.rotation_rad + shift.roll_rad)),
      m_sin(std::sin(camera.rotation_rad + shift.roll_rad)) {}

Vector2 ObjectFromPixel::operator()(double x_px, double y_px) const {
  double x = x_px - (m_camera.width_px - 1) / 2.0;
  double y = y_px - (m_camera.height_px - 1) / 2.0;
  // The lens is defined from the picture outwards: exact for every pixel without iteration.
  const double stretch = 1.0 + m_camera.distortion_per_px2 * (x * x + y * y);
  x = (x * stretch - m_shift.shift_px.x) / m_shift.scale * m_camera.um_per_px;
  y = (m_shift.shift_px.y - y * stretch) / m_shift.scale * m_camera.um_per_px;  // now up
  const double up = -m_sin * x + m_cos * y;
  const double right = m_cos * x + m_sin * y - m_camera.shear * up;
  return {m_camera.mirrored ? -right : right, up * m_camera.aspect};
}

FrameRenderer::FrameRenderer(Camera camera, Stage stage) : m_camera(camera), m_stage(std::move(stage)) {
  m_background = background({});
}

Vector2 FrameRenderer::object_from_pixel(Vector2 pixel, const CameraShift& shift) const {
  return ObjectFromPixel(m_camera, shift)(pixel.x, pixel.y);
}

Vector2 FrameRenderer::pixel_from_object(Vector2 object_um, const CameraShift& shift) const {
  const double up = object_um.y / m_camera.aspect;
  const double right = (m_camera.mirrored ? -object_um.x : object_um.x) + m_camera.shear * up;
  const Vector2 seen = turned({right, up}, m_camera.rotation_rad + shift.roll_rad);
  const double ideal_x = seen.x / m_camera.um_per_px * shift.scale + shift.shift_px.x;
  const double ideal_y = -seen.y / m_camera.um_per_px * shift.scale + shift.shift_px.y;
  double x = ideal_x;
  double y = ideal_y;
  for (int i = 0; i < 15; ++i) {
    const double stretch = 1.0 + m_camera.distortion_per_px2 * (x * x + y * y);
    x = ideal_x / stretch;
    y = ideal_y / stretch;
  }
  return {x + (m_camera.width_px - 1) / 2.0, y + (m_camera.height_px - 1) / 2.0};
}

Vector2 FrameRenderer::target_point_seen(Vector2 pixel, const FrameSpec& spec) const {
  const Vector2 at_home = object_from_pixel(pixel);
  const Vector2 arm = turned({at_home.x - m_stage.home_um.x, at_home.y - m_stage.home_um.y}, spec.target.rotation_rad);
  return pixel_from_object(
      {m_stage.home_um.x + spec.target.shift_um.x + arm.x, m_stage.home_um.y + spec.target.shift_um.y + arm.y},
      spec.camera);
}

/// The machine behind the target, out of focus: broad soft spots that stay where they are.
std::vector<double> FrameRenderer::background(const CameraShift& shift) const {
  struct Spot {
    Vector2 place_um;
    double sigma_um;
    double height;
  };
  Noise noise(m_camera.background_seed);
  std::vector<Spot> spots(30);
  for (Spot& spot : spots) {
    spot = {{m_camera.um_per_px * noise.uniform(-330.0, 330.0), m_camera.um_per_px * noise.uniform(-250.0, 250.0)},
            m_camera.um_per_px * noise.uniform(9.0, 45.0),
            noise.uniform(-0.09, 0.12)};
  }
  std::vector<double> out(static_cast<std::size_t>(m_camera.width_px) * m_camera.height_px);
  const ObjectFromPixel seen_at(m_camera, shift);
  std::size_t index = 0;
  for (int row = 0; row < m_camera.height_px; ++row) {
    for (int column = 0; column < m_camera.width_px; ++column, ++index) {
      const Vector2 seen = seen_at(column, row);
      double sum = 0.42;
      for (const Spot& spot : spots) {
        const double x = seen.x - spot.place_um.x;
        const double y = seen.y - spot.place_um.y;
        const double squares = x * x + y * y;
        if (squares < 25.0 * spot.sigma_um * spot.sigma_um) sum += spot.height * gaussian(squares, spot.sigma_um);
      }
      out[index] = std::clamp(sum, 0.08, 0.8);
    }
  }
  return out;
}

/// Adds share * (what the pixels under the pattern gain over `under`).
void FrameRenderer::paint(const Pattern& pattern, Vector2 centre_um, double rotation_rad, const FrameSpec& spec,
                          double share, const std::vector<double>& under, std::vector<double>& out) const {
  const double sigma_um = (spec.blur_px > 0.0 ? spec.blur_px : m_camera.blur_px) * m_camera.um_per_px;
  const double limit_um = pattern.half_um() + 6.0 * sigma_um;
  const Vector2 middle = pixel_from_object(centre_um, spec.camera);
  const double reach_px = 1.5 * limit_um / m_camera.um_per_px + 2.0;
  const auto bounded = [](double value, int size) { return std::clamp(static_cast<int>(value), 0, size); };
  const ObjectFromPixel seen_at(m_camera, spec.camera);
  const double c = std::cos(rotation_rad);
  const double s = std::sin(rotation_rad);
  const int x1 = bounded(middle.x + reach_px, m_camera.width_px);
  const int y1 = bounded(middle.y + reach_px, m_camera.height_px);
  for (int row = bounded(middle.y - reach_px, m_camera.height_px); row < y1; ++row) {
    for (int column = bounded(middle.x - reach_px, m_camera.width_px); column < x1; ++column) {
      const Vector2 seen = seen_at(column, row);
      const double right = seen.x - centre_um.x;
      const double up = seen.y - centre_um.y;
      const Vector2 on{c * right + s * up, -s * right + c * up};
      if (std::abs(on.x) > limit_um || std::abs(on.y) > limit_um) continue;
      const std::size_t index = static_cast<std::size_t>(row) * m_camera.width_px + column;
      const Paint paint = pattern.at(on.x, on.y, sigma_um, spec.light.lamp);
      out[index] += share * paint.coverage * (paint.reflectance - under[index]);
    }
  }
}

std::vector<double> FrameRenderer::levels(const FrameSpec& spec) const {
  std::vector<double> under = stands_still(spec.camera) ? m_background : background(spec.camera);
  for (const FixedMark& mark : m_stage.marks) {
    std::vector<double> with_mark = under;
    paint(mark.pattern, mark.place_um, 0.0, spec, 1.0, under, with_mark);
    under = std::move(with_mark);
  }
  std::vector<double> out = under;
  if (spec.target_present) {
    const double smear_px = std::hypot(spec.smear_um.x, spec.smear_um.y) / m_camera.um_per_px;
    // Moments of the exposure a third of a pixel apart: far below the blur, so their mean is the integral.
    const int moments = smear_px > 0.0 ? std::max(3, static_cast<int>(std::ceil(3.0 * smear_px))) : 1;
    for (int i = 0; i < moments; ++i) {
      const double part = (i + 0.5) / moments - 0.5;
      const Vector2 centre{m_stage.home_um.x + spec.target.shift_um.x + part * spec.smear_um.x,
                           m_stage.home_um.y + spec.target.shift_um.y + part * spec.smear_um.y};
      paint(spec.other_target ? *spec.other_target : m_stage.target, centre, spec.target.rotation_rad, spec,
            1.0 / moments, under, out);
    }
  }
  for (const Chip& chip : spec.chips) cover(m_camera, chip, out);
  add_light(m_camera, spec.light, out);
  if (spec.glare) add_glare(m_camera, *spec.glare, out);
  return out;
}

Frame FrameRenderer::render(const FrameSpec& spec) const {
  const std::vector<double> clean = levels(spec);
  Frame frame{m_camera.width_px, m_camera.height_px, std::vector<std::uint8_t>(clean.size())};
  Noise noise(spec.noise_seed * 0x9E3779B97F4A7C15ULL + 12345);
  for (std::size_t i = 0; i < clean.size(); ++i) {
    const double sensed = clean[i] + noise.normal() * std::sqrt(spec.noise.variance(clean[i]));
    frame.pixels[i] = static_cast<std::uint8_t>(std::lround(std::clamp(sensed, 0.0, 255.0)));
  }
  return frame;
}

}  // namespace zerodrift::test_support
