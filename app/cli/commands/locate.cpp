// locate: where the target is in each frame of a folder, in px and, with a calibration, as an error in um.

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/cli/command.h"
#include "app/cli/commands/vision_options.h"
#include "core/base/file.h"
#include "core/base/json.h"
#include "core/vision/calibration.h"
#include "core/vision/error_view.h"
#include "core/vision/measure_files.h"
#include "core/vision/one_direction.h"
#include "core/vision/target_file.h"

namespace zerodrift::cli {
namespace locate_command {

struct Options {
  std::string image;
  std::string region;
  std::string point;
  std::vector<std::string> references;
  std::string frames;
  std::string calibration;
  std::string views;
  std::string out;
};

struct Prepared {
  vision::Target target;
  vision::LocateRequest request;
};

constexpr double most_on_target = 0.5;

/// Of the first region's area.
double share_within(const vision::Region& one, const vision::Region& other) {
  const int width = std::min(one.x + one.width, other.x + other.width) - std::max(one.x, other.x);
  const int height = std::min(one.y + one.height, other.y + other.height) - std::max(one.y, other.y);
  return std::max(width, 0) * static_cast<double>(std::max(height, 0)) / (static_cast<double>(one.width) * one.height);
}

// The camera's own motion that fixed marks cannot tell; without any the user knows that there is none.
std::string what_marks_leave(const std::vector<vision::Target>& marks) {
  if (marks.empty()) return "";
  std::vector<vision::PixelPoint> places;
  for (const vision::Target& mark : marks) places.push_back(mark.point());
  if (vision::taken_off_by(places) == vision::TakenOff::shift_turn_scale) return "";
  const std::string left =
      "a turn of the camera and a change of its scale stay in the positions and are not in their uncertainty";
  return marks.size() == 1
             ? "with one fixed mark " + left
             : fmt::format("the fixed marks stand less than {:.0f} px apart: {}", vision::least_mark_spacing_px, left);
}

// Region, point and mask come from the calibration where the command line is silent, so that both see the same pixels.
Result<Prepared> prepare(const Options& options, std::vector<std::string>& warnings, const TaskContext& context) {
  vision::TemplateChoice choice{options.image, {}, {}};
  ZD_TRY(choice.region, region_from(options.region, "--roi"));
  ZD_TRY(choice.point, point_from(options.point, "--point"));
  vision::LocateRequest request;
  std::optional<vision::StoredTarget> stored;
  if (!options.calibration.empty()) {
    ZD_TRY(const nlohmann::json document, read_json_file(options.calibration));
    ZD_TRY(request.calibration, vision::calibration_from_json(document, options.calibration, &warnings));
    ZD_TRY(stored, vision::target_from_json(document, options.calibration));
    if (stored && !choice.region) {
      choice.region = stored->region;
      if (!choice.point) choice.point = stored->point;
    }
  }
  Result<vision::Target> loaded = vision::load_target(choice, &warnings);
  if (!loaded && stored && options.region.empty() && loaded.error().code == ErrorCode::region_outside_image) {
    return fail(ErrorCode::calibration_of_another_target,
                {{"file", options.calibration},
                 {"template", options.image},
                 {"detail", fmt::format("its region {} is not inside {} pixels", loaded.error().context.at("region"),
                                        loaded.error().context.at("size"))}});
  }
  ZD_TRY(vision::Target target, std::move(loaded));
  if (!choice.region) request.other = vision::other_pattern(target);
  if (stored) ZD_CHECK(vision::made_with(*stored, target, options.calibration, options.image));
  if (request.calibration && !(stored && stored->picture)) {
    warnings.push_back(options.calibration +
                       " does not hold its target's picture: whether it was made with this target is not checked");
  }
  if (request.calibration && request.calibration->handedness_assumed) {
    warnings.push_back(options.calibration +
                       " was made with two positions: a mirrored camera does not show, and across their line the "
                       "micrometres may have the other sign");
  }
  if (!options.views.empty()) {
    ZD_TRY(const std::vector<vision::ViewRow> views, vision::read_views(options.views, &warnings));
    ZD_TRY(const vision::FileCalibration learned, vision::calibrate_from_files(target, views, &warnings, context));
    target = learned.target;
    request.learn = false;
  } else if (stored && stored->region == target.region()) {
    target = target.with_backdrop(stored->backdrop).with_mask(stored->mask).with_lens(stored->lens);
    if (stored->gathered) target = target.with_gathered(*stored->gathered);
    request.learn = false;
  } else if (stored) {
    warnings.push_back(fmt::format(
        "{} was made for the region {},{},{},{}: mask, lens and backdrop are learned from the frames",
        options.calibration, stored->region.x, stored->region.y, stored->region.width, stored->region.height));
  }
  for (const std::string& text : options.references) {
    vision::TemplateChoice reference{options.image, {}, {}};
    ZD_TRY(reference.region, region_from(text, "--reference-roi"));
    auto mark = vision::load_target(reference, nullptr);
    if (!mark && mark.error().code == ErrorCode::template_without_texture) {
      return fail(ErrorCode::template_without_texture, {{"file", options.image + " (--reference-roi " + text + ")"}});
    }
    ZD_CHECK(mark);
    // What lies on the target moves with it and takes out what is to be measured.
    if (share_within(mark->region(), target.region()) > most_on_target) {
      return fail(ErrorCode::bad_argument, {{"what", "the reference mark " + text},
                                            {"found", "over the target's region or another mark"},
                                            {"expected", "a place beside them"}});
    }
    request.references.push_back(*std::move(mark));
  }
  if (const std::string left = what_marks_leave(request.references); !left.empty()) warnings.push_back(left);
  return Prepared{std::move(target), std::move(request)};
}

nlohmann::json json_of(const vision::FramePosition& p) {
  const vision::Location& at = p.location;
  nlohmann::json out{{"frame", p.frame}, {"ok", at.ok}, {"reason", at.reason}};
  if (at.ok) {
    out["x_px"] = at.x_px;
    out["y_px"] = at.y_px;
    out["sigma_x_px"] = at.sigma_x_px;
    out["sigma_y_px"] = at.sigma_y_px;
    out["correlation"] = at.correlation;
  }
  if (p.error) {
    out["ex_um"] = p.error->x_um;
    out["ey_um"] = p.error->y_um;
    out["sigma_ex_um"] = p.error->sigma_x_um;
    out["sigma_ey_um"] = p.error->sigma_y_um;
  }
  return out;
}

Status run(const Options& options, const TaskContext& context, CommandOutput& output) {
  ZD_TRY(const Prepared prepared, prepare(options, output.warnings, context));
  ZD_TRY(const std::vector<vision::FramePosition> positions,
         vision::locate_in_folder(prepared.target, prepared.request, options.frames, &output.warnings, context));
  const bool with_um = prepared.request.calibration.has_value();
  ZD_CHECK(write_file(options.out, vision::positions_csv(positions, with_um)));
  int good = 0;
  output.json["positions"] = nlohmann::json::array();
  for (const vision::FramePosition& p : positions) {
    good += p.location.ok ? 1 : 0;
    output.json["positions"].push_back(json_of(p));
    if (!p.location.ok) output.text += fmt::format("{}: {}\n", p.frame, p.location.reason);
  }
  if (good == 0) {
    std::string first = positions.front().location.reason;
    const vision::Target& target = prepared.target;
    if (const std::string unseen = vision::unseen_direction(target.image(), target.region()); !unseen.empty()) {
      first += "; " + unseen;
    }
    // The file with each frame's reason is there; nothing was measured all the same.
    return fail(ErrorCode::target_refused,
                {{"reason", fmt::format("none of {} frames in {} (the first: {}); each frame's reason is in {}",
                                        positions.size(), options.frames, first, options.out)}});
  }
  output.json["frames"] = positions.size();
  output.json["measured"] = good;
  output.text += fmt::format("{} of {} frames measured, written to {}", good, positions.size(), options.out);
  return {};
}

}  // namespace locate_command

void add_locate(Cli& cli) {
  using namespace locate_command;
  auto options = std::make_shared<Options>();
  CLI::App* command =
      cli.add("locate", "Measure the target's displacement in the frames of a folder",
              [options](const TaskContext& context, CommandOutput& output) { return run(*options, context, output); });
  command->add_option("--template", options->image, "Picture of the target at rest")->required();
  command
      ->add_option("--roi", options->region,
                   "Region of the target, X,Y,W,H in px; default: the calibration's, or found by itself")
      ->check(check_region);
  command->add_option("--point", options->point, "Point whose displacement is measured, X,Y in px; default: the centre")
      ->check(check_point);
  command
      ->add_option("--reference-roi", options->references,
                   "Region of a fixed mark whose motion is taken off; two, 120 px apart or more, take turn and scale "
                   "off as well")
      ->check(check_region);
  command->add_option("--frames", options->frames, "Folder of pictures")->required();
  command->add_option("--calibration", options->calibration, "Calibration file: adds the error in um");
  command->add_option("--views", options->views, "Calibration views, to learn which pixels travel with the target");
  command->add_option("--out", options->out, "CSV file to write")->required();
  command->footer(
      "The frames of a folder are measured together: without a calibration or views, mask, lens and what stands behind "
      "the target are learned from all of them, so that what is said of one frame may depend on the others.\n"
      "With a calibration over the drift the scatter is about 1.2 times the theoretical bound, without one up to 2.5 "
      "times.");
}

}  // namespace zerodrift::cli
