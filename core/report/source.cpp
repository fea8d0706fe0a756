#include "core/report/source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/report/naming.h"

namespace zerodrift::report {

using nlohmann::json;

Result<Source> Source::load(const commissioning::Job& job, Words words) {
  Source source;
  source.m_words = std::move(words);
  source.m_created_utc = job.created_utc();
  ZD_TRY(source.m_header, job.header());
  ZD_TRY(source.m_header_changes, job.header_changes());
  ZD_TRY(const auto kinds, job.kinds());
  for (const auto& kind : kinds) {
    ZD_TRY(const auto history, job.history(kind));
    for (const auto& one : history) {
      ZD_TRY(json body, one.document());
      source.m_artefacts[kind].push_back(
          {one.id, one.created_utc, one.content_hash, one.made_by, one.engineer, one.inputs, std::move(body)});
      const json& kept = source.m_artefacts[kind].back().body;
      const auto series = kept.find("series");
      if (series == kept.end() || !series->is_number_integer()) continue;
      const auto id = series->get<commissioning::SeriesId>();
      if (source.m_runs.contains(id)) continue;
      LoadedRun run;
      ZD_TRY(run.info, job.series_info(id));
      ZD_TRY(run.samples, job.read_series(id));
      ZD_TRY(run.events, job.events(id));
      source.m_runs.emplace(id, std::move(run));
    }
  }
  if (const LoadedArtefact* machine = source.find("machine")) {
    for (const auto& sensor : list_of(machine->body, "health")) {
      source.m_labels[text_of(sensor, "channel")] = source.say(sensor.value("label", ""));
    }
  }
  if (const LoadedArtefact* warmup = source.find("warmup")) {
    add_imported(source.m_labels, warmup->body.value("import", json()));
  }
  ZD_TRY(source.m_audit, job.audit_trail());
  source.m_audit_is_whole = job.verify_audit().has_value();
  return source;
}

const std::vector<LoadedArtefact>& Source::history(const std::string& kind) const {
  static const std::vector<LoadedArtefact> none;
  const auto at = m_artefacts.find(kind);
  return at == m_artefacts.end() ? none : at->second;
}

const LoadedArtefact* Source::find(const std::string& kind) const {
  const auto& all = history(kind);
  return all.empty() ? nullptr : &all.back();
}

const LoadedRun* Source::run(const LoadedArtefact* artefact) const {
  if (artefact == nullptr) return nullptr;
  const auto series = artefact->body.find("series");
  if (series == artefact->body.end() || !series->is_number_integer()) return nullptr;
  const auto found = m_runs.find(series->get<commissioning::SeriesId>());
  return found == m_runs.end() ? nullptr : &found->second;
}

const recording::Recording* Source::run_of(const std::string& kind) const {
  const LoadedRun* loaded = run(find(kind));
  return loaded == nullptr ? nullptr : &loaded->samples;
}

Trace Source::trace(const std::string& kind, std::string detail) const {
  const LoadedArtefact* artefact = find(kind);
  return {kind, artefact == nullptr ? 0 : artefact->id, std::move(detail)};
}

Trace Source::at(const std::string& kind, const std::string& pointer) const {
  Trace made = trace(kind, pointer);
  made.pointer = pointer;
  return made;
}

std::string Source::in_words(const std::string& text) const {
  return with_names(say(text));
}

std::string Source::with_names(const std::string& text) const {
  if (!m_words) return readable(text, m_labels);
  return readable(text, m_labels, [this](const std::string& channel) { return channel_in_words(channel); });
}

std::string Source::channel_in_words(const std::string& channel) const {
  return say(report::channel_in_words(channel, m_labels));
}

double longest_hole_s(const recording::Recording* run) {
  double hole_s = 0.0;
  for (std::size_t r = 1; run != nullptr && r < run->rows(); ++r) {
    hole_s = std::max(hole_s, run->time_s[r] - run->time_s[r - 1]);
  }
  return hole_s;
}

std::string shown(double value, int digits) {
  if (!std::isfinite(value)) return "-";
  std::string text = fmt::format("{:.{}f}", value, digits);
  // A zero has no sign: "-0.0" would say that something was measured below zero.
  if (text.front() == '-' && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
  return text;
}

double number_of(const json& body, const std::string& key) {
  const auto at = body.find(key);
  return at != body.end() && at->is_number() ? at->get<double>() : std::numeric_limits<double>::quiet_NaN();
}

double number_of(const json& body, const std::string& key, const std::string& direction) {
  const auto at = body.find(key);
  return at != body.end() && at->is_object() ? number_of(*at, direction) : std::numeric_limits<double>::quiet_NaN();
}

std::string text_of(const json& body, const std::string& key) {
  const auto at = body.find(key);
  if (at == body.end() || at->is_null()) return "-";
  return at->is_string() ? at->get<std::string>() : at->dump();
}

json list_of(const json& body, const std::string& key) {
  const auto at = body.find(key);
  return at != body.end() && at->is_array() ? *at : json::array();
}

json object_of(const json& body, const std::string& key) {
  const auto at = body.find(key);
  return at != body.end() && at->is_object() ? *at : json::object();
}

std::vector<std::string> directions_of(const json& body, const std::string& key) {
  std::vector<std::string> directions;
  for (const char* direction : {"X", "Y", "Z"}) {
    if (std::isfinite(number_of(body, key, direction))) directions.emplace_back(direction);
  }
  return directions;
}

std::string minute_of(const std::string& utc) {
  constexpr std::size_t minutes = 16;
  if (utc.size() < minutes || utc[10] != 'T') return utc;
  return utc.substr(0, 10) + " " + utc.substr(11, 5);
}

/// For legends: "T14", "X", "Room".
static std::string short_name(const std::string& channel, const Labels& labels) {
  const auto kind = recording::kind_of(channel);
  const bool sensor = kind == recording::ChannelKind::temperature || kind == recording::ChannelKind::error;
  return sensor ? tag_of(channel, labels) : channel_in_words(channel, labels);
}

Hue hue_of(const std::string& channel, const Labels& labels) {
  const std::string axis = recording::kind_of(channel) == recording::ChannelKind::error ? tag_of(channel, labels) : "";
  if (axis == "X") return Hue::x;
  if (axis == "Y") return Hue::y;
  if (axis == "Z") return Hue::z;
  return channel == "ambient_C" ? Hue::room : Hue::order;
}

std::vector<Curve> curves_of(const recording::Recording& run, const std::vector<std::string>& channels, bool points,
                             const Labels& labels) {
  std::vector<Curve> curves;
  for (const auto& name : channels) {
    const auto* channel = run.find(name);
    if (channel == nullptr) continue;
    Curve curve{short_name(name, labels), {}, {}, points, hue_of(name, labels)};
    for (std::size_t r = 0; r < run.rows(); ++r) {
      if (std::isnan(channel->values[r])) continue;
      curve.x.push_back((run.time_s[r] - run.time_s.front()) / 3600.0);
      curve.y.push_back(channel->values[r]);
    }
    if (!curve.x.empty()) curves.push_back(std::move(curve));
  }
  return curves;
}

TraceRow row_of(const LoadedRun& run, const std::string& channel, std::size_t row) {
  const auto* values = run.samples.find(channel);
  return {run.info.id, static_cast<long long>(row), run.samples.time_s.at(row), channel,
          values == nullptr ? std::nan("") : values->values.at(row)};
}

Extremes extremes_of(const recording::Recording& run, const std::string& channel, double until_s) {
  Extremes found;
  const auto* values = run.find(channel);
  if (values == nullptr) return found;
  for (std::size_t r = 0; r < run.rows(); ++r) {
    const double value = values->values[r];
    if (std::isnan(value) || run.time_s[r] - run.time_s.front() > until_s) continue;
    if (!found.lowest || value < values->values[*found.lowest]) found.lowest = r;
    if (!found.highest || value > values->values[*found.highest]) found.highest = r;
    if (!found.largest || std::abs(value) > std::abs(values->values[*found.largest])) found.largest = r;
  }
  found.low = found.lowest ? values->values[*found.lowest] : std::nan("");
  found.high = found.highest ? values->values[*found.highest] : std::nan("");
  return found;
}

}  // namespace zerodrift::report
