#include "core/vision/target_file.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace zerodrift::vision {
namespace {

// Run lengths, beginning with pixels that are left out.
nlohmann::json runs_of(const std::vector<std::uint8_t>& mask) {
  nlohmann::json runs = nlohmann::json::array();
  std::uint8_t now = 0;
  int length = 0;
  for (const std::uint8_t value : mask) {
    if ((value != 0) != (now != 0)) {
      runs.push_back(length);
      now = value;
      length = 0;
    }
    ++length;
  }
  runs.push_back(length);
  return runs;
}

std::optional<std::vector<int>> integers_in(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_array()) return std::nullopt;
  std::vector<int> out;
  for (const nlohmann::json& one : *found) {
    if (!one.is_number_integer()) return std::nullopt;
    const auto value = one.get<std::int64_t>();
    if (value < 0 || value > 100'000'000) return std::nullopt;
    out.push_back(static_cast<int>(value));
  }
  return out;
}

std::vector<std::uint8_t> mask_from(const std::vector<int>& runs, std::size_t size) {
  std::vector<std::uint8_t> mask;
  std::uint8_t now = 0;
  for (const int length : runs) {
    if (mask.size() + static_cast<std::size_t>(length) > size) return {};
    mask.insert(mask.end(), static_cast<std::size_t>(length), now);
    now = now == 0 ? 1 : 0;
  }
  return mask.size() == size ? mask : std::vector<std::uint8_t>{};
}

}  // namespace

nlohmann::json target_to_json(const Target& target, const std::string& template_name) {
  const Region& r = target.region();
  return {{"template", template_name},
          {"roi_px", {r.x, r.y, r.width, r.height}},
          {"point_px", {target.point().x_px, target.point().y_px}},
          {"lens_per_px2", target.lens().per_px2},
          {"lens_sigma_per_px2", target.lens().sigma_per_px2},
          {"mask_runs", runs_of(target.mask())}};
}

std::optional<StoredTarget> target_from_json(const nlohmann::json& calibration_document) {
  if (!calibration_document.is_object()) return std::nullopt;
  const auto target = calibration_document.find("target");
  if (target == calibration_document.end() || !target->is_object()) return std::nullopt;
  const auto roi = integers_in(*target, "roi_px");
  const auto runs = integers_in(*target, "mask_runs");
  const auto point = target->find("point_px");
  if (!roi || roi->size() != 4 || !runs || (*roi)[2] > 20'000 || (*roi)[3] > 20'000) return std::nullopt;
  if (point == target->end() || !point->is_array() || point->size() != 2 || !(*point)[0].is_number() ||
      !(*point)[1].is_number()) {
    return std::nullopt;
  }
  StoredTarget out;
  out.region = {(*roi)[0], (*roi)[1], (*roi)[2], (*roi)[3]};
  out.point = {(*point)[0].get<double>(), (*point)[1].get<double>()};
  out.mask = mask_from(*runs, static_cast<std::size_t>(out.region.width) * out.region.height);
  if (out.mask.empty()) return std::nullopt;
  const auto lens = target->find("lens_per_px2");
  const auto sigma = target->find("lens_sigma_per_px2");
  if (lens != target->end() && lens->is_number() && sigma != target->end() && sigma->is_number() &&
      sigma->get<double>() > 0.0 && std::abs(lens->get<double>()) < 1e-5) {
    out.lens = {lens->get<double>(), sigma->get<double>()};
  }
  return out;
}

}  // namespace zerodrift::vision
