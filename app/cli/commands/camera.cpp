// camera list: the cameras this computer reaches. camera show: one picture of a camera, with how it is set and how well
// its pictures come through.

#include "core/vision/camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/cli/command.h"
#include "core/base/redact.h"
#include "core/vision/camera_list.h"
#include "core/vision/image_codec.h"

namespace zerodrift::cli {
namespace camera_command {

using nlohmann::json;

constexpr std::chrono::milliseconds picture_timeout{10000};
constexpr int pictures_watched = 5;  // losses show in several pictures only

struct Options {
  std::string url;
  std::string out;
  double exposure_us = 0.0;
  double gain_db = 0.0;
  CLI::Option* exposure = nullptr;
  CLI::Option* gain = nullptr;
};

json json_of(const vision::CameraIdentity& identity) {
  json out = {{"kind", identity.kind},
              {"vendor", identity.vendor},
              {"model", identity.model},
              {"serial", identity.serial},
              {"address", identity.address}};
  if (identity.exposure_us) out["exposure_us"] = *identity.exposure_us;
  if (identity.gain_db) out["gain_db"] = *identity.gain_db;
  return out;
}

Result<CommandOutput> list() {
  CommandOutput output;
  output.json["cameras"] = json::array();
  for (const auto& camera : vision::find_cameras()) {
    json row = json_of(camera.identity);
    row["url"] = camera.url;
    output.json["cameras"].push_back(row);
    output.text += fmt::format("{}  {}  {} {}  serial {}  {}\n", camera.url, camera.identity.kind,
                               camera.identity.vendor, camera.identity.model,
                               camera.identity.serial.empty() ? "-" : camera.identity.serial, camera.identity.address);
  }
  if (output.text.empty()) output.text = "no cameras found\n";
  output.text.pop_back();
  return output;
}

/// What tells whether the exposure is right: a picture with saturated pixels is measured without them.
struct Brightness {
  double mean = 0.0;
  int low = 0;   // grey value that 1 % of the pixels are below
  int high = 0;  // and 99 %
  double saturated_percent = 0.0;
};

Brightness brightness_of(const vision::GrayImage& image) {
  std::array<std::size_t, 256> histogram{};
  for (const std::uint8_t value : image.pixels) ++histogram[value];
  const double all = static_cast<double>(image.pixels.size());
  Brightness out;
  double below = 0.0;
  for (int value = 0; value < 256; ++value) {
    const double share = static_cast<double>(histogram[static_cast<std::size_t>(value)]) / all;
    if (below < 0.01) out.low = value;
    if (below < 0.99) out.high = value;
    below += share;
    out.mean += share * value;
  }
  out.saturated_percent = 100.0 * static_cast<double>(histogram[255]) / all;
  return out;
}

Result<CommandOutput> show(const Options& options, const TaskContext& context) {
  vision::CameraOptions how;
  if (*options.exposure) how.exposure_us = options.exposure_us;
  if (*options.gain) how.gain_db = options.gain_db;
  const vision::Camera camera(options.url, how);
  std::shared_ptr<const vision::CameraFrame> frame;
  for (int i = 0; i < pictures_watched; ++i) {
    ZD_TRY(frame, camera.fresh_frame(vision::Camera::Time::clock::now(), picture_timeout, context.stop));
  }
  ZD_CHECK(vision::write_png(options.out, frame->image));
  const auto health = camera.health();
  const auto identity = camera.identity().value_or(vision::CameraIdentity{});
  const Brightness light = brightness_of(frame->image);
  CommandOutput output;
  output.json = json_of(identity);
  output.json["url"] = without_secrets(options.url);
  output.json["out"] = options.out;
  output.json["width_px"] = frame->image.width;
  output.json["height_px"] = frame->image.height;
  output.json["frames_per_s"] = camera.frames_per_s();
  output.json["brightness"] = {{"mean", light.mean},
                               {"percentile_1", light.low},
                               {"percentile_99", light.high},
                               {"saturated_percent", light.saturated_percent}};
  output.json["health"] = {{"pictures", health.pictures},
                           {"incomplete", health.incomplete},
                           {"lost", health.lost},
                           {"lost_packets", health.lost_packets},
                           {"resent_packets", health.resent_packets},
                           {"reconnections", health.reconnections}};
  output.text = fmt::format("{}: {} x {} px, {:.1f} pictures a second", options.out, frame->image.width,
                            frame->image.height, camera.frames_per_s());
  if (!identity.kind.empty()) {
    output.text += fmt::format("\n{} {}, serial number {}", identity.vendor, identity.model,
                               identity.serial.empty() ? "-" : identity.serial);
    if (identity.exposure_us) output.text += fmt::format(", exposure {:g} us", *identity.exposure_us);
    if (identity.gain_db) output.text += fmt::format(", gain {:g} dB", *identity.gain_db);
  }
  output.text += fmt::format("\ngrey values {} to {} (1 % to 99 %), mean {:.0f}, {:.2f} % saturated", light.low,
                             light.high, light.mean, light.saturated_percent);
  output.text += fmt::format("\n{} pictures, {} incomplete, {} lost, {} packets lost, {} sent again", health.pictures,
                             health.incomplete, health.lost, health.lost_packets, health.resent_packets);
  if (health.incomplete + health.lost > 0) {
    output.warnings.push_back("pictures of the camera are lost on the way: check its cable, its network and the load");
  }
  return output;
}

}  // namespace camera_command

void add_camera(Cli& cli) {
  using namespace camera_command;
  auto options = std::make_shared<Options>();
  auto shown = std::make_shared<CLI::App*>(nullptr);
  CLI::App* camera = cli.add(
      "camera", "Find cameras and look through one",
      [options, shown](const TaskContext& context) { return (*shown)->parsed() ? show(*options, context) : list(); });
  const auto with_json = [&](CLI::App* command) {
    command->add_flag("--json", cli.json_output, "Print the result as JSON on stdout");
    return command;
  };
  with_json(camera->add_subcommand("list", "List cameras: GigE Vision, USB3 Vision, and devices of this computer"));
  *shown = with_json(camera->add_subcommand("show", "Take one picture, and tell how it is exposed and comes through"));
  (*shown)->add_option("--url", options->url, "aravis:SERIAL, aravis:*, a device, http(s):// or rtsp://")->required();
  (*shown)->add_option("--out", options->out, "Picture to write (PNG)")->required();
  options->exposure = (*shown)
                          ->add_option("--exposure-us", options->exposure_us, "Exposure while it is read")
                          ->check(CLI::Range(1.0, 1e7));
  options->gain =
      (*shown)->add_option("--gain-db", options->gain_db, "Gain while it is read")->check(CLI::Range(-100.0, 100.0));
  camera->require_subcommand(1);
}

}  // namespace zerodrift::cli
