#include "core/vision/target_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "core/base/base64.h"
#include "core/base/json.h"
#include "core/vision/image_codec.h"
#include "core/vision/opencv_image.h"

namespace zerodrift::vision {
namespace {

constexpr int largest_side_px = 100'000;
constexpr double largest_area_px = 1e8;
constexpr double largest_lens = 1e-5;
constexpr double hardly_moved_px = 2.0;  // another picture of the target at rest, not of a drift

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

std::vector<std::uint8_t> mask_from(JsonObject& object, const Region& region) {
  const char* const key = "mask_runs";
  const std::size_t size = static_cast<std::size_t>(region.width) * static_cast<std::size_t>(region.height);
  std::vector<std::uint8_t> mask;
  std::uint8_t now = 0;
  double total = 0.0;
  for (const double length : object.numbers(key)) {
    total += length;
    const bool whole = length >= 0.0 && length == std::floor(length);
    if (!whole || total > static_cast<double>(size)) break;
    mask.insert(mask.end(), static_cast<std::size_t>(length), now);
    now = now == 0 ? 1 : 0;
  }
  if (mask.size() != size || total != static_cast<double>(size)) {
    object.reject(key, fmt::format("a mask of {:g} pixels", total),
                  fmt::format("run lengths of {}x{} pixels, the region of the target", region.width, region.height));
  }
  if (std::find(mask.begin(), mask.end(), std::uint8_t{1}) == mask.end()) {
    object.reject(key, "a mask that leaves nothing", "a mask with pixels of the target");
  }
  return mask;
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

GrayImage picture_in(JsonObject& object, const char* key) {
  const char* const expected = "a PNG picture in base64";
  const auto bytes = from_base64(object.text(key));
  if (!bytes) object.reject(key, "no base64", expected);
  auto decoded = decode(*bytes, key);
  if (!decoded) object.reject(key, "no picture", expected);
  return std::move(decoded->image);
}

FloatImage levels_in(JsonObject& object, const char* key, float factor) {
  const GrayImage gray = picture_in(object, key);
  FloatImage out(gray.width, gray.height);
  for (std::size_t k = 0; k < out.values.size(); ++k) out.values[k] = static_cast<float>(gray.pixels[k]) / factor;
  return out;
}

constexpr float clear_levels = 255.0f;  // of the stored picture, for what is all clear

nlohmann::json backdrop_to_json(const Backdrop& backdrop) {
  return {{"x_px", backdrop.area.x},
          {"y_px", backdrop.area.y},
          {"levels_png", picture_of(backdrop.levels, 1.0f)},
          {"clear_png", picture_of(backdrop.clear, clear_levels)}};
}

std::string size_of(int width, int height) {
  return fmt::format("{}x{} pixels", width, height);
}

void check_covers_region(JsonObject& object, const char* key, const FloatImage& image, const Region& region) {
  const int width = region.width + 2 * template_margin_px;
  const int height = region.height + 2 * template_margin_px;
  if (image.width != width || image.height != height) {
    object.reject(key, size_of(image.width, image.height), size_of(width, height));
  }
}

std::shared_ptr<const Backdrop> backdrop_from(JsonObject& object, const Region& region) {
  auto out = std::make_shared<Backdrop>();
  const int x = object.integer("x_px", -largest_side_px, largest_side_px);
  const int y = object.integer("y_px", -largest_side_px, largest_side_px);
  out->levels = levels_in(object, "levels_png", 1.0f);
  out->clear = levels_in(object, "clear_png", clear_levels);
  out->area = {x, y, out->levels.width, out->levels.height};
  if (std::min(out->levels.width, out->levels.height) < 2) {
    object.reject("levels_png", size_of(out->levels.width, out->levels.height), "at least 2x2");
  }
  check_covers_region(object, "clear_png", out->clear, region);
  return out;
}

LensTerm lens_from(JsonObject& object) {
  LensTerm out;
  if (!object.has("lens_per_px2") && !object.has("lens_sigma_per_px2")) return out;  // files of before
  out.per_px2 = object.number("lens_per_px2", {-largest_lens, largest_lens, false, "a number from -1e-05 to 1e-05"});
  out.sigma_per_px2 = object.number("lens_sigma_per_px2", {0.0, largest_lens, true, "a number above 0, up to 1e-05"});
  return out;
}

StoredTarget stored_target(JsonObject& object) {
  StoredTarget out;
  object.text_or("template", "");
  const std::vector<double> roi = object.numbers("roi_px", 4);
  for (std::size_t k = 0; k < 4; ++k) {
    if (roi[k] == std::floor(roi[k]) && roi[k] >= (k < 2 ? 0.0 : 1.0) && roi[k] <= largest_side_px) continue;
    object.reject("roi_px", fmt::format("{:g},{:g},{:g},{:g}", roi[0], roi[1], roi[2], roi[3]),
                  "X,Y,W,H in whole pixels, inside the picture");
  }
  out.region = {static_cast<int>(roi[0]), static_cast<int>(roi[1]), static_cast<int>(roi[2]), static_cast<int>(roi[3])};
  if (roi[2] * roi[3] > largest_area_px) {
    object.reject("roi_px", fmt::format("{:g}x{:g} pixels", roi[2], roi[3]), "a region of 100 megapixels at most");
  }
  const std::vector<double> point = object.numbers("point_px", 2);
  if (std::max(std::abs(point[0]), std::abs(point[1])) > largest_side_px) {
    object.reject("point_px", fmt::format("{:g},{:g}", point[0], point[1]), "X,Y in pixels");
  }
  out.point = {point[0], point[1]};
  out.mask = mask_from(object, out.region);
  out.lens = lens_from(object);
  if (JsonObject* backdrop = object.object_if("backdrop")) out.backdrop = backdrop_from(*backdrop, out.region);
  if (object.has("mean_png")) {
    out.gathered = levels_in(object, "mean_png", 1.0f);
    check_covers_region(object, "mean_png", *out.gathered, out.region);
  }
  if (object.has("size_px")) {
    const std::vector<double> size = object.numbers("size_px", 2);
    for (const double side : size) {
      if (side != std::floor(side) || side < 1.0 || side > largest_side_px) {
        object.reject("size_px", fmt::format("{:g},{:g}", size[0], size[1]), "width and height in pixels");
      }
    }
    out.size_px = {static_cast<int>(size[0]), static_cast<int>(size[1])};
    if (out.region.x + out.region.width > size[0] || out.region.y + out.region.height > size[1]) {
      object.reject("roi_px", fmt::format("{:g},{:g},{:g},{:g}", roi[0], roi[1], roi[2], roi[3]),
                    fmt::format("a region inside {:g}x{:g} pixels", size[0], size[1]));
    }
  }
  if (object.has("picture_png")) {
    out.picture = picture_in(object, "picture_png");
    if (out.picture->width != out.region.width || out.picture->height != out.region.height) {
      object.reject("picture_png", size_of(out.picture->width, out.picture->height),
                    size_of(out.region.width, out.region.height));
    }
  }
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
                     {"mask_runs", runs_of(target.mask())},
                     {"size_px", {target.image().width, target.image().height}},
                     {"picture_png", picture_of(crop(target.image(), r), 1.0f)}};
  if (target.backdrop()) out["backdrop"] = backdrop_to_json(*target.backdrop());
  if (target.gathered() != nullptr) out["mean_png"] = picture_of(*target.gathered(), 1.0f);
  return out;
}

Result<std::optional<StoredTarget>> target_from_json(const nlohmann::json& calibration_document,
                                                     const std::string& file) {
  using Found = std::optional<StoredTarget>;
  return from_json<Found>(calibration_document, file, nullptr, [](JsonObject& object) -> Found {
    if (JsonObject* target = object.object_if("target")) return stored_target(*target);
    return std::nullopt;
  });
}

namespace {

/// Correlation of a picture with a region of its size.
double likeness(const GrayImage& picture, const GrayImage& image, const Region& region) {
  cv::Mat score;
  cv::matchTemplate(mat_view(image)(cv::Rect(region.x, region.y, region.width, region.height)), mat_view(picture),
                    score, cv::TM_CCOEFF_NORMED);
  return score.at<float>(0, 0);
}

}  // namespace

Status made_with(const StoredTarget& stored, const Target& target, const std::string& file,
                 const std::string& template_name) {
  const GrayImage& image = target.image();
  const auto other = [&](std::string detail) {
    return fail(ErrorCode::calibration_of_another_target,
                {{"file", file}, {"template", template_name}, {"detail", std::move(detail)}});
  };
  if (stored.size_px && *stored.size_px != std::array<int, 2>{image.width, image.height}) {
    return other(fmt::format("{}: {}x{} pixels, the template has {}x{}", file, (*stored.size_px)[0],
                             (*stored.size_px)[1], image.width, image.height));
  }
  if (!stored.picture) return {};
  if (target.region() != stored.region) {
    // Another region of the same picture: the camera is the same, if it shows there what it showed then.
    constexpr double alike = 0.5;
    if (inside(stored.region, image) && likeness(*stored.picture, image, stored.region) > alike) return {};
    return other("the template shows something else in the region it was made with");
  }
  GrayImage as_it_was = image;
  for (int row = 0; row < stored.region.height; ++row) {
    const auto from = stored.picture->pixels.begin() + std::ptrdiff_t{row} * stored.region.width;
    std::copy(from, from + stored.region.width,
              as_it_was.pixels.begin() + (std::ptrdiff_t{stored.region.y} + row) * image.width + stored.region.x);
  }
  const Location at = target.locate(as_it_was);
  if (!at.ok) return other(at.reason);
  if (const double moved_px = std::hypot(at.x_px, at.y_px); moved_px > hardly_moved_px) {
    return other(fmt::format("it stood {:.1f} px from where it is", moved_px));
  }
  return {};
}

}  // namespace zerodrift::vision
