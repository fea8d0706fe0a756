#include "core/vision/outline.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/vision/opencv_image.h"

namespace zerodrift::vision {
namespace {

constexpr float seen_through = 0.5f;  // less may be the noise of what was learned
constexpr int within_outline_px = 10;
constexpr double even_blur_px = 1.5;
constexpr double even_noises = 3.0;
constexpr double even_levels = 3.0;     // that light may fall off by, over the region
constexpr double single_share = 0.98;   // of what is not beside the target, that hangs together
constexpr double most_of_region = 0.9;  // a target that fills its region shows no outline
constexpr double outline_share = 0.5;   // of the gradient energy: then it will do alone

// 1 where the template shows what is beside the target: what has been learned of it or, where that could not be told
// from the template because it is even, the even part that reaches the region's border around one thing. Empty where
// neither is so.
cv::Mat beside_target(const TemplateSource& source, const TemplateModel& model) {
  if (source.backdrop && !model.shown.empty()) {
    return cv::Mat(mat_view(source.backdrop->clear) > seen_through) / 255;
  }
  cv::Mat levels;
  cv::GaussianBlur(mat_view(source.pixels), levels, {0, 0}, even_blur_px);
  std::vector<float> border;
  for (int x = 0; x < levels.cols; ++x)
    border.insert(border.end(), {levels.at<float>(0, x), levels.at<float>(levels.rows - 1, x)});
  for (int y = 0; y < levels.rows; ++y)
    border.insert(border.end(), {levels.at<float>(y, 0), levels.at<float>(y, levels.cols - 1)});
  std::nth_element(border.begin(), border.begin() + border.size() / 2, border.end());
  const float level = border[border.size() / 2];
  const double reach = even_noises * source.noise_levels + even_levels;
  const cv::Mat even = cv::abs(levels - level) < reach;
  cv::Mat labels, figures, centres;
  // Around it: what is even within a ring is no surroundings.
  cv::Mat framed;
  cv::copyMakeBorder(even, framed, 1, 1, 1, 1, cv::BORDER_CONSTANT, 255);
  cv::connectedComponentsWithStats(framed, labels, figures, centres, 4);
  const cv::Mat around = labels == labels.at<int>(0, 0);
  const cv::Mat beside = around(cv::Rect(1, 1, even.cols, even.rows)).clone();
  const int things = cv::connectedComponentsWithStats(255 - beside, labels, figures, centres, 8);
  int largest = 0;
  for (int k = 1; k < things; ++k) largest = std::max(largest, figures.at<int>(k, cv::CC_STAT_AREA));
  const int all = static_cast<int>(beside.total()) - cv::countNonZero(beside);
  const bool one_thing = largest > single_share * all && all < most_of_region * static_cast<double>(beside.total());
  return one_thing ? cv::Mat(beside / 255) : cv::Mat();
}

}  // namespace

std::optional<TemplateSource> outline_of(const TemplateSource& source, const TemplateModel& model) {
  cv::Mat near = beside_target(source, model);
  if (near.empty()) return std::nullopt;
  const int side = 2 * within_outline_px + 1;
  cv::dilate(near, near, cv::getStructuringElement(cv::MORPH_ELLIPSE, {side, side}));
  TemplateSource out = source;
  for (int y = 0; y < source.region.height; ++y) {
    for (int x = 0; x < source.region.width; ++x) {
      const bool keep = near.at<std::uint8_t>(y + source.margin_px, x + source.margin_px) != 0;
      out.usable[static_cast<std::size_t>(y) * source.region.width + x] &= keep ? 1 : 0;
    }
  }
  double kept = 0.0, all = 0.0;
  for (int k = 0; k < model.pixels; ++k) {
    const double energy = double{model.fx[k]} * model.fx[k] + double{model.fy[k]} * model.fy[k];
    const bool keep = out.usable[static_cast<std::size_t>(model.row[k]) * source.region.width + model.column[k]] != 0;
    all += energy;
    kept += keep ? energy : 0.0;
  }
  return kept > outline_share * all ? std::optional(std::move(out)) : std::nullopt;
}

Eigen::Vector2d middle_of_turn(const TemplateModel& model) {
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (int k = 0; k < model.pixels; ++k) {
    const Eigen::Vector2d across(-double{model.fy[k]}, double{model.fx[k]});
    normal += across * across.transpose();
    right += across * across.dot(Eigen::Vector2d(model.x[k], model.y[k]));
  }
  const Eigen::Vector2d middle = normal.ldlt().solve(right);
  const bool within = middle.allFinite() && middle.norm() < std::max(model.width, model.height);
  return within ? middle : Eigen::Vector2d::Zero();
}

}  // namespace zerodrift::vision
