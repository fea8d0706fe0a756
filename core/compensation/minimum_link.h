#pragma once
// The fewest straight links of a continuous polygon that passes within a tolerance of every point, knots anywhere.
// A line is a point (slope, value) of a dual plane; each window [e - tol, e + tol] at x cuts a strip there, so the
// lines through a row of windows are a convex polygon. When it becomes empty, its vertex nearest to the missed window
// is the extreme line; every path with one link more crosses that line after its last contact, and the conditions on
// the next link are again half-planes. So going as far as possible with each link is optimal, in time linear in the
// points.

#include <vector>

namespace zerodrift::compensation {

struct LinkLine {
  double slope = 0.0;      // um per mm
  double intercept = 0.0;  // um at x = 0
};

struct LinkPath {
  std::vector<LinkLine> lines;    // one or more
  std::vector<double> joints_mm;  // first position, crossings, last position: lines + 1
};

/// x strictly increasing, at least two points.
LinkPath minimum_link_path(const std::vector<double>& x_mm, const std::vector<double>& e_um, double tolerance_um);
/// The same number of links with nearly the smallest possible largest residual (found by halving the tolerance).
LinkPath tightest_minimum_link_path(const std::vector<double>& x_mm, const std::vector<double>& e_um,
                                    double tolerance_um);

}  // namespace zerodrift::compensation
