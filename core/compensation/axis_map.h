#pragma once
// Forward and inverse transformation of an axis (C4). Forward: encoder feedback (commanded) -> true coordinate,
// y = a x + b of the segment that holds x. Inverse: true position -> what the display shows in encoder terms,
// x = (y - b) / a of the segment whose image holds y: chosen by the images of the joints, so that the way there and
// back ends where it began. Beyond the ends the error of the end is held. Continuous and increasing everywhere.

#include <vector>

#include "core/base/result.h"
#include "core/compensation/table.h"

namespace zerodrift::compensation {

class AxisMap {
 public:
  /// From the segments; without any from the points (mean of both directions). data_does_not_fit when not increasing.
  static Result<AxisMap> from(const AxisTable& axis);

  double forward(double encoder_mm) const;
  double inverse(double true_mm) const;
  const std::vector<double>& knots_mm() const { return m_x; }

 private:
  std::vector<double> m_x;  // strictly increasing
  std::vector<double> m_y;  // their images, strictly increasing
};

}  // namespace zerodrift::compensation
