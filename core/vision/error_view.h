#pragma once
// One camera's view of the nose: target, references and calibration, and from a frame the error along two machine axes.
// Reference marks stand still on the table: what they do is the camera's own motion and is taken off. One mark gives
// translation; two or more spaced marks give scale and roll as well.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/vision/calibration.h"
#include "core/vision/target.h"

namespace zerodrift::vision {

/// The target's displacement with the camera's own motion taken off; refused when target or references are.
Location locate_against(const Target& target, const std::vector<Target>& references, const GrayImage& frame,
                        std::vector<Location>* reference_locations = nullptr);

/// Mean of several locations of the same standing target. At least half of them must be good.
struct MeanLocation {
  Location location;  // sigma is that of the mean; refused with the most frequent reason otherwise
  int good = 0;
  int refused = 0;
  double scatter_x_px = 0.0;  // standard deviation of single frames; NaN below two
  double scatter_y_px = 0.0;
};
MeanLocation mean_of(const std::vector<Location>& locations);

}  // namespace zerodrift::vision
