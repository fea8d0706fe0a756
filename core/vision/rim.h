#pragma once
// The rim of a ball. What a ball shows within it is the reflection of its surroundings and of a lamp, which need not
// move as the ball does; the circle in which it meets what stands behind is all that travels with it. Fitted to the
// levels on both sides: within, any smooth function of the direction in which the surface looks (which is what a
// reflection is a function of: Basri and Jacobs, IEEE PAMI 25 (2003) 218); beside it levels and slopes that change
// little around it, or what has been learned of the backdrop. So the levels within may cross those beside it, and both
// may change from picture to picture.

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "core/vision/frame_patch.h"
#include "core/vision/template_model.h"

namespace zerodrift::vision {

struct RimPlace {
  Eigen::Vector2d moved_px = Eigen::Vector2d::Zero();        // of the ball's middle since the template, right and down
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Zero();  // of that; the template's own part is in it
  double fitting_share = 0.0;                                // of the rim's pixels
  double growth = 0.0;                                       // of the radius since the template, as a share of it
};

class Rim {
 public:
  /// The source must be completed. Nothing where the template shows no ball: no circle, one with a
  /// print within it, or one beside which it is neither smooth nor learned.
  static std::optional<Rim> seen_in(const TemplateSource& source, const Eigen::Matrix2d& blur_px2);

  /// Of the ball in the template, from the named point.
  const Eigen::Vector2d& middle_px() const;
  /// The same, with its radius and the blur of its edge.
  RimCircle circle() const;
  /// From where the middle is expected, to a pixel; `contrast` is the frame's gain over the template, `blur_px2` the
  /// covariance by which it is more blurred. Nothing where the rim cannot be followed; where it is hidden in part,
  /// `fitting_share` says so.
  std::optional<RimPlace> find(const FramePatch& patch, const Eigen::Vector2d& expected_px, double contrast,
                               const Eigen::Matrix2d& blur_px2) const;

 private:
  struct Seen;
  explicit Rim(std::shared_ptr<const Seen> seen) : m_seen(std::move(seen)) {}
  std::shared_ptr<const Seen> m_seen;
};

}  // namespace zerodrift::vision
