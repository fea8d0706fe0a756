#pragma once
// A frame with the parts of it that have been looked at: nearly all looks at one frame are at the same place with the
// same blur, and a patch costs as much as a glance at it. Inside core/vision only; not for two threads.

#include <memory>
#include <vector>

#include "core/vision/frame_patch.h"
#include "core/vision/registration.h"

namespace zerodrift::vision {

class FramePatches {
 public:
  /// The frame must outlive it.
  explicit FramePatches(const GrayImage& frame) : m_frame(frame) {}
  const GrayImage& image() const { return m_frame; }
  /// A patch that holds the region; `wide_glare`: with the surroundings of bright spots left out as well.
  const FramePatch& around(const Region& region, const Eigen::Matrix2d& blur_px2, bool wide_glare = false);

 private:
  struct Kept {
    std::unique_ptr<FramePatch> patch;
    bool wide_glare = false;
  };
  const GrayImage& m_frame;
  std::vector<Kept> m_kept;
};

// A frame at one place.
struct PlaceInFrame {
  FramePatches& frame;
  Region region;
  const FramePatch& with(const ImageSetup& setup) const {
    return frame.around(region, setup.frame_blur, setup.with_field);
  }
};

}  // namespace zerodrift::vision
