#include "core/vision/picture_sketch.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace zerodrift::vision {
namespace {

// A picture at rest differs by its noise, which the mean over a cell takes down to a level or two; an edge that moves
// by a pixel changes its cells by a tenth of its contrast.
constexpr double least_difference = 4.0;  // grey levels
constexpr double noise_share = 2.0;       // of what pictures of the same differ by

}  // namespace

PictureSketch sketch_of(const GrayImage& image, Seconds stamp) {
  PictureSketch sketch;
  sketch.stamp = stamp;
  // OpenCV takes no const data; nothing is written to it.
  const cv::Mat whole(image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.pixels.data()));
  cv::Mat small(PictureSketch::rows, PictureSketch::columns, CV_8UC1, sketch.cells.data());
  cv::resize(whole, small, small.size(), 0.0, 0.0, cv::INTER_AREA);
  return sketch;
}

Region sketch_region(const Region& region, const GrayImage& image) {
  const auto down = [](int value, int cells, int pixels) { return value * cells / std::max(1, pixels); };
  const int left = std::max(0, down(region.x, PictureSketch::columns, image.width) - 1);
  const int top = std::max(0, down(region.y, PictureSketch::rows, image.height) - 1);
  const int right = down(region.x + region.width, PictureSketch::columns, image.width) + 2;
  const int bottom = down(region.y + region.height, PictureSketch::rows, image.height) + 2;
  return {left, top, std::min(right, PictureSketch::columns) - left, std::min(bottom, PictureSketch::rows) - top};
}

double difference(const PictureSketch& a, const PictureSketch& b, const Region& cells) {
  double sum_a = 0.0;
  double sum_b = 0.0;
  const auto each = [&](auto use) {
    for (int y = cells.y; y < cells.y + cells.height; ++y) {
      for (int x = cells.x; x < cells.x + cells.width; ++x) {
        const std::size_t at = static_cast<std::size_t>(y) * PictureSketch::columns + x;
        use(static_cast<double>(a.cells[at]), static_cast<double>(b.cells[at]));
      }
    }
  };
  each([&](double va, double vb) {
    sum_a += va;
    sum_b += vb;
  });
  const double gain = sum_b > 0.0 ? sum_a / sum_b : 1.0;
  double largest = 0.0;
  each([&](double va, double vb) { largest = std::max(largest, std::abs(va - gain * vb)); });
  return largest;
}

std::optional<PictureChange> last_change(const Sketches& sketches, const Region& cells, double noise) {
  if (sketches.empty()) return std::nullopt;
  const double limit = std::max(least_difference, noise_share * noise);
  const PictureSketch& newest = *sketches.back();
  Seconds same = newest.stamp;
  for (auto one = sketches.rbegin() + 1; one != sketches.rend(); ++one) {
    if (difference(newest, **one, cells) > limit) return PictureChange{(*one)->stamp, same};
    same = (*one)->stamp;
  }
  return std::nullopt;
}

double noise_of(const Sketches& sketches, std::size_t count, const Region& cells) {
  double noise = 0.0;
  const std::size_t first = sketches.size() - std::min(count, sketches.size());
  for (std::size_t i = first; i + 1 < sketches.size(); ++i) {
    noise = std::max(noise, difference(*sketches.back(), *sketches[i], cells));
  }
  return noise;
}

}  // namespace zerodrift::vision
