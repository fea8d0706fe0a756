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
constexpr int same_period_px = 2;
constexpr std::size_t most_periods = 40;  // beside their opposites

constexpr int samples_a_side = 80;
constexpr int window_samples = 9;
constexpr double even_share = 0.05;  // of the target's variance: a window with less shows nothing
constexpr int saturated_level = 252;
constexpr int bright_margin_px = 7;   // what a saturated spot's edge spoils
constexpr double least_lost = 0.25;   // of the lead where all is seen, for a place to be told from another
constexpr double sure_lead = 0.3;     // of the region: more than the covers beside which a target is measured
constexpr double bad_residual = 6.0;  // standard deviations of shot noise: a bad fit has no outliers
constexpr double least_told = 0.015;  // of the region, by which it must differ from itself a period further
constexpr std::array grown = {0.0, 0.125, 0.25, 0.375, 0.5, 0.75};  // of the region's larger side, on each side

/// A picture against itself.
class Itself {
 public:
  explicit Itself(const cv::Mat1f& picture) : m_picture(picture) { cv::integral(picture, m_sums, m_squares, CV_64F); }

  /// Normalized correlation over the overlap, shifted; 0 where either part is even.
  double likeness(int dx, int dy) const {
    const cv::Size size(m_picture.cols - std::abs(dx), m_picture.rows - std::abs(dy));
    const cv::Rect here(cv::Point(std::max(dx, 0), std::max(dy, 0)), size);
    const cv::Rect there(cv::Point(std::max(-dx, 0), std::max(-dy, 0)), size);
    const double n = size.area();
    const double mean_here = within(m_sums, here) / n, mean_there = within(m_sums, there) / n;
    const double square_here = within(m_squares, here) / n - mean_here * mean_here;
    const double square_there = within(m_squares, there) / n - mean_there * mean_there;
    if (!(square_here > 1.0 && square_there > 1.0)) return 0.0;
    const double product = m_picture(here).dot(m_picture(there)) / n - mean_here * mean_there;
    return product / std::sqrt(square_here * square_there);
  }

  const cv::Mat1f& picture() const { return m_picture; }

 private:
  static double within(const cv::Mat1d& sums, const cv::Rect& at) {
    return sums(at.y + at.height, at.x + at.width) - sums(at.y, at.x + at.width) - sums(at.y + at.height, at.x) +
           sums(at.y, at.x);
  }

  cv::Mat1f m_picture;
  cv::Mat1d m_sums, m_squares;
};

/// The peak of the full picture that is next to a place, and how high it is.
std::pair<std::array<int, 2>, double> top_near(const Itself& region, std::array<int, 2> period) {
  const int rounds = static_cast<int>(std::max(region.picture().cols, region.picture().rows) / searched_px) + 2;
  double top = region.likeness(period[0], period[1]);
  for (int round = 0; round < rounds; ++round) {
    std::array<int, 2> best{0, 0};
    for (const std::array<int, 2> to : {std::array{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      const double here = region.likeness(period[0] + to[0], period[1] + to[1]);
      if (here > top) top = here, best = to;
    }
    if (best == std::array{0, 0}) break;
    period[0] += best[0], period[1] += best[1];
  }
  return {period, top};
}

/// Peaks of the correlation of the picture with itself over the overlap, px; of two opposites one.
std::vector<std::array<int, 2>> peaks_of(const cv::Mat1f& region) {
  const double shrink = std::max(1.0, std::max(region.cols, region.rows) / searched_px);
  const cv::Size size(static_cast<int>(std::lround(region.cols / shrink)),
                      static_cast<int>(std::lround(region.rows / shrink)));
  cv::Mat1f picture;
  cv::resize(region, picture, size, 0, 0, cv::INTER_AREA);
  const Itself itself(picture);
  const int far_x = static_cast<int>((1.0 - least_overlap) * size.width);
  const int far_y = static_cast<int>((1.0 - least_overlap) * size.height);
  cv::Mat1d map(2 * far_y + 1, 2 * far_x + 1);
  for (int dy = 0; dy <= far_y; ++dy) {
    for (int dx = -far_x; dx <= far_x; ++dx) {
      map(far_y + dy, far_x + dx) = map(far_y - dy, far_x - dx) = itself.likeness(dx, dy);
    }
  }
  std::vector<std::array<int, 2>> peaks;
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
      if (highest) peaks.push_back({dx, dy});
    }
  }
  for (std::array<int, 2>& peak : peaks) {
    peak = {static_cast<int>(std::lround(peak[0] * static_cast<double>(region.cols) / size.width)),
            static_cast<int>(std::lround(peak[1] * static_cast<double>(region.rows) / size.height))};
  }
  return peaks;
}

