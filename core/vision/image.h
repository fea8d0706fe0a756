#pragma once
// A grey image as the camera gives it: rows from the top, 8 bits a pixel. Pixel (x, y) covers the unit square around
// the point (x, y): x to the right, y down, (0, 0) is the centre of the first pixel.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace zerodrift::vision {

struct GrayImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;  // width * height, row by row

  bool empty() const { return width <= 0 || height <= 0; }
  std::uint8_t at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width + x]; }
  std::uint8_t& at(int x, int y) { return pixels[static_cast<std::size_t>(y) * width + x]; }
};

/// A rectangle of whole pixels.
struct Region {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;

  bool empty() const { return width <= 0 || height <= 0; }
  bool operator==(const Region&) const = default;
};

struct PixelPoint {
  double x_px = 0.0;
  double y_px = 0.0;
};

inline bool inside(const Region& region, const GrayImage& image) {
  return !region.empty() && region.x >= 0 && region.y >= 0 && region.width <= image.width - region.x &&
         region.height <= image.height - region.y;
}
inline PixelPoint centre_of(const Region& region) {
  return {region.x + (region.width - 1) / 2.0, region.y + (region.height - 1) / 2.0};
}

}  // namespace zerodrift::vision
