// The warm-up run: errors, temperatures and inputs over the steps of its plan, with what happened on the way.

#include <algorithm>
#include <cmath>

#include "core/report/build.h"
#include "core/report/pieces.h"

namespace zerodrift::report {
namespace {

Plot plot_of(const Source& source, const LoadedRun& run, const std::vector<std::string>& channels, const char* id,
             const char* title, const char* unit) {
  Plot plot;
  plot.id = id;
  plot.title = source.say(title);
  plot.x_label = source.say("hours");
  plot.y_label = unit;
  plot.curves = curves_of(run.samples, channels, false, source.labels());
  for (auto& curve : plot.curves) curve.name = source.say(curve.name);
  plot.trace = source.trace("warmup", "series");
  add_course(source, *source.find("warmup"), plot);
  return plot;
}

Table steps_of(const Source& source) {
  Table table;
  table.id = "plan";
  table.title = source.tell("Plan: {}", source.say(text_of(object_of(source.find("warmup")->body, "plan"), "name")));
  table.header = {source.say("step"), source.say("minutes"), source.say("spindle, rpm"), source.say("coolant"),
                  source.say("axes")};
  table.trace = source.at("warmup", "/plan");
  int number = 0;
  for (const auto& step : list_of(object_of(source.find("warmup")->body, "plan"), "steps")) {
    table.rows.push_back({std::to_string(++number), shown(number_of(step, "duration_s") / 60.0, 0),
                          shown(number_of(step, "spindle_rpm"), 0),
                          source.say(step.value("coolant_on", false) ? "on" : "off"),
                          source.say(step.value("path", "still") == "cycle" ? "run the path" : "stand still")});
  }
  return table;
}

Table notes_of(const Source& source, const LoadedRun& run) {
  Table table;
  table.id = "happenings";
  table.title = source.say("What happened during the run (numbers as in the plots)");
  table.header = {source.say("no."), source.say("after, min"), source.say("what"), source.say("text")};
  table.trace = source.trace("warmup", "events");
  for (const auto& one : happenings_of(source, run)) {
    table.rows.push_back({std::to_string(one.number), shown(one.time_s / 60.0, 1), one.what, one.text});
  }
  return table;
}

/// Start, end and largest rise of each sensor: ISO 230-3 wants the temperatures beside the distortions.
Table temperatures_of(const Source& source, const LoadedRun& run) {
  Table table;
  table.id = "rises";
  table.title = source.say("Temperatures of the run");
  table.header = {source.say("sensor"), source.say("start, °C"), source.say("end, °C"), source.say("largest rise, K"),
                  source.say("after, min")};
  table.trace = source.trace("warmup", "series");
  auto channels = run.samples.names(recording::ChannelKind::temperature);
  const auto room = run.samples.names(recording::ChannelKind::ambient);
  channels.insert(channels.begin(), room.begin(), room.end());
  for (const auto& channel : channels) {
    const auto extremes = extremes_of(run.samples, channel, 1e12);
    if (!extremes.highest) continue;
    const auto* values = run.samples.find(channel);
    const double start = recording::value_at(run.samples, *values, run.samples.time_s.front());
    const double end = recording::value_at(run.samples, *values, run.samples.time_s.back());
    const Trace trace =
        of_rows(source, *source.find("warmup"), "warmup", channel, {row_of(run, channel, *extremes.highest)});
    table.rows.push_back({source.channel_in_words(channel), shown(start, 2), shown(end, 2),
                          cell(extremes.high - start, 2, "rise_" + channel.substr(0, channel.find('_')) + "_K", trace),
                          shown((run.samples.time_s[*extremes.highest] - run.samples.time_s.front()) / 60.0, 0)});
  }
  return table;
}

/// What else was recorded on this machine, and what each run serves for.
Table further_runs_of(const Source& source) {
  Table table;
  table.id = "further_recordings";
  table.title = source.say("Further recordings");
  table.header = {source.say("name"),         source.say("serves as"), source.say("hours"), source.say("rows"),
                  source.say("temperatures"), source.say("errors"),    source.say("file")};
  table.trace = source.at("recordings", "/recordings");
  const LoadedArtefact* kept = source.find("recordings");
  if (kept == nullptr) return table;
  int number = 0;
  for (const auto& one : list_of(kept->body, "recordings")) {
    const std::string pointer = fmt::format("/recordings/{}/", number++);
    const std::string role = text_of(one, "role");
    const auto count = [&](const char* key) {
      return cell(number_of(one, key), 0, fmt::format("recording_{}_{}", number, key),
                  source.at("recordings", pointer + key));
    };
    table.rows.push_back({text_of(one, "name"),
                          source.say(role == "cooling"    ? "cooling"
                                     : role == "training" ? "training"
                                                          : "another day"),
                          shown(number_of(one, "duration_s") / 3600.0, 1), count("rows"), count("temperatures"),
                          count("errors"), text_of(one, "file")});
  }
  return table;
}

}  // namespace

std::optional<Section> warmup_section(const Source& source) {
  const LoadedRun* run = source.run(source.find("warmup"));
  if (run == nullptr || run->samples.rows() == 0) return std::nullopt;
  Section section{"warmup", source.say("Warm-up run"), {}};
  if (auto steps = steps_of(source); !steps.rows.empty()) section.blocks.emplace_back(std::move(steps));
  const auto errors = run->samples.names(recording::ChannelKind::error);
  if (!errors.empty()) section.blocks.emplace_back(plot_of(source, *run, errors, "errors", "Errors at the nose", "µm"));
  const auto tilts = run->samples.names(recording::ChannelKind::tilt);
  if (!tilts.empty()) section.blocks.emplace_back(plot_of(source, *run, tilts, "tilts", "Tilt at the nose", "µrad"));
  auto temperatures = run->samples.names(recording::ChannelKind::temperature);
  const auto room = run->samples.names(recording::ChannelKind::ambient);
  temperatures.insert(temperatures.end(), room.begin(), room.end());
  section.blocks.emplace_back(plot_of(source, *run, temperatures, "temperatures", "Temperatures", "°C"));
  if (run->samples.find("spindle_rpm") != nullptr) {
    section.blocks.emplace_back(plot_of(source, *run, {"spindle_rpm"}, "speed", "Spindle speed", "rpm"));
  }
  if (auto notes = notes_of(source, *run); !notes.rows.empty()) section.blocks.emplace_back(std::move(notes));
  section.blocks.emplace_back(temperatures_of(source, *run));
  if (auto further = further_runs_of(source); !further.rows.empty()) section.blocks.emplace_back(std::move(further));
  return section;
}

}  // namespace zerodrift::report
