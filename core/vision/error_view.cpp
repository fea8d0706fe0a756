#include "core/vision/error_view.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace zerodrift::vision {
namespace {

// How far roll (rad) and scale (relative) may have gone where they are not seen, as a standard uncertainty: a holder of
// 100 mm of aluminium that is some K warmer on one side.
constexpr double unseen_turn = 1e-4;
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

double spacing_px(const std::vector<PixelPoint>& marks) {
  double spacing = 0.0;
  for (const PixelPoint& a : marks) {
    for (const PixelPoint& b : marks) spacing = std::max(spacing, std::hypot(a.x_px - b.x_px, a.y_px - b.y_px));
  }
  return spacing;
}

struct SeenMark {
  PixelPoint place;  // of the template
  Location now;
};

/// The camera's motion at a point of the image, with covariance, from what the marks do.
struct CameraMotion {
  Eigen::Vector2d shift_px;
  Eigen::Matrix2d covariance_px2;
  double unseen_px = 0.0;  // standard uncertainty by a turn and scale that the marks do not show
  CameraTurn turn;
};

/// What a turn and a change of scale about the point move at a place.
Eigen::Matrix2d of_scale_and_roll(const PixelPoint& place, const PixelPoint& point) {
  const double x = place.x_px - point.x_px;
  const double y = place.y_px - point.y_px;
  Eigen::Matrix2d moved;
  moved << x, -y, y, x;
  return moved;
}

CameraMotion motion_at(const PixelPoint& point, const std::vector<SeenMark>& marks, bool with_turn,
                       const CameraTurn& last) {
  // Parameters: shift x, shift y and, with spaced marks, scale and roll about the point, of 1 in 100 each.
  constexpr double unit = 0.01;
  const int unknowns = with_turn ? 4 : 2;
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(unknowns, unknowns);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns);
  PixelPoint middle{0.0, 0.0};
  for (const SeenMark& mark : marks) {
    const Eigen::Matrix2d turning = of_scale_and_roll(mark.place, point);
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(2, unknowns);
    rows.leftCols(2).setIdentity();
    Eigen::Vector2d moved(mark.now.x_px, mark.now.y_px);
    if (with_turn) {
      rows.rightCols(2) = unit * turning;
    } else {
      moved -= turning * Eigen::Vector2d(last.scale, last.roll_rad);
    }
    const Eigen::Vector2d weight(1.0 / (mark.now.sigma_x_px * mark.now.sigma_x_px),
                                 1.0 / (mark.now.sigma_y_px * mark.now.sigma_y_px));
    normal += rows.transpose() * weight.asDiagonal() * rows;
    right += rows.transpose() * weight.cwiseProduct(moved);
    middle.x_px += mark.place.x_px / static_cast<double>(marks.size());
    middle.y_px += mark.place.y_px / static_cast<double>(marks.size());
  }
  const Eigen::MatrixXd covariance = normal.inverse();
  const Eigen::VectorXd solved = covariance * right;
  CameraMotion motion{solved.head<2>(), covariance.topLeftCorner<2, 2>(), 0.0, last};
  if (with_turn) {
    motion.turn = {unit * solved(2), unit * solved(3)};
  } else {
    motion.unseen_px = unseen_turn * std::hypot(middle.x_px - point.x_px, middle.y_px - point.y_px);
  }
  return motion;
}

}  // namespace

TakenOff taken_off_by(const std::vector<PixelPoint>& marks) {
  if (marks.empty()) return TakenOff::nothing;
  return spacing_px(marks) >= least_mark_spacing_px ? TakenOff::shift_turn_scale : TakenOff::shift;
}

TakenOff taken_off_by(const std::vector<Region>& marks) {
  std::vector<PixelPoint> centres;
  for (const Region& mark : marks) centres.push_back(centre_of(mark));
  return taken_off_by(centres);
}

std::string marks_not_seen(const std::vector<Location>& references) {
  std::string text;
  for (std::size_t k = 0; k < references.size(); ++k) {
    if (references[k].ok) continue;
    if (!text.empty()) text += "; ";
    text += references.size() == 1 ? "reference: " + references[k].reason
                                   : fmt::format("reference {}: {}", k + 1, references[k].reason);
  }
  return text;
}

Location locate_against(const Target& target, const std::vector<Target>& references, const GrayImage& frame,
                        std::vector<Location>* reference_locations, CameraTurn* turn) {
  Location at = target.locate(frame);
  std::vector<Location> found;
  std::vector<SeenMark> seen;
  std::vector<PixelPoint> places, seen_places;
  for (const Target& reference : references) {
    found.push_back(reference.locate(surroundings_of(reference, frame)));
    places.push_back(reference.point());
    if (!found.back().ok) continue;
    seen.push_back({reference.point(), found.back()});
    seen_places.push_back(reference.point());
  }
  if (reference_locations != nullptr) *reference_locations = found;
  if (!at.ok || references.empty()) return at;
  if (seen.empty()) return refused(std::move(at), marks_not_seen(found));
  const bool with_turn = taken_off_by(seen_places) == TakenOff::shift_turn_scale;
  const bool expected = taken_off_by(places) == TakenOff::shift_turn_scale;
  const CameraTurn last = expected && turn != nullptr ? *turn : CameraTurn{};
  // Of the place where the target is, which the camera's own motion shows elsewhere.
  constexpr int corrections = 2;
  CameraMotion motion = motion_at(at.point, seen, with_turn, last);
  for (int i = 0; i < corrections; ++i) {
    const PixelPoint place{at.point.x_px - motion.shift_px(0), at.point.y_px - motion.shift_px(1)};
    motion = motion_at(place, seen, with_turn, last);
  }
  if (turn != nullptr) *turn = motion.turn;
  // With no more than one mark from the start, what remains is said once, beside all figures.
  if (expected) at.shared_sigma_px = motion.unseen_px;
  at.x_px -= motion.shift_px(0);
  at.y_px -= motion.shift_px(1);
  at.sigma_x_px = std::hypot(at.sigma_x_px, std::sqrt(motion.covariance_px2(0, 0)), at.shared_sigma_px);
  at.sigma_y_px = std::hypot(at.sigma_y_px, std::sqrt(motion.covariance_px2(1, 1)), at.shared_sigma_px);
  at.covariance_xy_px2 += motion.covariance_px2(0, 1);
  return at;
}

MeanLocation mean_of(const std::vector<Location>& locations) {
  MeanLocation out;
  std::map<std::string, int> reasons;
  double sx = 0.0, sy = 0.0, vx = 0.0, vy = 0.0, vxy = 0.0, shared = 0.0;
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
    vx += one.sigma_x_px * one.sigma_x_px - one.shared_sigma_px * one.shared_sigma_px;
    vy += one.sigma_y_px * one.sigma_y_px - one.shared_sigma_px * one.shared_sigma_px;
    shared += one.shared_sigma_px;
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
    return std::hypot(std::max(std::sqrt(stated_variance / n / n), from_scatter), shared / n);
  };
  Location& mean = out.location;
  mean.point.x_px += sx / n - mean.x_px;
  mean.point.y_px += sy / n - mean.y_px;
  mean.x_px = sx / n;
  mean.y_px = sy / n;
  mean.shared_sigma_px = shared / n;
  mean.sigma_x_px = sigma_of_mean(vx, out.scatter_x_px);
  mean.sigma_y_px = sigma_of_mean(vy, out.scatter_y_px);
  mean.covariance_xy_px2 = vxy / n / n;
  return out;
}

}  // namespace zerodrift::vision
