#include "tests/support/pattern.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/noise.h"
#include "tests/support/blurred_edge.h"

namespace zerodrift::test_support {
namespace {

constexpr double paper = 0.86;
constexpr double ink = 0.08;
constexpr int code_cells = 9;
constexpr double widest_blur_px = 4.0;  // for which the speckle's neighbourhood is complete

double either(double a, double b) {
  return a + b - a * b;
}

}  // namespace

std::string name_of(PatternKind kind) {
  switch (kind) {
    case PatternKind::rings:
      return "rings";
    case PatternKind::circle_grid:
      return "circle_grid";
    case PatternKind::cross_hair:
      return "cross_hair";
    case PatternKind::checkerboard:
      return "checkerboard";
    case PatternKind::siemens_star:
      return "siemens_star";
    case PatternKind::speckle:
      return "speckle";
    case PatternKind::ball:
      return "ball";
    case PatternKind::code:
      return "code";
    case PatternKind::mark:
      break;
  }
  return "mark";
}

Pattern::Pattern(PatternKind kind, double half_um, std::uint64_t seed) : m_kind(kind), m_half_um(half_um), m_count(0) {
  Noise noise(seed * 7919 + static_cast<std::uint64_t>(kind));
  m_proportion = noise.uniform(0.9, 1.1);
  m_count =
      kind == PatternKind::siemens_star ? 14 + static_cast<int>(noise.index(8)) : 7 + static_cast<int>(noise.index(2));
  if (kind == PatternKind::speckle) scatter_bumps(seed);
  if (kind == PatternKind::code) {
    m_black.resize(static_cast<std::size_t>(code_cells) * code_cells);
    for (std::uint8_t& cell : m_black) cell = noise.uniform() < 0.5;
  }
}

Paint Pattern::at(double x, double y, double sigma, const LampDirection& lamp) const {
  if (m_kind == PatternKind::ball) {
    // What is blurred is the shaded disc: its brightness at the middle of what the blur gathers from within the
    // outline.
    const double r = std::hypot(x, y);
    const double away = (r - 0.95 * m_half_um) / sigma;
    const double coverage = 1.0 - edge(away, 1.0);
    const double density = std::exp(-0.5 * away * away) / std::sqrt(2.0 * std::numbers::pi);
    const double inwards = coverage > 1e-9 ? std::min(sigma * density / coverage / std::max(r, sigma), 1.0) : 0.0;
    return {coverage, ball((1.0 - inwards) * x, (1.0 - inwards) * y, sigma, lamp)};
  }
  const double coverage = band(x, -m_half_um, m_half_um, sigma) * band(y, -m_half_um, m_half_um, sigma);
  if (coverage <= 0.0) return {0.0, 0.0};
  double dark = 0.0;
  switch (m_kind) {
    case PatternKind::rings:
      dark = rings(x, y, sigma);
      break;
    case PatternKind::circle_grid:
      dark = circle_grid(x, y, sigma);
      break;
    case PatternKind::cross_hair:
      dark = cross_hair(x, y, sigma);
      break;
    case PatternKind::checkerboard:
      dark = checkerboard(x, y, sigma);
      break;
    case PatternKind::siemens_star:
      dark = siemens_star(x, y, sigma);
      break;
    case PatternKind::code:
      dark = code(x, y, sigma);
      break;
    case PatternKind::speckle:
      return {coverage, speckle(x, y, sigma)};
    case PatternKind::mark:
    case PatternKind::ball:
      dark = mark(x, y, sigma);
      break;
  }
  return {coverage, paper + (ink - paper) * dark};
}

double Pattern::rings(double x, double y, double sigma) const {
  const double r = std::hypot(x, y) / m_half_um;
  const double blur = sigma / m_half_um;
  const double step = 0.235 * m_proportion;
  double dark = 1.0 - edge(r - 0.09, blur);
  for (int i = 1; i <= 3; ++i) dark += band(r, step * i, step * i + 0.11, blur);
  return dark;
}

double Pattern::circle_grid(double x, double y, double sigma) const {
  const double pitch = 0.26 * m_half_um * std::min(m_proportion, 1.04);
  const double column = std::clamp(std::round(x / pitch), -3.0, 3.0);
  const double row = std::clamp(std::round(y / pitch), -2.0, 2.0);
  return 1.0 - edge(std::hypot(x - column * pitch, y - row * pitch) - 0.33 * pitch, sigma);
}

double Pattern::cross_hair(double x, double y, double sigma) const {
  const double thin = 0.03 * m_half_um;
  const double reach = 0.88 * m_half_um;
  double dark = either(band(x, -thin, thin, sigma) * band(y, -reach, reach, sigma),
                       band(y, -thin, thin, sigma) * band(x, -reach, reach, sigma));
  const double pitch = 0.24 * m_half_um * m_proportion;
  const double tick = 0.09 * m_half_um;
  for (const double side : {-1.0, 1.0}) {
    for (int i = 1; i <= 3; ++i) {
      const double place = side * i * pitch;
      dark = either(dark, band(x, place - thin, place + thin, sigma) * band(y, -tick, tick, sigma));
      dark = either(dark, band(y, place - thin, place + thin, sigma) * band(x, -tick, tick, sigma));
    }
  }
  return dark;
}

double Pattern::checkerboard(double x, double y, double sigma) const {
  const double square = 0.215 * m_half_um * std::min(m_proportion, 1.04);
  const auto wave = [&](double t, int squares) {
    double value = -1.0;
    for (int i = 0; i <= squares; ++i) {
      value += (i % 2 == 0 ? 2.0 : -2.0) * edge(t - (i - squares / 2.0) * square, sigma);
    }
    return value;
  };
  const double wide = m_count * square / 2.0;
  const double high = (m_count - 1) * square / 2.0;
  const double board = band(x, -wide, wide, sigma) * band(y, -high, high, sigma);
  return board * 0.5 * (1.0 + wave(x, m_count) * wave(y, m_count - 1));
}

double Pattern::siemens_star(double x, double y, double sigma) const {
  const double r = std::hypot(x, y);
  const double distance = r * std::sin(m_count * std::atan2(y, x)) / m_count;  // to the nearest spoke's edge
  return edge(distance, sigma) * (1.0 - edge(r - 0.86 * m_half_um * std::min(m_proportion, 1.05), sigma));
}

double Pattern::mark(double x, double y, double sigma) const {
  const double r = std::hypot(x, y) / m_half_um;
  const double blur = sigma / m_half_um;
  const double right = edge(x, sigma);
  const double up = edge(y, sigma);
  return (1.0 - edge(r - 0.6, blur)) * (right * up + (1.0 - right) * (1.0 - up)) + band(r, 0.74, 0.88, blur);
}

double Pattern::code(double x, double y, double sigma) const {
  const double cell = 2.0 * 0.84 * m_half_um * std::min(m_proportion, 1.05) / code_cells;
  const double edge_um = 0.5 * code_cells * cell;
  const int reach = static_cast<int>(std::ceil(6.0 * sigma / cell));
  const int column = static_cast<int>(std::floor((x + edge_um) / cell));
  const int row = static_cast<int>(std::floor((y + edge_um) / cell));
  double dark = 0.0;
  for (int j = std::max(0, row - reach); j <= std::min(code_cells - 1, row + reach); ++j) {
    const double high = band(y, j * cell - edge_um, (j + 1) * cell - edge_um, sigma);
    for (int i = std::max(0, column - reach); i <= std::min(code_cells - 1, column + reach); ++i) {
      if (m_black[static_cast<std::size_t>(j) * code_cells + i] == 0) continue;
      dark += high * band(x, i * cell - edge_um, (i + 1) * cell - edge_um, sigma);
    }
  }
  return dark;
}

void Pattern::scatter_bumps(std::uint64_t seed) {
  Noise noise(seed + 104729);
  const double px = m_half_um / 90.0;  // a target of +-90 px; grains of 1.6 to 3.2 px
  m_cells_a_side = 18;
  m_cells.resize(static_cast<std::size_t>(m_cells_a_side) * m_cells_a_side);
  const double cell = 2.0 * m_half_um / m_cells_a_side;
  for (int i = 0; i < 1500; ++i) {
    const Bump bump{noise.uniform(-m_half_um, m_half_um), noise.uniform(-m_half_um, m_half_um),
                    px * noise.uniform(1.6, 3.2), noise.uniform() < 0.5 ? -0.22 : 0.22};
    const double reach = 4.5 * std::hypot(bump.sigma_um, widest_blur_px * px);
    const auto index = [&](double t) {
      return std::clamp(static_cast<int>((t + m_half_um) / cell), 0, m_cells_a_side - 1);
    };
    for (int row = index(bump.y_um - reach); row <= index(bump.y_um + reach); ++row) {
      for (int column = index(bump.x_um - reach); column <= index(bump.x_um + reach); ++column) {
        m_cells[static_cast<std::size_t>(row) * m_cells_a_side + column].push_back(bump);
      }
    }
  }
}

double Pattern::speckle(double x, double y, double sigma) const {
  const double cell = 2.0 * m_half_um / m_cells_a_side;
  const auto index = [&](double t) {
    return std::clamp(static_cast<int>((t + m_half_um) / cell), 0, m_cells_a_side - 1);
  };
  double sum = 0.47;
  for (const Bump& bump : m_cells[static_cast<std::size_t>(index(y)) * m_cells_a_side + index(x)]) {
    const double variance = bump.sigma_um * bump.sigma_um + sigma * sigma;
    const double squares = (x - bump.x_um) * (x - bump.x_um) + (y - bump.y_um) * (y - bump.y_um);
    if (squares > 20.25 * variance) continue;  // 4.5 sigma: 4e-5 of the bump is cut off
    sum += bump.height * (bump.sigma_um * bump.sigma_um / variance) * std::exp(-0.5 * squares / variance);
  }
  return sum;
}

// The sphere's mirror image of the lamp and of a bright sky, blurred: Gaussians stay Gaussians.
double Pattern::ball(double x, double y, double sigma, const LampDirection& lamp) const {
  const double nx = x / (0.95 * m_half_um);
  const double ny = y / (0.95 * m_half_um);
  const double blur2 = std::pow(sigma / (0.95 * m_half_um), 2);
  const double sky = 0.06 + 0.07 * (1.0 + ny) + 0.04 * (nx * nx + blur2);
  const auto lobe = [&](double cx, double cy, double width, double height) {
    const double variance = width * width + blur2;
    const double squares = (nx - cx) * (nx - cx) + (ny - cy) * (ny - cy);
    return height * width * width / variance * std::exp(-0.5 * squares / variance);
  };
  return sky + lobe(lamp.x, lamp.y, 0.055, 0.65) + lobe(lamp.x, lamp.y, 0.18, 0.12) +
         lobe(-0.9 * lamp.x, -0.8 * lamp.y, 0.10, 0.08);
}

}  // namespace zerodrift::test_support
