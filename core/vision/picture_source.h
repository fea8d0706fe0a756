#pragma once
// What measuring needs of a source of pictures, whatever carries it: a live camera, a test double.

#include <chrono>
#include <cstdint>
#include <memory>
#include <stop_token>

#include "core/base/result.h"
#include "core/vision/image.h"
#include "core/vision/picture_sketch.h"

namespace zerodrift::vision {

struct CameraFrame {
  GrayImage image;
  std::uint64_t count = 0;  // frames since the start
  std::chrono::steady_clock::time_point arrived;
  Seconds stamp{0.0};  // host time: by the device, else of the arrival
};

class PictureSource {
 public:
  virtual ~PictureSource() = default;
  /// The first frame that is stamped after this host time and does not repeat the one before. Frames that come at once,
  /// as a starved reader finds them in the line, are passed over: their stamp is too late.
  virtual Result<std::shared_ptr<const CameraFrame>> next_picture(Seconds after, std::chrono::milliseconds timeout,
                                                                  const std::stop_token& stop) const = 0;
  /// Of the last pictures, from the last one that is not after `from` on.
  virtual Sketches sketches(Seconds from) const = 0;
  /// A file or a sequence of images: played at its own rate, its pictures are of no time.
  virtual bool is_file() const = 0;
};

}  // namespace zerodrift::vision
