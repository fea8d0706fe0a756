#pragma once
// Hat functions over a row of cells: 1 at a cell's middle, 0 at its neighbours' middles. What is shared out by them
// keeps its sum and its centre of gravity, wherever its edges lie between the cells' faces.

#include <algorithm>
#include <cmath>

namespace zerodrift::physics {

/// How much of what lies at u, in cells from a middle, counts for that middle.
inline double hat(double u) {
  return std::max(0.0, 1.0 - std::abs(u));
}

/// Integral of the hat from far left to u.
inline double hat_until(double u) {
  if (u <= -1.0) return 0.0;
  if (u >= 1.0) return 1.0;
  return u < 0.0 ? 0.5 * (1.0 + u) * (1.0 + u) : 1.0 - 0.5 * (1.0 - u) * (1.0 - u);
}

/// The same along a rod of `count` cells, in cells: the half cells at its ends count for the end cells alone. `x`, from
/// the rod's end, is held to the rod.
inline double hat_of_cell(int cell, int count, double x) {
  x = std::clamp(x, 0.0, static_cast<double>(count));
  const double u = x - cell - 0.5;
  if (count == 1) return x;
  if (cell == 0 && u < 0.0) return x;
  if (cell == 0) return hat_until(u);
  if (cell == count - 1 && u > 0.0) return 0.5 + u;
  return hat_until(u);
}

/// Its slope: what counts for the cell of what lies at x.
inline double hat_at(int cell, int count, double x) {
  if (x <= 0.0 || x > count) return 0.0;
  const double u = x - cell - 0.5;
  if (count == 1 || (cell == 0 && u < 0.0) || (cell == count - 1 && u > 0.0)) return std::abs(u) <= 0.5 ? 1.0 : 0.0;
  return hat(u);
}

}  // namespace zerodrift::physics
