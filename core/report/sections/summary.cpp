// The customer's page: drift before and after, what was written, for which temperatures, when to look again.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/report/build.h"
#include "core/report/doubts.h"
#include "core/report/limits.h"
#include "core/report/pieces.h"
#include "core/report/promise.h"

namespace zerodrift::report {
namespace {

constexpr int check_interval_months = 12;  // no standard sets the time to the next check: this program's proposal

/// The number of a direction: what is left, beside what there was.
Figure left_in(const Source& source, const std::string& direction) {
  const auto& body = source.find("verification")->body;
  const double limit = number_of(body, "limit_um");
  const double value = number_of(body, "peak_error_after_um", direction);
  Figure made = figure("peak_after_" + direction + "_um", source.tell("Largest error left in {}", direction),
                       shown(value, 1), "µm", source.at("verification", "/peak_error_after_um/" + direction));
  if (const LoadedRun* run = source.run(source.find("verification"))) {
    const std::string channel = "d" + direction + "_um";
    const auto extremes = extremes_of(run->samples, channel, 1e12);
    if (extremes.largest) made.trace.rows.push_back(row_of(*run, channel, *extremes.largest));
  }
  made = judged(source, std::move(made), value, limit, 1);
  // Worse than without is never good, even within the limit.
  if (number_of(body, "removed_percent", direction) < 0.0 && made.verdict == Verdict::good) {
    made.verdict = Verdict::doubtful;
  }
  const double before = number_of(body, "peak_error_before_um", direction);
  if (std::isfinite(before)) {
    made.limit = source.tell("before {} µm", shown(before, 1)) + (made.limit.empty() ? "" : " · " + made.limit);
  }
  return made;
}

/// One picture: each direction in its colour, dashed without and solid with the compensation.
Plot before_and_after(const Source& source, const std::vector<std::string>& directions) {
  Plot plot;
  plot.id = "before_after";
  plot.title =
      source.say("Error at the nose: dashed the warm-up run without, solid the verification with compensation");
  plot.x_label = source.say("hours since the start of each run");
  plot.y_label = "µm";
  const auto add = [&](const char* kind, Stroke stroke, const char* words) {
    const auto* run = source.run_of(kind);
    for (const auto& direction : directions) {
      if (run == nullptr) continue;
      auto curves = curves_of(*run, {"d" + direction + "_um"}, false);
      if (const LoadedRun* loaded = source.run(source.find(kind))) break_at_pauses(*loaded, curves);
      for (auto& curve : curves) {
        curve.name = source.tell(words, direction);
        curve.stroke = stroke;
        plot.curves.push_back(std::move(curve));
      }
    }
  };
  add("warmup", Stroke::dashed, "{} without");
  add("verification", Stroke::solid, "{} with");
  const double limit = number_of(source.find("verification")->body, "limit_um");
  if (std::isfinite(limit)) plot.limit = limit;
  plot.trace = source.trace("verification", "series");
  return plot;
}

/// How many figures need a second look, before anybody trusts the others.
std::optional<Text> count_of_doubts(const Source& source) {
  const auto doubts = doubts_of(source);
  if (doubts.empty()) return std::nullopt;
  const auto bad =
      std::count_if(doubts.begin(), doubts.end(), [](const Doubt& d) { return d.verdict == Verdict::bad; });
  Text text{source.tell("{} points were refused or look doubtful, {} of them so that a result is in question; they are "
                        "listed under \"Refused or doubtful\".",
                        doubts.size(), bad),
            true};
  text.verdict = bad > 0 ? Verdict::bad : Verdict::doubtful;
  return text;
}

/// The same day, so many months later; the last day of a shorter month.
std::string months_after(const std::string& utc, int months) {
  int year = 0;
  int month = 0;
  int day = 0;
  if (std::sscanf(utc.c_str(), "%4d-%2d-%2d", &year, &month, &day) != 3) return "-";
  using namespace std::chrono;
  const auto later = year_month(std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month))) +
                     std::chrono::months(months);
  const auto last = year_month_day(later / std::chrono::last);
  const unsigned kept = std::min(static_cast<unsigned>(day), static_cast<unsigned>(last.day()));
  return fmt::format("{:04d}-{:02d}-{:02d}", static_cast<int>(later.year()), static_cast<unsigned>(later.month()),
                     kept);
}

std::string valid_range(const Source& source, const nlohmann::json& table) {
  std::string text;
  const auto valid = object_of(table, "valid");
  for (const auto& [sensor, range] : valid.items()) {
    if (!range.is_array() || range.size() != 2) continue;
    text +=
        (text.empty() ? "" : "; ") + source.tell("{} from {} to {} °C", source.channel_in_words(sensor),
                                                 shown(range[0].get<double>(), 1), shown(range[1].get<double>(), 1));
  }
  return text.empty() ? source.say("not stated") : text;
}

