// calibrate: um_from_px of a camera from pictures of the target at known machine positions.

#include <fmt/format.h>

#include <cmath>

#include "app/cli/command.h"
#include "app/cli/commands/vision_options.h"
#include "core/base/json.h"
#include "core/vision/calibration.h"
#include "core/vision/measure_files.h"
#include "core/vision/target_file.h"

namespace zerodrift::cli {
namespace calibrate_command {

struct Options {
  std::string image;
  std::string region;
  std::string point;
  std::string views;
  std::string out;
};

std::string text_of(const vision::Calibration& c) {
  const Eigen::Matrix2d sigma = c.sigma();
  std::string text = fmt::format("um_from_px  {:+.5f} +- {:.5f}  {:+.5f} +- {:.5f}\n", c.um_from_px(0, 0), sigma(0, 0),
                                 c.um_from_px(0, 1), sigma(0, 1));
  text += fmt::format("            {:+.5f} +- {:.5f}  {:+.5f} +- {:.5f}\n", c.um_from_px(1, 0), sigma(1, 0),
                      c.um_from_px(1, 1), sigma(1, 1));
  text += fmt::format("{:.3f} um/px, {}turned by {:.2f} degrees, {} views, residual {:.2f} um rms", c.scale_um_per_px,
                      c.mirrored ? "mirrored and " : "", c.rotation_deg, c.views.size(), c.rms_um);
  if (std::isfinite(c.leave_one_out_um))
    text += fmt::format(", {:.2f} um where a view is told by the others", c.leave_one_out_um);
  return text;
}

Status run(const Options& options, const TaskContext& context, CommandOutput& output) {
  vision::TemplateChoice choice{options.image, {}, {}};
  ZD_TRY(choice.region, region_from(options.region, "--roi"));
  ZD_TRY(choice.point, point_from(options.point, "--point"));
  ZD_TRY(const vision::Target target, vision::load_target(choice, &output.warnings));
  ZD_TRY(const std::vector<vision::ViewRow> views, vision::read_views(options.views, &output.warnings));
  ZD_TRY(vision::FileCalibration result, vision::calibrate_from_files(target, views, &output.warnings, context));
  if (result.calibration.mirrored && !result.calibration.handedness_assumed) {
    result.calibration.warnings.push_back(fmt::format(
        "the camera's picture is mirrored, or x and y are exchanged in {}, or one of them has the other sign: check "
        "that "
        "x_mm is the axis seen to the right and y_mm the one seen upwards (seen in a mirror, it is as it should be)",
        options.views));
  }
  output.json = vision::to_json(result.calibration);
  output.json["target"] = vision::target_to_json(result.target, options.image);
  ZD_CHECK(write_json_file(options.out, output.json));
  for (const std::string& warning : result.calibration.warnings) output.warnings.push_back(warning);
  output.text = text_of(result.calibration);
  return {};
}

}  // namespace calibrate_command

void add_calibrate(Cli& cli) {
  using namespace calibrate_command;
  auto options = std::make_shared<Options>();
  CLI::App* command =
      cli.add("calibrate", "Calibrate a camera from views of the target at known machine positions",
              [options](const TaskContext& context, CommandOutput& output) { return run(*options, context, output); });
  command->add_option("--template", options->image, "Picture of the target at rest")->required();
  command->add_option("--roi", options->region, "Region of the target, X,Y,W,H in px; found by itself if absent")
      ->check(check_region);
  command->add_option("--point", options->point, "Point whose displacement is measured, X,Y in px; default: the centre")
      ->check(check_point);
  command->add_option("--views", options->views, "CSV image,x_mm,y_mm: pictures at known positions")->required();
  command->add_option("--out", options->out, "Calibration file to write")->required();
  command->footer(
      "Move over all of the drift that is expected: a lens is found from moves that show it, and beyond them locate "
      "warns.");
}

}  // namespace zerodrift::cli
