#include "core/vision/backdrop.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/vision/backdrop_sheet.h"
#include "core/vision/opencv_image.h"

namespace zerodrift::vision {
namespace backdrop {
namespace {

constexpr double least_backdrop_move_px = 2.0;  // below it the target and what stands behind are not told apart
constexpr std::size_t least_moved = 3;
constexpr double widest_reach_px = 80.0;  // beyond the region; further off it is not followed
constexpr int squares_window_px = 5;      // over which squares are averaged
constexpr float largest_backdrop_square = 50.0f;
constexpr float standing_square = 3.0f;  // mean square over the noise: the pixel does not travel
constexpr int closing_px = 9;            // holes where what stands behind is even
constexpr double outline_px = 7.0;       // the outline, as classified, is never further off
constexpr double usual_outline_px = 1.5;
constexpr double solid_px = 4.5;  // further inside than this the target is opaque
constexpr double plane_px = 6.0;  // around a pixel, in which the target's own brightness is fitted
constexpr double least_plane_weight = 2e-3;
constexpr double rough_window_px = 1.5;
constexpr int classifications = 2;
constexpr float near_prior = 1.0f;  // variances' worth of the usual outline near it, and of the classes elsewhere
constexpr float far_prior = 4.0f;
constexpr double opacity_window_px = 0.8;  // blur of the products: odd across the outline, so it moves nothing
constexpr double backdrop_blur_px = 1.0;   // against the noise; it is out of focus anyway
constexpr double least_part = 0.02;        // of the template's pixels on either side
constexpr float usual_read = 25.0f;

cv::Mat floats_of(const FloatImage& image) {
  return cv::Mat(image.height, image.width, CV_32F, const_cast<float*>(image.values.data()));
}

// Mean square of what a frame differs from the template by, over its noise, around each pixel.
cv::Mat squares_of(const FloatImage& still, const FloatImage& moved) {
  cv::Mat difference(still.height, still.width, CV_32F, cv::Scalar(0));
  cv::Mat seen(still.height, still.width, CV_32F, cv::Scalar(0));
  for (std::size_t k = 0; k < still.values.size(); ++k) {
    if (!is_known(still.values[k]) || !is_known(moved.values[k])) continue;
    const float root = std::sqrt((shot_noise_grey + usual_read) / (std::max(still.values[k], 0.0f) + usual_read));
    difference.ptr<float>()[k] = (moved.values[k] - still.values[k]) * root;
    seen.ptr<float>()[k] = 1.0f;
  }
  const float noise = noise_of(difference);
  cv::Mat squares = difference.mul(difference) / (noise * noise);
  squares = cv::min(squares, largest_backdrop_square);
  cv::boxFilter(squares, squares, CV_32F, {squares_window_px, squares_window_px}, {-1, -1}, false, cv::BORDER_CONSTANT);
  cv::boxFilter(seen, seen, CV_32F, {squares_window_px, squares_window_px}, {-1, -1}, false, cv::BORDER_CONSTANT);
  return squares / seen;  // 0 / 0 is NaN
}

// The target is the largest of the parts that do not stand still; what stands within it is a highlight, not a hole.
// Empty when one of the two is hardly there.
cv::Mat in_two_parts(const cv::Mat& standing) {
  cv::Mat labels, figures, centres;
  const int count = cv::connectedComponentsWithStats(255 - standing, labels, figures, centres, 4);
  int target = 0;
  for (int k = 1; k < count; ++k) {
    if (target == 0 || figures.at<int>(k, cv::CC_STAT_AREA) > figures.at<int>(target, cv::CC_STAT_AREA)) target = k;
  }
  if (target == 0) return {};
  cv::Mat behind = labels != target;
  const int parts = cv::connectedComponentsWithStats(behind, labels, figures, centres, 4);
  for (int k = 1; k < parts; ++k) {
    const int* box = figures.ptr<int>(k);
    const bool at_border = box[cv::CC_STAT_LEFT] == 0 || box[cv::CC_STAT_TOP] == 0 ||
                           box[cv::CC_STAT_LEFT] + box[cv::CC_STAT_WIDTH] == behind.cols ||
                           box[cv::CC_STAT_TOP] + box[cv::CC_STAT_HEIGHT] == behind.rows;
    if (!at_border) behind.setTo(0, labels == k);
  }
  const double part = cv::countNonZero(behind) / static_cast<double>(behind.total());
  return part < least_part || part > 1.0 - least_part ? cv::Mat() : behind;
}

// 255 where the template shows what stands behind: what does not travel and reaches the sheet's border, and what that
// encloses. Empty when there is no such thing.
cv::Mat classified(const FloatImage& still, const std::vector<FloatImage>& moved) {
  std::vector<cv::Mat> squares;
  for (const FloatImage& one : moved) squares.push_back(squares_of(still, one));
  cv::Mat standing(still.height, still.width, CV_8U, cv::Scalar(0));
  std::vector<float> values;
  for (std::size_t k = 0; k < still.values.size(); ++k) {
    values.clear();
    for (const cv::Mat& one : squares) {
      if (is_known(one.ptr<float>()[k])) values.push_back(one.ptr<float>()[k]);
    }
    standing.data[k] = values.size() >= least_moved && middle_of(values) > standing_square ? 255 : 0;
  }
  cv::Mat wide;  // closed with the border taken for standing where its surroundings are
  cv::copyMakeBorder(standing, wide, closing_px, closing_px, closing_px, closing_px, cv::BORDER_REPLICATE);
  cv::morphologyEx(wide, wide, cv::MORPH_CLOSE,
                   cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * closing_px + 1, 2 * closing_px + 1}));
  standing = wide(cv::Rect(closing_px, closing_px, still.width, still.height)).clone();
  return in_two_parts(standing);
}

cv::Mat smoothed(const cv::Mat& image, double sigma) {
  cv::Mat out;
  cv::GaussianBlur(image, out, {0, 0}, sigma, sigma, cv::BORDER_REPLICATE);
  return out;
}

// Blurs what is known and fills the rest from ever further around.
cv::Mat filled(const cv::Mat& levels) {
  cv::Mat weight(levels.size(), CV_32F, cv::Scalar(0)), value(levels.size(), CV_32F, cv::Scalar(0));
  for (std::size_t k = 0; k < levels.total(); ++k) {
    if (!is_known(levels.ptr<float>()[k])) continue;
    weight.ptr<float>()[k] = 1.0f;
    value.ptr<float>()[k] = levels.ptr<float>()[k];
  }
  cv::Mat out(levels.size(), CV_32F, cv::Scalar(unknown));
  for (const double sigma : {backdrop_blur_px, 3.0, 9.0, 27.0, 81.0}) {
    const cv::Mat share = smoothed(weight, sigma);
    const cv::Mat sum = smoothed(value, sigma);
    for (std::size_t k = 0; k < out.total(); ++k) {
      const bool first = sigma == backdrop_blur_px;
      if (is_known(out.ptr<float>()[k]) || share.ptr<float>()[k] < 1e-3f) continue;
      if (first && weight.ptr<float>()[k] == 0.0f) continue;
      out.ptr<float>()[k] = sum.ptr<float>()[k] / share.ptr<float>()[k];
    }
  }
  cv::patchNaNs(out, cv::mean(value)[0]);
  return out;
}

Region reached(const Region& sheet, const GrayImage& picture, const std::vector<LitFrame>& frames) {
  double reach = 0.0;
  for (const LitFrame& one : frames) reach = std::max(reach, one.displacement_px.norm());
  const int r = static_cast<int>(std::ceil(std::min(reach, widest_reach_px)));
  const int x = std::max(0, sheet.x - r);
  const int y = std::max(0, sheet.y - r);
  return {x, y, std::min(picture.width, sheet.x + sheet.width + r) - x,
          std::min(picture.height, sheet.y + sheet.height + r) - y};
}

// Levels of what stands behind: the median of the frames in which the target is well away. NaN where it always hides
// it.
cv::Mat seen_behind(const Sheet& sheet, const Region& area, const cv::Mat& distance,
                    const std::vector<LitFrame>& frames) {
  std::vector<Eigen::Matrix2d> back;
  for (const LitFrame& one : frames) back.push_back(one.linear.inverse());
  cv::Mat out(area.height, area.width, CV_32F, cv::Scalar(unknown));
  std::vector<float> values;
  for (int y = 0; y < area.height; ++y) {
    for (int x = 0; x < area.width; ++x) {
      values.clear();
      for (std::size_t k = 0; k < frames.size(); ++k) {
        if (!usable(*frames[k].image, area.x + x, area.y + y)) continue;
        const Eigen::Vector2d on = sheet.on_sheet(area.x + x, area.y + y, frames[k], back[k]);
        const int column = std::clamp(static_cast<int>(std::lround(on.x())), 0, sheet.width() - 1);
        const int row = std::clamp(static_cast<int>(std::lround(on.y())), 0, sheet.height() - 1);
        if (distance.at<float>(row, column) < outline_px) continue;
        const float level = frames[k].light.undone(frames[k].image->at(area.x + x, area.y + y), area.x + x, area.y + y);
        if (is_known(level)) values.push_back(level);
      }
      if (!values.empty()) out.at<float>(y, x) = middle_of(values);
    }
  }
  return out;
}

// Products of what a pixel of the sheet became and what stood behind it, over the frames.
struct Regression {
  cv::Mat product, square;
};

Regression regress(const Sheet& sheet, const FloatImage& still, const std::vector<FloatImage>& moved,
                   const Backdrop& backdrop, const cv::Mat& seen, const std::vector<LitFrame>& frames) {
  Regression out{cv::Mat(sheet.height(), sheet.width(), CV_32F, cv::Scalar(0)),
                 cv::Mat(sheet.height(), sheet.width(), CV_32F, cv::Scalar(0))};
  const Region& area = backdrop.area;
  for (int row = 0; row < sheet.height(); ++row) {
    for (int column = 0; column < sheet.width(); ++column) {
      double n = 0.0, sum_b = 0.0, sum_y = 0.0, bb = 0.0, by = 0.0;
      const auto add = [&](double x, double y, float level) {
        const int at_x = static_cast<int>(std::lround(x)) - area.x;
        const int at_y = static_cast<int>(std::lround(y)) - area.y;
        if (at_x < 0 || at_y < 0 || at_x >= area.width || at_y >= area.height) return;
        if (!is_known(level) || !is_known(seen.at<float>(at_y, at_x))) return;
        const double b = double{backdrop.at(static_cast<float>(x), static_cast<float>(y))};
        n += 1.0, sum_b += b, sum_y += double{level}, bb += b * b, by += b * double{level};
      };
      add(sheet.at().x + column, sheet.at().y + row, still.row(row)[column]);
      for (std::size_t k = 0; k < moved.size(); ++k) {
        const Eigen::Vector2d at = sheet.in_frame(column, row, frames[k]);
        add(at.x(), at.y(), moved[k].row(row)[column]);
      }
      if (n < 3.0) continue;
      out.product.at<float>(row, column) = static_cast<float>(by - sum_b * sum_y / n);
      out.square.at<float>(row, column) = static_cast<float>(bb - sum_b * sum_b / n);
    }
  }
  return out;
}

// Fit of a plane to what is inside the outline, weighted by a Gaussian around each pixel: the target's own brightness
// up to its outline, and how far single pixels are from it.
struct Extrapolated {
  cv::Mat level, variance;
};

Extrapolated extrapolated(const FloatImage& still, const cv::Mat& inside) {
  const cv::Size size = inside.size();
  cv::Mat w(size, CV_32F), x(size, CV_32F), y(size, CV_32F), t(size, CV_32F);
  const int middle_x = size.width / 2;
  const int middle_y = size.height / 2;
  for (int row = 0; row < size.height; ++row) {
    for (int column = 0; column < size.width; ++column) {
      const float level = still.row(row)[column];
      const bool use = inside.at<float>(row, column) > static_cast<float>(solid_px) && is_known(level);
      w.at<float>(row, column) = use ? 1.0f : 0.0f;
      x.at<float>(row, column) = static_cast<float>(column - middle_x) / static_cast<float>(plane_px);
      y.at<float>(row, column) = static_cast<float>(row - middle_y) / static_cast<float>(plane_px);
      t.at<float>(row, column) = use ? level : 0.0f;
    }
  }
  const auto sum = [](const cv::Mat& values) { return smoothed(values, plane_px); };
  const cv::Mat s1 = sum(w), sx = sum(w.mul(x)), sy = sum(w.mul(y)), sxx = sum(w.mul(x).mul(x)),
                sxy = sum(w.mul(x).mul(y)), syy = sum(w.mul(y).mul(y)), st = sum(w.mul(t)), sxt = sum(w.mul(x).mul(t)),
                syt = sum(w.mul(y).mul(t)), stt = sum(w.mul(t).mul(t));
  Extrapolated out{cv::Mat(size, CV_32F, cv::Scalar(unknown)), cv::Mat(size, CV_32F, cv::Scalar(0))};
  for (int k = 0; k < size.area(); ++k) {
    const auto at = [k](const cv::Mat& m) { return double{m.ptr<float>()[k]}; };
    if (at(s1) < least_plane_weight) continue;
    const Eigen::Vector3d here(1.0, at(x), at(y));
    Eigen::Matrix3d normal;
    normal << at(s1), at(sx), at(sy), at(sx), at(sxx), at(sxy), at(sy), at(sxy), at(syy);
    // About the middle of what is used, so that the weak prior on the slope does not pull the level.
    normal.bottomRightCorner<2, 2>().diagonal().array() += 1e-4 * at(s1);
    const Eigen::Vector3d right(at(st), at(sxt), at(syt));
    const Eigen::LDLT<Eigen::Matrix3d> solved(normal);
    const Eigen::Vector3d plane = solved.solve(right);
    const double scatter = std::max(at(stt) - plane.dot(right), 0.0) / at(s1);
    out.level.ptr<float>()[k] = static_cast<float>(plane.dot(here));
    // Of a single pixel there; the plane itself is known better, but what it leaves out may go on to the outline.
    out.variance.ptr<float>()[k] = static_cast<float>(scatter);
  }
  return out;
}

// Everything that is known of what stands behind, drawn on the sheet.
class Learning {
 public:
  Learning(const GrayImage& picture, const Sheet& sheet, std::vector<LitFrame> away, FloatImage still)
      : m_picture(picture), m_sheet(sheet), m_away(std::move(away)), m_still(std::move(still)) {
    for (const LitFrame& one : m_away) m_moved.push_back(sheet.travelled(one));
    cv::Mat difference = floats_of(m_moved.front()) - floats_of(m_still);
    cv::patchNaNs(difference, 0.0);
    m_variance = std::pow(noise_of(difference), 2.0f);
  }

