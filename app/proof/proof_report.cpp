#include "app/proof/proof_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace zerodrift::proof {
namespace {

using report::Figure;
using report::Figures;
using report::Plot;
using report::Section;
using report::Table;
using report::Text;

const report::Trace from_result{"result.json", 0, ""};

/// Columns of the confusion matrix are letters: names of twenty effects do not fit across a page.
std::string letter(std::size_t index) {
  return std::string(1, static_cast<char>(index < 26 ? 'A' + index : 'a' + (index - 26)));
}

Section figures_section(const Trial& trial) {
  Section section{"figures", "Figures against what they must reach", {}};
  Table table;
  table.id = "figures";
  table.header = {"figure", "reached", "must", ""};
  table.trace = from_result;
  Figures cards;
  for (const auto& figure : trial.score.figures()) {
    const char* word = !figure.met ? "not judged" : *figure.met ? "met" : "not met";
    const bool leads =
        figure.id == "first_right" || figure.id == "all_right" || figure.id == "false_alarms" || figure.id == "missed";
    if (leads) {
      const auto verdict = !figure.met   ? report::Verdict::none
                           : *figure.met ? report::Verdict::good
                                         : report::Verdict::bad;
      static const std::map<std::string, std::string> labels = {{"first_right", "named right"},
                                                                {"all_right", "all effects right"},
                                                                {"false_alarms", "false alarms"},
                                                                {"missed", "called consistent"}};
      const std::string percent =
          figure.value.substr(figure.value.find('=') == std::string::npos ? 0 : figure.value.find('=') + 2);
      cards.figures.push_back({figure.id,
                               labels.at(figure.id),
                               percent,
                               figure.unit,
                               figure.limit,
                               verdict,
                               {"result.json", 0, figure.label + ": " + figure.value}});
    }
    table.rows.push_back({figure.label, figure.value + " " + figure.unit, figure.limit, word});
  }
  section.blocks.emplace_back(std::move(cards));
  section.blocks.emplace_back(std::move(table));
  return section;
}

std::string what_is_left(const Trial& trial) {
  const double least = least_left(trial.options.strength);
  if (least == 0.0) return ".";
  int count = 0;
  std::string list;
  for (const auto& [id, n] : trial.score.put_aside()) {
    count += n;
    list += fmt::format("{}{} {}", list.empty() ? "" : ", ", id, n);
  }
  return fmt::format(
      ", of which {} are left after the virtual machine itself has re-fitted the machine's ordinary numbers "
      "(conductivity, capacity, expansion, film, heats, the bearings' contact) without it: what a re-fit hides from "
      "everybody is not asked for. {} draws were put aside for that{}.",
      least, count, list.empty() ? "" : " (" + list + ")");
}

Section method_section(const Trial& trial) {
  Section section{"method", "What was done", {}};
  section.blocks.emplace_back(Text{fmt::format(
      "{} machines were built by the virtual machine tool from seed {}. Its heat model (two bodies in rings, air gap, "
      "bearings between them, steps of 2 s) shares no code with the simulation that is judged, and the description "
      "that goes with each machine is the drawing's, not the built machine's. Each hides nothing, one effect, two, or "
      "one that no library lists. Every hidden effect changes some channel by at least 2.5 noise widths (rms){}",
      trial.score.judgements().size(), trial.options.seed, what_is_left(trial))});
  section.blocks.emplace_back(Text{fmt::format(
      "The answers were sealed before the first diagnosis: commitments.json holds SHA-256 of salt and answer for every "
      "case; its own SHA-256 was {}. Each case was then diagnosed from machine.json, recording.csv and second.csv "
      "alone, and the seals were opened: {} of {} promises held. Both recordings are "
      "fitted jointly, as one body of evidence.",
      trial.digest, trial.seals_kept, trial.options.cases)});
  section.blocks.emplace_back(
      Text{"Any case can be repeated: zerodrift-cli diagnose --machine cases/case-001/machine.json --recording "
           "cases/case-001/recording.csv --recording cases/case-001/second.csv --out again.json"});
  return section;
}

Section confusion_section(const Score& score) {
  Section section{"confusion", "What was hidden and what was answered", {}};
  Table by_truth;
  by_truth.id = "by_truth";
  by_truth.title = "By what was hidden";
  by_truth.header = {"hidden", "cases", "right", "other answers"};
  std::map<std::string, int> right;
  std::map<std::string, std::map<std::string, int>> other_answers;
  for (const auto& one : score.judgements()) {
    if (one.outcome == Outcome::right) {
      ++right[one.truth];
    } else {
      ++other_answers[one.truth][one.answer];
    }
  }
  std::set<std::string> single_names;
  for (const auto& [truth, answers] : score.confusion()) {
    int all = 0;
    std::string others;
    for (const auto& [answer, n] : answers) all += n;
    for (const auto& [answer, n] : other_answers[truth]) {
      others += fmt::format("{}{} x {}", others.empty() ? "" : ", ", n, answer);
    }
    by_truth.rows.push_back({truth, std::to_string(all), std::to_string(right[truth]), others});
    if (truth.find('+') == std::string::npos) single_names.insert(truth);
  }
  section.blocks.emplace_back(std::move(by_truth));

  // The matrix: one hidden effect (or none) against the first of the answer.
  std::set<std::string> columns;
  std::map<std::string, std::map<std::string, int>> cells;
  for (const auto& one : score.judgements()) {
    if (single_names.count(one.truth) == 0) continue;
    const std::string answer = one.answer.substr(0, one.answer.find('+'));
    columns.insert(answer.rfind("refused", 0) == 0 ? "refused" : answer);
    ++cells[one.truth][answer.rfind("refused", 0) == 0 ? "refused" : answer];
  }
  Table matrix;
  matrix.id = "matrix";
  matrix.title = "One hidden effect against the first answer";
  matrix.header = {"hidden"};
  std::string legend;
  std::size_t index = 0;
  for (const auto& column : columns) {
    matrix.header.push_back(letter(index));
    legend += fmt::format("{}{} {}", index == 0 ? "" : ", ", letter(index), column);
    ++index;
  }
  for (const auto& [truth, row] : cells) {
    std::vector<report::Cell> texts = {truth};
    for (const auto& column : columns) {
      texts.emplace_back(row.count(column) != 0 ? std::to_string(row.at(column)) : "\u00b7");
    }
    matrix.rows.push_back(std::move(texts));
  }
  section.blocks.emplace_back(std::move(matrix));
  section.blocks.emplace_back(Text{"Columns: " + legend + "."});
  return section;
}

Section improvement_section(const Score& score) {
  Section section{"improvement", "How much better the simulation fits", {}};
  section.blocks.emplace_back(Text{
      "Rms of recording against simulation, median over channels and cases (unlisted effects left out): with the "
      "description as it was; re-fitted within its tolerances without any effect; with what was found. The floor "
      "is the sensors' own noise: no simulation can be below it. The true structure is what an analysis reaches "
      "that is told what is hidden and fits it to the same recording; over that: the ratio of the two medians, over "
      "the channels where both are known, and the median of the channels' own ratios."});
  Table table;
  table.id = "improvement";
  table.header = {"channels", "recording",     "as described",   "re-fitted", "with the effect",
                  "floor",    "worst / floor", "true structure", "over that", "median of ratios",
                  "unit"};
  for (const auto& one : score.improvements()) {
    const auto number = [](double value) { return fmt::format("{:.3f}", value); };
    table.rows.push_back({one.kind == "T" ? "temperatures" : one.kind, one.second ? "held out" : "fitted",
                          number(one.nominal), number(one.refitted), number(one.explained), number(one.floor),
                          fmt::format("{:.1f}", one.worst_over_floor),
                          std::isfinite(one.reached) ? number(one.reached) : "",
                          std::isfinite(one.over_reached) ? fmt::format("{:.4f}", one.over_reached) : "",
                          std::isfinite(one.median_over_reached) ? fmt::format("{:.4f}", one.median_over_reached) : "",
                          one.kind == "T" ? "K" : "um"});
  }
  section.blocks.emplace_back(std::move(table));
  return section;
}

Section calibration_section(const Score& score) {
  Section section{"calibration", "Can the stated confidence be believed?", {}};
  Table table;
  table.id = "reliability";
  table.header = {"stated confidence", "cases", "mean stated", "right"};
  Plot plot;
  plot.id = "reliability_plot";
  plot.title = "Stated confidence against how often the first name was right";
  plot.x_label = "stated";
  plot.y_label = "right";
  report::Curve points{"measured", {}, {}, true};
  for (const auto& bin : score.reliability()) {
    table.rows.push_back({fmt::format("{:.1f} to {:.1f}", bin.low, bin.high), std::to_string(bin.cases),
                          bin.cases > 0 ? fmt::format("{:.2f}", bin.confidence) : "-",
                          bin.cases > 0 ? fmt::format("{:.2f}", bin.right) : "-"});
    if (bin.cases == 0) continue;
    points.x.push_back(bin.confidence);
    points.y.push_back(bin.right);
  }
  plot.curves.push_back({"perfect", {0.0, 1.0}, {0.0, 1.0}, false});
  plot.curves.push_back(std::move(points));
  section.blocks.emplace_back(
      Text{fmt::format("Expected calibration error {:.3f}: the mean distance between what is "
                       "stated and what came true.",
                       score.expected_calibration_error())});
  section.blocks.emplace_back(std::move(table));
  section.blocks.emplace_back(std::move(plot));
  return section;
}

/// What was not named: could the recording show it, and did the answer say so?
Section misses_section(const Score& score) {
  Section section{"misses", "What was not named, and whether it could be", {}};
  Table table;
  table.id = "misses";
  table.header = {"case", "hidden", "answer", "not named", "evidence if told", "hidden size", "would show from", ""};
  for (const auto& one : score.judgements()) {
    for (const NotNamed& effect : one.not_named) {
      const bool told = one.told.has_value();
      table.rows.push_back({one.name, one.truth, one.answer, effect.id, told ? fmt::format("{:.1f}", *one.told) : "",
                            effect.compared() ? fmt::format("{:.3g} ({})", effect.hidden, effect.key) : "",
                            effect.compared() ? fmt::format("{:.3g}", effect.could_show_from) : "",
                            !one.decidable()    ? "too little even for one who is told"
                            : effect.was_told() ? "told that it would not show"
                                                : "should have been found"});
    }
  }
  const Score::Undecidable hard = score.undecidable();
  section.blocks.emplace_back(Text{fmt::format(
      "Evidence if told: what the recording says, in natural logarithms, for the hidden effect that shows least, to an "
      "analysis that is told the answer. An answer needs 8. Of {} listed effects or pairs that were not answered "
      "rightly {} have less. With every answer stands from which size each other effect would have shown in this "
      "recording: of {} effects that were not named, and whose size is given in the same unit, {} were smaller than "
      "that.",
      hard.wrong, hard.undecidable, hard.compared, hard.said_so)});
  section.blocks.emplace_back(std::move(table));
  return section;
}

Section cases_section(const Score& score) {
  Section section{"cases", "Every case", {}};
  Table table;
  table.id = "cases";
  table.header = {"case", "hidden", "noise widths, left", "evidence if told", "answer", "confidence", "mm off",
                  "s",    "outcome"};
  for (const auto& one : score.judgements()) {
    table.rows.push_back({one.name, one.truth,
                          one.truth == "none" ? "" : fmt::format("{:.1f}, {:.1f}", one.strength, one.left),
                          one.told ? fmt::format("{:.0f}", *one.told) : "", one.answer,
                          one.confidence > 0 ? fmt::format("{:.2f}", one.confidence) : "",
                          one.location_error_mm ? fmt::format("{:.1f}", *one.location_error_mm) : "",
                          fmt::format("{:.1f}", one.seconds), name_of(one.outcome)});
  }
  section.blocks.emplace_back(std::move(table));
  return section;
}

}  // namespace

report::Report report_of(const Trial& trial, const std::optional<ExperimentTrial>& experiments) {
  report::Report report;
  report.title = "Blind trial: what did the simulation leave out?";
  report.header = {{"Cases", std::to_string(trial.score.judgements().size())},
                   {"Seed", std::to_string(trial.options.seed)},
                   {"Promises kept", fmt::format("{} of {}", trial.seals_kept, trial.options.cases)},
                   {"Time", fmt::format("{:.0f} s", trial.seconds)}};
  report.sections = {figures_section(trial),           method_section(trial),       confusion_section(trial.score),
                     improvement_section(trial.score), misses_section(trial.score), calibration_section(trial.score),
                     cases_section(trial.score)};
  if (experiments) report.sections.insert(report.sections.end() - 1, experiments_section(*experiments));
  report.provenance = fmt::format("Zerodrift {}, commitments {}", ZERODRIFT_VERSION, trial.digest.substr(0, 16));
  return report;
}

}  // namespace zerodrift::proof
