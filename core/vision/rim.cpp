#include "core/vision/rim.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/vision/opencv_image.h"
#include "core/vision/rim_fit.h"

namespace zerodrift::vision {
namespace {

using namespace rim_fit;

constexpr double least_radius_px = 12.0;
constexpr double usual_blur_px = 1.2;
constexpr double least_fitting = 0.9;
constexpr double rim_noises = 1.5;      // times the noise's deviation: what is left beside a ball, or at its rim
constexpr double rim_levels = 0.7;      // and that,
constexpr double learned_levels = 3.0;  // or that where the backdrop has been learned
constexpr double print_noises = 5.0;
constexpr double print_levels = 4.0;
constexpr double print_share = 0.1;  // of what lies within: a ball has its highlights
constexpr double print_blur_px = 3.0;
constexpr double largest_rim_sigma_px = 0.3;  // a rim that is known worse is no help
constexpr float saturated_from = 250.0f;
constexpr double least_edge = 50.0, most_edge = 120.0;  // of Sobel's operator, where the levels reach from 0 to 255
constexpr std::size_t circles_tried = 4;
constexpr double circle_known_px = 2.0;
constexpr std::size_t rays = 64;
constexpr int edge_rounds = 3, edge_turns = 12;
constexpr int edge_reach_px = 8;
constexpr double edge_noises = 4.0;
constexpr double near_edge_px = 1.5;

}  // namespace

struct Rim::Seen {
  TemplateSource source;
  Eigen::Vector2d middle_px;  // from the named point
  Fit fit;                    // in the template's picture
  Ring ring;
};

namespace {

// The circle through the places of steepest change along its radii; empty where it does not go through most of them.
std::optional<RimCircle> through_edges(const cv::Mat1f& levels, double noise, RimCircle circle) {
  for (int round = 0; round < edge_rounds; ++round) {
    const int reach = round == 0 ? edge_reach_px : edge_reach_px / 2;
    std::vector<Eigen::Vector2d> points;
    std::vector<double> strength;
    for (std::size_t ray = 0; ray < rays; ++ray) {
      const double turn = 2.0 * std::numbers::pi * static_cast<double>(ray) / rays;
      const Eigen::Vector2d outwards(std::cos(turn), std::sin(turn));
      std::vector<double> change;
      for (int step = -2 * reach; step <= 2 * reach; ++step) {
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
      const auto steepest = std::max_element(
          change.begin(), change.end(), [&](double a, double b) { return std::abs(a - usual) < std::abs(b - usual); });
      const double above = std::abs(*steepest - usual);
      if (above < edge_noises * noise) continue;
      const double at = circle.radius_px + 0.5 * static_cast<double>(steepest - change.begin() - 2 * reach);
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
    if (!(circle.radius_px > least_radius_px) || (last && near < rays / 2)) return std::nullopt;
  }
  return circle;
}

// Circles that the template may show, likeliest first; in the coordinates of the source's pixels.
std::vector<RimCircle> circles_in(const TemplateSource& source) {
  const Eigen::Vector2d named(source.point.x_px + source.margin_px, source.point.y_px + source.margin_px);
  if (source.ball) return {{source.ball->middle_px + named, source.ball->radius_px, source.ball->blur_px}};
  cv::Mat levels, grey;
  cv::GaussianBlur(mat_view(source.pixels), levels, {0, 0}, 1.0);
  double low = 0.0, high = 0.0;
  cv::minMaxLoc(levels, &low, &high);
  const double gain = 255.0 / std::max(high - low, 1.0);
  levels.convertTo(grey, CV_8U, gain, -low * gain);
  // The blur leaves a quarter of the noise's deviation, of which Sobel's operator makes three times as much.
  const double edge = std::clamp(10.0 * source.noise_levels * gain, least_edge, most_edge);
  const int smallest = std::max(static_cast<int>(least_radius_px), std::min(grey.cols, grey.rows) / 8);
  const int largest = std::min(grey.cols, grey.rows) / 2;
  std::vector<cv::Vec3f> found;
  cv::HoughCircles(grey, found, cv::HOUGH_GRADIENT, 1.0, 4.0, edge, 12.0, smallest, largest);
  std::vector<RimCircle> out;
  for (std::size_t k = 0; k < std::min(found.size(), circles_tried); ++k) {
    const auto circle =
        through_edges(levels, 0.28 * source.noise_levels, {{found[k][0], found[k][1]}, found[k][2], usual_blur_px});
    if (circle) out.push_back(*circle);
  }
  return out;
}

// Whether much within the circle changes from pixel to pixel; a ball shows smooth shades and some highlights.
bool shows_a_print(const TemplateSource& source, const RimCircle& circle) {
  cv::Mat fine, broad;
  cv::GaussianBlur(mat_view(source.pixels), fine, {0, 0}, 0.8);
  cv::GaussianBlur(mat_view(source.pixels), broad, {0, 0}, print_blur_px);
  const double inner = circle.radius_px - within_px - within_blurs * circle.blur_px;
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

// Takes off what is known of the backdrop beside the ball; `corner` is the place in the picture of the source's or the
// patch's first pixel.
void take_off_backdrop(const Backdrop& backdrop, const Eigen::Vector2d& middle_px, const Eigen::Vector2d& corner,
                       const Ring& ring, double contrast, Eigen::VectorXf& level) {
  for (int k = 0; k < ring.count; ++k) {
    const float share = 1.0f - ring.inside(k);
    if (share < 0.01f) continue;
    level(k) -= share * static_cast<float>(contrast) *
                backdrop.at(static_cast<float>(corner(0) + middle_px(0)) + ring.x(k),
                            static_cast<float>(corner(1) + middle_px(1)) + ring.y(k));
  }
}

// The spline's values around a middle; false where it reaches beyond the picture.
bool sample_ring(const SplineImage& spline, const Eigen::Vector2d& middle_px, const Ring& ring, std::vector<int>& place,
                 Eigen::VectorXf& level) {
  const Eigen::Vector2d whole = middle_px.array().floor();
  const Eigen::Vector2f part = (middle_px - whole).cast<float>();
  place.resize(static_cast<std::size_t>(ring.count));
  const std::vector<float> right(place.size(), part(0)), down(place.size(), part(1));
  for (int k = 0; k < ring.count; ++k) {
    const int column = static_cast<int>(whole(0)) + static_cast<int>(ring.x(k));
    const int row = static_cast<int>(whole(1)) + static_cast<int>(ring.y(k));
    if (column < 2 || row < 2 || column > spline.width() - SplineImage::reach_after ||
        row > spline.height() - SplineImage::reach_after) {
      return false;
    }
    place[k] = row * spline.width() + column;
  }
  level.resize(ring.count);
  spline.sample(place.data(), right.data(), down.data(), ring.count, level.data());
  return true;
}

}  // namespace

std::optional<Rim> Rim::seen_in(const TemplateSource& source, const Eigen::Matrix2d& blur_px2) {
  const SplineImage spline(blurred(source.pixels, blur_px2));
  const Eigen::Vector2d corner(source.region.x - source.margin_px, source.region.y - source.margin_px);
  std::vector<int> place;
  const Levels levels = [&](const Eigen::Vector2d& middle_px, const Ring& ring, Eigen::VectorXf& level,
                            Eigen::Array<bool, Eigen::Dynamic, 1>& seen) {
    if (!sample_ring(spline, middle_px, ring, place, level)) return false;
    if (source.backdrop) take_off_backdrop(*source.backdrop, middle_px, corner, ring, 1.0, level);
    seen.setConstant(ring.count, true);
    for (int k = 0; k < ring.count; ++k) seen(k) = source.pixels.values[place[k]] < saturated_from;
    return true;
  };
  const double noise = source.noise_levels * std::sqrt(blur_power(blur_px2));
  const auto is_ball = [&](const Fit& one) {
    return one.fitting_share > least_fitting && one.circle.radius_px > least_radius_px &&
           one.deviation < rim_noises * noise + (source.backdrop ? learned_levels : rim_levels) &&
           one.covariance_px2.diagonal().maxCoeff() < largest_rim_sigma_px * largest_rim_sigma_px &&
           !shows_a_print(source, one.circle);
  };
  std::optional<Fit> best;
  for (const RimCircle& circle : circles_in(source)) {
    // Most targets are no balls, and this needs the circle less well.
    RimCircle narrow = circle;
    narrow.radius_px -= circle_known_px;
    if (shows_a_print(source, narrow)) continue;
    best = fit(levels, circle, nullptr, blur_px2);
    if (best && is_ball(*best)) break;
    best.reset();
  }
  if (!best) return std::nullopt;
  const Eigen::Vector2d named(source.point.x_px + source.margin_px, source.point.y_px + source.margin_px);
  return Rim(std::make_shared<const Seen>(
      Seen{source, best->circle.middle_px - named, *best, Ring(best->circle.radius_px, best->circle.blur_px)}));
}

const Eigen::Vector2d& Rim::middle_px() const {
  return m_seen->middle_px;
}

RimCircle Rim::circle() const {
  return {m_seen->middle_px, m_seen->fit.circle.radius_px, m_seen->fit.circle.blur_px};
}

std::optional<RimPlace> Rim::find(const FramePatch& patch, const Eigen::Vector2d& expected_px, double contrast,
                                  double blur_px2) const {
  const TemplateSource& source = m_seen->source;
  const Eigen::Vector2d corner(patch.at.x, patch.at.y);
  const Eigen::Vector2d stood = m_seen->fit.circle.middle_px +
                                Eigen::Vector2d(source.region.x - source.margin_px, source.region.y - source.margin_px);
  std::vector<int> place;
  const Levels levels = [&](const Eigen::Vector2d& middle_px, const Ring& ring, Eigen::VectorXf& level,
                            Eigen::Array<bool, Eigen::Dynamic, 1>& seen) {
    if (!sample_ring(patch.spline, middle_px, ring, place, level)) return false;
    if (source.backdrop) take_off_backdrop(*source.backdrop, middle_px, corner, ring, contrast, level);
    seen.resize(ring.count);
    for (int k = 0; k < ring.count; ++k) seen(k) = patch.state[place[k]] == FramePatch::seen;
    return true;
  };
  RimCircle start = m_seen->fit.circle;
  start.middle_px = stood + expected_px - corner;
  start.blur_px = std::sqrt(std::max(start.blur_px * start.blur_px + blur_px2, least_blur_px * least_blur_px));
  const bool alike = std::abs(start.blur_px - m_seen->ring.blur_px) < other_shape * start.blur_px;
  const std::optional<Fit> found = fit(levels, start, alike ? &m_seen->ring : nullptr, patch.blur_px2);
  if (!found) return std::nullopt;
  RimPlace out;
  out.moved_px = found->circle.middle_px + corner - stood;
  out.covariance_px2 = found->covariance_px2 + m_seen->fit.covariance_px2;
  // A ball keeps its size: what the light did to the radius it may have done to the middle.
  const double grown_px = found->circle.radius_px - m_seen->fit.circle.radius_px;
  out.covariance_px2.diagonal().array() += 0.5 * grown_px * grown_px;
  out.fitting_share = found->fitting_share;
  return out;
}

}  // namespace zerodrift::vision
