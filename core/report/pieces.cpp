#include "core/report/pieces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/acquisition/happening.h"

namespace zerodrift::report {

using nlohmann::json;

Cell cell(double value, int digits, std::string id, Trace trace) {
  return {shown(value, digits), std::move(id), std::move(trace)};
}

Figure figure(std::string id, std::string label, std::string value, std::string unit, Trace trace) {
  Figure made;
  made.id = std::move(id);
  made.label = std::move(label);
  made.value = std::move(value);
  made.unit = std::move(unit);
  made.trace = std::move(trace);
  return made;
}

Figure judged(const Source& source, Figure made, double value, double limit, int digits) {
  if (!std::isfinite(limit)) return made;
  const bool kept = value <= limit;
  made.limit = source.tell(kept ? "limit {} {}: kept" : "limit {} {}: exceeded", shown(limit, digits), made.unit);
  made.verdict = kept ? Verdict::good : Verdict::bad;
  return made;
}

Trace of_rows(const Source& source, const LoadedArtefact& artefact, const std::string& kind, std::string detail,
              std::vector<TraceRow> rows) {
  Trace made = source.trace(kind, std::move(detail));
  made.id = artefact.id;
  made.rows = std::move(rows);
  return made;
}

/// "3000 rpm", with what else runs.
static std::string step_in_words(const Source& source, const json& step) {
  std::string text = shown(number_of(step, "spindle_rpm"), 0) + " rpm";
  if (step.value("coolant_on", false)) text += " · " + source.say("coolant");
  return text;
}

struct Pause {
  double from_s = 0.0;
  double to_s = 0.0;
};

/// By time. One that was not ended lasts as long as the run.
static std::vector<Pause> pauses_of(const LoadedRun& run) {
  std::vector<Pause> pauses;
  bool open = false;
  for (const auto& event : run.events) {
    if (event.kind == "pause" && !std::exchange(open, true)) pauses.push_back({event.time_s, event.time_s});
    if (event.kind == "resume" && std::exchange(open, false)) pauses.back().to_s = event.time_s;
  }
  if (open && run.samples.rows() > 0) pauses.back().to_s = std::max(pauses.back().to_s, run.samples.time_s.back());
  return pauses;
}

void break_at_pauses(const LoadedRun& run, std::vector<Curve>& curves) {
  for (const Pause& pause : pauses_of(run)) {
    const double from_h = pause.from_s / 3600.0;
    const double to_h = pause.to_s / 3600.0;
    for (Curve& curve : curves) {
      const auto next = std::upper_bound(curve.x.begin(), curve.x.end(), from_h);
      if (next == curve.x.begin() || next == curve.x.end() || *next < to_h) continue;  // it goes on in the pause
      const auto index = next - curve.x.begin();
      curve.x.insert(curve.x.begin() + index, from_h);
      curve.y.insert(curve.y.begin() + index, std::nan(""));
    }
  }
}

void add_course(const Source& source, const LoadedArtefact& artefact, Plot& plot) {
  const json steps = list_of(object_of(artefact.body, "plan"), "steps");
  double fastest = 1.0;
  for (const auto& step : steps) fastest = std::max(fastest, step.value("spindle_rpm", 0.0));
  const LoadedRun* run = source.run(&artefact);
  const auto pauses = run == nullptr ? std::vector<Pause>{} : pauses_of(*run);
  auto pause = pauses.begin();
  double at_s = 0.0;
  for (const auto& step : steps) {
    double left_s = step.value("duration_s", 0.0);
    const auto stretch = [&](double until_s) {
      plot.stretches.push_back(
          {at_s / 3600.0, until_s / 3600.0, step.value("spindle_rpm", 0.0) / fastest, step_in_words(source, step)});
      left_s -= until_s - at_s;
      at_s = until_s;
    };
    // The plan waits while the run pauses.
    for (; pause != pauses.end() && pause->from_s < at_s + left_s; ++pause) {
      if (pause->from_s > at_s) stretch(pause->from_s);
      at_s = std::max(at_s, pause->to_s);
    }
    stretch(at_s + left_s);
  }
  if (run == nullptr) return;
  break_at_pauses(*run, plot.curves);
  for (const auto& one : happenings_of(source, *run)) {
    plot.marks.push_back({one.time_s / 3600.0, std::to_string(one.number)});
  }
}

namespace {

/// Which one an event is about.
std::string particulars_of(const commissioning::Event& event) {
  const json details = json::parse(event.details, nullptr, false);
  if (!details.is_object()) return {};
  const json values = object_of(details, "context");
  std::map<std::string, std::string> context;
  for (const auto& [key, value] : values.items()) {
    if (value.is_string()) context[key] = value.get<std::string>();
  }
  return acquisition::Tally::particulars_of(context);
}

}  // namespace

std::vector<Happening> happenings_of(const Source& source, const LoadedRun& run) {
  static const std::map<std::string, const char*> kinds = {
      {"note", "note"},       {"pause", "pause"},          {"resume", "resumed"}, {"gap", "gap"},
      {"problem", "problem"}, {"cleared", "problem over"}, {"clock", "clock"}};
  std::vector<Happening> all;
  for (const auto& event : run.events) {
    const auto kind = kinds.find(event.kind);
    if (kind == kinds.end()) continue;
    std::string text = event.text;
    // What a person wrote stays as it was written; identifiers become words.
    if (event.kind != "note") {
      std::replace(text.begin(), text.end(), '_', ' ');
      text = source.in_words(text);
      if (const std::string about = particulars_of(event); !about.empty()) text += " (" + source.in_words(about) + ")";
    }
    all.push_back({static_cast<int>(all.size()) + 1, event.time_s, source.say(kind->second), std::move(text)});
  }
  return all;
}

}  // namespace zerodrift::report
