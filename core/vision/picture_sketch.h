#pragma once
// Small copies of a camera's last pictures: they tell when the picture came to show something else, at no cost, without
// looking for the target.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/clock.h"
#include "core/vision/image.h"

namespace zerodrift::vision {

struct PictureSketch {
  static constexpr int columns = 96;
  static constexpr int rows = 72;
  Seconds stamp{0.0};
  std::array<std::uint8_t, static_cast<std::size_t>(columns) * rows> cells{};  // means of the picture's parts
};
using Sketches = std::vector<std::shared_ptr<const PictureSketch>>;  // the oldest first

PictureSketch sketch_of(const GrayImage& image, Seconds stamp);
/// The sketch's part of a region of the picture, with its borders.
Region sketch_region(const Region& region, const GrayImage& image);
/// Largest difference of a cell in the region, grey levels; a change of the light as a whole is none.
double difference(const PictureSketch& a, const PictureSketch& b, const Region& cells);

/// When the pictures came to show what the newest shows.
struct PictureChange {
  Seconds last_other{0.0};  // stamp of the last picture that shows something else
  Seconds first_same{0.0};  // of the next one
};
/// The last change, going back from the newest picture; nothing when all show the same. `noise` is what pictures of the
/// same may differ by, grey levels.
std::optional<PictureChange> last_change(const Sketches& sketches, const Region& cells, double noise);
/// By how much the newest `count` pictures differ from the newest one at most.
double noise_of(const Sketches& sketches, std::size_t count, const Region& cells);

}  // namespace zerodrift::vision
