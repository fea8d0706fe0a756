#include "core/vision/coarse_search.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/vision/opencv_image.h"

namespace zerodrift::vision {
namespace {

constexpr int smallest_template_px = 24;  // a smaller one has lost its pattern
constexpr int deepest_level = 2;
constexpr double free_px = 80.0;          // displacements up to here are all equally likely
constexpr double far_penalty = 0.15;      // of the correlation, at twice that and beyond
constexpr double sure_correlation = 0.6;  // below this the next finer level is searched as well

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

// The best position of the template within `reach` of a start, on one level. Positions are of the template's corner.
Candidate refine(const cv::Mat& frame, const GrayImage& pattern, cv::Point start, int reach) {
  const cv::Rect wanted(start.x - reach, start.y - reach, pattern.width + 2 * reach, pattern.height + 2 * reach);
  cv::Mat part;
  const cv::Rect there = wanted & cv::Rect(0, 0, frame.cols, frame.rows);
  if (there.empty()) return {start.x, start.y, -1.0};
  cv::copyMakeBorder(frame(there), part, there.y - wanted.y, wanted.br().y - there.br().y, there.x - wanted.x,
                     wanted.br().x - there.br().x, cv::BORDER_REPLICATE);
  cv::Mat scores;
  cv::matchTemplate(part, mat_view(pattern), scores, cv::TM_CCOEFF_NORMED);
  cv::Point best;
  double value = 0.0;
  cv::minMaxLoc(scores, nullptr, &value, nullptr, &best);
  return {wanted.x + best.x, wanted.y + best.y, value};
}

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
}

std::vector<Candidate> CoarseSearch::find(const GrayImage& frame, int count) const {
  const std::vector<GrayImage> frames = pyramid(frame, m_templates.size());
  std::vector<Candidate> found;
  for (int level = static_cast<int>(m_templates.size()) - 1; level >= 0; --level) {
    found = find_from(frames, level, count);
    if (!found.empty() && found.front().correlation > sure_correlation) break;
    if (level == 1) break;  // the full resolution costs much and finds nothing that the half did not
  }
  return found;
}

std::vector<Candidate> CoarseSearch::find_from(const std::vector<GrayImage>& frames, int top_level, int count) const {
  const GrayImage& top = m_templates[top_level];
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
  std::vector<Candidate> candidates;
  for (const cv::Point& peak : starts) {
    cv::Point corner(peak.x - pad_x, peak.y - pad_y);
    const double penalty = plain.at<float>(peak) - scores.at<float>(peak);
    Candidate one{corner.x, corner.y, plain.at<float>(peak)};
    for (int level = top_level - 1; level >= 0; --level) {
      one = refine(mat_view(frames[level]), m_templates[level], cv::Point(2 * one.dx_px, 2 * one.dy_px), 3);
    }
    one.correlation -= penalty;
    one.dx_px -= m_region.x;
    one.dy_px -= m_region.y;
    candidates.push_back(one);
  }
  sort_and_merge(candidates, count);
  return candidates;
}

}  // namespace zerodrift::vision
