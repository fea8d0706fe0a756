#pragma once
// For registration.cpp alone.

#include <optional>

#include "core/vision/frame_patch.h"
#include "core/vision/registration.h"

namespace zerodrift::vision {

// The part of a frame at one place, made anew only when another blur is asked for.
class PatchOfFrame {
 public:
  PatchOfFrame(const GrayImage& frame, const Region& at) : m_frame(frame), m_at(at) {}
  const FramePatch& with(const ImageSetup& setup) {
    if (!m_patch || m_patch->blur_px2 != setup.frame_blur || (m_wide && !setup.with_field)) {
      m_patch.emplace(m_frame, m_at, setup.frame_blur);
      m_wide = false;
    }
    if (setup.with_field && !m_wide) {
      m_patch->widen_glare();
      m_wide = true;
    }
    return *m_patch;
  }

 private:
  const GrayImage& m_frame;
  Region m_at;
  std::optional<FramePatch> m_patch;
  bool m_wide = false;
};

}  // namespace zerodrift::vision
