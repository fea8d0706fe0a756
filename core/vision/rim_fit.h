#pragma once
// The fit of a circle to the edge between what lies within it and what lies beside it, whatever either shows; see
// rim.h.

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <functional>
#include <optional>

#include "core/vision/template_model.h"

namespace zerodrift::vision::rim_fit {

inline constexpr int harmonics = 8;  // around the rim, of what is seen within
inline constexpr int angles = 2 * harmonics + 1;
inline constexpr int orders = 3;  // in the surface's slope
inline constexpr int within_count = angles * orders;
inline constexpr int beside_harmonics = 4;
inline constexpr int beside_angles = 2 * beside_harmonics + 1;
inline constexpr int beside_count = 2 * beside_angles;  // level and slope along the radius
inline constexpr int light_terms = within_count + beside_count;
inline constexpr int simpler_terms = angles * (orders - 1) + beside_count;
inline constexpr int shape_terms = 4;  // middle, radius, blur
inline constexpr double within_px = 4.0, within_blurs = 2.2;
inline constexpr double least_blur_px = 0.4, largest_blur_px = 4.0;
inline constexpr double other_shape = 0.25;  // the same: the middle is not sought to the end with it

using Light = Eigen::Matrix<double, light_terms, light_terms>;
using Shape = Eigen::Matrix<double, shape_terms, 1>;

// The pixels at both sides of a circle about the origin, and what the light there is made of.
struct Ring {
  double radius_px, blur_px;
  int count = 0;
  Eigen::VectorXf x, y, cosine, sine, distance;
  Eigen::VectorXf inside, slope, widening;  // share of the ball, and how it changes with radius and with blur
  Eigen::VectorXf fall;                     // of the surface's slope along the radius
  Eigen::Matrix<float, Eigen::Dynamic, within_count> within;
  Eigen::Matrix<float, Eigen::Dynamic, beside_count> beside;
  Eigen::LLT<Light> solved;
  Eigen::LLT<Eigen::Matrix<double, simpler_terms, simpler_terms>> simpler;

  /// `uneven`, without a trace: by how much the edge's blur, px^2, is more in one direction than in the other.
  Ring(double radius, double blur, const Eigen::Matrix2d& uneven);

  // By how much a step from here would go if what is seen within were simpler by one order: no reflection is quite of
  // the form that is fitted, and of its misfit this is the measure.
  Eigen::Vector2d moved_by_simpler_light(const Eigen::VectorXf& level, const Eigen::MatrixXf& columns,
                                         const Eigen::Array<bool, Eigen::Dynamic, 1>& seen,
                                         const Eigen::VectorXf& error) const;

  /// Onto the terms of the light.
  Eigen::MatrixXd project(const Eigen::MatrixXf& rows) const;
};

// A picture around a middle.
struct Around {
  Eigen::VectorXf level;
  /// What is known to stand behind; beside the ball that much of the level needs no fit. Empty: nothing is known.
  Eigen::VectorXf behind;
  Eigen::Array<bool, Eigen::Dynamic, 1> seen;  // false for levels that cannot be used
};

// Fills in the picture around a middle; false where it reaches beyond it.
using Levels = std::function<bool(const Eigen::Vector2d& middle_px, const Ring&, Around&)>;

struct Fit {
  RimCircle circle;
  Eigen::Matrix2d covariance_px2;
  double deviation = 0.0;  // of the levels from the model
  double fitting_share = 0.0;
};

/// Starts from `first`, the ring of the start's shape, if there is one. `uneven` as in Ring. Nothing where it does not
/// settle.
std::optional<Fit> fit(const Levels& levels, const RimCircle& start, const Ring* first, const Eigen::Matrix2d& blur_px2,
                       const Eigen::Matrix2d& uneven_px2 = Eigen::Matrix2d::Zero());

}  // namespace zerodrift::vision::rim_fit
