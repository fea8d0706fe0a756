// The model and its honest figures.

#include "core/report/build.h"

namespace zerodrift::report {

std::optional<Section> model_section(const Source& source) {
  const LoadedArtefact* model = source.find("model");
  if (model == nullptr) return std::nullopt;
  Section section{"model", source.say("Compensation model"), {}};
  section.blocks.emplace_back(Text{source.in_words(text_of(model->body, "summary")), false});
  Figures figures;
  for (const auto& error : model->body.value("figures", nlohmann::json::array())) {
    const std::string channel = text_of(error, "channel");
    const auto add = [&](const char* id, const char* label, const char* key) {
      Figure figure;
      figure.id = fmt::format("{}_{}", id, channel);
      figure.label = source.say(label) + " " + channel.substr(1, 1);
      figure.value = shown(number_of(error, key), 2);
      figure.unit = "µm";
      figure.trace = source.trace("model", std::string(key) + " of " + channel);
      figures.figures.push_back(std::move(figure));
    };
    add("fit_rms", "RMS on the fitted part,", "rms_fit_um");
    add("held_out_rms", "RMS on unseen data,", "rms_held_out_um");
    add("held_out_peak", "Largest on unseen data,", "peak_held_out_um");
  }
  section.blocks.emplace_back(std::move(figures));
  Table table;
  table.id = "coefficients";
  table.title = source.say(
      "Coefficients as fitted: error = offset + sum of coefficient × (T − reference); corrections stand with the "
      "table");
  table.header = {source.say("direction"), source.say("sensor"), source.say("µm/K"), source.say("reference, °C")};
  table.trace = source.trace("model", "terms");
  for (const auto& row : model->body.value("table", nlohmann::json::array())) {
    table.rows.push_back({text_of(row, "axis"), source.channel_in_words(text_of(row, "sensor")),
                          shown(number_of(row, "um_per_K"), 3), shown(number_of(row, "reference_C"), 2)});
  }
  section.blocks.emplace_back(std::move(table));
  return section;
}

}  // namespace zerodrift::report
