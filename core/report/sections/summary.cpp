// The customer's page: drift before and after, what was done, may the machine work.

#include <cmath>

#include "core/report/build.h"

namespace zerodrift::report {
namespace {

Figure direction_figure(const Source& source, const std::string& direction, const char* key, const char* id,
                        const char* label) {
  const auto& body = source.find("verification")->body;
  const double value = number_of(body, key, direction);
  Figure figure;
  figure.id = fmt::format("{}_{}_um", id, direction);
  figure.label = source.say(label) + " " + direction;
  figure.value = shown(value, 1);
  figure.unit = "um";
  figure.trace = source.trace("verification", std::string(key) + "." + direction);
  return figure;
}

Figures figures_of(const Source& source) {
  Figures figures;
  const auto& body = source.find("verification")->body;
  const double limit = number_of(body, "limit_um");
  for (const auto& direction : directions_of(body, "peak_error_after_um")) {
    figures.figures.push_back(
        direction_figure(source, direction, "peak_error_before_um", "peak_before", "Largest error before,"));
    Figure after = direction_figure(source, direction, "peak_error_after_um", "peak_after", "Largest error after,");
    after.limit = std::isfinite(limit) ? source.say("limit") + " " + shown(limit, 1) + " um" : "";
    const double value = number_of(body, "peak_error_after_um", direction);
    after.verdict = !std::isfinite(limit) ? Verdict::none : value <= limit ? Verdict::good : Verdict::bad;
    figures.figures.push_back(after);
    figures.figures.push_back(direction_figure(source, direction, "rms_error_after_um", "rms_after", "RMS after,"));
    figures.figures.push_back(
        direction_figure(source, direction, "removed_percent", "removed", "Removed of the largest,"));
    figures.figures.back().unit = "%";
    figures.figures.back().id = "removed_" + direction + "_percent";
  }
  return figures;
}

Plot before_and_after(const Source& source) {
  Plot plot;
  plot.id = "before_after";
  plot.title = source.say("Error at the nose in Z, before and after");
  plot.x_label = source.say("hours since the start of each run");
  plot.y_label = "um";
  const auto add = [&](const char* kind, const char* name) {
    const auto* run = source.run_of(kind);
    if (run == nullptr) return;
    for (auto& curve : curves_of(*run, {"dZ_um"}, false)) {
      curve.name = source.say(name);
      plot.curves.push_back(std::move(curve));
    }
  };
  add("warmup", "without compensation");
  add("verification", "with compensation");
  plot.trace = source.trace("verification", "dZ_um");
  return plot;
}

}  // namespace

std::optional<Section> summary_section(const Source& source) {
  Section section{"summary", source.say("Result"), {}};
  const LoadedArtefact* verification = source.find("verification");
  if (verification == nullptr) {
    section.blocks.emplace_back(Text{source.say("The compensation has not been verified on the machine yet."), true});
    return section;
  }
  const std::string verdict = text_of(verification->body, "verdict");
  section.blocks.emplace_back(
      verdict == "passed"
          ? Text{source.say(
                     "The thermal error of this machine was measured, learned and compensated. A second run with "
                     "the compensation on stayed within the limit."),
                 false}
          : Text{source.say("A second run with the compensation on did not stay within the limit; see Verification."),
                 true});
  section.blocks.emplace_back(figures_of(source));
  section.blocks.emplace_back(before_and_after(source));
  return section;
}

}  // namespace zerodrift::report
