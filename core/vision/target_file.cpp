#include "core/vision/target_file.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/base64.h"
#include "core/vision/image_codec.h"

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

// As a picture of 8 bits: a quarter of a grey level is below the noise of what it was learned from.
nlohmann::json picture_of(const FloatImage& image, float factor) {
  GrayImage gray{image.width, image.height, std::vector<std::uint8_t>(image.values.size())};
  for (std::size_t k = 0; k < image.values.size(); ++k) {
    gray.pixels[k] = static_cast<std::uint8_t>(std::lround(std::clamp(image.values[k] * factor, 0.0f, 255.0f)));
  }
  const auto png = encode_png(gray);
  return png ? nlohmann::json(base64_of(*png)) : nlohmann::json();
}

std::optional<FloatImage> picture_in(const nlohmann::json& object, const char* key, float factor) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_string()) return std::nullopt;
  const auto bytes = from_base64(found->get<std::string>());
  if (!bytes) return std::nullopt;
  const auto decoded = decode(*bytes, key);
  if (!decoded) return std::nullopt;
  FloatImage out(decoded->image.width, decoded->image.height);
  for (std::size_t k = 0; k < out.values.size(); ++k) {
    out.values[k] = static_cast<float>(decoded->image.pixels[k]) / factor;
  }
  return out;
}

constexpr float clear_levels = 255.0f;  // of the stored picture, for what is all clear

nlohmann::json backdrop_to_json(const Backdrop& backdrop) {
  return {{"x_px", backdrop.area.x},
          {"y_px", backdrop.area.y},
          {"levels_png", picture_of(backdrop.levels, 1.0f)},
          {"clear_png", picture_of(backdrop.clear, clear_levels)}};
}

std::shared_ptr<const Backdrop> backdrop_from(const nlohmann::json& target) {
  const auto object = target.find("backdrop");
  if (object == target.end() || !object->is_object()) return nullptr;
  const auto x = object->find("x_px");
  const auto y = object->find("y_px");
  if (x == object->end() || y == object->end() || !x->is_number_integer() || !y->is_number_integer()) return nullptr;
  auto levels = picture_in(*object, "levels_png", 1.0f);
  auto clear = picture_in(*object, "clear_png", clear_levels);
  if (!levels || !clear || levels->width < 2 || levels->height < 2) return nullptr;
  auto out = std::make_shared<Backdrop>();
  out->area = {x->get<int>(), y->get<int>(), levels->width, levels->height};
  out->levels = std::move(*levels);
  out->clear = std::move(*clear);
  return out;
}

}  // namespace

nlohmann::json target_to_json(const Target& target, const std::string& template_name) {
  const Region& r = target.region();
  nlohmann::json out{{"template", template_name},
                     {"roi_px", {r.x, r.y, r.width, r.height}},
                     {"point_px", {target.point().x_px, target.point().y_px}},
                     {"lens_per_px2", target.lens().per_px2},
                     {"lens_sigma_per_px2", target.lens().sigma_per_px2},
                     {"mask_runs", runs_of(target.mask())}};
  if (target.backdrop()) out["backdrop"] = backdrop_to_json(*target.backdrop());
  return out;
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
  out.backdrop = backdrop_from(*target);
  const auto lens = target->find("lens_per_px2");
  const auto sigma = target->find("lens_sigma_per_px2");
  if (lens != target->end() && lens->is_number() && sigma != target->end() && sigma->is_number() &&
      sigma->get<double>() > 0.0 && std::abs(lens->get<double>()) < 1e-5) {
    out.lens = {lens->get<double>(), sigma->get<double>()};
  }
  return out;
}

}  // namespace zerodrift::vision
