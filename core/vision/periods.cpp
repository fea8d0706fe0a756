#include "core/vision/periods.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>

#include "core/vision/opencv_image.h"

namespace zerodrift::vision {
namespace {

constexpr double searched_px = 56.0;       // the larger side of the picture that is compared
constexpr double least_overlap = 0.4;      // of each side
constexpr double least_correlation = 0.7;  // rings and spokes stay below half of it
constexpr int least_shift = 2;             // px of that picture: nearer it is the pattern's own smoothness
constexpr std::size_t most_periods = 8;    // beside their opposites

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

}  // namespace

std::vector<std::array<int, 2>> periods_of(const GrayImage& image, const Region& region) {
  const double shrink = std::max(1.0, std::max(region.width, region.height) / searched_px);
  const cv::Size size(static_cast<int>(std::lround(region.width / shrink)),
                      static_cast<int>(std::lround(region.height / shrink)));
  const cv::Mat inside = mat_view(image)(cv::Rect(region.x, region.y, region.width, region.height));
  cv::Mat small;
  cv::resize(inside, small, size, 0, 0, cv::INTER_AREA);
  cv::Mat1f picture;
  small.convertTo(picture, CV_32F);
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
    const int x = static_cast<int>(std::lround(peak.dx * static_cast<double>(region.width) / size.width));
    const int y = static_cast<int>(std::lround(peak.dy * static_cast<double>(region.height) / size.height));
    periods.push_back({x, y});
    periods.push_back({-x, -y});
  }
  return periods;
}

}  // namespace zerodrift::vision
