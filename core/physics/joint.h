#pragma once
// An imperfect joint across a rod whose resistance is spread evenly over a breadth, on a grid of cells. Lengths in
// cells. G(x) is the share of the joint that lies before x. What a cell's temperature stands for is the mean over the
// cell, so that the share between two cells' middles is the difference of their means of G.

namespace zerodrift::physics {

struct JointShare {
  double value = 0.0;
  double by_place = 0.0;  // per cell that the joint moves on
  double by_half = 0.0;   // per cell of half the breadth
};

/// Of a joint `u` after the face between two cells: what lies between their middles.
JointShare share_of_face(double u, double half);
/// What of a joint at 0 lies before x.
JointShare share_before(double x, double half);
/// The mean of that over the cell with its middle at x.
JointShare mean_share_before(double x, double half);

}  // namespace zerodrift::physics
