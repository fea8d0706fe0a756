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
constexpr double band_width = 1.6;                      // from radius to radius
constexpr float full_share = 0.6f;      // of the edges for its size that the clearest circle has: shades have a third
constexpr double extreme_share = 0.02;  // of the pixels
constexpr std::size_t circles_tried = 40, most_circles = 6;
constexpr std::size_t rays = 64, sure_rays = 38;
constexpr int edge_rounds = 3, edge_turns = 12;
constexpr int edge_reach_px = 8, near_reach_px = 3;
constexpr double edge_noises = 4.0;
constexpr double near_edge_px = 1.5;
constexpr double same_edge_px = 0.75;
constexpr double many_more_edges = 1.35;                // times what the expected circle has
constexpr double smooth_px = 1.0, smooth_noise = 0.28;  // the blur leaves that share of the noise's deviation

struct Edge {
  Eigen::Vector2d at;
  double strength;  // levels over 2 px
};

// The steepest change along each of a circle's radii, within `reach_px` of it.
std::vector<Edge> edges_of(const cv::Mat1f& levels, double noise, const RimCircle& circle, int reach_px) {
  std::vector<Edge> out;
  for (std::size_t ray = 0; ray < rays; ++ray) {
    const double turn = 2.0 * std::numbers::pi * static_cast<double>(ray) / rays;
    const Eigen::Vector2d outwards(std::cos(turn), std::sin(turn));
    const auto level_at = [&](double radius) {
      const Eigen::Vector2d at = circle.middle_px + radius * outwards;
      const int x = std::clamp(static_cast<int>(std::floor(at(0))), 0, levels.cols - 2);
      const int y = std::clamp(static_cast<int>(std::floor(at(1))), 0, levels.rows - 2);
      const double u = std::clamp(at(0) - x, 0.0, 1.0), v = std::clamp(at(1) - y, 0.0, 1.0);
      return (1 - v) * ((1 - u) * levels(y, x) + u * levels(y, x + 1)) +
             v * ((1 - u) * levels(y + 1, x) + u * levels(y + 1, x + 1));
    };
    std::vector<double> change;
    for (int step = -2 * edge_reach_px; step <= 2 * edge_reach_px; ++step) {
      const double radius = circle.radius_px + 0.5 * step;
      change.push_back(level_at(radius + 1.0) - level_at(radius - 1.0));
    }
    // Shading changes all along the radius, an edge at one place.
    std::vector<double> sorted = change;
    std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
    const double usual = sorted[sorted.size() / 2];
    const auto middle = change.begin() + 2 * edge_reach_px;
    const auto steepest = std::max_element(middle - 2 * reach_px, middle + 2 * reach_px + 1, [&](double a, double b) {
      return std::abs(a - usual) < std::abs(b - usual);
    });
    const double above = std::abs(*steepest - usual);
    if (above < edge_noises * noise) continue;
    const double at = circle.radius_px + 0.5 * static_cast<double>(steepest - middle);
    out.push_back({circle.middle_px + at * outwards, above});
  }
  return out;
}

std::size_t edges_near(const std::vector<Edge>& edges, const RimCircle& circle, double near_px) {
  return static_cast<std::size_t>(std::count_if(edges.begin(), edges.end(), [&](const Edge& one) {
    return std::abs((one.at - circle.middle_px).norm() - circle.radius_px) < near_px;
  }));
}

