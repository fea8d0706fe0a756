// The heat simulation beside the recording, and what it left out.

#include <cmath>

#include "core/report/build.h"

namespace zerodrift::report {
namespace {

Table rmse_table(const Source& source, const nlohmann::json& body) {
  Table table;
  table.id = "simulation_rmse";
  table.title = source.say("Simulation against recording, RMS difference");
  table.header = {source.say("channel"), source.say("as described"), source.say("with what was found")};
  table.trace = source.trace("physics", "rmse");
  const auto rmse = body.value("rmse", nlohmann::json::object());
  const auto after = rmse.value("after", nlohmann::json::object());
  const auto before = rmse.value("before", nlohmann::json::object());
  for (const auto& [channel, value] : before.items()) {
    if (!value.is_number()) continue;
    table.rows.push_back({channel, shown(value.get<double>(), 2), shown(number_of(after, channel), 2)});
  }
  return table;
}

}  // namespace

std::optional<Section> physics_section(const Source& source) {
  const LoadedArtefact* physics = source.find("physics");
  if (physics == nullptr) return std::nullopt;
  Section section{"physics", source.say("Physics: simulation against recording"), {}};
  for (const auto& sentence : physics->body.value("sentences", nlohmann::json::array())) {
    section.blocks.emplace_back(Text{sentence.get<std::string>(), false});
  }
  section.blocks.emplace_back(rmse_table(source, physics->body));
  const auto* run = source.run_of("warmup");
  const auto curves = physics->body.value("curves", nlohmann::json::array());
  for (const auto& one : curves) {
    Plot plot;
    const std::string channel = text_of(one, "channel");
    plot.id = "simulation_" + channel;
    plot.title = source.say("Recorded and simulated:") + " " + channel;
    plot.x_label = source.say("hours");
    plot.y_label = text_of(one, "unit");
    if (run != nullptr) {
      plot.curves = curves_of(*run, {channel}, false);
      for (auto& curve : plot.curves) curve.name = source.say("recorded");
    }
    Curve simulated{source.say("simulated"), {}, {}, false};
    for (const auto& x : one.value("time_h", nlohmann::json::array())) simulated.x.push_back(x.get<double>());
    for (const auto& y : one.value("values", nlohmann::json::array())) {
      simulated.y.push_back(y.is_number() ? y.get<double>() : std::nan(""));
    }
    plot.curves.push_back(std::move(simulated));
    plot.trace = source.trace("physics", "curves " + channel);
    section.blocks.emplace_back(std::move(plot));
  }
  return section;
}

}  // namespace zerodrift::report
