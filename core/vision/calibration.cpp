#include "core/vision/calibration.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>
#include <complex>
#include <limits>

namespace zerodrift::vision {
namespace {

using Points = Eigen::Matrix<double, Eigen::Dynamic, 2>;

struct Fit {
  Eigen::Matrix2d um_from_px;
  Eigen::Vector2d origin_um;  // machine position of the template's place
  Eigen::Matrix2d spread;     // inverse of the centred px scatter
};

Points pixels_of(const std::vector<CalibrationView>& views) {
  Points out(static_cast<Eigen::Index>(views.size()), 2);
  for (std::size_t k = 0; k < views.size(); ++k) out.row(static_cast<Eigen::Index>(k)) << views[k].x_px, views[k].y_px;
  return out;
}

Points machine_um_of(const std::vector<CalibrationView>& views) {
  Points out(static_cast<Eigen::Index>(views.size()), 2);
  for (std::size_t k = 0; k < views.size(); ++k) {
    out.row(static_cast<Eigen::Index>(k)) << 1000.0 * views[k].x_mm, 1000.0 * views[k].y_mm;
  }
  return out;
}

// The machine's repeatability is the noise (1 um against some 0.02 um of the image), so machine is regressed on px.
Fit fit_full(const Points& pixels, const Points& machine_um) {
  const Eigen::RowVector2d mean_px = pixels.colwise().mean();
  const Eigen::RowVector2d mean_um = machine_um.colwise().mean();
  const Points p = pixels.rowwise() - mean_px;
  const Points m = machine_um.rowwise() - mean_um;
  Fit fit;
  fit.spread = (p.transpose() * p).inverse();
  fit.um_from_px = (fit.spread * (p.transpose() * m)).transpose();
  fit.origin_um = mean_um.transpose() - fit.um_from_px * mean_px.transpose();
  return fit;
}

// Published form with two positions: c = (M2 - M1) / (p2 - p1) in complex numbers, the image's y turned upwards.
Fit fit_two(const Points& pixels, const Points& machine_um) {
  const std::complex<double> p(pixels(1, 0) - pixels(0, 0), -(pixels(1, 1) - pixels(0, 1)));
  const std::complex<double> m(machine_um(1, 0) - machine_um(0, 0), machine_um(1, 1) - machine_um(0, 1));
  const std::complex<double> c = m / p;
  Fit fit;
  fit.um_from_px << c.real(), c.imag(), c.imag(), -c.real();
  fit.spread = Eigen::Matrix2d::Identity() * 2.0 / std::norm(p);
  fit.origin_um = machine_um.row(0).transpose() - fit.um_from_px * pixels.row(0).transpose();
  return fit;
}

// A camera that shows less than a pixel of this much travel would be of no use to anybody.
constexpr double clear_move_um = 100.0;
constexpr double same_um = 0.01;
constexpr double stands_still_px = 1.0;

double largest_step(const Points& points) {
  return (points.rowwise() - points.row(0)).rowwise().norm().maxCoeff();
}

std::string refusal_of(const Points& pixels, const Points& machine_um, const CalibrationLimits& limits) {
  if (!pixels.allFinite() || !machine_um.allFinite()) return "a position is not a number";
  if (largest_step(pixels) < stands_still_px && largest_step(machine_um) > clear_move_um) {
    return "what was measured stood still while the machine moved: the region shows more of what stands still than of "
           "the target; draw it closer to the target";
  }
  if (largest_step(machine_um) < same_um) return "all positions have the same machine coordinates";
  if (pixels.rows() == 2) {
    const double distance = (pixels.row(1) - pixels.row(0)).norm();
    if (distance < limits.least_span_two_px) {
      return fmt::format("the two positions are {:.1f} px apart in the image, at least {:.0f} px are needed", distance,
                         limits.least_span_two_px);
    }
    return "";
  }
  const auto extents = [](const Points& points) {
    const Points centred = points.rowwise() - points.colwise().mean();
    const Eigen::JacobiSVD<Points> svd(centred, Eigen::ComputeFullV);
    const Points along = centred * svd.matrixV();
    return Eigen::Vector2d(along.col(0).maxCoeff() - along.col(0).minCoeff(),
                           along.col(1).maxCoeff() - along.col(1).minCoeff());
  };
  const Eigen::Vector2d px = extents(pixels);
  const Eigen::Vector2d um = extents(machine_um);
  if (px.maxCoeff() < limits.least_span_px) {
    return fmt::format("the positions span only {:.1f} px in the image, at least {:.0f} px are needed", px.maxCoeff(),
                       limits.least_span_px);
  }
  if (px.minCoeff() < limits.least_aspect * px.maxCoeff() || um.minCoeff() < limits.least_aspect * um.maxCoeff()) {
    return "the positions lie on one line: move along both axes";
  }
  if (px.minCoeff() < limits.least_span_px) {
    return fmt::format("the positions span only {:.1f} px in one direction, at least {:.0f} px are needed",
                       px.minCoeff(), limits.least_span_px);
  }
  return "";
}

// Repeats the fit without each view in turn; the view that fits worst to the others is named.
struct LeftOut {
  double rms_um = std::numeric_limits<double>::quiet_NaN();
  double worst_um = 0.0;
  Eigen::Index worst = 0;
  double chance = 1.0;     // that a view would be so far off by what the others scatter: of the least likely one
  double others_um = 0.0;  // rms of their residuals, by their freedom
  double apart_um = 0.0;
  Eigen::Index least_likely = 0;
};
LeftOut leave_one_out(const Points& pixels, const Points& machine_um) {
  LeftOut out;
  const Eigen::Index n = pixels.rows();
  if (n < 5) return out;
  double sum = 0.0;
  for (Eigen::Index skip = 0; skip < n; ++skip) {
    Points p(n - 1, 2);
    Points m(n - 1, 2);
    for (Eigen::Index k = 0, to = 0; k < n; ++k) {
      if (k == skip) continue;
      p.row(to) = pixels.row(k);
      m.row(to++) = machine_um.row(k);
    }
    const Fit fit = fit_full(p, m);
    const double miss =
        (machine_um.row(skip).transpose() - fit.origin_um - fit.um_from_px * pixels.row(skip).transpose()).norm();
    sum += miss * miss;
    // Both coordinates together follow F with 2 and `freedom` degrees of freedom, whose tail has a closed form.
    const double freedom = 2.0 * static_cast<double>(n - 1) - 6.0;
    const Points left = (m - p * fit.um_from_px.transpose()).rowwise() - fit.origin_um.transpose();
    const double variance = left.squaredNorm() / freedom;
    const Eigen::RowVector2d away = pixels.row(skip) - p.colwise().mean();
    const double predicted = variance * (1.0 + 1.0 / static_cast<double>(n - 1) + away.dot(away * fit.spread));
    const double chance = std::pow(1.0 + miss * miss / (predicted * freedom), -freedom / 2.0);
    if (chance < out.chance) {
      out.chance = chance;
      out.others_um = std::sqrt(variance);
      out.apart_um = miss;
      out.least_likely = skip;
    }
    if (miss > out.worst_um) {
      out.worst_um = miss;
      out.worst = skip;
    }
  }
  out.rms_um = std::sqrt(sum / (2.0 * static_cast<double>(n)));
  return out;
}

// Scale, rotation and handedness in the engineer's terms, and what looks odd about them.
void describe_geometry(Calibration& c) {
  // Image y runs down: a camera that is not mirrored has a negative determinant.
  const double determinant = c.um_from_px.determinant();
  c.mirrored = determinant > 0.0;
  c.scale_um_per_px = std::sqrt(std::abs(determinant));
  Eigen::Matrix2d up = c.um_from_px;  // machine from image with y up
  up.col(1) *= -1.0;
  if (c.mirrored) up.col(0) *= -1.0;
  c.rotation_deg = std::atan2(up(1, 0) - up(0, 1), up(0, 0) + up(1, 1)) * 180.0 / M_PI;
  // A mirrored image has either left and right exchanged or top and bottom: whichever leaves less to turn.
  if (c.mirrored && std::abs(c.rotation_deg) > 90.0) c.rotation_deg -= std::copysign(180.0, c.rotation_deg);
  const Eigen::JacobiSVD<Eigen::Matrix2d> svd(c.um_from_px);
  const double ratio = svd.singularValues()(0) / svd.singularValues()(1);
  if (ratio > 1.1) {
    c.warnings.push_back(fmt::format(
        "the scale differs by {:.0f} % between two directions: the camera looks at the plane of motion from the side",
        100.0 * (ratio - 1.0)));
  }
}

}  // namespace

Eigen::Matrix2d Calibration::sigma() const {
  Eigen::Matrix2d out;
  out << covariance(0, 0), covariance(1, 1), covariance(2, 2), covariance(3, 3);
  return out.cwiseMax(0.0).cwiseSqrt();
}

bool Calibration::covers(const Location& location) const {
  constexpr double beyond = 1.05;  // the same place but for the machine's own scatter
  const bool known = range_px[0] > 0.0 && range_px[1] > 0.0;
  return !known || (std::abs(location.x_px) <= beyond * range_px[0] && std::abs(location.y_px) <= beyond * range_px[1]);
}

ErrorUm Calibration::to_um(const Location& location) const {
  const Eigen::Vector2d p(location.x_px, location.y_px);
  const Eigen::Vector2d um = um_from_px * p;
  Eigen::Matrix2d image;
  image << location.sigma_x_px * location.sigma_x_px, location.covariance_xy_px2, location.covariance_xy_px2,
      location.sigma_y_px * location.sigma_y_px;
  const Eigen::Matrix2d from_image = um_from_px * image * um_from_px.transpose();
  const double from_scale_x = p.dot(covariance.topLeftCorner<2, 2>() * p);
  const double from_scale_y = p.dot(covariance.bottomRightCorner<2, 2>() * p);
  return {um(0), um(1), std::sqrt(from_image(0, 0) + from_scale_x), std::sqrt(from_image(1, 1) + from_scale_y)};
}

std::optional<OddView> oddest_view(const std::vector<CalibrationView>& views) {
  const LeftOut out = leave_one_out(pixels_of(views), machine_um_of(views));
  if (!std::isfinite(out.rms_um)) return std::nullopt;
  return OddView{static_cast<std::size_t>(out.worst), out.worst_um};
}

Result<Calibration> calibrate(std::vector<CalibrationView> views, const CalibrationLimits& limits) {
  if (views.size() < 2) {
    return fail(ErrorCode::calibration_refused,
                {{"reason", fmt::format("{} of the views can be used: 2 are needed, 9 are better", views.size())}});
  }
  const Points pixels = pixels_of(views);
  const Points machine_um = machine_um_of(views);
  if (const std::string reason = refusal_of(pixels, machine_um, limits); !reason.empty()) {
    return fail(ErrorCode::calibration_refused, {{"reason", reason}});
  }
  const bool two = views.size() == 2;
  const Fit fit = two ? fit_two(pixels, machine_um) : fit_full(pixels, machine_um);
  Calibration out;
  out.um_from_px = fit.um_from_px;
  out.handedness_assumed = two;
  const Points residual = (machine_um - pixels * fit.um_from_px.transpose()).rowwise() - fit.origin_um.transpose();
  out.rms_um = std::sqrt(residual.squaredNorm() / static_cast<double>(residual.size()));
  const LeftOut left_out = leave_one_out(pixels, machine_um);
  out.leave_one_out_um = left_out.rms_um;
  const double span_um = (machine_um.colwise().maxCoeff() - machine_um.colwise().minCoeff()).norm();
  const double limit_um = std::max(limits.largest_rms_um, 0.005 * span_um);
  if (out.rms_um > limit_um) {
    std::string reason = fmt::format("the residual is {:.1f} um rms, the limit {:.1f} um", out.rms_um, limit_um);
    if (std::isfinite(left_out.rms_um)) {
      reason += fmt::format("; the view that fits worst is {} ({:.0f} um off)",
                            views[static_cast<std::size_t>(left_out.worst)].image, left_out.worst_um);
    }
    return fail(ErrorCode::calibration_refused, {{"reason", reason}});
  }
  // What is predicted with a noise known from few residuals scatters as Student's t, whose variance is
  // freedom / (freedom - 2) times theirs (JCGM 101, 6.4.9). Fewer still say little: the assumed repeatability counts as
  // two further observations there.
  constexpr double enough_freedom = 6.0;
  const double freedom = 2.0 * static_cast<double>(views.size()) - (two ? 4.0 : 6.0);
  const double assumed = limits.repeatability_um * limits.repeatability_um;
  const double with_assumed = (residual.squaredNorm() + 2.0 * assumed) / (freedom + 2.0);
  const double variance = freedom >= enough_freedom ? residual.squaredNorm() / (freedom - 2.0) : with_assumed;
  out.covariance.topLeftCorner<2, 2>() = variance * fit.spread;
  out.covariance.bottomRightCorner<2, 2>() = variance * fit.spread;
  // A px is some um in every picture that a drift can be measured in: else the coordinates are in another unit.
  const double scale = std::sqrt(std::abs(fit.um_from_px.determinant()));
  const double scale_sigma = std::sqrt(std::max(variance, with_assumed) * fit.spread.diagonal().maxCoeff());
  if (!(scale >= limits.least_um_per_px && scale <= limits.largest_um_per_px)) {
    return fail(ErrorCode::calibration_refused,
                {{"reason", fmt::format("a pixel would be {:.3g} um: the positions do not seem to be in mm", scale)}});
  }
  if (scale_sigma > limits.largest_scale_sigma * scale) {
    return fail(
        ErrorCode::calibration_refused,
        {{"reason", fmt::format("the positions are too close together, or not in mm: {:.3g} um apart, with {:g} "
                                "um of the machine's own the scale is known to {:.0f} % only",
                                span_um, limits.repeatability_um, 100.0 * scale_sigma / scale)}});
  }
  out.range_px = {pixels.col(0).cwiseAbs().maxCoeff(), pixels.col(1).cwiseAbs().maxCoeff()};
  for (std::size_t k = 0; k < views.size(); ++k) {
    views[k].residual_x_um = residual(static_cast<Eigen::Index>(k), 0);
    views[k].residual_y_um = residual(static_cast<Eigen::Index>(k), 1);
  }
  out.views = std::move(views);
  describe_geometry(out);
  // One position read wrongly is taken for the machine's scatter: honest, but it need not be.
  constexpr double never_by_chance = 1e-3;  // in any of the views
  if (static_cast<double>(out.views.size()) * left_out.chance < never_by_chance &&
      left_out.apart_um > 2.0 * limits.repeatability_um) {
    out.warnings.push_back(fmt::format(
        "{} does not fit the other views: it is {:.3g} um off where they agree to {:.2g} um; check its "
        "position, or leave it out",
        out.views[static_cast<std::size_t>(left_out.least_likely)].image, left_out.apart_um, left_out.others_um));
  }
  if (two) {
    out.warnings.push_back(
        "two positions cannot show a mirrored camera; the image was taken as not mirrored: add a third position beside "
        "the line of the two");
  } else if (out.views.size() == 3) {
    out.warnings.push_back("three positions leave nothing to check the calibration with: use nine");
  }
  return out;
}

bool scatters_beyond_pictures(const Calibration& calibration, const CalibrationLimits& limits) {
  constexpr double never_by_chance = 1e-3;
  constexpr double fair_part = 0.25;  // of the residual
  double chi_square = 0.0;
  double stated_um2 = 0.0;
  for (const CalibrationView& view : calibration.views) {
    const double stated_um = view.sigma_px * calibration.scale_um_per_px;
    const double miss_um2 = view.residual_x_um * view.residual_x_um + view.residual_y_um * view.residual_y_um;
    chi_square += miss_um2 / (stated_um * stated_um + limits.repeatability_um * limits.repeatability_um);
    stated_um2 += stated_um * stated_um / static_cast<double>(calibration.views.size());
  }
  if (stated_um2 < fair_part * fair_part * calibration.rms_um * calibration.rms_um) return false;
  // The tail of chi-square has a closed form for an even number of degrees of freedom: two for each view, less the six
  // of the fit.
  double term = 1.0;
  double sum = 0.0;
  for (std::size_t k = 0; k + 3 < calibration.views.size(); ++k) {
    sum += term;
    term *= 0.5 * chi_square / static_cast<double>(k + 1);
  }
  return sum > 0.0 && std::exp(-0.5 * chi_square) * sum < never_by_chance;
}

std::vector<ProposedPosition> propose_positions(double span_mm, int per_side, double approach_mm) {
  std::vector<ProposedPosition> out{{0.0, 0.0, -approach_mm, -approach_mm}};
  const double step = span_mm / (per_side - 1);
  for (int row = 0; row < per_side; ++row) {
    for (int column = 0; column < per_side; ++column) {
      const double x = -0.5 * span_mm + column * step;
      const double y = -0.5 * span_mm + row * step;
      if (std::abs(x) < 1e-9 && std::abs(y) < 1e-9) continue;
      out.push_back({x, y, x - approach_mm, y - approach_mm});
    }
  }
  return out;
}

}  // namespace zerodrift::vision
