#pragma once
// What a target holds; for the files that make up the target alone.

#include <optional>
#include <vector>

#include "core/vision/coarse_search.h"
#include "core/vision/disc.h"
#include "core/vision/frame_patches.h"
#include "core/vision/gathered_template.h"
#include "core/vision/registration.h"
#include "core/vision/repeating_target.h"
#include "core/vision/target.h"

namespace zerodrift::vision {

struct Target::Learned {
  std::vector<std::uint8_t> mask;
  std::shared_ptr<const Backdrop> backdrop;
  std::shared_ptr<const GatheredTemplate> gathered;
  std::optional<RimCircle> ball;
};

struct Target::Impl : Learned {
  GrayImage image;
  Region region;
  PixelPoint point;
  CoarseSearch coarse;
  Registrar fine;
  RepeatingTarget repeating;
  std::vector<Disc> discs;
  std::vector<Candidate> twins;  // where the template's picture shows the like of it once more

  Impl(GrayImage picture, const Region& at, const PixelPoint& named, Learned learned)
      : Learned(std::move(learned)),
        image(std::move(picture)),
        region(at),
        point(named),
        coarse(image, at),
        fine(source_of(*this)),
        repeating(image, region, point, mask) {
    if (fine.rim()) ball = fine.rim()->circle();
    discs = Disc::all_in(fine.source(), ball);
    if (!repeating.repeats()) twins = seen_again();
  }

  // Candidates that a glance finds best, best first; none where at a glance nothing is like the target.
  std::vector<Candidate> likeliest(FramePatches& frame, const std::vector<Candidate>& candidates) const;

  RegisteredFrame place_of(const GrayImage& frame, const Location& at) const {
    return {&frame, {at.point.x_px - point.x_px, at.point.y_px - point.y_px}, at.linear, at.lens};
  }

  std::vector<Candidate> seen_again() const;

  // Empty where hardly anything lies over the target: as it moves, it hides and uncovers some of what stands behind it.
  std::vector<std::uint8_t> under_a_cover(const GrayImage& frame, const Location& at,
                                          const std::vector<float>& residual_map) const;

  static TemplateSource source_of(const Impl& self);
};

}  // namespace zerodrift::vision
