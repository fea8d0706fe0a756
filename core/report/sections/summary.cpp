// The customer's page: drift before and after, what was done, may the machine work.

#include <algorithm>
#include <cmath>

#include "core/report/build.h"
#include "core/report/doubts.h"

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
  figure.unit = "µm";
  figure.trace = source.trace("verification", std::string(key) + "." + direction);
  return figure;
}

/// What a direction gained. Worse than without is never good, even within the limit.
void add_direction(const Source& source, const std::string& direction, Figures& figures) {
  const auto& body = source.find("verification")->body;
  const double limit = number_of(body, "limit_um");
  const double value = number_of(body, "peak_error_after_um", direction);
  const double removed = number_of(body, "removed_percent", direction);
  const bool worse = removed < 0.0;
  Figure before = direction_figure(source, direction, "peak_error_before_um", "peak_before", "Largest error before,");
  const double span_s = number_of(body, "compared_s");
  if (std::isfinite(span_s)) {
    before.limit = fmt::format(fmt::runtime(source.say("first {} min of the run")), shown(span_s / 60.0, 0));
  }
  figures.figures.push_back(std::move(before));
  Figure after = direction_figure(source, direction, "peak_error_after_um", "peak_after", "Largest error after,");
  if (std::isfinite(limit)) {
    const bool kept = value <= limit;
    after.limit = source.say("limit") + " " + shown(limit, 1) + " µm: " + source.say(kept ? "kept" : "exceeded");
    after.verdict = !kept ? Verdict::bad : worse ? Verdict::doubtful : Verdict::good;
  }
  figures.figures.push_back(std::move(after));
  figures.figures.push_back(direction_figure(source, direction, "rms_error_after_um", "rms_after", "RMS after,"));
  Figure gain = direction_figure(source, direction, "removed_percent", "removed",
                                 worse ? "Made worse," : "Removed of the largest,");
  gain.id = "removed_" + direction + "_percent";
  gain.unit = "%";
  if (worse) {
    gain.value = shown(-removed, 1);
    gain.limit = source.say("worse than without compensation");
    gain.verdict = value <= limit ? Verdict::doubtful : Verdict::bad;
  }
  figures.figures.push_back(std::move(gain));
}

Figures figures_of(const Source& source) {
  Figures figures;
  for (const auto& direction : directions_of(source.find("verification")->body, "peak_error_after_um")) {
    add_direction(source, direction, figures);
  }
  return figures;
}

Plot before_and_after(const Source& source, const std::string& direction) {
  Plot plot;
  const std::string channel = "d" + direction + "_um";
  plot.id = "before_after_" + direction;
  plot.title = source.say("Error at the nose, before and after, in") + " " + direction;
  plot.x_label = source.say("hours since the start of each run");
  plot.y_label = "µm";
  const auto add = [&](const char* kind, const char* name) {
    const auto* run = source.run_of(kind);
    if (run == nullptr) return;
    for (auto& curve : curves_of(*run, {channel}, false)) {
      curve.name = source.say(name);
      plot.curves.push_back(std::move(curve));
    }
  };
  add("warmup", "without compensation");
  add("verification", "with compensation");
  plot.trace = source.trace("verification", channel);
  return plot;
}

/// How many figures need a second look, before anybody trusts the others.
std::optional<Text> count_of_doubts(const Source& source) {
  const auto doubts = doubts_of(source);
  if (doubts.empty()) return std::nullopt;
  const auto bad =
      std::count_if(doubts.begin(), doubts.end(), [](const Doubt& d) { return d.verdict == Verdict::bad; });
  Text text{fmt::format(fmt::runtime(source.say("{} points were refused or look doubtful, {} of them outside their "
                                                "limit; they are listed under \"Refused or doubtful\".")),
                        doubts.size(), bad),
            true};
  text.verdict = bad > 0 ? Verdict::bad : Verdict::doubtful;
  return text;
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
  if (auto text = count_of_doubts(source)) section.blocks.emplace_back(std::move(*text));
  section.blocks.emplace_back(figures_of(source));
  for (const auto& direction : directions_of(verification->body, "peak_error_after_um")) {
    section.blocks.emplace_back(before_and_after(source, direction));
  }
  return section;
}

}  // namespace zerodrift::report