  std::shared_ptr<const Backdrop> run() {
    cv::Mat standing = classified(m_still, m_moved);
    for (int round = 0; round < classifications && !standing.empty(); ++round) {
      look_behind(standing);
      standing = in_two_parts(opacity(standing, rough_window_px) > 0.5f);
    }
    if (standing.empty()) return nullptr;
    look_behind(standing);
    auto out = std::make_shared<Backdrop>(m_backdrop);
    out->clear = FloatImage(m_sheet.width(), m_sheet.height());
    opacity(standing, opacity_window_px).copyTo(floats_of(out->clear));
    return out;
  }

 private:
  void look_behind(const cv::Mat& standing) {
    cv::distanceTransform(standing, m_outside, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    cv::distanceTransform(255 - standing, m_inside, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    std::vector<LitFrame> all = m_away;
    all.push_back({{&m_picture, Eigen::Vector2d::Zero(), Eigen::Matrix2d::Identity(), {}}, {}});
    m_backdrop.area = reached(m_sheet.at(), m_picture, m_away);
    m_seen = seen_behind(m_sheet, m_backdrop.area, m_outside, all);
    m_backdrop.levels = FloatImage(m_backdrop.area.width, m_backdrop.area.height);
    filled(m_seen).copyTo(floats_of(m_backdrop.levels));
  }

  // How much is seen of what stands behind: from how each pixel follows it as the target moves; near the outline also
  // from where the template's level lies between that of the target and that of what stands behind, which does not
  // depend on where the target was found. As classified where neither tells.
  cv::Mat opacity(const cv::Mat& standing, double window_px) const {
    const Regression sums = regress(m_sheet, m_still, m_moved, m_backdrop, m_seen, m_away);
    const cv::Mat product = smoothed(sums.product, window_px);
    const cv::Mat square = smoothed(sums.square, window_px);
    const Extrapolated own = extrapolated(m_still, m_inside);
    cv::Mat usual;
    standing.convertTo(usual, CV_32F, 1.0 / 255.0);
    usual = smoothed(usual, usual_outline_px);
    cv::Mat out(standing.size(), CV_32F);
    for (int row = 0; row < out.rows; ++row) {
      for (int column = 0; column < out.cols; ++column) {
        const float distance = std::max(m_outside.at<float>(row, column), m_inside.at<float>(row, column));
        const bool near = distance <= static_cast<float>(outline_px);
        const float prior = (near ? near_prior : far_prior) * m_variance;
        float weight = square.at<float>(row, column) + prior;
        float sum = product.at<float>(row, column) + prior * usual.at<float>(row, column);
        const float level = m_still.row(row)[column];
        const float target = own.level.at<float>(row, column);
        if (near && is_known(level) && is_known(target)) {
          const float behind =
              m_backdrop.at(static_cast<float>(m_sheet.at().x + column), static_cast<float>(m_sheet.at().y + row));
          const float contrast = behind - target;
          const float trust = m_variance / (m_variance + own.variance.at<float>(row, column));
          weight += trust * contrast * contrast;
          sum += trust * contrast * (level - target);
        }
        out.at<float>(row, column) = std::clamp(sum / weight, 0.0f, 1.0f);
      }
    }
    return out;
  }

  const GrayImage& m_picture;
  const Sheet& m_sheet;
  std::vector<LitFrame> m_away;
  FloatImage m_still;
  std::vector<FloatImage> m_moved;
  float m_variance;
  Backdrop m_backdrop;
  cv::Mat m_outside, m_inside, m_seen;
};

}  // namespace
}  // namespace backdrop

float Backdrop::at(float x_px, float y_px) const {
  const float x = std::clamp(x_px - static_cast<float>(area.x), 0.0f, static_cast<float>(levels.width) - 1.001f);
  const float y = std::clamp(y_px - static_cast<float>(area.y), 0.0f, static_cast<float>(levels.height) - 1.001f);
  const int column = static_cast<int>(x);
  const int row = static_cast<int>(y);
  const float fx = x - static_cast<float>(column);
  const float fy = y - static_cast<float>(row);
  const float* upper = levels.row(row) + column;
  const float* lower = levels.row(row + 1) + column;
  return (1.0f - fy) * (upper[0] + fx * (upper[1] - upper[0])) + fy * (lower[0] + fx * (lower[1] - lower[0]));
}

std::shared_ptr<const Backdrop> learn_backdrop(const GrayImage& picture, const Region& region, const PixelPoint& point,
                                               const std::vector<RegisteredFrame>& frames, const FloatImage* still) {
  using namespace backdrop;
  const Sheet sheet(picture, region, point);
  std::vector<LitFrame> away;
  for (const RegisteredFrame& one : frames) {
    if (one.displacement_px.norm() <= least_backdrop_move_px) continue;
    if (const auto light = light_of(picture, sheet.at(), one)) away.push_back({one, *light});
  }
  if (away.size() < least_moved) return nullptr;
  return Learning(picture, sheet, std::move(away), still != nullptr ? *still : sheet.of_template()).run();
}

}  // namespace zerodrift::vision
