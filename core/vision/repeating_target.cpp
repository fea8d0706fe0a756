#include "core/vision/repeating_target.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>

#include "core/vision/opencv_image.h"
#include "core/vision/window_likeness.h"

namespace zerodrift::vision {
namespace {

constexpr double searched_px = 56.0;       // the larger side of the picture in which periods are searched
constexpr double least_overlap = 0.4;      // of each side
constexpr double least_correlation = 0.7;  // rings and spokes stay below half of it
constexpr int least_shift = 2;             // px of that picture: nearer it is the pattern's own smoothness
constexpr std::size_t most_periods = 8;    // beside their opposites

constexpr int samples_a_side = 80;
constexpr int window_samples = 9;
constexpr int saturated_level = 252;
constexpr int bright_margin_px = 7;   // what a saturated spot's edge spoils
constexpr double least_lost = 0.25;   // of what a period takes away where all is seen; true places keep 0.4 and more
constexpr double seen_whole = 0.93;   // inliers, of all pixels
constexpr double bad_residual = 6.0;  // standard deviations of shot noise: a bad fit has no outliers

/// Normalized correlation of the picture with itself, shifted; 0 where either part is even.
double likeness(const cv::Mat1f& picture, int dx, int dy) {
  const int width = picture.cols - std::abs(dx);
  const int height = picture.rows - std::abs(dy);
  const cv::Mat1f a = picture(cv::Rect(std::max(dx, 0), std::max(dy, 0), width, height));
  const cv::Mat1f b = picture(cv::Rect(std::max(-dx, 0), std::max(-dy, 0), width, height));
  const double n = static_cast<double>(width) * height;
  const double mean_a = cv::sum(a)[0] / n;
  const double mean_b = cv::sum(b)[0] / n;
  const double square_a = a.dot(a) / n - mean_a * mean_a;
  const double square_b = b.dot(b) / n - mean_b * mean_b;
  const double product = a.dot(b) / n - mean_a * mean_b;
  return square_a > 1.0 && square_b > 1.0 ? product / std::sqrt(square_a * square_b) : 0.0;
}

/// Peaks of the correlation of the region with itself over the overlap, the most alike first; of two opposites one.
std::vector<std::array<int, 2>> rough_periods(const cv::Mat1f& region) {
  const double shrink = std::max(1.0, std::max(region.cols, region.rows) / searched_px);
  const cv::Size size(static_cast<int>(std::lround(region.cols / shrink)),
                      static_cast<int>(std::lround(region.rows / shrink)));
  cv::Mat1f picture;
  cv::resize(region, picture, size, 0, 0, cv::INTER_AREA);
  const int far_x = static_cast<int>((1.0 - least_overlap) * size.width);
  const int far_y = static_cast<int>((1.0 - least_overlap) * size.height);
  cv::Mat1d map(2 * far_y + 1, 2 * far_x + 1);
  for (int dy = 0; dy <= far_y; ++dy) {
    for (int dx = -far_x; dx <= far_x; ++dx) {
      map(far_y + dy, far_x + dx) = map(far_y - dy, far_x - dx) = likeness(picture, dx, dy);
    }
  }
  struct Peak {
    double correlation;
    int dx, dy;
  };
  std::vector<Peak> peaks;
  for (int dy = 0; dy <= far_y; ++dy) {
    for (int dx = -far_x; dx <= far_x; ++dx) {
      const double here = map(far_y + dy, far_x + dx);
      if (here < least_correlation || std::max(dy, std::abs(dx)) < least_shift || (dy == 0 && dx < 0)) continue;
      bool highest = true;
      for (int y = std::max(dy - 1, -far_y); y <= std::min(dy + 1, far_y); ++y) {
        for (int x = std::max(dx - 1, -far_x); x <= std::min(dx + 1, far_x); ++x) {
          highest = highest && map(far_y + y, far_x + x) <= here;
        }
      }
      if (highest) peaks.push_back({here, dx, dy});
    }
  }
  std::sort(peaks.begin(), peaks.end(), [](const Peak& a, const Peak& b) { return a.correlation > b.correlation; });
  if (peaks.size() > most_periods) peaks.resize(most_periods);
  std::vector<std::array<int, 2>> periods;
  for (const Peak& peak : peaks) {
    periods.push_back({static_cast<int>(std::lround(peak.dx * static_cast<double>(region.cols) / size.width)),
                       static_cast<int>(std::lround(peak.dy * static_cast<double>(region.rows) / size.height))});
  }
  return periods;
}

/// To the top of the peak in the full picture, and between its pixels by a parabola along each axis.
Eigen::Vector2d refined(const cv::Mat1f& region, std::array<int, 2> period) {
  const int rounds = static_cast<int>(std::max(region.cols, region.rows) / searched_px) + 2;
  const auto at = [&](int dx, int dy) { return likeness(region, period[0] + dx, period[1] + dy); };
  double top = at(0, 0);
  for (int round = 0; round < rounds; ++round) {
    std::array<int, 2> best{0, 0};
    for (const std::array<int, 2> to : {std::array{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      const double here = at(to[0], to[1]);
      if (here > top) top = here, best = to;
    }
    if (best == std::array{0, 0}) break;
    period[0] += best[0], period[1] += best[1];
  }
  const auto between = [top](double before, double after) {
    const double bend = before - 2.0 * top + after;
    return bend < 0.0 ? std::clamp((before - after) / (2.0 * bend), -0.5, 0.5) : 0.0;
  };
  return {period[0] + between(at(-1, 0), at(1, 0)), period[1] + between(at(0, -1), at(0, 1))};
}

FloatImage smoothed(const GrayImage& image, int step_px) {
  FloatImage out(image.width, image.height);
  cv::Mat1f to = mat_view(out);
  mat_view(image).convertTo(to, CV_32F);
  cv::blur(to, to, {step_px, step_px}, {-1, -1}, cv::BORDER_REPLICATE);
  return out;
}

/// 0 at saturated pixels and around them, else 1.
FloatImage visible_in(const GrayImage& frame) {
  cv::Mat bright;
  cv::threshold(mat_view(frame), bright, saturated_level - 1, 1.0, cv::THRESH_BINARY_INV);
  cv::erode(bright, bright, cv::Mat::ones(bright_margin_px, bright_margin_px, CV_8U));
  FloatImage out(bright.cols, bright.rows);
  bright.convertTo(mat_view(out), CV_32F);
  return out;
}

}  // namespace

RepeatingTarget::RepeatingTarget(const GrayImage& image, const Region& region, const PixelPoint& point,
                                 const std::vector<std::uint8_t>& usable)
    : m_region(region), m_point(point), m_step_px(std::max(1, std::max(region.width, region.height) / samples_a_side)) {
  cv::Mat1f inside;
  mat_view(image)(cv::Rect(region.x, region.y, region.width, region.height)).convertTo(inside, CV_32F);
  const std::vector<std::array<int, 2>> rough = rough_periods(inside);
  if (rough.empty()) return;
  const FloatImage picture = smoothed(image, m_step_px);
  m_template = m_energy = m_usable = FloatImage(region.width / m_step_px, region.height / m_step_px);
  cv::Mat1f levels = mat_view(m_template), energy = mat_view(m_energy), use = mat_view(m_usable);
  for (int row = 0; row < levels.rows; ++row) {
    for (int column = 0; column < levels.cols; ++column) {
      const int x = column * m_step_px;
      const int y = row * m_step_px;
      levels(row, column) = picture.row(region.y + y)[region.x + x];
      use(row, column) = usable[static_cast<std::size_t>(y) * region.width + x] != 0 ? 1.0f : 0.0f;
    }
  }
  cv::Mat1f along_x, along_y;
  cv::Sobel(levels, along_x, CV_32F, 1, 0, 3, 1.0, 0.0, cv::BORDER_REPLICATE);
  cv::Sobel(levels, along_y, CV_32F, 0, 1, 3, 1.0, 0.0, cv::BORDER_REPLICATE);
  double all = 1e-9;
  for (int row = 0; row < levels.rows; ++row) {
    for (int column = 0; column < levels.cols; ++column) {
      const float x = along_x(row, column);
      const float y = along_y(row, column);
      all += energy(row, column) = use(row, column) * (x * x + y * y);
    }
  }
  for (float& one : m_energy.values) one /= static_cast<float>(all);
  Registration itself;
  itself.contrast = 1.0;
  const FloatImage visible = visible_in(image);
  const double whole = balance(picture, visible, itself, Eigen::Vector2d::Zero());
  for (const std::array<int, 2>& one : rough) {
    const Eigen::Vector2d there = refined(inside, one);
    for (const Eigen::Vector2d& shift_px : {there, Eigen::Vector2d(-there)}) {
      m_periods.push_back({shift_px, whole - balance(picture, visible, itself, shift_px)});
    }
  }
}

// Window by window, since light is even over a window: what correlates there with the target is explained, what does
// not is a contradiction unless nothing can be seen there.
double RepeatingTarget::balance(const FloatImage& frame, const FloatImage& visible, const Registration& found,
                                const Eigen::Vector2d& shift_px) const {
  cv::Mat1f map_x(m_template.height, m_template.width), map_y(m_template.height, m_template.width);
  const Eigen::Vector2d point(m_point.x_px, m_point.y_px);
  for (int row = 0; row < map_x.rows; ++row) {
    for (int column = 0; column < map_x.cols; ++column) {
      const Eigen::Vector2d at(m_region.x + column * m_step_px, m_region.y + row * m_step_px);
      const Eigen::Vector2d there = point + found.displacement_px + found.linear * (at - point + shift_px);
      map_x(row, column) = static_cast<float>(there(0));
      map_y(row, column) = static_cast<float>(there(1));
    }
  }
  FloatImage seen(m_template.width, m_template.height), weight(m_template.width, m_template.height);
  cv::remap(mat_view(frame), mat_view(seen), map_x, map_y, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  cv::remap(mat_view(visible), mat_view(weight), map_x, map_y, cv::INTER_NEAREST, cv::BORDER_CONSTANT, 0);
  for (std::size_t k = 0; k < weight.values.size(); ++k) weight.values[k] *= m_usable.values[k];
  const FloatImage likeness = window_likeness(m_template, seen, weight, window_samples, found.contrast);
  double out = 0.0;
  for (std::size_t k = 0; k < likeness.values.size(); ++k) out += likeness.values[k] * m_energy.values[k];
  return out;
}

bool RepeatingTarget::may_be_elsewhere(const GrayImage& frame, const Registration& found) const {
  if (!repeats() || (found.inlier_share > seen_whole && found.residual < bad_residual)) return false;
  if (found.residual >= bad_residual) return true;
  const FloatImage picture = smoothed(frame, m_step_px);
  const FloatImage visible = visible_in(frame);
  const double here = balance(picture, visible, found, Eigen::Vector2d::Zero());
  return std::any_of(m_periods.begin(), m_periods.end(), [&](const Period& period) {
    return here - balance(picture, visible, found, period.shift_px) < least_lost * period.lost;
  });
}

}  // namespace zerodrift::vision
