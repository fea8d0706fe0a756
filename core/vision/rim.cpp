#include "core/vision/rim.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/vision/opencv_image.h"

namespace zerodrift::vision {
namespace {

constexpr int harmonics = 8;  // around the rim, of what is seen within
constexpr int angles = 2 * harmonics + 1;
constexpr int orders = 3;  // in the surface's slope
constexpr int within_count = angles * orders;
constexpr int beside_harmonics = 4;
constexpr int beside_angles = 2 * beside_harmonics + 1;
constexpr int beside_count = 2 * beside_angles;  // level and slope along the radius
constexpr int light_terms = within_count + beside_count;
constexpr int simpler_terms = angles * (orders - 1) + beside_count;
constexpr double simpler_share = 0.06;  // of the square of what a simpler light moves
constexpr int shape_terms = 4;          // middle, radius, blur
constexpr double within_px = 4.0, within_blurs = 2.2;
constexpr double beside_px = 5.0, beside_blurs = 2.0;
constexpr double pixel_px = 0.5;
constexpr double least_radius_px = 12.0;
constexpr double least_blur_px = 0.4, largest_blur_px = 4.0;
constexpr double usual_blur_px = 1.2;
constexpr double largest_step_px = 1.5;
constexpr double largest_way_px = 4.0;
constexpr double settled_px = 5e-4;
constexpr int steps = 12;
constexpr int shapes = 10;            // that are tried, each from what the one before left
constexpr double same_shape = 0.04;   // px, and of the blur
constexpr double other_shape = 0.25;  // the same: the middle is not sought to the end with it
constexpr double reach_sigmas = 4.0;  // a larger error counts as one of these
constexpr double robust_deviation = 1.4826;
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
constexpr int sectors = 32;
constexpr double least_edge = 50.0, most_edge = 120.0;  // of Sobel's operator, where the levels reach from 0 to 255
constexpr std::size_t circles_tried = 4;
constexpr double circle_known_px = 2.0;
constexpr std::size_t rays = 64;
constexpr int edge_rounds = 3, edge_turns = 12;
constexpr int edge_reach_px = 8;
constexpr double edge_noises = 4.0;
constexpr double near_edge_px = 1.5;

using Light = Eigen::Matrix<double, light_terms, light_terms>;
using Shape = Eigen::Matrix<double, shape_terms, 1>;

// The pixels at both sides of a circle about the origin, and what the light there is made of.
struct Ring {
  double radius_px, blur_px;
  int count = 0;
  Eigen::VectorXf x, y, cosine, sine, distance;
  Eigen::VectorXf inside, slope, widening;  // share of the ball, and how it changes with radius and with blur
  Eigen::VectorXf fall;                     // of the surface's slope along the radius
  Eigen::Matrix<float, Eigen::Dynamic, within_count> within;
  Eigen::Matrix<float, Eigen::Dynamic, beside_count> beside;
  Eigen::LLT<Light> solved;
  Eigen::LLT<Eigen::Matrix<double, simpler_terms, simpler_terms>> simpler;

