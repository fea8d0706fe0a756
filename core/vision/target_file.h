#pragma once
// The target in calibration.json: template file name, region, named point, and what was learned from the views - mask,
// lens, backdrop, their mean - so that `locate` measures with the same pixels the calibration was made with.

#include <array>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/vision/target.h"

namespace zerodrift::vision {

nlohmann::json target_to_json(const Target& target, const std::string& template_name);

struct StoredTarget {
  Region region;
  PixelPoint point;
  std::vector<std::uint8_t> mask;  // region's width * height
  LensTerm lens;
  std::shared_ptr<const Backdrop> backdrop;   // null: none was learned
  std::optional<FloatImage> gathered;         // mean of the views, where the template is too noisy
  std::optional<std::array<int, 2>> size_px;  // of the template's picture; files of before have neither this nor
  std::optional<GrayImage> picture;           // what it shows in the region
};
/// What calibration.json says of the target; nothing when it says nothing. Errors name `file` and the key.
Result<std::optional<StoredTarget>> target_from_json(const nlohmann::json& calibration_document,
                                                     const std::string& file);

/// Whether the calibration was made with this target: pictures of one size, and in the same region what it shows is
/// looked for with the template at hand, which may be another picture of the same. With another region, whether the
/// template shows there what the calibration's did. Errors: calibration_of_another_target.
Status made_with(const StoredTarget& stored, const Target& target, const std::string& file,
                 const std::string& template_name);

}  // namespace zerodrift::vision
