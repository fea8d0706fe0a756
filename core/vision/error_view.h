#pragma once
// One camera's view of the nose: target, references and calibration, and from a frame the error along two machine axes.
// Reference marks stand still on the table: what they do is the camera's own motion and is taken off. One mark gives
// translation; two or more spaced marks give scale and roll as well. A mark that is not seen is done without as long as
// another one is.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/vision/calibration.h"
#include "core/vision/target.h"

namespace zerodrift::vision {

/// Marks closer together than this cannot tell roll and scale better than none.
inline constexpr double least_mark_spacing_px = 120.0;

/// What of the camera's own motion fixed marks take off.
enum class TakenOff {
  nothing,
  shift,
  shift_turn_scale,
};
TakenOff taken_off_by(const std::vector<PixelPoint>& marks);
TakenOff taken_off_by(const std::vector<Region>& marks);  // by their centres

/// How far the camera has turned and its scale has changed since the template.
struct CameraTurn {
  double scale = 0.0;     // relative change
  double roll_rad = 0.0;  // of the picture's content, from x towards y
};

/// The target's displacement with the camera's own motion taken off; refused when the target is, or all references.
/// When too few of several marks are seen for turn and scale, those are taken as last seen (`turn`, if given) and may
/// have changed since: that is in the uncertainty. Marks that are seen renew `turn`.
Location locate_against(const Target& target, const std::vector<Target>& references, const GrayImage& frame,
                        std::vector<Location>* reference_locations = nullptr, CameraTurn* turn = nullptr);

/// Which of the marks are refused and why, "reference 2: target missing"; the number only where there are several. ""
/// when all are seen.
std::string marks_not_seen(const std::vector<Location>& references);

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
