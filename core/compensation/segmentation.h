#pragma once
// Automatic variable-step linear regression of an axis's errors (C4).
//
// The published rule: take n points, least squares y = a x + b, Pearson r; while |r| is below the threshold drop the
// last point and fit again; go on with the rest, which begins at the first dropped point. Decided here where the rule
// is silent:
// - between the last point of a segment and the first of the next the map runs straight (a joint, 0 points), so that
// the
//   fitted lines keep their published coefficients and the map is continuous;
// - two points always pass (|r| = 1); errors within the resolution count as flat and pass, since r is 0/0 there;
// - a falling error counts by |r|; a single last point is reached by a joint.
// The criterion can be r on errors (x, y - x), r on coordinates (x, y) - which never triggers with laser data, because
// 1 - r is about 1e-9 - or a tolerance: the fewest segments of any continuous polygon that stays within it at each
// point.
//
// The fewest: greedy over minimum-link paths through the windows [e - tol, e + tol] (Imai and Iri 1986; Hakimi and
// Schmeichel 1991). Each link goes as far as any link can; the next one starts on the extreme line of the last. Among
// the polygons with that number of segments the one with (nearly) the smallest largest residual is taken.

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/compensation/table.h"

namespace zerodrift::compensation {

enum class Criterion {
  errors,
  coordinates,
  tolerance,
};
std::string_view name_of(Criterion criterion);

struct SegmentationOptions {
  Criterion criterion = Criterion::errors;
  double threshold = 0.98;
  int start_points = 10;
  double tolerance_um = 1.0;
  double resolution_um = 0.05;  // errors that differ by no more are flat
};

struct Segmentation {
  std::vector<Segment> segments;  // continuous from the first position to the last
  int fitted = 0;                 // segments without the joints
  double largest_residual_um = 0.0;
  double largest_at_mm = 0.0;
  std::vector<std::string> notes;  // what was used and why, for the user
};

/// Positions strictly increasing, in mm; at least 2.
Result<Segmentation> segment_errors(const std::vector<double>& position_mm, const std::vector<double>& error_um,
                                    const SegmentationOptions& options);

}  // namespace zerodrift::compensation
