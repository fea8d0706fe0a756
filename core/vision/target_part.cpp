#include "core/vision/target_part.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace zerodrift::vision {
namespace {

constexpr float misfit_scales = 4.0f;
constexpr int around_misfit_px = 3;  // the other side of an edge, and what it lies on
constexpr int least_misfits = 60;    // pixels
constexpr int least_part_pixels = 150;
constexpr int solved_pixels = 500;  // fewer are not solved well: as much again around them
constexpr int widened_times = 3;
constexpr double least_part_energy = 0.015;  // of the gradients'
constexpr double most_of_misfit = 0.7;       // it hides and uncovers some of what stands
constexpr double most_at_point = 0.9;
constexpr double around_point = 1.25;   // times the radius that tells enough
constexpr double known_px = 0.01;       // a place at the point, along either axis
constexpr double most_of_target = 0.6;  // of the gradients' energy
constexpr int border_px = 4;            // around the part: gradients there are not of the part

double energy_at(const TemplateModel& model, int k) {
  return double{model.fx[k]} * model.fx[k] + double{model.fy[k]} * model.fy[k];
}

struct Told {
  double energy = 0.0, all = 0.0;
  int pixels = 0;
};

// Fills in the part that `mask` holds, and says how much it tells.
Told tell(const Registrar& fine, const cv::Mat1b& mask, TargetPart& part) {
  const TemplateModel& model = fine.model();
  const TemplateSource& source = fine.source();
  part.pixels.assign(mask.begin(), mask.end());
  for (std::size_t k = 0; k < part.pixels.size(); ++k) part.pixels[k] = part.pixels[k] && source.usable[k];
  part.box = cv::boundingRect(mask);
  part.middle_px.setZero();
  Told out;
  for (int k = 0; k < model.pixels; ++k) {
    const double energy = energy_at(model, k);
    out.all += energy;
    if (!part.pixels[static_cast<std::size_t>(model.row[k]) * source.region.width + model.column[k]]) continue;
    out.energy += energy;
    part.middle_px += energy * Eigen::Vector2d(model.x[k], model.y[k]);
    ++out.pixels;
  }
  if (out.energy > 0.0) part.middle_px /= out.energy;
  return out;
}

cv::Mat1b misfit_of(const Registrar& fine, const std::vector<float>& residual_map) {
  const TemplateModel& model = fine.model();
  const Region& region = fine.source().region;
  cv::Mat1b out(region.height, region.width, std::uint8_t{0});
  for (int k = 0; k < model.pixels; ++k) {
    const float residual = residual_map[static_cast<std::size_t>(model.row[k]) * region.width + model.column[k]];
    out(model.row[k], model.column[k]) = std::abs(residual) > misfit_scales ? 1 : 0;  // not if it is not a number
  }
  return out;
}

}  // namespace

std::optional<TargetPart> part_that_does_not_fit(const Registrar& fine, const std::vector<float>& residual_map) {
  cv::Mat1b misfit = misfit_of(fine, residual_map);
  if (cv::countNonZero(misfit) < least_misfits) return std::nullopt;
  const cv::Mat around = cv::Mat::ones(2 * around_misfit_px + 1, 2 * around_misfit_px + 1, CV_8U);
  TargetPart out;
  out.least_share = most_of_misfit;
  int pixels = 0;
  for (int widened = 0; widened < widened_times && pixels < solved_pixels; ++widened) {
    cv::dilate(misfit, misfit, around);
    const Told told = tell(fine, misfit, out);
    pixels = told.pixels;
    if (pixels < least_part_pixels || told.energy < least_part_energy * told.all) return std::nullopt;
  }
  return out;
}

std::optional<TargetPart> part_at_the_point(const Registrar& fine, const std::vector<float>& residual_map) {
  if (cv::countNonZero(misfit_of(fine, residual_map)) < least_misfits) return std::nullopt;
  const TemplateModel& model = fine.model();
  const TemplateSource& source = fine.source();
  // How much is told within each radius, in whole pixels.
  struct Ring {
    double xx = 0.0, xy = 0.0, yy = 0.0;
    int pixels = 0;
  };
  std::vector<Ring> rings;
  for (int k = 0; k < model.pixels; ++k) {
    const auto radius = static_cast<std::size_t>(std::hypot(model.x[k], model.y[k]));
    if (radius >= rings.size()) rings.resize(radius + 1);
    Ring& ring = rings[radius];
    ring.xx += double{model.fx[k]} * model.fx[k];
    ring.xy += double{model.fx[k]} * model.fy[k];
    ring.yy += double{model.fy[k]} * model.fy[k];
    ++ring.pixels;
  }
  const double variance =
      source.noise_levels * source.noise_levels + source.frame_noise_levels * source.frame_noise_levels;
  const double least = variance / (known_px * known_px);
  double xx = 0.0, xy = 0.0, yy = 0.0;
  int pixels = 0;
  std::size_t radius = 0;
  for (bool enough = false; !enough; ++radius) {
    if (radius == rings.size()) return std::nullopt;
    xx += rings[radius].xx, xy += rings[radius].xy, yy += rings[radius].yy;
    pixels += rings[radius].pixels;
    const double smaller = 0.5 * (xx + yy) - std::hypot(0.5 * (xx - yy), xy);
    enough = pixels >= solved_pixels && smaller > least;
  }
  cv::Mat1b mask(source.region.height, source.region.width, std::uint8_t{0});
  const cv::Point point(static_cast<int>(std::lround(source.point.x_px)),
                        static_cast<int>(std::lround(source.point.y_px)));
  cv::circle(mask, point, static_cast<int>(std::ceil(around_point * static_cast<double>(radius))), cv::Scalar(1),
             cv::FILLED);
  TargetPart out;
  out.least_share = most_at_point;
  const Told told = tell(fine, mask, out);
  if (told.energy > most_of_target * told.all) return std::nullopt;
  return out;
}

TemplateSource source_of(const TemplateSource& whole, const TargetPart& part) {
  const cv::Rect box = (part.box + cv::Size(2 * border_px, 2 * border_px) - cv::Point(border_px, border_px)) &
                       cv::Rect(0, 0, whole.region.width, whole.region.height);
  TemplateSource out;
  out.margin_px = whole.margin_px;
  out.region = {whole.region.x + box.x, whole.region.y + box.y, box.width, box.height};
  out.point = {whole.point.x_px - box.x, whole.point.y_px - box.y};
  out.noise_levels = whole.noise_levels;
  out.frame_noise_levels = whole.frame_noise_levels;
  out.pixels = FloatImage(box.width + 2 * whole.margin_px, box.height + 2 * whole.margin_px);
  for (int row = 0; row < out.pixels.height; ++row) {
    std::copy_n(whole.pixels.row(box.y + row) + box.x, out.pixels.width, out.pixels.row(row));
  }
  out.usable.reserve(static_cast<std::size_t>(box.area()));
  for (int row = 0; row < box.height; ++row) {
    const auto first = part.pixels.begin() + static_cast<std::ptrdiff_t>(box.y + row) * whole.region.width + box.x;
    out.usable.insert(out.usable.end(), first, first + box.width);
  }
  return out;
}

}  // namespace zerodrift::vision
