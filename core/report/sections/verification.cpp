// The compensated run: what was left.

#include "core/report/build.h"

namespace zerodrift::report {

std::optional<Section> verification_section(const Source& source) {
  const LoadedArtefact* verification = source.find("verification");
  const auto* run = source.run_of("verification");
  if (verification == nullptr || run == nullptr) return std::nullopt;
  Section section{"verification", source.say("Verification"), {}};
  Plot plot;
  plot.id = "residual";
  plot.title = source.say("Error left with the compensation on");
  plot.x_label = source.say("hours");
  plot.y_label = "um";
  plot.curves = curves_of(*run, run->names(recording::ChannelKind::error), false);
  plot.trace = source.trace("verification", "series");
  section.blocks.emplace_back(std::move(plot));
  Table table;
  table.id = "correction";
  table.title = source.say("Correction by residual (kappa = 1 + residual / compensation)");
  table.header = {source.say("direction"), source.say("kappa"), source.say("applied")};
  table.trace = source.trace("verification", "kappa");
  const auto kappa = verification->body.value("kappa", nlohmann::json::object());
  for (const auto& [direction, value] : kappa.items()) {
    if (!value.is_number()) continue;
    table.rows.push_back(
        {direction, shown(value.get<double>(), 3),
         verification->body.value("correction_applied", false) ? source.say("yes") : source.say("no")});
  }
  if (!table.rows.empty()) section.blocks.emplace_back(std::move(table));
  return section;
}

}  // namespace zerodrift::report