// The circle through the edges; nothing where it does not go through most of them.
std::optional<RimCircle> through_edges(const cv::Mat1f& levels, double noise, RimCircle circle, int reach_px,
                                       std::size_t least_rays = rays / 2) {
  for (int round = 0; round < edge_rounds; ++round) {
    const int reach = round == 0 ? reach_px : std::min(reach_px, edge_reach_px / 2);
    const std::vector<Edge> edges = edges_of(levels, noise, circle, reach);
    if (edges.size() < rays / 3) return std::nullopt;
    // Distances from the circle, robustly (Cauchy).
    for (int turn = 0; turn < edge_turns; ++turn) {
      Eigen::Matrix3d normal = 1e-6 * Eigen::Matrix3d::Identity();
      Eigen::Vector3d right = Eigen::Vector3d::Zero();
      for (const Edge& one : edges) {
        const Eigen::Vector2d from = one.at - circle.middle_px;
        const double off = from.norm() - circle.radius_px;
        const Eigen::Vector3d row(from(0) / from.norm(), from(1) / from.norm(), 1.0);
        const double weight = std::min(one.strength, edge_noises * 3.0 * noise) / (1.0 + off * off);
        normal += weight * row * row.transpose();
        right += weight * off * row;
      }
      const Eigen::Vector3d step = normal.ldlt().solve(right);
      circle.middle_px += step.head<2>();
      circle.radius_px += step(2);
    }
    const bool last = round + 1 == edge_rounds;
    if (!(circle.radius_px > least_radius_px)) return std::nullopt;
    if (last && edges_near(edges, circle, near_edge_px) < least_rays) return std::nullopt;
  }
  return circle;
}

}  // namespace

std::optional<RimCircle> circle_at(const FloatImage& picture, double noise, const RimCircle& expected) {
  cv::Mat1f levels;
  cv::GaussianBlur(mat_view(picture), levels, {0, 0}, smooth_px);
  const double left = smooth_noise * noise;
  auto found = through_edges(levels, left, expected, edge_reach_px, sure_rays);
  if (!found) return std::nullopt;
  // Under a cover its edges draw the circle away from those that are left.
  const std::size_t here = edges_near(edges_of(levels, left, *found, edge_reach_px), *found, same_edge_px);
  const std::size_t there = edges_near(edges_of(levels, left, expected, edge_reach_px), expected, same_edge_px);
  if (static_cast<double>(here) < many_more_edges * static_cast<double>(there)) return expected;
  return found;
}

std::vector<RimCircle> circles_in(const TemplateSource& source) {
  const Eigen::Vector2d named(source.point.x_px + source.margin_px, source.point.y_px + source.margin_px);
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
  // Of circles about one middle the strongest alone is found, so in bands of the radius; with the votes for each.
  std::vector<cv::Vec4f> found;
  for (double least = std::max(least_radius_px, side / 8.0); least < side / 2.0; least *= band_width) {
    std::vector<cv::Vec4f> some;
    cv::HoughCircles(grey, some, cv::HOUGH_GRADIENT, 1.0, 4.0, edge, 12.0, static_cast<int>(least),
                     static_cast<int>(std::min(least * band_width, side / 2.0)));
    found.insert(found.end(), some.begin(), some.end());
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a[3] > b[3]; });
  // Contours of shades draw circles too, of fewer edges for their size than a rim's.
  float fullest = 0.0f;
  for (const cv::Vec4f& one : found) fullest = std::max(fullest, one[3] / one[2]);
  const auto faint = [&](const cv::Vec4f& one) { return one[3] / one[2] < full_share * fullest; };
  found.erase(std::remove_if(found.begin(), found.end(), faint), found.end());
  const double noise = smooth_noise * source.noise_levels;
  std::vector<RimCircle> out;
  for (std::size_t k = 0; k < std::min(found.size(), circles_tried) && out.size() < most_circles; ++k) {
    const RimCircle rough{{found[k][0], found[k][1]}, found[k][2], usual_blur_px};
    auto circle = through_edges(levels, noise, rough, edge_reach_px);
    // Beside a texture its edges are the steepest a little further.
    if (!circle) circle = through_edges(levels, noise, rough, near_reach_px);
    const auto same = [&](const RimCircle& one) {
      return (one.middle_px - circle->middle_px).norm() + std::abs(one.radius_px - circle->radius_px) < near_edge_px;
    };
    if (circle && std::none_of(out.begin(), out.end(), same)) out.push_back(*circle);
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
