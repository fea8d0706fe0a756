#include "core/vision/standing_pictures.h"

#include <fmt/format.h>

#include <algorithm>

namespace zerodrift::vision {
namespace {

constexpr double rest_patience_s = 5.0;  // for pictures that come to rest late

/// Whether the pictures from the first of them on show one place, and that the stand's.
bool show_the_stand(const PictureSource& camera, const acquisition::Stand& stand, const StandingLook& look,
                    const Pictures& pictures, Seconds surely_here) {
  const Region cells = sketch_region(look.region, pictures.back()->image);
  const Sketches sketches = camera.sketches(stand.left);
  const double noise = noise_of(sketches, pictures.size(), cells);
  const auto change = last_change(sketches, cells, noise);
  if (change) return change->first_same <= pictures.front()->stamp;
  const double way_mm = *std::max_element(stand.came_mm.begin(), stand.came_mm.end());
  return way_mm < look.least_way_mm || pictures.front()->stamp > surely_here;
}

}  // namespace

Result<Pictures> standing_pictures(const PictureSource& camera, const acquisition::Stand& stand,
                                   const StandingLook& look, const TaskContext& context) {
  const Seconds settle = camera.is_file() ? Seconds(0.0) : look.latency.settle();
  const Seconds surely_here = stand.since + std::max(settle, Seconds(acquisition::assumed_latency_s));
  Pictures pictures;
  Seconds after = stand.since + settle;
  while (after < surely_here + Seconds(rest_patience_s)) {
    ZD_TRY(auto frame, camera.next_picture(after, look.picture_timeout, context.stop));
    after = frame->stamp;
    pictures.push_back(std::move(frame));
    const auto wanted = static_cast<std::size_t>(std::max(1, look.pictures));
    if (pictures.size() > wanted) pictures.erase(pictures.begin());
    if (pictures.size() < wanted) continue;
    if (!camera.is_file() && !show_the_stand(camera, stand, look, pictures, surely_here)) continue;
    ZD_CHECK(stand.still());
    return pictures;
  }
  return fail(ErrorCode::target_refused, {{"reason", "the target still moves in the picture"}});
}

Result<GrayImage> mean_of(const Pictures& pictures, const std::string& source) {
  GrayImage out = pictures.front()->image;
  std::vector<int> sum(out.pixels.size(), 0);
  for (const auto& picture : pictures) {
    const GrayImage& image = picture->image;
    if (image.width != out.width || image.height != out.height) {
      return fail(ErrorCode::image_size, {{"file", source},
                                          {"found", fmt::format("{}x{}", image.width, image.height)},
                                          {"expected", fmt::format("{}x{}", out.width, out.height)}});
    }
    for (std::size_t at = 0; at < sum.size(); ++at) sum[at] += image.pixels[at];
  }
  const int count = static_cast<int>(pictures.size());
  for (std::size_t at = 0; at < sum.size(); ++at) {
    out.pixels[at] = static_cast<std::uint8_t>((sum[at] + count / 2) / count);
  }
  return out;
}

}  // namespace zerodrift::vision
