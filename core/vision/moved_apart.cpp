#include "core/vision/moved_apart.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/vision/opencv_image.h"
#include "core/vision/registration_solver.h"
#include "core/vision/row_sums.h"
#include "core/vision/target_part.h"

namespace zerodrift::vision {
namespace {

constexpr int sample_step_px = 3, searched_samples = 27;  // each way
constexpr int places_tried = 3, same_place_samples = 3;
constexpr double least_alike = 0.6;  // correlation at the samples
constexpr double part_correlation = 0.995, glanced_correlation = 0.9;
constexpr double part_known_px = 0.03;       // along a cover's edge nearly anything fits somewhere, not so well, unless
constexpr double nearly_all_of_part = 0.95;  // fits, and so near that it was not sought
constexpr double barely_known_px = 0.045;
constexpr double least_residual = 1.0;  // grey levels at middle grey
constexpr double as_well = 1.6;  // times the residual of the rest: what has moved fits there, a cover does so roughly
constexpr double apart_px = 0.1, here_px = 0.08;
constexpr double apart_chi_square = 36.0;
constexpr double next_piece_px = 3.0;              // further away a pattern that repeats is like itself
constexpr double alike = 0.95, alike_share = 0.5;  // correlation, and of its pixels
constexpr double less_alike = 0.1;                 // and not so much fewer of them than where it is seen now

RegistrationStart start_at(const Eigen::Vector2d& displacement_px) {
  RegistrationStart out;
  out.whole_px = displacement_px.array().round();
  out.shift_px = displacement_px - out.whole_px;
  return out;
}

Region patch_at(const Region& region, const RegistrationStart& start) {
  return patch_around(region, static_cast<int>(start.whole_px(0)), static_cast<int>(start.whole_px(1)));
}

// Of all that the template shows, where it was found.
std::vector<float> residuals_at(const Registrar& fine, FramePatches& frame, const Registration& found) {
  RegistrationStart start = start_at(found.displacement_px);
  start.linear = found.linear;
  const Region& region = fine.source().region;
  const FramePatch& patch = frame.around(patch_at(region, start), fine.model().blur_px2);
  RegistrationSolver solver(fine.model(), patch, nullptr, start);
  if (!solver.compare()) return found.residual_map;
  return solver.residual_map(region.width, region.height);
}

// Normalized correlation of a pattern's samples with a picture, wherever it lies within; -1 where that is even.
// OpenCV's with a mask takes several Fourier transforms, eight times as long for so few places.
cv::Mat1f masked_correlation(const cv::Mat1f& picture, const cv::Mat1f& pattern, const cv::Mat1b& mask) {
  constexpr double least_variance = 1e-3;  // grey levels^2
  const int count = cv::countNonZero(mask);
  cv::Mat1f out(picture.rows - pattern.rows + 1, picture.cols - pattern.cols + 1, -1.0f);
  if (count == 0) return out;
  cv::Scalar mean, deviation;
  cv::meanStdDev(pattern, mean, deviation, mask);
  const double n = count;
  if (deviation[0] * deviation[0] < least_variance) return out;
  // Some places beyond the last are looked at and left out.
  cv::Mat1f levels(picture.rows + 1, picture.cols + places_at_once, 0.0f);
  cv::subtract(picture, cv::mean(picture), levels(cv::Rect({0, 0}, picture.size())));
  std::vector<PatternSample> samples;
  for (int row = 0; row < pattern.rows; ++row) {
    for (int column = 0; column < pattern.cols; ++column) {
      if (mask(row, column) == 0) continue;
      samples.push_back({row * levels.cols + column, static_cast<float>(pattern(row, column) - mean[0])});
    }
  }
  std::array<float, places_at_once> product, sum, squares;
  for (int y = 0; y < out.rows; ++y) {
    for (int first = 0; first < out.cols; first += places_at_once) {
      pattern_sums(samples.data(), count, levels[y] + first, product.data(), sum.data(), squares.data());
      for (int k = 0; k < std::min(places_at_once, out.cols - first); ++k) {
        const double variance = squares[k] / n - std::pow(sum[k] / n, 2);
        if (variance > least_variance) {
          out(y, first + k) = static_cast<float>(product[k] / n / (deviation[0] * std::sqrt(variance)));
        }
      }
    }
  }
  return out;
}

// Where the part is seen best in the frame, from where the rest is.
std::vector<Eigen::Vector2d> places_of(const TemplateSource& part, const GrayImage& frame, const Registration& found) {
  const Region& region = part.region;
  const cv::Size samples(region.width / sample_step_px, region.height / sample_step_px);
  cv::Mat1b mask(samples);
  cv::Mat1f smooth, shown(samples), there(samples.height + 2 * searched_samples, samples.width + 2 * searched_samples);
  cv::blur(mat_view(part.pixels), smooth, {sample_step_px, sample_step_px}, {-1, -1}, cv::BORDER_REPLICATE);
  for (int row = 0; row < samples.height; ++row) {
    for (int column = 0; column < samples.width; ++column) {
      const int x = column * sample_step_px, y = row * sample_step_px;
      shown(row, column) = smooth(y + part.margin_px, x + part.margin_px);
      mask(row, column) = part.usable[static_cast<std::size_t>(y) * region.width + x] != 0 ? 1 : 0;
    }
  }
  const Eigen::Vector2d point(part.point.x_px, part.point.y_px), corner(region.x, region.y);
  // Around all that is looked at.
  const int reach_px = sample_step_px * (searched_samples + 3);
  const Eigen::Vector2d from = corner + found.displacement_px;
  cv::Rect seen(static_cast<int>(std::floor(from(0))) - reach_px, static_cast<int>(std::floor(from(1))) - reach_px,
                region.width + 2 * reach_px, region.height + 2 * reach_px);
  seen &= cv::Rect(0, 0, frame.width, frame.height);
  if (seen.empty()) return {};
  cv::Mat1f map_x(there.size()), map_y(there.size());
  for (int row = 0; row < there.rows; ++row) {
    for (int column = 0; column < there.cols; ++column) {
      const Eigen::Vector2d at(column - searched_samples, row - searched_samples);
      const Eigen::Vector2d in_frame = from + point + found.linear * (sample_step_px * at - point);
      map_x(row, column) = static_cast<float>(in_frame(0) - seen.x);
      map_y(row, column) = static_cast<float>(in_frame(1) - seen.y);
    }
  }
  cv::boxFilter(mat_view(frame)(seen), smooth, CV_32F, {sample_step_px, sample_step_px}, {-1, -1}, true,
                cv::BORDER_REPLICATE);
  cv::remap(smooth, there, map_x, map_y, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  cv::Mat1f scores = masked_correlation(there, shown, mask);
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

// The part alone, where it is elsewhere than the target was found.
std::optional<Registration> elsewhere(const TargetPart& part, const Registrar& fine, FramePatches& image,
                                      FramePatches& frame, const Registration& found) {
  const TemplateSource of_part = source_of(fine.source(), part);
  TemplateModel alone = make_template_model(of_part, found.setup.template_blur, found.setup.frame_blur);
  const Eigen::Vector2d rest_px = found.displacement_px + (found.linear - Eigen::Matrix2d::Identity()) * part.middle_px;
  // Whatever does not fit there, it has not moved.
  const auto is_here = [&](const Registration& own) {
    return own.correlation > part_correlation && own.inlier_share > part.least_share &&
           (own.middle_px - rest_px).norm() < here_px;
  };
  const auto seen_in = [&](FramePatches& picture, const Eigen::Matrix2d& blur_px2, RegistrationStart start) {
    start.middle_px = part.middle_px;
    start.outline_alone = true;  // of a few edges size and place are hardly told apart
    const FramePatch& patch = picture.around(patch_at(of_part.region, start), blur_px2);
    RegistrationSolver solver(alone, patch, nullptr, start);
    if (!solver.glance()) return Registration{};
    Registration out = solver.fit(alone.pixels / 4);
    out.middle_px = out.displacement_px + (out.linear - Eigen::Matrix2d::Identity()) * part.middle_px;
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
    if (own.correlation < part_correlation || own.inlier_share < part.least_share) return std::nullopt;
    if (own.residual > as_well * std::max(found.residual, least_residual)) return std::nullopt;
    const bool all_there = away_px.isZero() && own.inlier_share > nearly_all_of_part;
    const double known_px = all_there ? barely_known_px : part_known_px;
    const Eigen::Array2d variance_px2 = own.covariance_px2.diagonal();
    if (!(variance_px2 <= known_px * known_px).all()) return std::nullopt;  // nor one that is not a number
    return own;
  };
  const auto has_moved = [&](const Registration& own) {
    const Eigen::Vector2d apart = own.middle_px - rest_px;
    if (apart.norm() < apart_px) return false;
    const Eigen::Matrix2d both = own.covariance_px2 + found.covariance_px2;
    if (apart.dot(both.ldlt().solve(apart)) < apart_chi_square) return false;
    if (apart.norm() < next_piece_px) return true;
    // Under a cover it may be taken for another piece of a print that repeats, which was there before.
    const Registration before = seen_in(image, found.setup.template_blur, start_at(apart));
    return before.correlation < alike || before.inlier_share < std::max(alike_share, own.inlier_share - less_alike) ||
           (before.middle_px - apart).norm() > next_piece_px;
  };
  if (const auto here = fitted_from(Eigen::Vector2d::Zero())) return has_moved(*here) ? here : std::nullopt;
  for (const Eigen::Vector2d& away_px : places_of(of_part, frame.image(), found)) {
    const auto there = fitted_from(away_px);
    if (there && has_moved(*there)) return there;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Registration> found_at_the_point(const Registrar& fine, const GrayImage& image, FramePatches& frame,
                                               const Registration& found) {
  const std::optional<TargetPart> part = part_at_the_point(fine, found.residual_map);
  std::optional<Registration> out;
  FramePatches before(image);
  if (part) out = elsewhere(*part, fine, before, frame, found);
  if (out) out->residual_map = residuals_at(fine, frame, *out);
  return out;
}

bool moved_apart(const Registrar& fine, const GrayImage& image, FramePatches& frame, Registration found) {
  if (found.by_outline) found.residual_map = residuals_at(fine, frame, found);
  if (found_at_the_point(fine, image, frame, found)) return true;
  const std::optional<TargetPart> part = part_that_does_not_fit(fine, found.residual_map);
  FramePatches before(image);
  return part && elsewhere(*part, fine, before, frame, found);
}

}  // namespace zerodrift::vision
