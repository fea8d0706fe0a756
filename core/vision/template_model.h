#pragma once
// What the fine registration needs of the template at its informative pixels: value, gradients and curvatures of the
// blurred template, as arrays. Coordinates are relative to the named point, whose displacement is asked.

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/vision/backdrop.h"
#include "core/vision/hidden_motion.h"
#include "core/vision/spline_image.h"

namespace zerodrift::vision {

inline constexpr int tiles_a_side = 8;

struct TemplateModel {
  Region region;  // in the template's image
  int pixels = 0;
  std::vector<int> column, row;              // in the region
  int width = 0, height = 0;                 // of what is used of the region, from its first pixel on
  std::vector<std::uint8_t> tile;            // one of 8 x 8 of that
  std::vector<float> x, y;                   // px from the named point
  std::vector<float> value;                  // grey levels
  std::vector<float> fx, fy;                 // per px
  std::vector<float> fxx, fxy, fyy;          // per px^2
  std::shared_ptr<const Backdrop> backdrop;  // null: not known; then nothing is clear
  std::vector<int> shown;                    // pixels through which it is seen, rising
  std::vector<float> clear, behind;          // of those: how much, and its level in the template
  Eigen::Matrix2d blur_px2;                  // covariance of the blur in it
  Eigen::Matrix2d frame_blur_px2;            // and in the frame it is compared with
  FloatImage gradient_x, gradient_y;
  double noise_growth_x = 0.0;     // by how much the blur's noise correlation raises the variance of x and y over the
  double noise_growth_y = 0.0;     // formula for independent noise; 0 until find_noise_effects
  double noise_correlation = 1.0;  // pixels that carry the noise of one, after the blur
  double gradient_energy = 0.0;    // mean of fx^2 + fy^2 over the region
  double noise_share = 0.0;        // of that
  double gradient_noise = 0.0;     // variance of fx and of fy by the template's noise
  HiddenMotion hidden;             // as if all were shown until find_noise_effects
};

/// Of whole grey levels. Where a camera has hardly any other noise, even places show none of it and edges all.
inline constexpr double rounding_variance = 1.0 / 12.0;

/// The rim of a ball.
struct RimCircle {
  Eigen::Vector2d middle_px = Eigen::Vector2d::Zero();
  double radius_px = 0.0;
  double blur_px = 0.0;  // standard deviation across the edge
};

struct TemplateSource {
  FloatImage pixels;  // the region with a margin on each side
  int margin_px = 0;
  PixelPoint point;  // named point, relative to the region's first pixel
  Region region;     // in the template's image
  std::shared_ptr<const Backdrop> backdrop;
  std::vector<std::uint8_t> usable;  // one a pixel of the region; 0: does not belong to the target, or saturated
  std::optional<RimCircle> ball;     // if it is known to be one; its middle from the named point
  // What every model made of it asks for; completed() finds them.
  FloatImage behind;                // what stands behind each of the pixels; empty without a backdrop
  double noise_levels = 0.0;        // standard deviation of the noise in the pixels
  double frame_noise_levels = 0.0;  // and in a frame's; that of the pixels unless it was set
  // What the pixels show of round things; a registrar finds them.
  std::optional<std::vector<RimCircle>> circles;
};

TemplateSource completed(TemplateSource source);

/// The source must be completed. `frame_blur_px2` is the blur of the frame it will be compared with: both carry noise
/// into the result.
TemplateModel make_template_model(const TemplateSource& source, const Eigen::Matrix2d& blur_px2,
                                  const Eigen::Matrix2d& frame_blur_px2);
/// What the template's and the frame's noise do to the result: matters once it has been found, and takes a while.
void find_noise_effects(TemplateModel& model);
/// Whether most of its edges do: they lie alike on the pixels all along, and what their sampling folded down does not
/// average out.
bool runs_along_rows(const TemplateModel& model);

}  // namespace zerodrift::vision
