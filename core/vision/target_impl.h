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
  std::optional<std::vector<RimCircle>> circles;  // in the template's own picture, which stays the same
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

  Impl(GrayImage picture, const RepeatingTarget& pattern, const PixelPoint& named, Learned learned)
      : Impl(picture, pattern.region(), named, CoarseSearch(picture, pattern.region()), pattern, std::move(learned)) {
    if (!repeating.repeats()) twins = seen_again();
  }
  /// What has been learned is another.
  Impl(const Impl& before, Learned learned)
      : Impl(before.image, before.region, before.point, before.coarse, before.repeating, std::move(learned)) {
    twins = before.twins;
  }

  struct Likely : Candidate {
    std::optional<Glance> glance;
  };
  // Candidates that a glance finds best, best first; none where at a glance nothing is like the target.
  std::vector<Likely> likeliest(FramePatches& frame, const std::vector<Candidate>& candidates,
                                const LensTerm& lens) const;

  RegisteredFrame place_of(const GrayImage& frame, const Location& at) const {
    return {&frame, {at.point.x_px - point.x_px, at.point.y_px - point.y_px}, at.linear, at.lens};
  }

  std::vector<Candidate> seen_again() const;

  // Empty where hardly anything lies over the target: as it moves, it hides and uncovers some of what stands behind it.
  std::vector<std::uint8_t> under_a_cover(const GrayImage& frame, const Location& at,
                                          const std::vector<float>& residual_map) const;

  static TemplateSource source_of(const Impl& self);

 private:
  Impl(const GrayImage& picture, const Region& at, const PixelPoint& named, CoarseSearch search,
       const RepeatingTarget& pattern, Learned learned)
      : Learned(std::move(learned)),
        image(picture),
        region(at),
        point(named),
        coarse(std::move(search)),
        fine(source_of(*this)),
        repeating(pattern.with(image, point, mask)) {
    if (fine.rim()) ball = fine.rim()->circle();
    if (!gathered) circles = fine.source().circles;
    discs = Disc::all_in(fine.source(), ball);
  }
};

}  // namespace zerodrift::vision
