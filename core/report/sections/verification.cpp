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
  plot.y_label = "µm";
  plot.curves = curves_of(*run, run->names(recording::ChannelKind::error), false);
  plot.trace = source.trace("verification", "series");
  section.blocks.emplace_back(std::move(plot));
  Table table;
  table.id = "correction";
  table.title = source.say("Correction proposed by the residual (kappa = 1 + residual / compensation)");
  table.header = {source.say("direction"), source.say("kappa"), source.say("offset, µm"), source.say("why")};
  table.trace = source.trace("verification", "kappa");
  for (const auto& axis : verification->body.value("correction", nlohmann::json::array())) {
    table.rows.push_back({text_of(axis, "axis"), shown(number_of(axis, "kappa"), 3),
                          shown(number_of(axis, "offset_um"), 1), source.in_words(text_of(axis, "reason"))});
  }
  if (!table.rows.empty()) section.blocks.emplace_back(std::move(table));
  return section;
}

}  // namespace zerodrift::report
