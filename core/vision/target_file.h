#pragma once
// The target in calibration.json: template file name, region, named point, and what was learned from the views - mask,
// lens, backdrop - so that `locate` measures with the same pixels the calibration was made with.

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
  std::shared_ptr<const Backdrop> backdrop;  // null: none was learned
};
/// What calibration.json says of the target; nothing when it says nothing or something else than we write.
std::optional<StoredTarget> target_from_json(const nlohmann::json& calibration_document);

}  // namespace zerodrift::vision
