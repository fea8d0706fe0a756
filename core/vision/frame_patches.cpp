#include "core/vision/frame_patches.h"

namespace zerodrift::vision {
namespace {

bool holds(const Region& outer, const Region& inner) {
  return inner.x >= outer.x && inner.y >= outer.y && inner.x + inner.width <= outer.x + outer.width &&
         inner.y + inner.height <= outer.y + outer.height;
}

}  // namespace

const FramePatch& FramePatches::around(const Region& region, const Eigen::Matrix2d& blur_px2, bool wide_glare) {
  const FramePatch* narrow = nullptr;
  for (const Kept& one : m_kept) {
    if (one.patch->blur_px2 != blur_px2 || !holds(one.patch->at, region)) continue;
    if (one.wide_glare == wide_glare || !one.patch->has_glare()) return *one.patch;
    if (!one.wide_glare) narrow = one.patch.get();
  }
  auto patch = narrow != nullptr ? std::make_unique<FramePatch>(*narrow)
                                 : std::make_unique<FramePatch>(m_frame, region, blur_px2);
  if (wide_glare) patch->widen_glare();
  m_kept.push_back({std::move(patch), wide_glare});
  return *m_kept.back().patch;
}

}  // namespace zerodrift::vision
