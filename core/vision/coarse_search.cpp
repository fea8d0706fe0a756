#include "core/vision/coarse_search.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>

#include "core/vision/opencv_image.h"
#include "core/vision/row_sums.h"

namespace zerodrift::vision {
namespace {

constexpr int smallest_template_px = 24;  // a smaller one has lost its pattern
constexpr int deepest_level = 2;
constexpr double free_px = 80.0;          // displacements up to here are all equally likely
constexpr double far_penalty = 0.15;      // of the correlation, at twice that and beyond
constexpr double sure_correlation = 0.6;  // below this the next finer level is searched as well

constexpr double found_correlation = 0.85;  // beside such a place those far behind it need not be refined
constexpr double far_behind = 0.3;
constexpr int climb_steps = 5;  // of half pixels: a quarter pixel's peak is never further off

constexpr double kept_contrast = 0.85;  // of the finer level's variance: the coarsest then shows the whole pattern

constexpr double surroundings_px = 3.0;  // of each level of the pyramid
constexpr double largest_relief = 25.0;  // grey levels

struct Peak {
  double x;
  double y;
  double correlation;
};

GrayImage halved(const GrayImage& image) {
  cv::Mat small;
  cv::resize(mat_view(image), small, {image.width / 2, image.height / 2}, 0, 0, cv::INTER_AREA);
  return gray_from_mat(small);
}

std::vector<GrayImage> pyramid(const GrayImage& image, std::size_t levels) {
  std::vector<GrayImage> out{image};
  while (out.size() < levels) out.push_back(halved(out.back()));
  return out;
}

// What differs from the surroundings, its extremes cut.
GrayImage flattened(const GrayImage& image) {
  cv::Mat level, around, flat;
  mat_view(image).convertTo(level, CV_32F);
  cv::GaussianBlur(level, around, {0, 0}, surroundings_px, surroundings_px, cv::BORDER_REPLICATE);
  cv::Mat(cv::min(cv::max(level - around, -largest_relief), largest_relief) * (127.0 / largest_relief) + 128.0)
      .convertTo(flat, CV_8U);
  return gray_from_mat(flat);
}

// The full resolution is not searched where there is another.
std::vector<GrayImage> flattened(const std::vector<GrayImage>& pyramid) {
  std::vector<GrayImage> out(pyramid.size());
  for (std::size_t level = pyramid.size() > 1 ? 1 : 0; level < pyramid.size(); ++level) {
    out[level] = flattened(pyramid[level]);
  }
  return out;
}

GrayImage cut(const GrayImage& image, const Region& region) {
  return gray_from_mat(mat_view(image)(cv::Rect(region.x, region.y, region.width, region.height)));
}

// A target drifts by tens of pixels, seldom by hundreds: of equal places the nearer is the likelier.
void prefer_near(cv::Mat& scores, cv::Point home, int level, cv::Point pad) {
  const double scale = 1 << level;
  for (int y = 0; y < scores.rows; ++y) {
    for (int x = 0; x < scores.cols; ++x) {
      const double away = std::hypot((x - pad.x) * scale - home.x, (y - pad.y) * scale - home.y);
      scores.at<float>(y, x) -= static_cast<float>(far_penalty * std::clamp((away - free_px) / free_px, 0.0, 1.0));
    }
  }
}

double variance_of(const GrayImage& image) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(mat_view(image), mean, deviation);
  return deviation[0] * deviation[0];
}

// Local maxima of the correlation, best first.
std::vector<cv::Point> peaks(const cv::Mat& scores, int count, int apart) {
  cv::Mat left = scores.clone();
  std::vector<cv::Point> out;
  while (static_cast<int>(out.size()) < count) {
    cv::Point best;
    double value = 0.0;
    cv::minMaxLoc(left, nullptr, &value, nullptr, &best);
    if (value < -1.0) break;
    out.push_back(best);
    const cv::Rect around(best.x - apart, best.y - apart, 2 * apart + 1, 2 * apart + 1);
    left(around & cv::Rect(0, 0, left.cols, left.rows)).setTo(-2.0f);
  }
  return out;
}

// Zero-mean normalized correlation of the pattern with the frame at places near some start, each computed once.
class Climb {
 public:
  Climb(const cv::Mat& frame, const GrayImage& pattern) {
    frame.convertTo(m_frame, CV_16S);
    mat_view(pattern).convertTo(m_pattern, CV_16S);
    const double n = static_cast<double>(pattern.pixels.size());
    double squares = 0.0;
    for (const std::uint8_t value : pattern.pixels) {
      m_sum += value;
      squares += value * value;
    }
    m_spread = squares - m_sum * m_sum / n;
  }

  double at(int x, int y) {
    if (x < 0 || y < 0 || x + m_pattern.cols > m_frame.cols || y + m_pattern.rows > m_frame.rows) return -1.0;
    const auto [place, is_new] = m_known.try_emplace({x, y}, 0.0);
    if (is_new) place->second = correlation(x, y);
    return place->second;
  }

