// Measurement set-up: machine, camera calibration, sensors.

#include <cmath>

#include "core/report/build.h"

namespace zerodrift::report {
namespace {

void add_calibration(const Source& source, Section& section) {
  const LoadedArtefact* calibration = source.find("calibration");
  if (calibration == nullptr) return;
  if (text_of(calibration->body, "source") == "probes") {
    section.blocks.emplace_back(Text{source.say("The errors were measured with displacement probes."), false});
    return;
  }
  Table table;
  table.id = "cameras";
  table.title = source.say("Camera calibration");
  table.header = {source.say("camera"),           source.say("sees"),
                  source.say("µm per px"),        source.say("rotation, °"),
                  source.say("rms residual, µm"), source.say("positions")};
  table.trace = source.trace("calibration", "cameras");
  for (const auto& camera : calibration->body.value("cameras", nlohmann::json::array())) {
    std::string axes;
    for (const auto& axis : camera.value("axes", nlohmann::json::array())) axes += axis.get<std::string>() + " ";
    table.rows.push_back({text_of(camera, "id"), axes, shown(number_of(camera, "um_per_px"), 4),
                          shown(number_of(camera, "rotation_deg"), 3), shown(number_of(camera, "rms_um"), 3),
                          shown(number_of(camera, "positions"), 0)});
  }
  section.blocks.emplace_back(std::move(table));
  const bool reference = calibration->body.value("reference_target", false);
  section.blocks.emplace_back(
      reference ? Text{source.say("A fixed reference target in each view removes the camera's own drift."), false}
                : Text{source.say("There was no fixed reference target: drift of the camera or its holder (about "
                                  "2 µm per K for 100 mm of aluminium) is part of the figures."),
                       true});
}

void add_health(const Source& source, Section& section) {
  const LoadedArtefact* machine = source.find("machine");
  if (machine == nullptr) return;
  Table table;
  table.id = "sensors";
  table.title = source.say("Temperature sensors at rest");
  table.header = {source.say("sensor"), source.say("place"), source.say("value, °C"), source.say("noise, K"),
                  source.say("state")};
  table.trace = source.trace("machine", "health");
  for (const auto& sensor : machine->body.value("health", nlohmann::json::array())) {
    table.rows.push_back({text_of(sensor, "channel").substr(0, text_of(sensor, "channel").find('_')),
                          text_of(sensor, "label"), shown(number_of(sensor, "value_C"), 2),
                          shown(number_of(sensor, "noise_K"), 2), text_of(sensor, "state")});
  }
  if (!table.rows.empty()) section.blocks.emplace_back(std::move(table));
}

}  // namespace

std::optional<Section> setup_section(const Source& source) {
  Section section{"setup", source.say("Measurement set-up"), {}};
  add_calibration(source, section);
  add_health(source, section);
  if (section.blocks.empty()) return std::nullopt;
  return section;
}

}  // namespace zerodrift::report
