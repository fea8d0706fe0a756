#pragma once
// The part of a frame in which the target is sought: blurred, as a spline, with the pixels that cannot be used.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/vision/image.h"
#include "core/vision/spline_image.h"

namespace zerodrift::vision {

struct FramePatch {
  enum State : std::uint8_t { seen, outside, too_bright, doubted };

  FramePatch(const GrayImage& frame, const Region& region, const Eigen::Matrix2d& blur_px2);
  /// Leaves out the surroundings of bright spots as well, where their flank still falls steeply.
  void widen_glare();
  bool has_glare() const { return !m_dark.empty(); }

  Region at;  // in the frame, or beyond it
  Eigen::Matrix2d blur_px2;
  SplineImage spline;
  std::vector<std::uint8_t> state;  // one a pixel

 private:
  void leave_out_bright(double further_px);
  std::vector<std::uint8_t> m_dark;  // 0 where the frame is saturated; empty if it is nowhere
  Region m_bright;                   // of the patch, around all that is saturated
};

}  // namespace zerodrift::vision
