#include "core/acquisition/standstill.h"

#include <algorithm>
#include <cmath>

namespace zerodrift::acquisition {
namespace {

constexpr double trend_coverage = 3.0;    // a trend by chance only costs another look
constexpr double picture_coverage = 4.0;  // standard uncertainties: one picture of 16 000 by chance

/// Straight line through one axis of the sightings, about the middle of their time.
struct Line {
  double span_s = 0.0;
  double slope_um_s = 0.0;
  double slope_sigma_um_s = 0.0;
  double furthest_um = 0.0;  // of a picture from the line
  double sigma_um = 0.0;     // largest stated of a picture
};

Line line_of(std::span<const Sighting> sightings, std::size_t axis) {
  Line line;
  const auto n = static_cast<double>(sightings.size());
  double middle_s = 0.0;
  double mean_um = 0.0;
  for (const Sighting& one : sightings) {
    middle_s += (one.stamp - sightings.front().stamp).count() / n;
    mean_um += one.um[axis] / n;
    line.sigma_um = std::max(line.sigma_um, one.sigma_um[axis]);
  }
  double squares_s2 = 0.0;
  double product = 0.0;
  for (const Sighting& one : sightings) {
    const double t = (one.stamp - sightings.front().stamp).count() - middle_s;
    squares_s2 += t * t;
    product += t * (one.um[axis] - mean_um);
  }
  line.span_s = (sightings.back().stamp - sightings.front().stamp).count();
  if (squares_s2 > 0.0) {
    line.slope_um_s = product / squares_s2;
    line.slope_sigma_um_s = line.sigma_um / std::sqrt(squares_s2);
  }
  for (const Sighting& one : sightings) {
    const double t = (one.stamp - sightings.front().stamp).count() - middle_s;
    line.furthest_um = std::max(line.furthest_um, std::abs(one.um[axis] - mean_um - line.slope_um_s * t));
  }
  return line;
}

}  // namespace

StandstillVerdict standstill(std::span<const Sighting> sightings, const StandstillRule& rule) {
  StandstillVerdict verdict;
  if (sightings.size() < 2) {
    verdict.stands = true;
    return verdict;
  }
  verdict.stands = true;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const Line line = line_of(sightings, axis);
    const double moved_um = std::abs(line.slope_um_s) * line.span_s;
    const double allowed_um = (rule.drift_um_per_s + trend_coverage * line.slope_sigma_um_s) * line.span_s;
    const bool agree = line.furthest_um <= std::max(rule.agree_um, picture_coverage * line.sigma_um);
    if (moved_um > std::max(allowed_um, 0.4 * rule.agree_um) || !agree) verdict.stands = false;
    // Heat moves the mean and its moment together; what is not heat may go on after the last picture.
    verdict.trend_um[axis] = std::max(0.0, moved_um - rule.drift_um_per_s * line.span_s) / 3.0;
  }
  if (!verdict.stands) verdict.reason = "the target still moves in the picture";
  return verdict;
}

}  // namespace zerodrift::acquisition
