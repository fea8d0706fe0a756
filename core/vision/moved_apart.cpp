#include "core/vision/moved_apart.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/vision/frame_patch.h"
#include "core/vision/opencv_image.h"
#include "core/vision/registration_solver.h"

namespace zerodrift::vision {
namespace {

constexpr float misfit_scales = 4.0f;
constexpr int around_misfit_px = 3;  // the other side of an edge, and what it lies on
constexpr int least_misfits = 60;    // pixels
constexpr int least_part_pixels = 150;
constexpr int solved_pixels = 500;  // fewer are not solved well: as much again around them
constexpr int widened_times = 3;
constexpr double least_part_energy = 0.015;               // of the gradients'
constexpr int sample_step_px = 3, searched_samples = 27;  // each way
constexpr int places_tried = 3, same_place_samples = 3;
constexpr double least_alike = 0.6;  // correlation at the samples
constexpr double part_correlation = 0.995, glanced_correlation = 0.9;
constexpr double most_of_part = 0.7;         // of its pixels: it hides and uncovers some of what stands
constexpr double part_known_px = 0.03;       // along a cover's edge nearly anything fits somewhere, not so well, unless
constexpr double nearly_all_of_part = 0.95;  // fits, and so near that it was not sought
constexpr double barely_known_px = 0.045;
constexpr double least_residual = 1.0;  // grey levels at middle grey
constexpr double as_well = 1.6;  // times the residual of the rest: what has moved fits there, a cover does so roughly
constexpr double apart_px = 0.1, here_px = 0.08;
constexpr double apart_chi_square = 36.0;
constexpr double next_piece_px = 3.0;              // further away a pattern that repeats is like itself
constexpr double alike = 0.95, alike_share = 0.5;  // correlation, and of its pixels

struct Part {
  std::vector<std::uint8_t> pixels;                     // of the region, 1 each
  cv::Rect box;                                         // around them
  Eigen::Vector2d middle_px = Eigen::Vector2d::Zero();  // from the named point
};

// What does not fit, with its surroundings; nothing where it is too little to tell a place.
std::optional<Part> part_that_does_not_fit(const Registrar& fine, const std::vector<float>& residual_map) {
  const TemplateSource& source = fine.source();
  const TemplateModel& model = fine.model();
  const Region& region = source.region;
  cv::Mat1b misfit(region.height, region.width, std::uint8_t{0});
  for (int k = 0; k < model.pixels; ++k) {
    const float residual = residual_map[static_cast<std::size_t>(model.row[k]) * region.width + model.column[k]];
    misfit(model.row[k], model.column[k]) = std::abs(residual) > misfit_scales ? 1 : 0;  // not if it is not a number
  }
  if (cv::countNonZero(misfit) < least_misfits) return std::nullopt;
  const cv::Mat around = cv::Mat::ones(2 * around_misfit_px + 1, 2 * around_misfit_px + 1, CV_8U);
  Part out;
  double all = 0.0, part = 0.0;
  int count = 0;
  for (int widened = 0; widened < widened_times && count < solved_pixels; ++widened) {
    cv::dilate(misfit, misfit, around);
    out.pixels.assign(misfit.begin(), misfit.end());
    for (std::size_t k = 0; k < out.pixels.size(); ++k) out.pixels[k] = out.pixels[k] && source.usable[k];
    out.middle_px.setZero();
    all = part = 0.0;
    count = 0;
    for (int k = 0; k < model.pixels; ++k) {
      const double energy = double{model.fx[k]} * model.fx[k] + double{model.fy[k]} * model.fy[k];
      all += energy;
      if (!out.pixels[static_cast<std::size_t>(model.row[k]) * region.width + model.column[k]]) continue;
      part += energy;
      out.middle_px += energy * Eigen::Vector2d(model.x[k], model.y[k]);
      ++count;
    }
    if (count < least_part_pixels || part < least_part_energy * all) return std::nullopt;
  }
  out.box = cv::boundingRect(misfit);
  out.middle_px /= part;
  return out;
}

RegistrationStart start_at(const Eigen::Vector2d& displacement_px) {
  RegistrationStart out;
  out.whole_px = displacement_px.array().round();
  out.shift_px = displacement_px - out.whole_px;
  return out;
}

// Around a part of the region.
FramePatch patch_at(const RegistrationStart& start, const Registrar& fine, const cv::Rect& part, const GrayImage& frame,
                    const Eigen::Matrix2d& blur_px2) {
  Region at = fine.patch_at(static_cast<int>(start.whole_px(0)), static_cast<int>(start.whole_px(1)));
  const Region& region = fine.source().region;
  at.x += part.x, at.y += part.y;
  at.width += part.width - region.width, at.height += part.height - region.height;
  return {frame, at, blur_px2};
}

// Of all that the template shows, where an outline alone was followed.
std::vector<float> residuals_of(const Registrar& fine, const GrayImage& frame, const Registration& found) {
  if (!found.by_outline) return found.residual_map;
  RegistrationStart start = start_at(found.displacement_px);
  start.linear = found.linear;
  const Region& region = fine.source().region;
  const FramePatch patch = patch_at(start, fine, {0, 0, region.width, region.height}, frame, fine.model().blur_px2);
  RegistrationSolver solver(fine.model(), patch, nullptr, start);
  if (!solver.compare()) return found.residual_map;
  return solver.residual_map(region.width, region.height);
}

// Where the part is seen best in the frame, from where the rest is.
std::vector<Eigen::Vector2d> places_of(const TemplateSource& source, const Part& part, const GrayImage& frame,
                                       const Registration& found) {
  const Region& region = source.region;
  const cv::Size samples(region.width / sample_step_px, region.height / sample_step_px);
  cv::Mat1f smooth, shown(samples), mask(samples),
      there(samples.height + 2 * searched_samples, samples.width + 2 * searched_samples);
  cv::blur(mat_view(source.pixels), smooth, {sample_step_px, sample_step_px}, {-1, -1}, cv::BORDER_REPLICATE);
  for (int row = 0; row < samples.height; ++row) {
    for (int column = 0; column < samples.width; ++column) {
      const int x = column * sample_step_px, y = row * sample_step_px;
      shown(row, column) = smooth(y + source.margin_px, x + source.margin_px);
      mask(row, column) = part.pixels[static_cast<std::size_t>(y) * region.width + x] != 0 ? 1.0f : 0.0f;
    }
  }
  cv::Mat1f map_x(there.size()), map_y(there.size());
  const Eigen::Vector2d point(source.point.x_px, source.point.y_px), corner(region.x, region.y);
  for (int row = 0; row < there.rows; ++row) {
    for (int column = 0; column < there.cols; ++column) {
      const Eigen::Vector2d at(column - searched_samples, row - searched_samples);
      const Eigen::Vector2d in_frame =
          corner + point + found.displacement_px + found.linear * (sample_step_px * at - point);
      map_x(row, column) = static_cast<float>(in_frame(0));
      map_y(row, column) = static_cast<float>(in_frame(1));
    }
  }
  mat_view(frame).convertTo(smooth, CV_32F);
  cv::blur(smooth, smooth, {sample_step_px, sample_step_px}, {-1, -1}, cv::BORDER_REPLICATE);
  cv::remap(smooth, there, map_x, map_y, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  cv::Mat1f scores;
  cv::matchTemplate(there, shown, scores, cv::TM_CCOEFF_NORMED, mask);
  scores.setTo(-1.0f, (scores != scores) | (scores > 1.1f));
  std::vector<Eigen::Vector2d> out;
  for (int k = 0; k < places_tried; ++k) {
    double best = 0.0;
    cv::Point place;
    cv::minMaxLoc(scores, nullptr, &best, nullptr, &place);
    if (best < least_alike) break;
    out.emplace_back(sample_step_px * (place.x - searched_samples), sample_step_px * (place.y - searched_samples));
    cv::circle(scores, place, same_place_samples, cv::Scalar(-1.0), cv::FILLED);
  }
  return out;
}

}  // namespace

bool moved_apart(const Registrar& fine, const GrayImage& image, const GrayImage& frame, const Registration& found) {
  const std::optional<Part> part = part_that_does_not_fit(fine, residuals_of(fine, frame, found));
  if (!part) return false;
  const TemplateSource& source = fine.source();
  TemplateSource of_part = source;
  of_part.usable = part->pixels;
  of_part.backdrop.reset();
  TemplateModel alone = make_template_model(of_part, found.setup.template_blur, found.setup.frame_blur);
  const Eigen::Vector2d rest_px =
      found.displacement_px + (found.linear - Eigen::Matrix2d::Identity()) * part->middle_px;
  // Whatever does not fit there, it has not moved.
  const auto is_here = [&](const Registration& own) {
    return own.correlation > part_correlation && own.inlier_share > most_of_part &&
           (own.middle_px - rest_px).norm() < here_px;
  };
  const auto seen_in = [&](const GrayImage& picture, const Eigen::Matrix2d& blur_px2, RegistrationStart start) {
    start.middle_px = part->middle_px;
    start.outline_alone = true;  // of a few edges size and place are hardly told apart
    const FramePatch patch = patch_at(start, fine, part->box, picture, blur_px2);
    RegistrationSolver solver(alone, patch, nullptr, start);
    if (!solver.glance()) return Registration{};
    Registration out = solver.fit(alone.pixels / 4);
    out.middle_px = out.displacement_px + (out.linear - Eigen::Matrix2d::Identity()) * part->middle_px;
    if (out.correlation < glanced_correlation || is_here(out)) return out;
    if (!solver.run()) return Registration{};
    out = solver.fit(alone.pixels);
    if (out.correlation < alike) return out;
    if (alone.noise_growth_x == 0.0) find_noise_effects(alone);
    solver.tell_uncertainty(out);
    return out;
  };
  // The part for itself, where it is like itself.
  const auto fitted_from = [&](const Eigen::Vector2d& away_px) -> std::optional<Registration> {
    RegistrationStart start = start_at(rest_px + found.linear * away_px);
    start.linear = found.linear;
    Registration own = seen_in(frame, found.setup.frame_blur, start);
    if (is_here(own)) return own;
    if (own.correlation < part_correlation || own.inlier_share < most_of_part) return std::nullopt;
    if (own.residual > as_well * std::max(found.residual, least_residual)) return std::nullopt;
    const bool all_there = away_px.isZero() && own.inlier_share > nearly_all_of_part;
    const double known_px = all_there ? barely_known_px : part_known_px;
    if (own.covariance_px2.diagonal().maxCoeff() > known_px * known_px) return std::nullopt;
    return own;
  };
  const auto is_elsewhere = [&](const Registration& own) {
    const Eigen::Vector2d apart = own.middle_px - rest_px;
    if (apart.norm() < apart_px) return false;
    const Eigen::Matrix2d both = own.covariance_px2 + found.covariance_px2;
    if (apart.dot(both.ldlt().solve(apart)) < apart_chi_square) return false;
    if (apart.norm() < next_piece_px) return true;
    // Under a cover it may be taken for another piece of a print that repeats, which was there before.
    const Registration before = seen_in(image, found.setup.template_blur, start_at(apart));
    return before.correlation < alike || before.inlier_share < alike_share ||
           (before.middle_px - apart).norm() > next_piece_px;
  };
  if (const auto here = fitted_from(Eigen::Vector2d::Zero())) return is_elsewhere(*here);
  for (const Eigen::Vector2d& away_px : places_of(source, *part, frame, found)) {
    const auto there = fitted_from(away_px);
    if (there && is_elsewhere(*there)) return true;
  }
  return false;
}

}  // namespace zerodrift::vision
