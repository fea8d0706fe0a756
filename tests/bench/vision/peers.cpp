#include "tests/bench/vision/peers.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

namespace zerodrift::bench {
namespace {

using vision::GrayImage;
using vision::Region;

constexpr int search_px = 60;
constexpr int margin_px = 14;
constexpr double accepted_correlation = 0.8;

cv::Mat mat_of(const GrayImage& image) {
  return cv::Mat(image.height, image.width, CV_8U, const_cast<std::uint8_t*>(image.pixels.data()));
}

double parabola(double before, double at, double after) {
  const double bend = before - 2.0 * at + after;
  return bend == 0.0 ? 0.0 : 0.5 * (before - after) / bend;
}

struct Coarse {
  cv::Mat scores;
  cv::Point peak;
  double score = 0.0;
  int dx = 0;
  int dy = 0;
};

// Whole-pixel position by normalized correlation, from which all the peers start.
Coarse coarse(const cv::Mat& pattern, const Region& region, const cv::Mat& frame) {
  const cv::Rect wanted(region.x - search_px, region.y - search_px, region.width + 2 * search_px,
                        region.height + 2 * search_px);
  const cv::Rect window = wanted & cv::Rect(0, 0, frame.cols, frame.rows);
  Coarse out;
  cv::matchTemplate(frame(window), pattern, out.scores, cv::TM_CCOEFF_NORMED);
  cv::minMaxLoc(out.scores, nullptr, &out.score, nullptr, &out.peak);
  out.dx = window.x + out.peak.x - region.x;
  out.dy = window.y + out.peak.y - region.y;
  return out;
}

cv::Mat around(const cv::Mat& frame, const Region& region, const Coarse& at, int margin) {
  cv::Mat padded;
  cv::copyMakeBorder(frame, padded, 80, 80, 80, 80, cv::BORDER_REPLICATE);
  return padded(cv::Rect(80 + region.x + at.dx - margin, 80 + region.y + at.dy - margin, region.width + 2 * margin,
                         region.height + 2 * margin))
      .clone();
}

std::optional<PeerAnswer> ncc_parabola(const Coarse& at) {
  const cv::Mat& r = at.scores;
  const cv::Point p = at.peak;
  if (p.x < 1 || p.y < 1 || p.x + 1 >= r.cols || p.y + 1 >= r.rows) return std::nullopt;
  const auto score = [&](int dx, int dy) { return static_cast<double>(r.at<float>(p.y + dy, p.x + dx)); };
  return PeerAnswer{at.dx + parabola(score(-1, 0), score(0, 0), score(1, 0)),
                    at.dy + parabola(score(0, -1), score(0, 0), score(0, 1)), at.score > accepted_correlation};
}

std::optional<PeerAnswer> phase(const cv::Mat& pattern, const cv::Mat& frame, const Region& region, const Coarse& at) {
  // Even sizes only: on odd ones OpenCV 4.6 is half a pixel off.
  const cv::Size size(pattern.cols & ~7, pattern.rows & ~7);
  cv::Mat a, b, window;
  pattern(cv::Rect({0, 0}, size)).convertTo(a, CV_64F);
  around(frame, region, at, 0)(cv::Rect({0, 0}, size)).convertTo(b, CV_64F);
  cv::createHanningWindow(window, size, CV_64F);
  const cv::Point2d shift = cv::phaseCorrelate(a, b, window);
  return PeerAnswer{at.dx + shift.x, at.dy + shift.y, at.score > accepted_correlation};
}

std::optional<PeerAnswer> ecc(const cv::Mat& pattern, const cv::Mat& frame, const Region& region, const Coarse& at) {
  cv::Mat warp = (cv::Mat_<float>(2, 3) << 1, 0, margin_px, 0, 1, margin_px);
  const cv::TermCriteria until(cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 60, 1e-7);
  const double score = cv::findTransformECC(pattern, around(frame, region, at, margin_px), warp, cv::MOTION_AFFINE,
                                            until, cv::noArray(), 5);
  const double cx = (pattern.cols - 1) / 2.0;
  const double cy = (pattern.rows - 1) / 2.0;
  const auto w = [&](int row, int column) { return static_cast<double>(warp.at<float>(row, column)); };
  return PeerAnswer{at.dx + w(0, 0) * cx + w(0, 1) * cy + w(0, 2) - cx - margin_px,
                    at.dy + w(1, 0) * cx + w(1, 1) * cy + w(1, 2) - cy - margin_px, score > accepted_correlation};
}

// Coefficients of the cubic B-spline through the pixels along the rows, mirrored at the ends: what the correlation
// codes sample with (cv::remap knows 1/32 pixels only, which would be all of the peer's error).
void spline_rows(cv::Mat& image) {
  const double pole = std::sqrt(3.0) - 2.0;
  for (int y = 0; y < image.rows; ++y) {
    double* row = image.ptr<double>(y);
    const int n = image.cols;
    double start = 0.0;
    for (int x = std::min(n, 30) - 1; x >= 0; --x) start = start * pole + row[x];
    row[0] = start;
    for (int x = 1; x < n; ++x) row[x] += pole * row[x - 1];
    row[n - 1] = pole / (pole * pole - 1.0) * (row[n - 1] + pole * row[n - 2]);
    for (int x = n - 2; x >= 0; --x) row[x] = pole * (row[x + 1] - row[x]);
    for (int x = 0; x < n; ++x) row[x] *= 6.0;
  }
}

cv::Mat cubic_spline(const cv::Mat& image) {
  cv::Mat out;
  image.convertTo(out, CV_64F);
  for (int axis = 0; axis < 2; ++axis) {
    spline_rows(out);
    cv::transpose(out.clone(), out);
  }
  return out;
}

double sampled(const cv::Mat& spline, double x, double y) {
  const auto weights = [](double t, double* w) {
    const double s = 1.0 - t;
    w[0] = s * s * s / 6.0;
    w[1] = 2.0 / 3.0 - t * t * (2.0 - t) / 2.0;
    w[2] = 2.0 / 3.0 - s * s * (2.0 - s) / 2.0;
    w[3] = t * t * t / 6.0;
  };
  const int column = std::clamp(static_cast<int>(std::floor(x)), 1, spline.cols - 3);
  const int row = std::clamp(static_cast<int>(std::floor(y)), 1, spline.rows - 3);
  double wx[4], wy[4];
  weights(std::clamp(x - column, 0.0, 1.0), wx);
  weights(std::clamp(y - row, 0.0, 1.0), wy);
  double sum = 0.0;
  for (int j = 0; j < 4; ++j) {
    const double* from = spline.ptr<double>(row - 1 + j) + column - 1;
    sum += wy[j] * (wx[0] * from[0] + wx[1] * from[1] + wx[2] * from[2] + wx[3] * from[3]);
  }
  return sum;
}

// Plain digital image correlation: inverse-compositional Gauss-Newton, affine, zero-mean normalized, cubic B-spline.
std::optional<PeerAnswer> plain_icgn(const cv::Mat& pattern, const cv::Mat& frame, const Region& region,
                                     const Coarse& at) {
  cv::Mat f, image, fx, fy;
  pattern.convertTo(f, CV_64F);
  image = cubic_spline(around(frame, region, at, margin_px));
  // The spline's own derivatives at the pixels.
  const cv::Mat slope = (cv::Mat_<double>(1, 3) << -0.5, 0.0, 0.5);
  const cv::Mat smooth = (cv::Mat_<double>(1, 3) << 1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0);
  const cv::Mat coefficients = cubic_spline(f);
  cv::sepFilter2D(coefficients, fx, CV_64F, slope, smooth, {-1, -1}, 0.0, cv::BORDER_REFLECT_101);
  cv::sepFilter2D(coefficients, fy, CV_64F, smooth, slope, {-1, -1}, 0.0, cv::BORDER_REFLECT_101);
  const double cx = (f.cols - 1) / 2.0;
  const double cy = (f.rows - 1) / 2.0;
  const cv::Scalar mean_f = cv::mean(f);
  const cv::Mat f0 = f - mean_f[0];
  const double norm_f = cv::norm(f0);
  cv::Matx<double, 6, 6> hessian = cv::Matx<double, 6, 6>::zeros();
  const auto row_at = [&](int y, int x) {
    const double a = fx.at<double>(y, x), b = fy.at<double>(y, x), u = (x - cx) / 100.0, v = (y - cy) / 100.0;
    return cv::Vec6d(a, b, a * u, a * v, b * u, b * v);
  };
  for (int y = 0; y < f.rows; ++y) {
    for (int x = 0; x < f.cols; ++x) {
      const cv::Vec6d j = row_at(y, x);
      hessian += j * j.t();
    }
  }
  cv::Matx33d motion(1, 0, margin_px, 0, 1, margin_px, 0, 0, 1);
  double correlation = 0.0;
  for (int iteration = 0; iteration < 25; ++iteration) {
    cv::Mat g(f.size(), CV_64F);
    for (int y = 0; y < f.rows; ++y) {
      for (int x = 0; x < f.cols; ++x) {
        const cv::Vec3d to = motion * cv::Vec3d(x - cx, y - cy, 1.0);
        g.at<double>(y, x) = sampled(image, to[0] + cx, to[1] + cy);
      }
    }
    g -= cv::mean(g)[0];
    const double norm_g = cv::norm(g);
    correlation = f0.dot(g) / (norm_f * norm_g);
    cv::Vec6d right = cv::Vec6d::all(0.0);
    for (int y = 0; y < f.rows; ++y) {
      for (int x = 0; x < f.cols; ++x) {
        right += row_at(y, x) * (g.at<double>(y, x) * norm_f / norm_g - f0.at<double>(y, x));
      }
    }
    cv::Vec6d p;
    if (!cv::solve(hessian, right, p, cv::DECOMP_CHOLESKY)) return std::nullopt;
    const cv::Matx33d change(1 + p[2] / 100, p[3] / 100, p[0], p[4] / 100, 1 + p[5] / 100, p[1], 0, 0, 1);
    motion = motion * change.inv();
    if (std::hypot(motion(0, 2) - margin_px, motion(1, 2) - margin_px) > 12.0) return std::nullopt;
    if (std::hypot(p[0], p[1]) < 1e-5) break;
  }
  return PeerAnswer{at.dx + motion(0, 2) - margin_px, at.dy + motion(1, 2) - margin_px,
                    correlation > accepted_correlation};
}

}  // namespace

std::vector<std::string> peer_names() {
  return {"NCC + parabola", "phaseCorrelate", "ECC affine", "IC-GN plain"};
}

std::optional<PeerAnswer> run_peer(const std::string& name, const GrayImage& image, const Region& region,
                                   const GrayImage& frame) {
  try {
    const cv::Mat pattern = mat_of(image)(cv::Rect(region.x, region.y, region.width, region.height)).clone();
    const cv::Mat picture = mat_of(frame);
    const Coarse at = coarse(pattern, region, picture);
    if (name == "NCC + parabola") return ncc_parabola(at);
    if (name == "phaseCorrelate") return phase(pattern, picture, region, at);
    if (name == "ECC affine") return ecc(pattern, picture, region, at);
    return plain_icgn(pattern, picture, region, at);
  } catch (const cv::Exception&) {
    return std::nullopt;
  }
}

}  // namespace zerodrift::bench
