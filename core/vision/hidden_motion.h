#pragma once
// What a target shows least of the ways in which it may turn and stretch. Rings do not show that they turn; what their
// template seems to tell of it is its own noise, which a solve would take for evidence.

#include <Eigen/Core>
#include <vector>

namespace zerodrift::vision {

/// Standard deviation of a turn, rad, that is expected of a target on a machine before anything is seen of it: bodies
/// that warm by tens of kelvin turn by less than 0.001, a holder that was knocked by more.
inline constexpr double expected_turn = 0.005;

struct HiddenMotion {
  /// Change of the linear part (xx, xy, yx, yy) for a turn by 1 rad; of a round target seen aslant with the stretch
  /// that hides it.
  Eigen::Vector4d direction{0.0, -1.0, 1.0, 0.0};
  /// Share of what the template tells of it that is not its noise, 0 .. 1.
  double shown = 1.0;
};

/// Of pixels at x, y (px from any point) with gradients fx, fy (grey levels per px) whose components have noise of the
/// given variance where they are not zero. Translations, which may hide it as well, are left free.
HiddenMotion find_hidden_motion(const std::vector<float>& x, const std::vector<float>& y, const std::vector<float>& fx,
                                const std::vector<float>& fy, double noise_variance);

}  // namespace zerodrift::vision
