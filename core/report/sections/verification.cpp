// The compensated run: what was left, against what there was, round by round.

#include <fmt/format.h>

#include <cmath>

#include "core/report/build.h"
#include "core/report/pieces.h"

namespace zerodrift::report {
namespace {

Figure figure_in(const Source& source, const std::string& direction, const char* key, const char* id,
                 const char* label) {
  const auto& body = source.find("verification")->body;
  return figure(fmt::format("{}_{}_um", id, direction), source.tell(label, direction),
                shown(number_of(body, key, direction), 1), "µm",
                source.at("verification", fmt::format("/{}/{}", key, direction)));
}

/// What a direction gained; the largest that is left stands on the first page.
void add_direction(const Source& source, const std::string& direction, Figures& figures) {
  const auto& body = source.find("verification")->body;
  Figure before = figure_in(source, direction, "peak_error_before_um", "peak_before", "Largest error before, {}");
  const double span_s = number_of(body, "compared_s");
  if (std::isfinite(span_s)) before.limit = source.tell("first {} min of the run", shown(span_s / 60.0, 0));
  if (const LoadedRun* run = source.run(source.find("warmup"))) {
    const std::string channel = "d" + direction + "_um";
    const auto extremes = extremes_of(run->samples, channel, std::isfinite(span_s) ? span_s : 1e12);
    if (extremes.largest) before.trace.rows.push_back(row_of(*run, channel, *extremes.largest));
  }
  figures.figures.push_back(std::move(before));
  figures.figures.push_back(figure_in(source, direction, "rms_error_before_um", "rms_before", "RMS before, {}"));
  figures.figures.push_back(figure_in(source, direction, "rms_error_after_um", "rms_after", "RMS after, {}"));
  const double removed = number_of(body, "removed_percent", direction);
  const bool worse = removed < 0.0;
  Figure gain = figure_in(source, direction, "removed_percent", "removed",
                          worse ? "Made worse, {}" : "Removed of the largest, {}");
  gain.id = "removed_" + direction + "_percent";
  gain.unit = "%";
  if (worse) {
    gain.value = shown(-removed, 1);
    gain.limit = source.say("worse than without compensation");
    const bool kept = number_of(body, "peak_error_after_um", direction) <= number_of(body, "limit_um");
    gain.verdict = kept ? Verdict::doubtful : Verdict::bad;
  }
  figures.figures.push_back(std::move(gain));
}

Plot residual(const Source& source, const recording::Recording& run) {
  Plot plot;
  plot.id = "residual";
  plot.title = source.say("Error left with the compensation on");
  plot.x_label = source.say("hours");
  plot.y_label = "µm";
  plot.curves = curves_of(run, run.names(recording::ChannelKind::error), false);
  plot.trace = source.trace("verification", "series");
  const double limit = number_of(source.find("verification")->body, "limit_um");
  if (std::isfinite(limit)) plot.limit = limit;
  add_course(source, *source.find("verification"), plot);
  return plot;
}

/// Of the table that the machine held in this run; empty when the upload is not in the job.
std::string table_version(const Source& source, const LoadedArtefact& verification) {
  for (const auto& input : verification.inputs) {
    if (input.kind != "upload") continue;
    for (const auto& upload : source.history("upload")) {
      if (upload.id == input.id) return text_of(upload.body, "version");
    }
  }
  return {};
}

/// Each verification of the job: a correction is written and proved, or the table of before stays in doubt.
Table rounds(const Source& source) {
  Table table;
  table.id = "rounds";
  table.title = source.say("Verification runs of this job, largest error left");
  table.header = {source.say("run"), source.say("made, UTC"), source.say("table version"), "X, µm", "Y, µm",
                  "Z, µm",           source.say("limit, µm"), source.say("result")};
  table.trace = source.trace("verification", "history");
  const auto& all = source.history("verification");
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& body = all[i].body;
    std::vector<Cell> row = {std::to_string(i + 1), minute_of(all[i].created_utc), table_version(source, all[i])};
    for (const char* axis : {"X", "Y", "Z"}) {
      Trace trace = source.at("verification", fmt::format("/peak_error_after_um/{}", axis));
      trace.id = all[i].id;
      row.push_back(cell(number_of(body, "peak_error_after_um", axis), 1, fmt::format("round_{}_{}_um", i + 1, axis),
                         std::move(trace)));
    }
    row.emplace_back(shown(number_of(body, "limit_um"), 1));
    row.emplace_back(source.say(text_of(body, "verdict")));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table correction(const Source& source) {
  Table table;
  table.id = "correction";
  table.title = source.say("Correction that the residual asks for (kappa = 1 + residual / compensation)");
  table.header = {source.say("direction"), source.say("kappa"), source.say("offset, µm"), source.say("why")};
  table.trace = source.trace("verification", "/correction");
  int number = 0;
  for (const auto& axis : list_of(source.find("verification")->body, "correction")) {
    const std::string name = text_of(axis, "axis");
    const std::string pointer = fmt::format("/correction/{}", number++);
    table.rows.push_back(
        {name, cell(number_of(axis, "kappa"), 3, "kappa_" + name, source.at("verification", pointer + "/kappa")),
         cell(number_of(axis, "offset_um"), 1, "kappa_offset_" + name + "_um",
              source.at("verification", pointer + "/offset_um")),
         source.in_words(text_of(axis, "reason"))});
  }
  return table;
}

}  // namespace

std::optional<Section> verification_section(const Source& source) {
  const LoadedArtefact* verification = source.find("verification");
  const auto* run = source.run_of("verification");
  if (verification == nullptr || run == nullptr) return std::nullopt;
  Section section{"verification", source.say("Verification"), {}};
  Figures figures;
  for (const auto& direction : directions_of(verification->body, "peak_error_after_um")) {
    add_direction(source, direction, figures);
  }
  section.blocks.emplace_back(std::move(figures));
  section.blocks.emplace_back(residual(source, *run));
  section.blocks.emplace_back(rounds(source));
  if (auto table = correction(source); !table.rows.empty()) section.blocks.emplace_back(std::move(table));
  return section;
}

}  // namespace zerodrift::report