std::optional<Table> brief(const Source& source) {
  const LoadedArtefact* upload = source.find("upload");
  if (upload == nullptr) return std::nullopt;
  Table table;
  table.id = "brief";
  table.title = source.say("What the machine runs now");
  table.header = {source.say("what"), source.say("detail")};
  table.trace = source.trace("upload", "table");
  table.rows.push_back(
      {source.say("Written to the controller"),
       source.tell("compensation table version {}, checksum {} read back, {} UTC", text_of(upload->body, "version"),
                   text_of(upload->body, "crc32"), minute_of(upload->created_utc))});
  table.rows.push_back({source.say("Largest change against the table before, when it was written"),
                        shown(number_of(upload->body, "largest_change_um"), 1) + " µm"});
  table.rows.push_back({source.say("Valid range"), valid_range(source, object_of(upload->body, "table"))});
  if (const auto* verification = source.find("verification")) {
    table.rows.push_back(
        {source.say("Next check due"), source.tell("{}, and after a repair, a collision or a move of the machine",
                                                   months_after(verification->created_utc, check_interval_months))});
  }
  return table;
}

}  // namespace

namespace {

/// What was proved is no longer what runs.
std::optional<Text> changed_since(const Source& source, const LoadedArtefact& verification) {
  const LoadedArtefact* upload = source.find("upload");
  if (upload == nullptr || upload->id < verification.id) return std::nullopt;
  const std::string version = text_of(upload->body, "version");
  const bool none = object_of(object_of(upload->body, "table"), "axes").empty();
  return Text{none
                  ? source.tell("The machine runs without compensation now (version {}, an empty table): what was "
                                "verified is not active.",
                                version)
                  : source.tell("The table was changed after the verification: version {}, which the machine runs now, "
                                "has not been verified.",
                                version),
              true, none ? Verdict::bad : Verdict::doubtful};
}

}  // namespace

namespace {

/// The figures are of the last verification: what came before it, and what the fit had promised.
std::vector<Text> what_was_promised(const Source& source, const LoadedArtefact& verification) {
  const LoadedArtefact* model = source.find("model");
  const nlohmann::json none;
  const Promise promise = promise_of(model != nullptr ? model->body : none, verification.body);
  std::vector<Text> said;
  const auto& all = source.history("verification");
  if (all.size() > 1) {
    const auto& first = all.front().body;
    said.push_back(
        {source.tell("These figures are of verification {} of this job; the first one left at most {} µm ({}). All of "
                     "them are listed under Verification.",
                     all.size(), shown(promise_of(none, first).left_um, 1), source.say(text_of(first, "verdict")))});
  }
  if (!promise.known()) return said;
  const std::string promised = shown(promise.promised_um, 1);
  const std::string left = shown(promise.left_um, 1);
  said.push_back({promise.held()
                      ? source.tell("The fit promised at most {} µm; measured are {} µm: held.", promised, left)
                      : source.tell("The fit promised at most {} µm; measured are {} µm: not reached.", promised, left),
                  !promise.held()});
  return said;
}

}  // namespace

namespace {

/// Before anything is verified: what the model leaves and what the physics says, as the job holds them.
void add_findings(const Source& source, Section& section) {
  Figures figures;
  if (const LoadedArtefact* model = source.find("model")) {
    int number = 0;
    for (const auto& one : list_of(model->body, "figures")) {
      const std::string tag = tag_of(text_of(one, "channel"), source.labels());
      const double peak_um = number_of(one, "peak_held_out_um");
      Figure made =
          figure("unseen_peak_" + tag + "_um", source.tell("Largest error left in {} on unseen data", tag),
                 shown(peak_um, 1), "µm", source.at("model", fmt::format("/figures/{}/peak_held_out_um", number++)));
      figures.figures.push_back(judged(source, std::move(made), peak_um, limits::attainable_peak_um, 1));
    }
  }
  if (!figures.figures.empty()) section.blocks.emplace_back(std::move(figures));
  add_verdict_of_physics(source, section);
}

}  // namespace

std::optional<Section> summary_section(const Source& source) {
  Section section{"summary", source.say("Result"), {}};
  const LoadedArtefact* verification = source.find("verification");
  if (verification == nullptr) {
    const LoadedArtefact* job = source.find("job");
    if (job != nullptr && text_of(job->body, "kind") == "files") {
      section.blocks.emplace_back(
          Text{source.say("This job is made from recordings in files: nothing was written to a machine, and nothing "
                          "was verified on one."),
               false});
      add_findings(source, section);
    } else {
      section.blocks.emplace_back(Text{source.say("The compensation has not been verified on the machine yet."), true});
    }
    if (auto text = count_of_doubts(source)) section.blocks.emplace_back(std::move(*text));
    return section;
  }
  const bool passed = text_of(verification->body, "verdict") == "passed";
  section.blocks.emplace_back(
      passed ? Text{source.say("The thermal error of this machine was measured, learned and compensated. A second run "
                               "with the compensation on stayed within the limit."),
                    false}
             : Text{source.say("A second run with the compensation on did not stay within the limit; see "
                               "Verification."),
                    true, Verdict::bad});
  if (auto text = changed_since(source, *verification)) section.blocks.emplace_back(std::move(*text));
  if (auto text = count_of_doubts(source)) section.blocks.emplace_back(std::move(*text));
  const auto directions = directions_of(verification->body, "peak_error_after_um");
  Figures figures;
  for (const auto& direction : directions) figures.figures.push_back(left_in(source, direction));
  section.blocks.emplace_back(std::move(figures));
  for (auto& text : what_was_promised(source, *verification)) section.blocks.emplace_back(std::move(text));
  section.blocks.emplace_back(before_and_after(source, directions));
  if (auto table = brief(source)) section.blocks.emplace_back(std::move(*table));
  return section;
}

}  // namespace zerodrift::report
