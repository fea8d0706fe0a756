#pragma once
// Fine registration of a template in a frame: inverse-compositional Gauss-Newton (Baker and Matthews, IJCV 56 (2004)
// 221) with an affine motion under a weak prior, and in the same solve what happens to the light: gain plane, offset,
// blur along any direction. Weights are 1 / noise variance times Tukey's biweight; saturated pixels are out.

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "core/vision/image.h"
#include "core/vision/lens_term.h"
#include "core/vision/rim.h"
#include "core/vision/template_model.h"

namespace zerodrift::vision {

/// What was put into the images and the model to make them alike.
struct ImageSetup {
  Eigen::Matrix2d template_blur;
  Eigen::Matrix2d frame_blur;
  bool with_field = false;
};

struct Registration {
  bool converged = false;
  bool partly_unlit = false;  // where not converged: light that falls on no target was needed to explain a part of it
  Eigen::Vector2d displacement_px = Eigen::Vector2d::Zero();  // of the named point, right and down
  Eigen::Matrix2d linear = Eigen::Matrix2d::Identity();       // affine part
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d unseen_turn_px2 = Eigen::Matrix2d::Zero();     // of that, by a turn which the target does not show
  Eigen::Vector2d noise_variance_px2 = Eigen::Vector2d::Zero();  // what the covariance would be by the noise alone
  Eigen::Vector2d middle_px = Eigen::Vector2d::Zero();  // displacement of the target's middle, which no turn moves
  Eigen::Vector2d middle_variance_px2 = Eigen::Vector2d::Zero();  // by the noise alone
  double correlation = 0.0;                                       // weighted, of frame and model
  double inlier_share = 0.0;                                      // of the pixels, by weight over a quarter
  double informed_share = 0.0;                                    // of the gradient energy
  double rim_share = 1.0;                                         // the same in the outermost eighths of the region
  bool light_changed = false;                                     // across the target, since the template
  bool by_outline = false;                                        // what it shows within was left out
  bool by_rim = false;                                            // of a ball: all that it shows within was left out
  bool parts_apart = false;                                       // the rim of a ball is elsewhere than what fits
  double growth = 0.0;                                            // of a ball, as a share of its size
  double printed_otherwise = 0.0;  // of what does not fit: shows the target's other tones
  double seen_share = 0.0;         // of the pixels that lie in the frame
  double saturated_share = 0.0;
  double contrast = 0.0;  // gain of the frame over the template
  double blur_px2 = 0.0;  // change of the blur's variance since the template, mean of both axes
  ImageSetup setup{Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Zero()};
  LensTerm lens;                   // prior and this frame together
  double residual = 0.0;           // robust scale of the weighted residual, in standard deviations of shot noise
  double expected_residual = 0.0;  // of the template's own noise, as if the frame had the same
  double structure = 0.0;          // rms of the residual's means over tiles, in units of their noise: 1 is none
  int iterations = 0;
  std::vector<float> residual_map;  // only if asked for: one a pixel of the region in units of the scale, NaN if unused
};

/// Largest element by which the linear part differs from none.
inline double linear_change(const Registration& r) {
  return (r.linear - Eigen::Matrix2d::Identity()).cwiseAbs().maxCoeff();
}

inline constexpr int registration_light_count = 7;  // gain and its plane, offset, blur

struct RegistrationStart {
  Eigen::Vector2d whole_px = Eigen::Vector2d::Zero();  // displacement of the region to the patch's middle
  Eigen::Vector2d shift_px = Eigen::Vector2d::Zero();  // of the named point from there
  Eigen::Matrix2d linear = Eigen::Matrix2d::Identity();
  LensTerm lens;
  std::optional<Eigen::Matrix<double, registration_light_count, 1>> light;  // of an earlier solve, without its blur
  // Pixels of the region that the glance alone does without, 1 each; null: none.
  const std::vector<std::uint8_t>* doubted = nullptr;
  bool outline_alone = false;
  Eigen::Vector2d middle_px = Eigen::Vector2d::Zero();  // of the target, from the named point
};

/// A look at a quarter of the pixels.
struct Glance {
  Registration seen;        // not converged where there was nothing to be seen
  RegistrationStart ended;  // to go on from
  Eigen::Matrix2d extra_blur_px2 = Eigen::Matrix2d::Zero();
};

class FramePatches;
struct PlaceInFrame;

class Registrar {
 public:
  explicit Registrar(TemplateSource source);

  /// Starts with the region displaced by whole pixels; the point may end up to 8 px from there. `glance`: one at that
  /// place, if there was one.
  Registration run(FramePatches& frame, int dx_px, int dy_px, const LensTerm& lens = {}, bool with_residual_map = false,
                   const Glance* glance = nullptr) const;
  /// From the turn about the target's middle at which a glance explains nearly all of it, and more than unturned; empty
  /// where none does.
  std::optional<Registration> run_turned(FramePatches& frame, int dx_px, int dy_px, const LensTerm& lens,
                                         double largest_turn_rad, bool with_residual_map) const;
  /// As run, on a quarter of the pixels, in a tenth of the time: to choose among places (whole displacements).
  std::vector<Glance> glances(FramePatches& frame, const std::vector<std::array<int, 2>>& places,
                              const LensTerm& lens) const;

  const TemplateModel& model() const { return m_model; }
  const TemplateSource& source() const { return m_source; }
  /// Empty where the target is no ball, whose rim is told from what it reflects.
  const std::optional<Rim>& rim() const { return m_rim; }

 private:
  struct Course;
  Registration attempt(const PlaceInFrame& place, RegistrationStart start, bool with_residual_map,
                       const Glance* glance = nullptr) const;
  Registration by_levels(const PlaceInFrame& place, RegistrationStart start, bool with_residual_map,
                         const Glance* glance) const;
  Registration solve(const TemplateSource& source, const TemplateModel& usual, const RegistrationStart& first_start,
                     Course& course) const;
  bool outline_tells_more(const Registration& whole) const;
  /// 1 for each pixel of the region around which a frame does not look like the template there.
  std::vector<std::uint8_t> unlike(const GrayImage& frame, int dx_px, int dy_px) const;
  /// The share of saturated pixels; 0 if the first glance found nothing.
  double match_blur_at_a_glance(const PlaceInFrame& place, ImageSetup& setup,
                                std::optional<TemplateModel>& blurred_model, RegistrationStart& start,
                                const Glance* glance) const;

  TemplateSource m_source;
  TemplateModel m_model;  // with the smallest blur
  // Of a target that hardly shows more than its outline: with the outline alone. What a ball shows within it is the
  // reflection of a lamp, which may have moved.
  std::optional<TemplateSource> m_outline;
  std::optional<TemplateModel> m_outline_model;
  std::optional<Rim> m_rim;
  Eigen::Vector2d m_middle = Eigen::Vector2d::Zero();  // about which it shows a turn least, from the named point
};

}  // namespace zerodrift::vision