  Ring(double radius, double blur) : radius_px(radius), blur_px(blur) {
    const double inner = std::max(radius - within_px - within_blurs * blur, 0.0);
    const double outer = radius + beside_px + beside_blurs * blur;
    const int reach = static_cast<int>(std::ceil(outer));
    std::vector<std::array<int, 2>> at;
    for (int row = -reach; row <= reach; ++row) {
      for (int column = -reach; column <= reach; ++column) {
        const double r = std::hypot(column, row);
        if (r > inner && r < outer) at.push_back({column, row});
      }
    }
    count = static_cast<int>(at.size());
    for (Eigen::VectorXf* one : {&x, &y, &cosine, &sine, &distance, &inside, &slope, &widening, &fall})
      one->resize(count);
    within.resize(count, within_count);
    beside.resize(count, beside_count);
    const double steepest = std::sqrt(1.0 - inner * inner / (radius * radius));
    for (int k = 0; k < count; ++k) {
      const double px = at[k][0], py = at[k][1];
      const double r = std::hypot(px, py);
      const double u = (r - radius) / blur;
      const double c = px / r, s = py / r;
      x(k) = static_cast<float>(px), y(k) = static_cast<float>(py);
      cosine(k) = static_cast<float>(c), sine(k) = static_cast<float>(s);
      inside(k) = static_cast<float>(0.5 * std::erfc(u / std::numbers::sqrt2));
      const double bell = std::exp(-0.5 * u * u) / (blur * std::sqrt(2.0 * std::numbers::pi));
      slope(k) = static_cast<float>(bell);
      widening(k) = static_cast<float>(bell * u);
      const double height = std::sqrt(std::max(1.0 - r * r / (radius * radius), 0.0)) / steepest;
      distance(k) = static_cast<float>(r);
      // At the very rim it has no end, and hardly any pixels.
      const double at_pixel = std::max(height * steepest, std::sqrt(pixel_px / radius));
      fall(k) = r < radius ? static_cast<float>(-r / (radius * radius * at_pixel * steepest)) : 0.0f;
      std::array<double, angles> around{};
      around[0] = 1.0;
      double cm = 1.0, sm = 0.0;
      for (int m = 1; m <= harmonics; ++m) {
        const double next = cm * c - sm * s;
        sm = sm * c + cm * s;
        cm = next;
        around[2 * m - 1] = cm, around[2 * m] = sm;
      }
      double power = 1.0;
      for (int order = 0; order < orders; ++order, power *= height) {
        for (int a = 0; a < angles; ++a) within(k, order * angles + a) = static_cast<float>(power * around[a]);
      }
      for (int a = 0; a < beside_angles; ++a) {
        beside(k, a) = static_cast<float>(around[a]);
        beside(k, beside_angles + a) = static_cast<float>(around[a] * (r - radius) / (outer - radius));
      }
    }
    Eigen::MatrixXf all(count, light_terms);
    all.leftCols<within_count>() = inside.asDiagonal() * within;
    all.rightCols<beside_count>() = (1.0f - inside.array()).matrix().asDiagonal() * beside;
    Light normal = (all.transpose() * all).cast<double>();
    normal.diagonal().array() += 1e-7 * normal.diagonal().maxCoeff();
    solved.compute(normal);
    constexpr int less = simpler_terms - beside_count;
    Eigen::Matrix<double, simpler_terms, simpler_terms> part;
    part << normal.topLeftCorner<less, less>(), normal.topRightCorner<less, beside_count>(),
        normal.bottomLeftCorner<beside_count, less>(), normal.bottomRightCorner<beside_count, beside_count>();
    simpler.compute(part);
  }

  // By how much a step from here would go if what is seen within were simpler by one order: no reflection is quite of
  // the form that is fitted, and of its misfit this is the measure.
  Eigen::Vector2d moved_by_simpler_light(const Eigen::VectorXf& level, const Eigen::MatrixXf& columns,
                                         const Eigen::Array<bool, Eigen::Dynamic, 1>& seen,
                                         const Eigen::VectorXf& error) const {
    Eigen::MatrixXf both(count, shape_terms + 1);
    both.leftCols<shape_terms>() = columns;
    both.rightCols<1>() = level;
    const Eigen::MatrixXd told = project(both);
    Eigen::MatrixXd few(simpler_terms, shape_terms + 1);
    few.topRows<simpler_terms - beside_count>() = told.topRows<simpler_terms - beside_count>();
    few.bottomRows<beside_count>() = told.bottomRows<beside_count>();
    const Eigen::MatrixXd light = simpler.solve(few);
    const auto left_of = [&](int column) {
      const Eigen::VectorXf of_ball = within.leftCols<simpler_terms - beside_count>() *
                                      light.col(column).head<simpler_terms - beside_count>().cast<float>();
      const Eigen::VectorXf of_rest = beside * light.col(column).tail<beside_count>().cast<float>();
      const Eigen::VectorXf left = both.col(column) - of_rest - inside.cwiseProduct(of_ball - of_rest);
      return Eigen::VectorXf(seen.select(left, 0.0f));
    };
    Eigen::MatrixXf left(count, shape_terms);
    for (int k = 0; k < shape_terms; ++k) left.col(k) = left_of(k);
    // Errors that count as limited ones count so here too.
    const auto limit = error.cwiseAbs().maxCoeff() + 1e-3f;
    const Eigen::VectorXf off = left_of(shape_terms).cwiseMax(-3.0f * limit).cwiseMin(3.0f * limit);
    const Eigen::Vector4d step =
        (left.transpose() * left).cast<double>().ldlt().solve((left.transpose() * off).cast<double>());
    return step.allFinite() ? Eigen::Vector2d(step.head<2>()) : Eigen::Vector2d::Zero();
  }

