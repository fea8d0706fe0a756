// Measurement set-up: machine, camera calibration, sensors.

#include <fmt/format.h>

#include <cmath>

#include "core/report/build.h"
#include "core/report/camera_marks.h"
#include "core/report/pieces.h"

namespace zerodrift::report {
namespace {

void add_machine(const Source& source, Section& section) {
  const LoadedArtefact* machine = source.find("machine");
  if (machine == nullptr) return;
  Figures figures;
  const auto add = [&](const char* id, const char* label, const char* key, int digits, const char* unit) {
    figures.figures.push_back(figure(id, source.say(label), shown(number_of(machine->body, key), digits), unit,
                                     source.at("machine", std::string("/") + key)));
  };
  add("sensors_alive", "Temperature sensors alive", "sensors_alive", 0, "");
  add("spread_K", "Spread of the sensors when the commissioning began", "spread_K", 2, "K");
  add("round_trip_ms", "Answer of the controller", "round_trip_ms", 1, "ms");
  add("clock_difference_s", "Clock against the computer's", "clock_difference_s", 2, "s");
  section.blocks.emplace_back(std::move(figures));
}

Table cameras_of(const Source& source, const LoadedArtefact& calibration) {
  Table table;
  table.id = "cameras";
  table.title = source.say("Camera calibration");
  table.header = {source.say("camera"),         source.say("sees"),        source.say("µm per px"),
                  source.say("uncertainty, %"), source.say("rotation, °"), source.say("rms residual, µm"),
                  source.say("left out, µm"),   source.say("positions")};
  table.trace = source.at("calibration", "/cameras");
  int number = 0;
  for (const auto& camera : list_of(calibration.body, "cameras")) {
    std::string axes;
    for (const auto& axis : list_of(camera, "axes")) axes += (axes.empty() ? "" : ", ") + axis.get<std::string>();
    const std::string id = text_of(camera, "id");
    const auto inner = object_of(camera, "calibration");
    const double scale = number_of(camera, "um_per_px");
    const auto sigma = list_of(inner, "sigma");
    const bool has_sigma = !sigma.empty() && sigma[0].is_array() && !sigma[0].empty() && sigma[0][0].is_number();
    const double percent = has_sigma ? 100.0 * sigma[0][0].get<double>() / scale : std::nan("");
    const auto at = [&](const char* key) {
      return source.at("calibration", fmt::format("/cameras/{}/{}", number, key));
    };
    table.rows.push_back({source.say(id), axes, cell(scale, 4, "um_per_px_" + id, at("um_per_px")),
                          cell(percent, 3, "scale_uncertainty_" + id + "_percent", at("calibration/sigma")),
                          cell(number_of(camera, "rotation_deg"), 3, "rotation_" + id + "_deg", at("rotation_deg")),
                          cell(number_of(camera, "rms_um"), 3, "calibration_rms_" + id + "_um", at("rms_um")),
                          cell(number_of(inner, "leave_one_out_um"), 3, "calibration_left_out_" + id + "_um",
                               at("calibration/leave_one_out_um")),
                          shown(number_of(camera, "positions"), 0)});
    ++number;
  }
  return table;
}

/// What of the cameras' own drift was taken out, and what of it remains possible.
Text own_drift(const Source& source, const CameraMarks& marks) {
  switch (marks.taken_off) {
    case CameraMarks::TakenOff::nothing:
      return {source.say("There was no fixed reference target: drift of the camera or its holder (about "
                         "2 µm per K for 100 mm of aluminium) is part of the figures."),
              true};
    case CameraMarks::TakenOff::shift:
      if (std::isfinite(marks.distance_mm)) {
        return {source.tell("A fixed reference mark in each view takes out that the camera shifts. That it turns or "
                            "changes its scale remains possible: {} µm for 0.1 mrad or 1 in 10 000, over the {} mm "
                            "between mark and target. Two marks, well apart, would take that out too.",
                            shown(0.1 * marks.distance_mm, 2), shown(marks.distance_mm, 1)),
                false};
      }
      return {source.say("A fixed reference mark in each view takes out that the camera shifts. That it turns or "
                         "changes its scale remains possible, by 0.1 µm a mm between mark and target for 0.1 mrad "
                         "or 1 in 10 000."),
              false};
    case CameraMarks::TakenOff::shift_turn_scale:
      break;
  }
  return {
      source.say("Fixed reference marks, well apart in each view, take out that the camera shifts, turns and changes "
                 "its scale. What remains possible is that a mark itself moved, or that marks and target stand at "
                 "different distances from the camera: of its shift then remains what they differ by, 1 % for 1 %."),
      false};
}

void add_calibration(const Source& source, Section& section) {
  const LoadedArtefact* calibration = source.find("calibration");
  if (calibration == nullptr) return;
  if (text_of(calibration->body, "source") == "probes") {
    section.blocks.emplace_back(Text{source.say("The errors were measured with displacement probes."), false});
    return;
  }
  section.blocks.emplace_back(cameras_of(source, *calibration));
  section.blocks.emplace_back(own_drift(source, camera_marks(calibration->body)));
}

void add_health(const Source& source, Section& section) {
  const LoadedArtefact* machine = source.find("machine");
  if (machine == nullptr) return;
  Table table;
  table.id = "sensors";
  table.title = source.say("Temperature sensors at rest");
  table.header = {source.say("sensor"), source.say("place"), source.say("value, °C"), source.say("noise, K"),
                  source.say("state")};
  table.trace = source.at("machine", "/health");
  int number = 0;
  for (const auto& sensor : list_of(machine->body, "health")) {
    const std::string tag = text_of(sensor, "channel").substr(0, text_of(sensor, "channel").find('_'));
    const auto at = [&](const char* key) { return source.at("machine", fmt::format("/health/{}/{}", number, key)); };
    table.rows.push_back({tag, source.say(text_of(sensor, "label")),
                          cell(number_of(sensor, "value_C"), 2, "rest_" + tag + "_C", at("value_C")),
                          cell(number_of(sensor, "noise_K"), 2, "noise_" + tag + "_K", at("noise_K")),
                          source.say(text_of(sensor, "state"))});
    ++number;
  }
  if (!table.rows.empty()) section.blocks.emplace_back(std::move(table));
}

}  // namespace

std::optional<Section> setup_section(const Source& source) {
  Section section{"setup", source.say("Measurement set-up"), {}};
  add_machine(source, section);
  add_calibration(source, section);
  add_health(source, section);
  if (section.blocks.empty()) return std::nullopt;
  return section;
}

}  // namespace zerodrift::report
