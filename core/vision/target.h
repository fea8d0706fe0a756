#pragma once
// The calibration target as it looked at rest (V1), and where it is in another frame (V3, V4).
// What is measured is the displacement of one named point of the target since the template, in px: x to the right, y
// down. A frame in which the target cannot be measured is refused with a reason, never answered with a doubtful number.

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/vision/backdrop.h"
#include "core/vision/image.h"
#include "core/vision/lens_term.h"

namespace zerodrift::vision {

enum class Refusal {
  none,
  missing,
  wrong_target,
  occluded,
  glare,
  dim,
  blurred,
  out_of_view,
  too_different,
  ambiguous,
  moved_apart,
  other_size
};
/// "target missing", "glare", ...; "" for none.
std::string_view words_of(Refusal refusal);

struct Location {
  bool ok = false;
  Refusal refusal = Refusal::missing;
  std::string reason;  // words_of(refusal), "" when ok
  double x_px = 0.0;   // displacement of the named point since the template; NaN when refused
  double y_px = 0.0;
  double sigma_x_px = 0.0;  // standard uncertainty
  double sigma_y_px = 0.0;
  double covariance_xy_px2 = 0.0;
  double shared_sigma_px = 0.0;  // the part of both sigmas that further frames do not average away
  PixelPoint point;              // where the named point is in the frame (for the drawing; best guess when refused)
  Eigen::Matrix2d linear = Eigen::Matrix2d::Identity();  // rotation, scale and shear since the template
  double correlation = 0.0;                              // of frame and template after registration, weighted
  double inlier_share = 0.0;
  double contrast = 0.0;   // of the frame relative to the template
  double blur_px2 = 0.0;   // change of the blur's variance since the template
  double structure = 0.0;  // left in the residual, in units of its noise
  LensTerm lens;           // what is known of the lens after this frame
};

class FramePatches;
struct Registration;

/// Whether something may lie over the target in frames that are learned from. In a calibration's views nothing does.
enum class Cover { none, possible };

class Target {
 public:
  /// `name` is the file's, for messages. Without a point the centre of the region is measured. A region within a
  /// pattern that repeats is made larger until it shows the pattern's end.
  /// Errors: region_outside_image, template_without_texture, pattern_repeats, bad_argument.
  static Result<Target> create(const GrayImage& image, const Region& region, std::optional<PixelPoint> point,
                               const std::string& name);

  Location locate(const GrayImage& frame) const;

  /// The same target, having learned from frames in which it was moved (the calibration's): what stands behind it,
  /// which pixels of its region do not travel with it, the lens and, where the template's noise matters, what it looks
  /// like without it. Frames in which it is not found are left out; fewer than three teach no mask.
  Target learned_from(const std::vector<GrayImage>& frames, Cover cover = Cover::none) const;
  /// The same with what was measured of the lens.
  Target with_lens(const LensTerm& lens) const;

  /// The same target with a stored mask (one byte a pixel of the region); itself if the mask does not suit.
  Target with_mask(const std::vector<std::uint8_t>& mask) const;

  /// The same target with what stands behind it; null forgets it.
  Target with_backdrop(std::shared_ptr<const Backdrop> backdrop) const;

  /// The same target with the mean of pictures in which it was moved for its template: the region with
  /// template_margin_px around it. What is measured is as before the displacement since the template's own picture.
  /// Itself if the mean does not suit.
  Target with_gathered(FloatImage pixels) const;

  const LensTerm& lens() const;
  const std::shared_ptr<const Backdrop>& backdrop() const;
  /// Null: the template's own picture is what is looked for.
  const FloatImage* gathered() const;
  const Region& region() const;
  const PixelPoint& point() const;
  const GrayImage& image() const;
  /// One byte a pixel of the region, 0 where it is left out.
  const std::vector<std::uint8_t>& mask() const;

 private:
  struct Learned;
  struct Impl;
  std::optional<RegisteredFrame> place_in(const GrayImage& frame, bool rough) const;
  std::vector<RegisteredFrame> places_in(const std::vector<GrayImage>& frames, bool rough) const;
  Location search_at_the_point(const GrayImage& frame, Registration& fit) const;
  Target learned_backdrop(const std::vector<GrayImage>& frames) const;
  std::vector<GrayImage> without_covered(const std::vector<GrayImage>& frames) const;
  Target gathered_from(const std::vector<GrayImage>& frames) const;
  Target without_what_stands(const std::vector<GrayImage>& frames, bool in_part, Cover cover) const;
  Location search(const GrayImage& frame) const;
  Location search(FramePatches& frame, std::vector<float>* residual_map, Registration* fit) const;
  explicit Target(std::shared_ptr<const Impl> impl, LensTerm lens = {}) : m_impl(std::move(impl)), m_lens(lens) {}
  std::shared_ptr<const Impl> m_impl;
  LensTerm m_lens;
};

}  // namespace zerodrift::vision
