#include "core/report/camera_marks.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/report/source.h"

namespace zerodrift::report {
namespace {

using nlohmann::json;

struct Place {
  double x_px = std::nan("");
  double y_px = std::nan("");
};

Place centre_of(const json& region) {
  const auto number = [](const json& value) { return value.is_number(); };
  if (!region.is_array() || region.size() != 4 || !std::all_of(region.begin(), region.end(), number)) return {};
  return {region[0].get<double>() + region[2].get<double>() / 2.0,
          region[1].get<double>() + region[3].get<double>() / 2.0};
}

/// From the middle of its marks to the target; NaN where the calibration does not say.
double distance_mm(const json& camera) {
  const json marks = list_of(camera, "reference_roi");
  const json list = !marks.empty() && marks.front().is_array() ? marks : json::array({marks});
  Place middle{0.0, 0.0};
  for (const json& mark : list) {
    const Place at = centre_of(mark);
    middle.x_px += at.x_px / static_cast<double>(list.size());
    middle.y_px += at.y_px / static_cast<double>(list.size());
  }
  const Place target = centre_of(list_of(camera, "roi"));
  return std::hypot(middle.x_px - target.x_px, middle.y_px - target.y_px) * number_of(camera, "um_per_px") / 1000.0;
}

}  // namespace

CameraMarks camera_marks(const json& calibration) {
  CameraMarks all;
  const auto target = calibration.find("reference_target");
  if (target == calibration.end() || !target->is_boolean() || !target->get<bool>()) return all;
  all.taken_off = CameraMarks::TakenOff::shift_turn_scale;
  for (const auto& camera : list_of(calibration, "cameras")) {
    if (text_of(camera, "takes_off") == "turn") continue;
    all.taken_off = CameraMarks::TakenOff::shift;
    const double distance = distance_mm(camera);
    if (!(distance <= all.distance_mm)) all.distance_mm = distance;
  }
  return all;
}

}  // namespace zerodrift::report