  /// Uphill from the start to a local maximum, at most `steps` away; its place with the top of a parabola.
  Peak top(cv::Point start, int steps) {
    for (int k = 0; k < steps; ++k) {
      cv::Point best = start;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          if (at(start.x + dx, start.y + dy) > at(best.x, best.y)) best = {start.x + dx, start.y + dy};
        }
      }
      if (best == start) break;
      start = best;
    }
    const double here = at(start.x, start.y);
    const auto between = [here](double before, double after) {
      const double bend = before + after - 2.0 * here;
      return bend < 0.0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0.0;
    };
    return {start.x + between(at(start.x - 1, start.y), at(start.x + 1, start.y)),
            start.y + between(at(start.x, start.y - 1), at(start.x, start.y + 1)), here};
  }

 private:
  double correlation(int x, int y) const {
    std::int64_t product = 0, sum = 0, squares = 0;
    for (int row = 0; row < m_pattern.rows; ++row) {
      std::int32_t sums[3];
      level_sums(m_frame.ptr<std::int16_t>(y + row) + x, m_pattern.ptr<std::int16_t>(row), m_pattern.cols, sums);
      product += sums[0];
      sum += sums[1];
      squares += sums[2];
    }
    const double n = static_cast<double>(m_pattern.total());
    const double spread = static_cast<double>(squares) - static_cast<double>(sum) * static_cast<double>(sum) / n;
    if (spread <= 0.0 || m_spread <= 0.0) return -1.0;
    return (static_cast<double>(product) - static_cast<double>(sum) * m_sum / n) / std::sqrt(spread * m_spread);
  }

  cv::Mat m_frame, m_pattern;  // of 16 bits a level: their products are then summed as fast as any
  double m_sum = 0.0;
  double m_spread = 0.0;
  std::map<std::pair<int, int>, double> m_known;
};

void sort_and_merge(std::vector<Candidate>& candidates, int count) {
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.correlation > b.correlation; });
  std::vector<Candidate> out;
  for (const Candidate& one : candidates) {
    const bool known = std::any_of(out.begin(), out.end(), [&](const Candidate& other) {
      return std::abs(one.dx_px - other.dx_px) <= 2 && std::abs(one.dy_px - other.dy_px) <= 2;
    });
    if (!known && static_cast<int>(out.size()) < count) out.push_back(one);
  }
  candidates = std::move(out);
}

}  // namespace

CoarseSearch::CoarseSearch(const GrayImage& image, const Region& region) : m_region(region) {
  std::size_t levels = 1;
  while (levels <= deepest_level && (std::min(region.width, region.height) >> levels) >= smallest_template_px) ++levels;
  m_templates = pyramid(cut(image, region), levels);
  m_flat = flattened(m_templates);
  m_fine_pattern = levels > 2 && variance_of(m_templates.back()) < kept_contrast * variance_of(m_templates[1]);
}

std::vector<Candidate> CoarseSearch::find(const GrayImage& frame, int count) const {
  const std::vector<GrayImage> frames = pyramid(frame, m_templates.size());
  const int top = static_cast<int>(m_templates.size()) - 1;
  std::vector<Candidate> found = find_from(frames, m_templates, top, count);
  const auto sure = [&found] { return !found.empty() && found.front().correlation > sure_correlation; };
  const auto add = [&](const std::vector<Candidate>& others) {
    found.insert(found.end(), others.begin(), others.end());
    sort_and_merge(found, count);
  };
  if (sure()) return found;
  // The full resolution costs much and finds nothing that the half did not.
  if (m_fine_pattern) add(find_from(frames, m_templates, 1, count));
  if (sure()) return found;
  add(find_from(flattened(frames), m_flat, top, count));
  return found;
}

std::vector<Candidate> CoarseSearch::find_from(const std::vector<GrayImage>& frames,
                                               const std::vector<GrayImage>& templates, int top_level,
                                               int count) const {
  const GrayImage& top = templates[top_level];
  const int pad_x = top.width / 4;
  const int pad_y = top.height / 4;
  cv::Mat padded;
  cv::copyMakeBorder(mat_view(frames[top_level]), padded, pad_y, pad_y, pad_x, pad_x, cv::BORDER_REPLICATE);
  if (padded.cols < top.width || padded.rows < top.height) return {};
  cv::Mat scores;
  cv::matchTemplate(padded, mat_view(top), scores, cv::TM_CCOEFF_NORMED);
  cv::patchNaNs(scores, -1.0);
  cv::min(scores, 1.0, scores);  // a flat area divides by nothing
  const cv::Mat plain = scores.clone();
  prefer_near(scores, {m_region.x, m_region.y}, top_level, {pad_x, pad_y});
  // Near peaks for patterns that repeat, far ones for broad maxima, which would fill the list with their own slope.
  std::vector<cv::Point> starts = peaks(scores, count, 2);
  const std::vector<cv::Point> far = peaks(scores, count, std::min(top.width, top.height) / 4);
  starts.insert(starts.end(), far.begin(), far.end());
  // From a quarter of the resolution up to half of it, which leaves a pixel at most for the fine registration.
  const bool finer = top_level > 1;
  cv::Mat half;
  if (finer)
    cv::copyMakeBorder(mat_view(frames[1]), half, 2 * pad_y, 2 * pad_y, 2 * pad_x, 2 * pad_x, cv::BORDER_REPLICATE);
  Climb climb(finer ? half : padded, finer ? templates[1] : top);
  const int level = finer ? 1 : top_level;
  std::vector<Candidate> candidates;
  double best = -1.0;
  for (const cv::Point& peak : starts) {
    if (best > found_correlation && plain.at<float>(peak) < best - far_behind) continue;
    const double penalty = plain.at<float>(peak) - scores.at<float>(peak);
    const Peak found = climb.top(finer ? 2 * peak : peak, climb_steps);
    const int pad = 1 << (finer ? 1 : 0);
    const auto full = [&](double place, int border, int home) {
      return static_cast<int>(std::lround((place - pad * border) * (1 << level))) - home;
    };
    best = std::max(best, found.correlation);
    candidates.push_back(
        {full(found.x, pad_x, m_region.x), full(found.y, pad_y, m_region.y), found.correlation - penalty});
  }
  sort_and_merge(candidates, count);
  return candidates;
}

}  // namespace zerodrift::vision