bool same(const std::array<int, 2>& a, const std::array<int, 2>& b) {
  return std::max(std::abs(a[0] - b[0]), std::abs(a[1] - b[1])) <= same_period_px;
}

/// A peak of the whole region too, and not that of no shift at all.
bool repeats_after(const Itself& region, const std::array<int, 2>& rough) {
  const auto [period, top] = top_near(region, rough);
  return top >= least_correlation && same(period, rough) && !same(period, {0, 0});
}

/// Periods, px, the nearest first; of two opposites one. What is fine for the picture of the whole region shows in its
/// middle part, half and half again as large.
std::vector<std::array<int, 2>> rough_periods(const Itself& region) {
  const cv::Mat1f& picture = region.picture();
  std::vector<std::array<int, 2>> periods = peaks_of(picture);
  for (cv::Rect part({0, 0}, picture.size()); std::max(part.width, part.height) > searched_px;) {
    part = {part.x + part.width / 4, part.y + part.height / 4, part.width / 2, part.height / 2};
    for (const std::array<int, 2>& one : peaks_of(picture(part))) {
      const auto known = [&](const std::array<int, 2>& other) { return same(one, other); };
      if (std::none_of(periods.begin(), periods.end(), known) && repeats_after(region, one)) periods.push_back(one);
    }
  }
  std::stable_sort(periods.begin(), periods.end(), [](const std::array<int, 2>& a, const std::array<int, 2>& b) {
    return a[0] * a[0] + a[1] * a[1] < b[0] * b[0] + b[1] * b[1];
  });
  if (periods.size() > most_periods) periods.resize(most_periods);
  return periods;
}

/// Between the pixels of the full picture by a parabola along each axis.
Eigen::Vector2d refined(const Itself& region, const std::array<int, 2>& rough) {
  const auto [period, top] = top_near(region, rough);
  const double before_x = region.likeness(period[0] - 1, period[1]);
  const double after_x = region.likeness(period[0] + 1, period[1]);
  const double before_y = region.likeness(period[0], period[1] - 1);
  const double after_y = region.likeness(period[0], period[1] + 1);
  const auto between = [](double before, double at, double after) {
    const double bend = before - 2.0 * at + after;
    return bend < 0.0 ? std::clamp((before - after) / (2.0 * bend), -0.5, 0.5) : 0.0;
  };
  return {period[0] + between(before_x, top, after_x), period[1] + between(before_y, top, after_y)};
}

double variance_of(const cv::Mat1f& levels) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(levels, mean, deviation);
  return deviation[0] * deviation[0];
}

