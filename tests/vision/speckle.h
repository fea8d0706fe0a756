#pragma once
// A speckle target whose pixels are exact integrals: Gaussian dots integrated over each pixel with the error function,
// so that a shift of any size is exact to the precision of a double. Nothing of core/vision is used.

#include <cmath>
#include <random>
#include <vector>

#include "core/vision/image.h"

namespace zerodrift::testing {

struct Speckle {
  struct Dot {
    double x, y, sigma, depth;
  };
  std::vector<Dot> dots;
  double paper = 190.0;

  explicit Speckle(unsigned seed, double centre_x = 320.0, double centre_y = 240.0, double size = 150.0) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-size / 2, size / 2), width(1.3, 2.4), depth(20.0, 110.0);
    const int count = static_cast<int>(size * size / 55.0);
    for (int k = 0; k < count; ++k) {
      dots.push_back({centre_x + place(random), centre_y + place(random), width(random), depth(random)});
    }
  }
};

struct Pose {
  double dx = 0.0, dy = 0.0;  // of the pivot
  double rotation_rad = 0.0;  // about the pivot
  double pivot_x = 320.0, pivot_y = 240.0;
};

struct Light {
  double gain = 1.0, offset = 0.0, slope_x = 0.0;  // gain plane: gain + slope_x * (x - 320) / 320
  double noise = 0.0;                              // grey levels
  double blur_px = 0.0;                            // added in quadrature to every dot
  unsigned seed = 1;
};

inline vision::GrayImage render(const Speckle& speckle, const Pose& pose = {}, const Light& light = {}, int width = 640,
                                int height = 480) {
  std::vector<double> level(static_cast<std::size_t>(width) * height, speckle.paper);
  const double c = std::cos(pose.rotation_rad), s = std::sin(pose.rotation_rad);
  for (const Speckle::Dot& dot : speckle.dots) {
    const double rx = dot.x - pose.pivot_x, ry = dot.y - pose.pivot_y;
    const double x = pose.pivot_x + pose.dx + c * rx - s * ry, y = pose.pivot_y + pose.dy + s * rx + c * ry;
    const double sigma = std::hypot(dot.sigma, light.blur_px);
    const double peak = dot.depth * dot.sigma * dot.sigma / (sigma * sigma) * 2.0 * M_PI * sigma * sigma;
    const int reach = static_cast<int>(std::ceil(6.0 * sigma));
    const auto part = [&](double at, int pixel) {
      return 0.5 *
             (std::erf((pixel + 0.5 - at) / (sigma * M_SQRT2)) - std::erf((pixel - 0.5 - at) / (sigma * M_SQRT2)));
    };
    for (int py = std::max(0, static_cast<int>(y) - reach); py <= std::min(height - 1, static_cast<int>(y) + reach);
         ++py) {
      const double wy = peak * part(y, py);
      for (int px = std::max(0, static_cast<int>(x) - reach); px <= std::min(width - 1, static_cast<int>(x) + reach);
           ++px) {
        level[static_cast<std::size_t>(py) * width + px] -= wy * part(x, px) * 0.35;
      }
    }
  }
  std::mt19937 random(light.seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  vision::GrayImage image{width, height, std::vector<std::uint8_t>(level.size())};
  for (std::size_t k = 0; k < level.size(); ++k) {
    const double x = static_cast<double>(k % static_cast<std::size_t>(width));
    const double gain = light.gain + light.slope_x * (x - 320.0) / 320.0;
    const double value = gain * level[k] + light.offset + light.noise * noise(random);
    image.pixels[k] = static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
  }
  return image;
}

}  // namespace zerodrift::testing
