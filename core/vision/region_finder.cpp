#include "core/vision/region_finder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/vision/opencv_image.h"

namespace zerodrift::vision {
namespace {

constexpr double least_eigenvalue = 0.5;  // mean over the window, grey levels^2 / px^2
constexpr double least_shown = 2.0;       // the same of a block that shows something, not noise alone
constexpr int strip_px = 8;
constexpr int block_px = 24;
constexpr double goes_on = 0.15;     // of the window's mean squared gradient: beside it the same thing goes on
constexpr double widest = 1.75;      // times the window
constexpr int least_room_px = 24;    // to the picture's border, for what is to come
constexpr int least_side_px = 32;    // of a small thing, before what is around it is added
constexpr int surroundings_px = 12;  // an outline is drawn by what is on both of its sides

// Sum over windows of this size, at the window's first pixel.
cv::Mat window_means(const cv::Mat& values, int size) {
  cv::Mat out;
  cv::boxFilter(values, out, CV_32F, {size, size}, {0, 0}, true, cv::BORDER_CONSTANT);
  return out(cv::Rect(0, 0, values.cols - size + 1, values.rows - size + 1));
}

bool shows_more(const cv::Mat& energy, const cv::Rect& strip, double limit) {
  const bool lies = strip.width > strip.height;
  const int length = std::max(strip.width, strip.height);
  for (int at = 0; at < length; at += block_px) {
    const int size = std::min(block_px, length - at);
    const cv::Rect block =
        lies ? cv::Rect(strip.x + at, strip.y, size, strip.height) : cv::Rect(strip.x, strip.y + at, strip.width, size);
    if (cv::mean(energy(block))[0] > limit) return true;
  }
  return false;
}

// Less of the window where it shows nothing at its sides: a small thing is not looked for with what is around it.
cv::Rect without_margins(const cv::Mat& energy, const cv::Rect& window, double limit) {
  cv::Rect out = window;
  for (bool less = true; less;) {
    less = false;
    const std::array<cv::Rect, 4> strips{cv::Rect(out.x, out.y, strip_px, out.height),
                                         cv::Rect(out.x, out.y, out.width, strip_px),
                                         cv::Rect(out.x + out.width - strip_px, out.y, strip_px, out.height),
                                         cv::Rect(out.x, out.y + out.height - strip_px, out.width, strip_px)};
    for (std::size_t side = 0; side < strips.size() && !less; ++side) {
      const bool narrow = (side % 2 == 0 ? out.width : out.height) <= least_side_px;
      if (narrow || shows_more(energy, strips[side], limit)) continue;
      if (side == 0) out.x += strip_px;
      if (side == 1) out.y += strip_px;
      (side % 2 == 0 ? out.width : out.height) -= strip_px;
      less = true;
    }
  }
  return out;
}

// The window as it is, or all of the single thing that it shows in part, with a little of what is around it.
cv::Rect all_of_thing(const cv::Mat& energy, const cv::Rect& window) {
  const cv::Rect picture(0, 0, energy.cols, energy.rows);
  const cv::Rect usable(least_room_px, least_room_px, energy.cols - 2 * least_room_px, energy.rows - 2 * least_room_px);
  const double limit = std::max(goes_on * cv::mean(energy(window))[0], least_shown);
  const auto grown = [](const cv::Rect& r, int left, int top, int right, int bottom) {
    return cv::Rect(r.x - left, r.y - top, r.width + left + right, r.height + top + bottom);
  };
  cv::Rect out = without_margins(energy, window, limit);
  for (bool more = true; more;) {
    more = false;
    const std::array<cv::Rect, 4> strips{cv::Rect(out.x - strip_px, out.y, strip_px, out.height),
                                         cv::Rect(out.x, out.y - strip_px, out.width, strip_px),
                                         cv::Rect(out.x + out.width, out.y, strip_px, out.height),
                                         cv::Rect(out.x, out.y + out.height, out.width, strip_px)};
    std::array<int, 4> by{};
    for (std::size_t side = 0; side < strips.size(); ++side) {
      if ((strips[side] & picture) != strips[side] || !shows_more(energy, strips[side], limit)) continue;
      if ((strips[side] & usable) != strips[side]) return window;  // it leaves the picture
      by[side] = strip_px;
      more = true;
    }
    out = grown(out, by[0], by[1], by[2], by[3]);
    if (std::max(out.width, out.height) > widest * window.width) return window;  // it is everywhere
  }
  const int m = surroundings_px;
  return grown(out, m, m, m, m) & picture;
}

}  // namespace

Result<Region> find_textured_region(const GrayImage& image, const std::string& name, const Region* beside) {
  const int size = std::min(image.width, image.height) / 3;
  if (size < 24) return fail(ErrorCode::template_without_texture, {{"file", name}});
  cv::Mat smooth, gx, gy;
  mat_view(image).convertTo(smooth, CV_32F);
  cv::GaussianBlur(smooth, smooth, {0, 0}, 1.5);  // noise is no texture
  cv::Sobel(smooth, gx, CV_32F, 1, 0, 3, 1.0 / 8);
  cv::Sobel(smooth, gy, CV_32F, 0, 1, 3, 1.0 / 8);
  if (beside != nullptr) {
    const int m = surroundings_px;
    const cv::Rect known(beside->x - m, beside->y - m, beside->width + 2 * m, beside->height + 2 * m);
    for (cv::Mat* one : {&gx, &gy}) (*one)(known & cv::Rect(0, 0, image.width, image.height)) = 0.0;
  }
  const cv::Mat xx = window_means(gx.mul(gx), size);
  const cv::Mat xy = window_means(gx.mul(gy), size);
  const cv::Mat yy = window_means(gy.mul(gy), size);
  cv::Mat root;
  cv::sqrt((xx - yy).mul(xx - yy) + 4.0 * xy.mul(xy), root);
  const cv::Mat smaller = 0.5 * (xx + yy - root);
  // Room to travel counts: a window at the border would leave the view with the first drift.
  cv::Mat score = smaller.clone();
  const int margin = size / 8;
  for (int y = 0; y < score.rows; ++y) {
    for (int x = 0; x < score.cols; ++x) {
      const int room = std::min({x, y, score.cols - 1 - x, score.rows - 1 - y});
      score.at<float>(y, x) *= static_cast<float>(std::min(1.0, 0.3 + 0.7 * room / std::max(margin, 1)));
    }
  }
  cv::Point best;
  cv::minMaxLoc(score, nullptr, nullptr, nullptr, &best);
  if (smaller.at<float>(best) < least_eigenvalue) return fail(ErrorCode::template_without_texture, {{"file", name}});
  const cv::Rect found = all_of_thing(gx.mul(gx) + gy.mul(gy), {best.x, best.y, size, size});
  return Region{found.x, found.y, found.width, found.height};
}

}  // namespace zerodrift::vision
