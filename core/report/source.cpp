#include "core/report/source.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace zerodrift::report {

using nlohmann::json;

Result<Source> Source::load(const commissioning::Job& job, Words words) {
  Source source;
  source.m_words = std::move(words);
  ZD_TRY(source.m_header, job.header());
  ZD_TRY(const auto kinds, job.kinds());
  for (const auto& kind : kinds) {
    ZD_TRY(const auto latest, job.latest(kind));
    if (!latest) continue;
    ZD_TRY(json body, latest->document());
    if (const auto series = body.find("series"); series != body.end() && series->is_number_integer()) {
      ZD_TRY(source.m_runs[kind], job.read_series(series->get<commissioning::SeriesId>()));
    }
    source.m_artefacts[kind] = {latest->id,      latest->created_utc, latest->content_hash,
                                latest->made_by, latest->inputs,      std::move(body)};
  }
  if (const LoadedArtefact* machine = source.find("machine")) {
    for (const auto& sensor : machine->body.value("health", json::array())) {
      source.m_labels[text_of(sensor, "channel")] = sensor.value("label", "");
    }
  }
  ZD_TRY(source.m_audit, job.audit_trail());
  source.m_audit_is_whole = job.verify_audit().has_value();
  return source;
}

const LoadedArtefact* Source::find(const std::string& kind) const {
  const auto at = m_artefacts.find(kind);
  return at == m_artefacts.end() ? nullptr : &at->second;
}

const recording::Recording* Source::run_of(const std::string& kind) const {
  const auto at = m_runs.find(kind);
  return at == m_runs.end() ? nullptr : &at->second;
}

Trace Source::trace(const std::string& kind, std::string detail) const {
  const LoadedArtefact* artefact = find(kind);
  return {kind, artefact == nullptr ? 0 : artefact->id, std::move(detail)};
}

double longest_hole_s(const recording::Recording* run) {
  double hole_s = 0.0;
  for (std::size_t r = 1; run != nullptr && r < run->rows(); ++r) {
    hole_s = std::max(hole_s, run->time_s[r] - run->time_s[r - 1]);
  }
  return hole_s;
}

std::string shown(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : std::string("-");
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

std::vector<std::string> directions_of(const json& body, const std::string& key) {
  std::vector<std::string> directions;
  for (const char* direction : {"X", "Y", "Z"}) {
    if (std::isfinite(number_of(body, key, direction))) directions.emplace_back(direction);
  }
  return directions;
}

/// For legends: "T14", "X", "Room".
static std::string short_name(const std::string& channel) {
  const auto kind = recording::kind_of(channel);
  const std::string tag = channel.substr(0, channel.find('_'));
  if (kind == recording::ChannelKind::temperature) return tag;
  if (kind == recording::ChannelKind::error && tag.size() == 2 && tag[0] == 'd') return tag.substr(1);
  return channel_in_words(channel, {});
}

std::vector<Curve> curves_of(const recording::Recording& run, const std::vector<std::string>& channels, bool points) {
  std::vector<Curve> curves;
  for (const auto& name : channels) {
    const auto* channel = run.find(name);
    if (channel == nullptr) continue;
    Curve curve{short_name(name), {}, {}, points};
    for (std::size_t r = 0; r < run.rows(); ++r) {
      if (std::isnan(channel->values[r])) continue;
      curve.x.push_back((run.time_s[r] - run.time_s.front()) / 3600.0);
      curve.y.push_back(channel->values[r]);
    }
    if (!curve.x.empty()) curves.push_back(std::move(curve));
  }
  return curves;
}

}  // namespace zerodrift::report
