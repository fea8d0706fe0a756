// Figures of tests for thermal effects by ISO 230-3: ranges in the first 60 min and over the whole period, tilt, room.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/report/build.h"
#include "core/report/pieces.h"

namespace zerodrift::report {
namespace {

constexpr double first_hour_s = 3600.0;
constexpr double whole_s = 1e12;

/// Which test of the standard a plan is, by what moves in it.
const char* test_of(const nlohmann::json& plan) {
  bool turns = false;
  bool travels = false;
  bool cools = false;
  for (const auto& step : list_of(plan, "steps")) {
    turns = turns || step.value("spindle_rpm", 0.0) > 0.0;
    travels = travels || step.value("path", "still") == "cycle";
    cools = cools || step.value("coolant_on", false);
  }
  if (list_of(plan, "steps").empty()) return "plan not kept in the job";
  if (!turns && !travels) return cools ? "Machine at rest, coolant on" : "ETVE (clause 5)";
  if (turns && travels) return "Spindle and axes together";
  return turns ? "Spindle (clause 6)" : "Linear axes (clause 7)";
}

Trace range_trace(const Source& source, const LoadedArtefact& artefact, const LoadedRun& run,
                  const std::string& channel, const Extremes& extremes) {
  std::vector<TraceRow> rows;
  if (extremes.lowest) rows = {row_of(run, channel, *extremes.lowest), row_of(run, channel, *extremes.highest)};
  return of_rows(source, artefact, "warmup", "largest minus smallest " + channel, std::move(rows));
}

/// The fastest change of the room within an hour, K/h.
double room_slope(const recording::Recording& run) {
  const auto* room = run.find("ambient_C");
  if (room == nullptr || run.rows() < 2) return std::nan("");
  double steepest = 0.0;
  double next = run.time_s.front();  // each quarter of an hour in which there is a row
  for (const double from : run.time_s) {
    if (from + first_hour_s > run.time_s.back()) break;
    if (from < next) continue;
    next = from + first_hour_s / 4.0;
    steepest = std::max(steepest, std::abs(recording::value_at(run, *room, from + first_hour_s) -
                                           recording::value_at(run, *room, from)));
  }
  return steepest;
}

Table ranges_of(const Source& source, const LoadedArtefact& artefact, const LoadedRun& run, bool latest,
                std::size_t number) {
  Table table;
  const std::string suffix = latest ? std::string() : fmt::format("_run{}", number);
  table.id = "ranges" + suffix;
  const auto plan = object_of(artefact.body, "plan");
  table.title =
      source.tell("Run {} of {} UTC: {}, {} min", number, minute_of(artefact.created_utc), source.say(test_of(plan)),
                  shown((run.samples.time_s.back() - run.samples.time_s.front()) / 60.0, 0));
  table.header = {source.say("direction"), source.say("range in the first 60 min"),
                  source.say("range over the whole period"), source.say("at the end"), source.say("unit")};
  table.trace = source.trace("warmup", "series");
  auto channels = run.samples.names(recording::ChannelKind::error);
  const auto tilts = run.samples.names(recording::ChannelKind::tilt);
  channels.insert(channels.end(), tilts.begin(), tilts.end());
  for (const auto& channel : channels) {
    const auto hour = extremes_of(run.samples, channel, first_hour_s);
    const auto whole = extremes_of(run.samples, channel, whole_s);
    if (!whole.lowest) continue;
    const bool tilt = recording::kind_of(channel) == recording::ChannelKind::tilt;
    const std::string axis = tag_of(channel, source.labels());
    const std::string unit = tilt ? "urad" : "um";
    const auto* values = run.samples.find(channel);
    table.rows.push_back({tilt ? source.tell("Tilt {}", axis) : axis,
                          cell(hour.range(), 1, fmt::format("range_60min_{}_{}{}", axis, unit, suffix),
                               range_trace(source, artefact, run, channel, hour)),
                          cell(whole.range(), 1, fmt::format("range_total_{}_{}{}", axis, unit, suffix),
                               range_trace(source, artefact, run, channel, whole)),
                          shown(recording::value_at(run.samples, *values, run.samples.time_s.back()), 1),
                          tilt ? "µrad" : "µm"});
  }
  return table;
}

Figures room_of(const Source& source, const LoadedArtefact& artefact, const LoadedRun& run) {
  Figures figures;
  const auto room = extremes_of(run.samples, "ambient_C", whole_s);
  if (!room.lowest) return figures;
  const Trace trace = range_trace(source, artefact, run, "ambient_C", room);
  figures.figures = {
      figure("room_low_C", source.say("Room, lowest"), shown(room.low, 1), "°C", trace),
      figure("room_high_C", source.say("Room, highest"), shown(room.high, 1), "°C", trace),
      figure("room_slope_K_h", source.say("Room, fastest change"), shown(room_slope(run.samples), 2), "K/h", trace)};
  return figures;
}

}  // namespace

std::optional<Section> iso230_3_section(const Source& source) {
  const LoadedArtefact* latest = source.find("warmup");
  if (source.run(latest) == nullptr || source.run(latest)->samples.rows() == 0) return std::nullopt;
  Section section{"iso230_3", source.say("Thermal effects by ISO 230-3"), {}};
  const auto& runs = source.history("warmup");
  bool environment = false;
  bool combined = false;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const LoadedRun* run = source.run(&runs[i]);
    if (run == nullptr || run->samples.rows() == 0) continue;
    const std::string test = test_of(object_of(runs[i].body, "plan"));
    environment = environment || test.starts_with("ETVE");
    combined = combined || test.starts_with("Spindle and");
    section.blocks.emplace_back(ranges_of(source, runs[i], *run, &runs[i] == latest, i + 1));
  }
  if (auto room = room_of(source, *latest, *source.run(latest)); !room.figures.empty()) {
    section.blocks.emplace_back(std::move(room));
  }
  if (combined) {
    section.blocks.emplace_back(
        Text{source.say("Spindle and axes ran together in one warm-up: the ranges are formed as in the standard, but "
                        "they are not those of its separate spindle and axis tests."),
             false});
  }
  if (!environment) {
    section.blocks.emplace_back(
        Text{source.say("No test of the environment alone (ETVE) is in this job: what the room contributes is not "
                        "separated."),
             false});
  }
  return section;
}

}  // namespace zerodrift::report
