#include "core/vision/bare_place.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/vision/backdrop_sheet.h"
#include "core/vision/opencv_image.h"

namespace zerodrift::vision {
namespace {

constexpr int step_px = 2;
constexpr float opaque = 0.5f;
constexpr std::size_t least_pixels = 200;
constexpr double most_of_it = 0.6;    // of the target's pixels must be where the backdrop is known
constexpr double explained = 2.0;     // times the noise, and
constexpr double known_levels = 1.5;  // grey levels: the backdrop is a blurred median
constexpr double clearly_more = 3.0;  // times what the backdrop leaves
constexpr double least_gain = 0.4, largest_gain = 2.5;

// Root mean square of what a straight line from `from` to `to` leaves, with a gain that light can have.
double left_by(const std::vector<float>& from, const std::vector<float>& to) {
  const double n = static_cast<double>(from.size());
  double f = 0.0, t = 0.0, ff = 0.0, ft = 0.0, tt = 0.0;
  for (std::size_t k = 0; k < from.size(); ++k) {
    f += double{from[k]}, t += double{to[k]};
    ff += double{from[k]} * from[k], ft += double{from[k]} * to[k], tt += double{to[k]} * to[k];
  }
  ff -= f * f / n, ft -= f * t / n, tt -= t * t / n;
  const double gain = ff > 0.0 ? std::clamp(ft / ff, least_gain, largest_gain) : least_gain;
  return std::sqrt(std::max(tt - 2.0 * gain * ft + gain * gain * ff, 0.0) / n);
}

}  // namespace

bool is_bare(const GrayImage& frame, const GrayImage& picture, const Region& region, const Backdrop& behind, int dx_px,
             int dy_px) {
  std::vector<float> shown, target, bare;
  std::size_t asked = 0;
  const Region& area = behind.area;
  for (int y = 0; y < region.height; y += step_px) {
    for (int x = 0; x < region.width; x += step_px) {
      if (behind.clear.row(y + template_margin_px)[x + template_margin_px] > opaque) continue;
      ++asked;
      const int at_x = region.x + x + dx_px;
      const int at_y = region.y + y + dy_px;
      const bool known = at_x >= std::max(area.x, 0) && at_y >= std::max(area.y, 0) &&
                         at_x < std::min(area.x + area.width, frame.width) &&
                         at_y < std::min(area.y + area.height, frame.height);
      if (!known) continue;
      shown.push_back(frame.at(at_x, at_y));
      target.push_back(picture.at(region.x + x, region.y + y));
      bare.push_back(behind.at(static_cast<float>(at_x), static_cast<float>(at_y)));
    }
  }
  if (shown.size() < least_pixels || static_cast<double>(shown.size()) < most_of_it * static_cast<double>(asked)) {
    return false;
  }
  const double by_bare = left_by(bare, shown);
  if (left_by(target, shown) <= clearly_more * by_bare) return false;
  const FloatImage patch = crop(frame, {region.x + dx_px, region.y + dy_px, region.width, region.height});
  const double noise =
      backdrop::noise_of(cv::Mat(patch.height, patch.width, CV_32F, const_cast<float*>(patch.values.data())));
  return by_bare < explained * noise + known_levels;
}

}  // namespace zerodrift::vision
