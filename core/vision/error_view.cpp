#include "core/vision/error_view.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace zerodrift::vision {
namespace {

constexpr double least_spacing_px = 120.0;  // marks closer than this cannot tell roll and scale better than none

constexpr int mark_margin_px = 40;  // a fixed mark moves by the camera's own drift only

/// The frame with everything beyond the mark's surroundings made even: marks of one plate look alike, and the one that
/// is asked for stands where it stood.
GrayImage surroundings_of(const Target& mark, const GrayImage& frame) {
  const Region& region = mark.region();
  const int left = std::max(0, region.x - mark_margin_px);
  const int top = std::max(0, region.y - mark_margin_px);
  const int right = std::min(frame.width, region.x + region.width + mark_margin_px);
  const int bottom = std::min(frame.height, region.y + region.height + mark_margin_px);
  GrayImage out = frame;
  if (left >= right || top >= bottom) return out;
  const std::uint8_t even = frame.at(left, top);
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      if (y < top || y >= bottom || x < left || x >= right) out.at(x, y) = even;
    }
  }
  return out;
}

Location refused(Location location, std::string reason) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  location.ok = false;
  location.reason = std::move(reason);
  location.x_px = location.y_px = location.sigma_x_px = location.sigma_y_px = nan;
  return location;
}

// The camera's motion at a point of the image, with covariance, from what the marks do.
struct CameraMotion {
  Eigen::Vector2d shift_px;
  Eigen::Matrix2d covariance_px2;
};

CameraMotion motion_at(const PixelPoint& point, const std::vector<Target>& marks, const std::vector<Location>& found) {
  double spacing = 0.0;
  for (const Target& a : marks) {
    for (const Target& b : marks) {
      spacing = std::max(spacing, std::hypot(a.point().x_px - b.point().x_px, a.point().y_px - b.point().y_px));
    }
  }
  const bool similarity = marks.size() >= 2 && spacing >= least_spacing_px;
  // Parameters: shift x, shift y and, with spaced marks, scale and roll about the point.
  const int unknowns = similarity ? 4 : 2;
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(unknowns, unknowns);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns);
  for (std::size_t k = 0; k < marks.size(); ++k) {
    const double x = (marks[k].point().x_px - point.x_px) / 100.0;
    const double y = (marks[k].point().y_px - point.y_px) / 100.0;
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(2, unknowns);
    rows.leftCols(2).setIdentity();
    if (similarity) rows.rightCols(2) << x, -y, y, x;
    const Eigen::Vector2d weight(1.0 / (found[k].sigma_x_px * found[k].sigma_x_px),
                                 1.0 / (found[k].sigma_y_px * found[k].sigma_y_px));
    normal += rows.transpose() * weight.asDiagonal() * rows;
    right += rows.transpose() * weight.cwiseProduct(Eigen::Vector2d(found[k].x_px, found[k].y_px));
  }
  const Eigen::MatrixXd covariance = normal.inverse();
  const Eigen::VectorXd solved = covariance * right;
  return {solved.head<2>(), covariance.topLeftCorner<2, 2>()};
}

}  // namespace

Location locate_against(const Target& target, const std::vector<Target>& references, const GrayImage& frame,
                        std::vector<Location>* reference_locations) {
  Location at = target.locate(frame);
  std::vector<Location> found;
  for (const Target& reference : references) {
    found.push_back(reference.locate(surroundings_of(reference, frame)));
  }
  if (reference_locations != nullptr) *reference_locations = found;
  if (!at.ok || references.empty()) return at;
  for (const Location& one : found) {
    if (!one.ok) return refused(std::move(at), "reference: " + one.reason);
  }
  const CameraMotion motion = motion_at(at.point, references, found);
  at.x_px -= motion.shift_px(0);
  at.y_px -= motion.shift_px(1);
  at.sigma_x_px = std::sqrt(at.sigma_x_px * at.sigma_x_px + motion.covariance_px2(0, 0));
  at.sigma_y_px = std::sqrt(at.sigma_y_px * at.sigma_y_px + motion.covariance_px2(1, 1));
  at.covariance_xy_px2 += motion.covariance_px2(0, 1);
  return at;
}

MeanLocation mean_of(const std::vector<Location>& locations) {
  MeanLocation out;
  std::map<std::string, int> reasons;
  double sx = 0.0, sy = 0.0, vx = 0.0, vy = 0.0, vxy = 0.0;
  for (const Location& one : locations) {
    if (!one.ok) {
      ++out.refused;
      ++reasons[one.reason];
      out.location = one;
      continue;
    }
    ++out.good;
    sx += one.x_px;
    sy += one.y_px;
    vx += one.sigma_x_px * one.sigma_x_px;
    vy += one.sigma_y_px * one.sigma_y_px;
    vxy += one.covariance_xy_px2;
  }
  const double n = out.good;
  if (out.good == 0 || out.good < out.refused) {
    std::string most = "no frame";
    int count = 0;
    for (const auto& [reason, times] : reasons) {
      if (times > count) {
        most = reason;
        count = times;
      }
    }
    out.location = refused(out.location, most);
    return out;
  }
  double dx = 0.0, dy = 0.0;
  for (const Location& one : locations) {
    if (!one.ok) continue;
    dx += (one.x_px - sx / n) * (one.x_px - sx / n);
    dy += (one.y_px - sy / n) * (one.y_px - sy / n);
    out.location = one;
  }
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  out.scatter_x_px = out.good > 1 ? std::sqrt(dx / (n - 1.0)) : nan;
  out.scatter_y_px = out.good > 1 ? std::sqrt(dy / (n - 1.0)) : nan;
  const auto sigma_of_mean = [&](double stated_variance, double scatter) {
    // The scatter sees vibration and lamp flicker, the stated uncertainty sees what all frames share: the larger holds.
    const double from_scatter = out.good > 2 ? scatter / std::sqrt(n) : 0.0;
    return std::max(std::sqrt(stated_variance / n / n), from_scatter);
  };
  Location& mean = out.location;
  mean.point.x_px += sx / n - mean.x_px;
  mean.point.y_px += sy / n - mean.y_px;
  mean.x_px = sx / n;
  mean.y_px = sy / n;
  mean.sigma_x_px = sigma_of_mean(vx, out.scatter_x_px);
  mean.sigma_y_px = sigma_of_mean(vy, out.scatter_y_px);
  mean.covariance_xy_px2 = vxy / n / n;
  return out;
}

}  // namespace zerodrift::vision