  Eigen::MatrixXd project(const Eigen::MatrixXf& rows) const {
    Eigen::MatrixXd out(light_terms, rows.cols());
    out.topRows<within_count>() = (within.transpose() * (inside.asDiagonal() * rows)).cast<double>();
    out.bottomRows<beside_count>() =
        (beside.transpose() * ((1.0f - inside.array()).matrix().asDiagonal() * rows)).cast<double>();
    return out;
  }
};

// Levels of a picture around a middle; false for those that cannot be used.
using Levels = std::function<bool(const Eigen::Vector2d& middle_px, const Ring&, Eigen::VectorXf&,
                                  Eigen::Array<bool, Eigen::Dynamic, 1>&)>;

struct Fit {
  RimCircle circle;
  Eigen::Matrix2d covariance_px2;
  double deviation = 0.0;  // of the levels from the model
  double fitting_share = 0.0;
};

double median_size(const Eigen::VectorXf& errors, const Eigen::Array<bool, Eigen::Dynamic, 1>& seen) {
  std::vector<float> sizes;
  for (Eigen::Index k = 0; k < errors.size(); ++k) {
    if (seen(k)) sizes.push_back(std::abs(errors(k)));
  }
  if (sizes.empty()) return 0.0;
  std::nth_element(sizes.begin(), sizes.begin() + sizes.size() / 2, sizes.end());
  return sizes[sizes.size() / 2];
}

// Variance of what a sum with these factors makes of noise of variance 1 that has gone through the blur.
Eigen::Matrix2d noise_of_sums(const Ring& ring, const Eigen::Matrix<float, Eigen::Dynamic, 2>& factors,
                              const Eigen::Matrix2d& blur_px2) {
  const int reach = static_cast<int>(std::ceil(ring.x.cwiseAbs().maxCoeff())) + 4;
  std::array<FloatImage, 2> seen;
  for (int axis = 0; axis < 2; ++axis) {
    FloatImage image(2 * reach + 1, 2 * reach + 1);
    for (int k = 0; k < ring.count; ++k) {
      image.row(static_cast<int>(ring.y(k)) + reach)[static_cast<int>(ring.x(k)) + reach] = factors(k, axis);
    }
    seen[axis] = blurred(image, blur_px2);
  }
  Eigen::Matrix2d out;
  for (int a = 0; a < 2; ++a) {
    for (int b = 0; b < 2; ++b) {
      out(a, b) = std::inner_product(seen[a].values.begin(), seen[a].values.end(), seen[b].values.begin(), 0.0);
    }
  }
  return out;
}

double power_of(const Eigen::Matrix2d& blur_px2) {
  double out = 0.0;
  for (const float one : blur_kernel(blur_px2).values) out += double{one} * one;
  return out;
}

// Gauss-Newton on middle, radius and blur with the light eliminated; large errors count as limited ones (Huber, Robust
// Statistics, 7.8: modified residuals), which leaves the light's normal matrix as it is.
std::optional<Fit> fit(const Levels& levels, const RimCircle& start, const Ring* first,
                       const Eigen::Matrix2d& blur_px2) {
  Fit out;
  out.circle = start;
  std::optional<Ring> own;
  if (first == nullptr) own.emplace(start.radius_px, start.blur_px);
  Eigen::VectorXf level, error;
  Eigen::Array<bool, Eigen::Dynamic, 1> seen;
  Eigen::Matrix<double, light_terms, 1> light;
  for (int shape = 0; shape < shapes; ++shape) {
    const Ring& ring = own ? *own : *first;
    if (ring.solved.info() != Eigen::Success) return std::nullopt;
    Eigen::MatrixXf columns(ring.count, shape_terms);
    Eigen::MatrixXd shares;
    Eigen::Matrix4d inverse;
    Shape step = Shape::Zero();
    bool settled = false;
    Eigen::Index fitting = 0;
    light.setZero();
    bool lit = false;
    for (int round = 0; round < steps && !settled; ++round) {
      if (!levels(out.circle.middle_px, ring, level, seen)) return std::nullopt;
      const auto errors = [&] {
        const Eigen::VectorXf of_ball = ring.within * light.head<within_count>().cast<float>();
        const Eigen::VectorXf of_rest = ring.beside * light.tail<beside_count>().cast<float>();
        const Eigen::VectorXf apart = of_ball - of_rest;
        error = level - of_rest - ring.inside.cwiseProduct(apart);
        const Eigen::VectorXf steep = apart.cwiseProduct(ring.slope);
        // What is seen within changes along the radius and across it.
        Eigen::Matrix<float, within_count, 1> along = Eigen::Matrix<float, within_count, 1>::Zero(), across = along;
        for (int order = 0; order < orders; ++order) {
          for (int a = 0; a < angles; ++a) {
            const auto here = static_cast<float>(light(order * angles + a));
            if (order > 0) along((order - 1) * angles + a) = static_cast<float>(order) * here;
            const int m = (a + 1) / 2;  // a odd: cosine, even: sine
            if (a > 0)
              across(order * angles + (a % 2 == 1 ? a + 1 : a - 1)) = static_cast<float>(a % 2 == 1 ? -m : m) * here;
          }
        }
        const Eigen::VectorXf outwards =
            steep - ring.inside.cwiseProduct((ring.within * along).cwiseProduct(ring.fall));
        const Eigen::VectorXf around = -ring.inside.cwiseProduct((ring.within * across).cwiseQuotient(ring.distance));
        columns.col(0) = outwards.cwiseProduct(ring.cosine) - around.cwiseProduct(ring.sine);
        columns.col(1) = outwards.cwiseProduct(ring.sine) + around.cwiseProduct(ring.cosine);
        columns.col(2) = steep;
        columns.col(3) = apart.cwiseProduct(ring.widening);
      };
      errors();
      if (!lit) {  // the light alone, before anything can be said of single pixels
        error = seen.select(error, 0.0f);
        light += ring.solved.solve(ring.project(error).col(0));
        lit = true;
        errors();
      }
      const auto limit = static_cast<float>(reach_sigmas * robust_deviation * median_size(error, seen) + 1e-3);
      fitting = (seen && error.array().abs() < limit).count();
      error = seen.select(error.cwiseMax(-limit).cwiseMin(limit), 0.0f);
      const Eigen::MatrixXd cross = ring.project(columns);
      shares = ring.solved.solve(cross);
      const Eigen::VectorXd told = ring.project(error).col(0);
      Eigen::Matrix4d normal = (columns.transpose() * columns).cast<double>() - cross.transpose() * shares;
      normal.diagonal().array() += 1e-9 * normal.diagonal().maxCoeff();
      inverse = normal.inverse();
      step = inverse * ((columns.transpose() * error).cast<double>() - shares.transpose() * told);
      if (!step.allFinite()) return std::nullopt;
      light += ring.solved.solve(told) - shares * step;
      const Eigen::Vector2d move = step.head<2>() * std::min(1.0, largest_step_px / (step.head<2>().norm() + 1e-12));
      out.circle.middle_px += move;
      if ((out.circle.middle_px - start.middle_px).norm() > largest_way_px) return std::nullopt;
      settled = move.norm() < settled_px;
      if (std::abs(step(2)) > other_shape || std::abs(step(3)) > other_shape * ring.blur_px) break;
    }
    const double radius = ring.radius_px + std::clamp(step(2), -largest_step_px, largest_step_px);
    const double blur = std::clamp(ring.blur_px + std::clamp(step(3), -0.5, 0.5), least_blur_px, largest_blur_px);
    out.circle.radius_px = radius;
    out.circle.blur_px = blur;
    if (std::abs(radius - start.radius_px) > largest_way_px) return std::nullopt;
    if (std::abs(radius - ring.radius_px) > same_shape || std::abs(blur - ring.blur_px) > same_shape * blur) {
      own.emplace(radius, blur);
      continue;
    }
    if (!settled) return std::nullopt;
    // What is left, once radius and blur have had their small share.
    error -= (columns * step.cast<float>());
    error = seen.select(error, 0.0f);
    const double usable = static_cast<double>(seen.count());
    const double left = std::max(usable - light_terms - shape_terms, 1.0);
    out.deviation = std::sqrt(error.squaredNorm() / left);
    out.fitting_share = static_cast<double>(fitting) / ring.count;
    const double lost = ring.count / std::max(usable, 1.0);
    // Factors with which each pixel's error goes into the middle.
    Eigen::MatrixXf factors = columns;
    factors -= ring.inside.asDiagonal() * (ring.within * shares.topRows<within_count>().cast<float>());
    factors -= (1.0f - ring.inside.array()).matrix().asDiagonal() *
               (ring.beside * shares.bottomRows<beside_count>().cast<float>());
    const Eigen::Matrix<float, Eigen::Dynamic, 2> middle = factors * inverse.leftCols<2>().cast<float>();
    const Eigen::Matrix2d noise =
        noise_of_sums(ring, middle, blur_px2) * (out.deviation * out.deviation / power_of(blur_px2) * lost);
    // By sectors: what the model misses is the same all across the rim.
    std::array<Eigen::Vector2d, sectors> sums;
    sums.fill(Eigen::Vector2d::Zero());
    for (int k = 0; k < ring.count; ++k) {
      const double turn = std::atan2(ring.sine(k), ring.cosine(k)) / (2.0 * std::numbers::pi) + 0.5;
      const int at = std::min(static_cast<int>(turn * sectors), sectors - 1);
      sums[at] += (middle.row(k) * error(k)).transpose().cast<double>();
    }
    Eigen::Vector2d by_sectors = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d& one : sums) by_sectors += one.cwiseAbs2();
    const Eigen::Vector2d growth = (by_sectors.array() / noise.diagonal().array()).max(1.0).sqrt();
    out.covariance_px2 = growth.asDiagonal() * noise * growth.asDiagonal();
    const Eigen::Vector2d simpler = ring.moved_by_simpler_light(level, columns, seen, error);
    out.covariance_px2.diagonal() += simpler_share * simpler.cwiseAbs2();
    if (!(out.covariance_px2.diagonal().array() > 0.0).all()) return std::nullopt;
    return out;
  }
  return std::nullopt;
}

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
  const double noise = source.noise_levels * std::sqrt(power_of(blur_px2));
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