FloatImage smoothed(const GrayImage& image, int step_px) {
  FloatImage out(image.width, image.height);
  cv::Mat1f to = mat_view(out);
  cv::boxFilter(mat_view(image), to, CV_32F, {step_px, step_px}, {-1, -1}, true, cv::BORDER_REPLICATE);
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

RepeatingTarget::RepeatingTarget(const GrayImage& image, const Region& region)
    : m_region(region),
      m_point(centre_of(region)),
      m_step_px(std::max(1, std::max(region.width, region.height) / samples_a_side)) {
  cv::Mat1f inside;
  mat_view(image)(cv::Rect(region.x, region.y, region.width, region.height)).convertTo(inside, CV_32F);
  const Itself itself(inside);
  for (const std::array<int, 2>& one : rough_periods(itself)) {
    const Eigen::Vector2d there = refined(itself, one);
    m_periods.push_back({there, {}});
    m_periods.push_back({-there, {}});
  }
  const std::vector<std::uint8_t> all(static_cast<std::size_t>(region.width) * region.height, 1);
  *this = with(image, m_point, all);
}

RepeatingTarget RepeatingTarget::with(const GrayImage& image, const PixelPoint& point,
                                      const std::vector<std::uint8_t>& usable) const {
  RepeatingTarget out = *this;
  out.m_point = point;
  if (repeats()) out.compare(image, usable);
  return out;
}

void RepeatingTarget::compare(const GrayImage& image, const std::vector<std::uint8_t>& usable) {
  const FloatImage picture = smoothed(image, m_step_px);
  m_template = m_usable = FloatImage(m_region.width / m_step_px, m_region.height / m_step_px);
  cv::Mat1f levels = mat_view(m_template), use = mat_view(m_usable);
  for (int row = 0; row < levels.rows; ++row) {
    for (int column = 0; column < levels.cols; ++column) {
      const int x = column * m_step_px;
      const int y = row * m_step_px;
      levels(row, column) = picture.row(m_region.y + y)[m_region.x + x];
      use(row, column) = usable[static_cast<std::size_t>(y) * m_region.width + x] != 0 ? 1.0f : 0.0f;
    }
  }
  Registration itself;
  itself.contrast = 1.0;
  const FloatImage visible = visible_in(image);
  m_even_variance = even_share * variance_of(levels);
  const FloatImage here = likeness(picture, visible, itself, Eigen::Vector2d::Zero());
  for (Period& one : m_periods) {
    one.lost = lead(here, likeness(picture, visible, itself, one.shift_px), one.shift_px);
  }
}

// Window by window, since light is even over a window: what correlates there with the target is explained, what does
// not is a contradiction unless nothing can be seen there.
FloatImage RepeatingTarget::likeness(const FloatImage& frame, const FloatImage& visible, const Registration& found,
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
  return window_likeness(m_template, seen, weight, window_samples, found.contrast, m_even_variance);
}

// What neither place explains is a cover and speaks for none of them.
RepeatingTarget::Lead RepeatingTarget::lead(const FloatImage& here, const FloatImage& there,
                                            const Eigen::Vector2d& shift_px) const {
  const int right = static_cast<int>(std::lround(shift_px(0) / m_step_px));
  const int down = static_cast<int>(std::lround(shift_px(1) / m_step_px));
  Lead out;
  for (int row = std::min(0, down); row < m_template.height + std::max(0, down); ++row) {
    for (int column = std::min(0, right); column < m_template.width + std::max(0, right); ++column) {
      const auto within = [&](int x, int y) {
        return x >= 0 && y >= 0 && x < m_template.width && y < m_template.height;
      };
      const bool in_here = within(column, row), in_there = within(column - right, row - down);
      const bool against_here = in_here && here.row(row)[column] < 0.0f;
      const bool against_there = in_there && there.row(row - down)[column - right] < 0.0f;
      if (against_here == against_there) continue;
      const double share = (against_there ? 1.0 : -1.0) / static_cast<double>(m_template.values.size());
      out.in_all += share;
      if (in_here && in_there) out.where_both_tell += share;
    }
  }
  return out;
}

RepeatingTarget::Doubt RepeatingTarget::doubt(const GrayImage& frame, const Registration& found) const {
  Doubt out;
  if (!repeats()) return out;
  const FloatImage picture = smoothed(frame, m_step_px);
  const FloatImage visible = visible_in(frame);
  const FloatImage here = likeness(picture, visible, found, Eigen::Vector2d::Zero());
  const auto unlike = std::count_if(here.values.begin(), here.values.end(), [](float one) { return one < 0.0f; });
  out.unlike = static_cast<double>(unlike) / static_cast<double>(here.values.size());
  out.may_be_elsewhere = found.residual >= bad_residual;
  if (out.unlike < least_lost * told_apart()) return out;  // elsewhere more would be
  double least = 0.0;
  for (const Period& period : m_periods) {
    const Lead leads = lead(here, likeness(picture, visible, found, period.shift_px), period.shift_px);
    const double in_all = leads.in_all / period.lost.in_all;
    const double both = leads.where_both_tell / std::max(period.lost.where_both_tell, least_told);
    if (leads.in_all > sure_lead || std::min(in_all, both) > least_lost) continue;
    out.may_be_elsewhere = true;
    if (leads.where_both_tell >= least) continue;
    least = leads.where_both_tell;
    out.likelier_px = found.linear * period.shift_px;
  }
  return out;
}

double RepeatingTarget::told_apart() const {
  double least = 1.0;
  for (const Period& period : m_periods) least = std::min(least, period.lost.in_all);
  return least;
}

std::optional<RepeatingTarget> RepeatingTarget::that_tells(const GrayImage& image, const Region& region) {
  for (const double part : grown) {
    const int more = static_cast<int>(std::lround(part * std::max(region.width, region.height)));
    const int left = std::max(region.x - more, 0), top = std::max(region.y - more, 0);
    const Region larger{left, top, std::min(region.x + region.width + more, image.width) - left,
                        std::min(region.y + region.height + more, image.height) - top};
    if (RepeatingTarget one(image, larger); one.told_apart() > least_told) return one;
  }
  return std::nullopt;
}

}  // namespace zerodrift::vision
