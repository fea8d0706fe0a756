#include "core/vision/circle_finder.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "core/vision/opencv_image.h"
#include "core/vision/rim_fit.h"

namespace zerodrift::vision {
namespace {

constexpr double usual_blur_px = 1.2;
constexpr double print_noises = 5.0;
constexpr double print_levels = 4.0;
constexpr double print_share = 0.1;  // of what lies within: a ball has its highlights
constexpr double print_blur_px = 3.0;
constexpr double least_edge = 50.0, most_edge = 120.0;  // of Sobel's operator, where the levels reach from 0 to 255
constexpr double extreme_share = 0.02;                  // of the pixels
constexpr std::size_t circles_tried = 6;
constexpr std::size_t rays = 64, sure_rays = 38;
constexpr int edge_rounds = 3, edge_turns = 12;
constexpr int edge_reach_px = 8, near_reach_px = 3;
constexpr double edge_noises = 4.0;
constexpr double near_edge_px = 1.5;
constexpr double smooth_px = 1.0, smooth_noise = 0.28;  // the blur leaves that share of the noise's deviation

// The circle through the places of steepest change along its radii; empty where it does not go through most of them.
std::optional<RimCircle> through_edges(const cv::Mat1f& levels, double noise, RimCircle circle, int reach_px,
                                       std::size_t least_rays = rays / 2) {
  for (int round = 0; round < edge_rounds; ++round) {
    const int reach = round == 0 ? reach_px : std::min(reach_px, edge_reach_px / 2);
    std::vector<Eigen::Vector2d> points;
    std::vector<double> strength;
    for (std::size_t ray = 0; ray < rays; ++ray) {
      const double turn = 2.0 * std::numbers::pi * static_cast<double>(ray) / rays;
      const Eigen::Vector2d outwards(std::cos(turn), std::sin(turn));
      std::vector<double> change;
      for (int step = -2 * edge_reach_px; step <= 2 * edge_reach_px; ++step) {
        const auto level_at = [&](double radius) {
          const Eigen::Vector2d at = circle.middle_px + radius * outwards;
          const int x = std::clamp(static_cast<int>(std::floor(at(0))), 0, levels.cols - 2);
          const int y = std::clamp(static_cast<int>(std::floor(at(1))), 0, levels.rows - 2);
          const double u = std::clamp(at(0) - x, 0.0, 1.0), v = std::clamp(at(1) - y, 0.0, 1.0);
          return (1 - v) * ((1 - u) * levels(y, x) + u * levels(y, x + 1)) +
                 v * ((1 - u) * levels(y + 1, x) + u * levels(y + 1, x + 1));
        };
        const double radius = circle.radius_px + 0.5 * step;
        change.push_back(level_at(radius + 1.0) - level_at(radius - 1.0));
      }
      // Shading changes all along the radius, an edge at one place.
      std::vector<double> sorted = change;
      std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
      const double usual = sorted[sorted.size() / 2];
      const auto middle = change.begin() + 2 * edge_reach_px;
      const auto steepest = std::max_element(middle - 2 * reach, middle + 2 * reach + 1, [&](double a, double b) {
        return std::abs(a - usual) < std::abs(b - usual);
      });
      const double above = std::abs(*steepest - usual);
      if (above < edge_noises * noise) continue;
      const double at = circle.radius_px + 0.5 * static_cast<double>(steepest - middle);
      points.push_back(circle.middle_px + at * outwards);
      strength.push_back(above);
    }
    if (points.size() < rays / 3) return std::nullopt;
    // Distances from the circle, robustly (Cauchy).
    std::size_t near = 0;
    for (int turn = 0; turn < edge_turns; ++turn) {
      Eigen::Matrix3d normal = 1e-6 * Eigen::Matrix3d::Identity();
      Eigen::Vector3d right = Eigen::Vector3d::Zero();
      near = 0;
      for (std::size_t k = 0; k < points.size(); ++k) {
        const Eigen::Vector2d from = points[k] - circle.middle_px;
        const double off = from.norm() - circle.radius_px;
        near += std::abs(off) < near_edge_px;
        const Eigen::Vector3d row(from(0) / from.norm(), from(1) / from.norm(), 1.0);
        const double weight = std::min(strength[k], edge_noises * 3.0 * noise) / (1.0 + off * off);
        normal += weight * row * row.transpose();
        right += weight * off * row;
      }
      const Eigen::Vector3d step = normal.ldlt().solve(right);
      circle.middle_px += step.head<2>();
      circle.radius_px += step(2);
    }
    const bool last = round + 1 == edge_rounds;
    if (!(circle.radius_px > least_radius_px) || (last && near < least_rays)) return std::nullopt;
  }
  return circle;
}

}  // namespace

std::optional<RimCircle> circle_at(const FloatImage& picture, double noise, const RimCircle& expected) {
  cv::Mat1f levels;
  cv::GaussianBlur(mat_view(picture), levels, {0, 0}, smooth_px);
  return through_edges(levels, smooth_noise * noise, expected, edge_reach_px, sure_rays);
}

std::vector<RimCircle> circles_in(const TemplateSource& source) {
  const Eigen::Vector2d named(source.point.x_px + source.margin_px, source.point.y_px + source.margin_px);
  if (source.ball) return {{source.ball->middle_px + named, source.ball->radius_px, source.ball->blur_px}};
  cv::Mat1f levels;
  cv::Mat grey;
  cv::GaussianBlur(mat_view(source.pixels), levels, {0, 0}, smooth_px);
  // A highlight must not make an edge look faint.
  std::vector<float> sorted(levels.begin(), levels.end());
  const auto level_of = [&](double share) {
    const auto at = sorted.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(sorted.size() - 1));
    std::nth_element(sorted.begin(), at, sorted.end());
    return static_cast<double>(*at);
  };
  const double low = level_of(extreme_share), high = level_of(1.0 - extreme_share);
  const double gain = 255.0 / std::max(high - low, 1.0);
  levels.convertTo(grey, CV_8U, gain, -low * gain);
  // Of what noise the blur leaves Sobel's operator makes three times as much.
  const double edge = std::clamp(10.0 * source.noise_levels * gain, least_edge, most_edge);
  const int side = std::min(grey.cols, grey.rows);
  std::vector<cv::Vec3f> found;
  cv::HoughCircles(grey, found, cv::HOUGH_GRADIENT, 1.0, 4.0, edge, 12.0,
                   std::max(static_cast<int>(least_radius_px), side / 8), side / 2);
  const double noise = smooth_noise * source.noise_levels;
  std::vector<RimCircle> out;
  for (std::size_t k = 0; k < std::min(found.size(), circles_tried); ++k) {
    const RimCircle rough{{found[k][0], found[k][1]}, found[k][2], usual_blur_px};
    auto circle = through_edges(levels, noise, rough, edge_reach_px);
    // Beside a texture its edges are the steepest a little further.
    if (!circle) circle = through_edges(levels, noise, rough, near_reach_px);
    if (circle) out.push_back(*circle);
  }
  std::stable_partition(out.begin(), out.end(),
                        [&](const RimCircle& one) { return (one.middle_px - named).norm() < one.radius_px; });
  return out;
}

bool shows_a_print(const TemplateSource& source, const RimCircle& circle) {
  cv::Mat fine, broad;
  cv::GaussianBlur(mat_view(source.pixels), fine, {0, 0}, 0.8);
  cv::GaussianBlur(mat_view(source.pixels), broad, {0, 0}, print_blur_px);
  const double inner = circle.radius_px - rim_fit::within_px - rim_fit::within_blurs * circle.blur_px;
  const double limit = std::max(print_noises * 0.35 * source.noise_levels, print_levels);
  int all = 0, print = 0;
  for (int y = 0; y < fine.rows; ++y) {
    for (int x = 0; x < fine.cols; ++x) {
      if ((Eigen::Vector2d(x, y) - circle.middle_px).norm() > inner) continue;
      ++all;
      print += std::abs(fine.at<float>(y, x) - broad.at<float>(y, x)) > limit;
    }
  }
  return print > print_share * all;
}

}  // namespace zerodrift::vision
