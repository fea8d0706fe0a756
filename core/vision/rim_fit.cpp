#include "core/vision/rim_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "core/vision/spline_image.h"

namespace zerodrift::vision::rim_fit {
namespace {

constexpr double simpler_share = 0.06;  // of the square of what a simpler light moves
constexpr double beside_px = 5.0, beside_blurs = 2.0;
constexpr double pixel_px = 0.5;
constexpr double largest_step_px = 1.5;
constexpr double largest_way_px = 4.0;
constexpr double settled_px = 5e-4;
constexpr double overshoot = 0.5;  // of the step before
constexpr int steps = 12;
constexpr int shapes = 10;            // that are tried, each from what the one before left
constexpr double same_shape = 0.04;   // px, and of the blur
constexpr double reach_sigmas = 4.0;  // a larger error counts as one of these
constexpr double robust_deviation = 1.4826;
constexpr int sectors = 32;

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

}  // namespace

Ring::Ring(double radius, double blur, const Eigen::Matrix2d& uneven) : radius_px(radius), blur_px(blur) {
  const double widest = std::sqrt(blur * blur + uneven.norm() / std::numbers::sqrt2);
  const double inner = std::max(radius - within_px - within_blurs * widest, 0.0);
  const double outer = radius + beside_px + beside_blurs * widest;
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
    const double c = px / r, s = py / r;
    const Eigen::Vector2d outwards(c, s);
    const double least = least_blur_px * least_blur_px;
    const double across = std::sqrt(std::max(blur * blur + outwards.dot(uneven * outwards), least));
    const double u = (r - radius) / across;
    x(k) = static_cast<float>(px), y(k) = static_cast<float>(py);
    cosine(k) = static_cast<float>(c), sine(k) = static_cast<float>(s);
    inside(k) = static_cast<float>(0.5 * std::erfc(u / std::numbers::sqrt2));
    const double bell = std::exp(-0.5 * u * u) / (across * std::sqrt(2.0 * std::numbers::pi));
    slope(k) = static_cast<float>(bell);
    widening(k) = static_cast<float>(bell * u * blur / across);
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
  Eigen::MatrixXf lower = Eigen::MatrixXf::Zero(light_terms, light_terms);
  lower.selfadjointView<Eigen::Lower>().rankUpdate(all.transpose());
  Light normal = Eigen::MatrixXf(lower.selfadjointView<Eigen::Lower>()).cast<double>();
  normal.diagonal().array() += 1e-7 * normal.diagonal().maxCoeff();
  solved.compute(normal);
  constexpr int less = simpler_terms - beside_count;
  Eigen::Matrix<double, simpler_terms, simpler_terms> part;
  part << normal.topLeftCorner<less, less>(), normal.topRightCorner<less, beside_count>(),
      normal.bottomLeftCorner<beside_count, less>(), normal.bottomRightCorner<beside_count, beside_count>();
  simpler.compute(part);
}

Eigen::Vector2d Ring::moved_by_simpler_light(const Eigen::VectorXf& level, const Eigen::MatrixXf& columns,
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

Eigen::MatrixXd Ring::project(const Eigen::MatrixXf& rows) const {
  Eigen::MatrixXd out(light_terms, rows.cols());
  out.topRows<within_count>() = (within.transpose() * (inside.asDiagonal() * rows)).cast<double>();
  out.bottomRows<beside_count>() =
      (beside.transpose() * ((1.0f - inside.array()).matrix().asDiagonal() * rows)).cast<double>();
  return out;
}

// Gauss-Newton on middle, radius and blur with the light eliminated; large errors count as limited ones (Huber, Robust
// Statistics, 7.8: modified residuals), which leaves the light's normal matrix as it is.
std::optional<Fit> fit(const Levels& levels, const RimCircle& start, const Ring* first, const Eigen::Matrix2d& blur_px2,
                       const Eigen::Matrix2d& uneven_px2) {
  Fit out;
  out.circle = start;
  std::optional<Ring> own;
  if (first == nullptr) own.emplace(start.radius_px, start.blur_px, uneven_px2);
  Around picture;
  const Eigen::VectorXf& behind = picture.behind;
  const Eigen::Array<bool, Eigen::Dynamic, 1>& seen = picture.seen;
  Eigen::VectorXf level, error;
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
    double share = 1.0;  // of a step that is gone: one that overshoots would go to and fro
    Eigen::Vector2d last = Eigen::Vector2d::Zero();
    for (int round = 0; round < steps && !settled; ++round) {
      if (!levels(out.circle.middle_px, ring, picture)) return std::nullopt;
      level = picture.level;
      if (behind.size() > 0) level -= (1.0f - ring.inside.array()).matrix().cwiseProduct(behind);
      const auto errors = [&] {
        const Eigen::VectorXf of_ball = ring.within * light.head<within_count>().cast<float>();
        const Eigen::VectorXf of_rest = ring.beside * light.tail<beside_count>().cast<float>();
        Eigen::VectorXf apart = of_ball - of_rest;
        error = level - of_rest - ring.inside.cwiseProduct(apart);
        // What is known was taken off as far as the ball leaves it free, and a step changes how far that is.
        if (behind.size() > 0) apart -= behind;
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
      if (last.dot(step.head<2>()) < -overshoot * last.squaredNorm()) share *= 0.5;
      last = step.head<2>();
      const Eigen::Vector2d move = last * std::min(share, largest_step_px / (last.norm() + 1e-12));
      out.circle.middle_px += move;
      if ((out.circle.middle_px - start.middle_px).norm() > largest_way_px) return std::nullopt;
      settled = last.norm() < settled_px;
      if (std::abs(step(2)) > other_shape || std::abs(step(3)) > other_shape * ring.blur_px) break;
    }
    const double radius = ring.radius_px + std::clamp(step(2), -largest_step_px, largest_step_px);
    const double blur = std::clamp(ring.blur_px + std::clamp(step(3), -0.5, 0.5), least_blur_px, largest_blur_px);
    out.circle.radius_px = radius;
    out.circle.blur_px = blur;
    if (std::abs(radius - start.radius_px) > largest_way_px) return std::nullopt;
    if (std::abs(radius - ring.radius_px) > same_shape || std::abs(blur - ring.blur_px) > same_shape * blur) {
      own.emplace(radius, blur, uneven_px2);
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
        noise_of_sums(ring, middle, blur_px2) * (out.deviation * out.deviation / blur_power(blur_px2) * lost);
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

}  // namespace zerodrift::vision::rim_fit
