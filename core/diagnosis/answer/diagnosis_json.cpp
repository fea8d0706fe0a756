#include <cmath>
#include <nlohmann/json.hpp>

#include "core/diagnosis/answer/sentences.h"
#include "core/diagnosis/diagnosis.h"

namespace zerodrift::diagnosis {
namespace {

using nlohmann::json;

json text_or_null(const std::string& text) {
  return text.empty() ? json() : json(text);
}

json json_of(const FoundEffect& effect) {
  json out = {{"id", effect.id},
              {"component", text_or_null(effect.component)},
              {"position_mm", effect.position_mm ? json(*effect.position_mm) : json()},
              {"channel", text_or_null(effect.channel)},
              {"parameters", effect.parameters},
              {"sigma", effect.sigma},
              {"at_rpm", effect.at_rpm},
              {"confidence", effect.confidence},
              {"explanation", effect.explanation.english},
              {"said", to_json(effect.explanation)},
              {"log_evidence_gain", effect.log_evidence_gain},
              {"contribution", effect.contribution}};
  for (const auto& [key, value] : effect.words) {
    if (key != "component" && key != "channel") out["parameters"][key] = value;
  }
  if (!effect.intervals_s.empty()) {
    out["intervals_s"] = json::array();
    for (const auto& [from_s, to_s] : effect.intervals_s) out["intervals_s"].push_back({from_s, to_s});
  }
  if (!effect.recording.empty()) out["recording"] = effect.recording;
  if (effect.heat) out["heat_W"] = {{"mean", effect.heat->mean_W}, {"sigma", effect.heat->sigma_W}};
  if (effect.between_mm) out["between_mm"] = {effect.between_mm->first, effect.between_mm->second};
  if (!effect.bounds_reached.empty()) out["bounds_reached"] = effect.bounds_reached;
  return out;
}

json json_of(const Mismatch& m) {
  json out = {{"channels", m.channels}, {"component", text_or_null(m.component)},
              {"regime", m.regime},     {"missing_heat_W", m.missing_heat_W},
              {"position_mm", json()},  {"time_s", json::array()}};
  if (m.position_mm) {
    out["position_mm"] = {m.position_mm->first, m.position_mm->second};
    out["best_position_mm"] = m.best_position_mm;
  }
  for (const auto& [from, to] : m.time_s) out["time_s"].push_back({from, to});
  return out;
}

}  // namespace

json to_json(const Diagnosis& diagnosis) {
  json out = {{"format", "zerodrift-diagnosis/2"},
              {"verdict", std::string(name_of(diagnosis.verdict))},
              {"mismatch", json_of(diagnosis.mismatch)},
              {"effects", json::array()},
              {"ambiguous_with", json::array()},
              {"suggested_experiment", json()},
              {"notes", json::array()},
              {"excess", {{"before", diagnosis.excess_before}, {"after", diagnosis.excess_after}}},
              {"doubtful", diagnosis.doubtful},
              {"seconds", diagnosis.seconds}};
  for (const Note& note : diagnosis.notes) {
    json one = note.facts;
    one["code"] = std::string(name_of(note.code));
    out["notes"].push_back(std::move(one));
  }
  for (const Tried& one : diagnosis.tried) {
    out["tried"].push_back({{"effects", one.effects},
                            {"mistakes", one.mistakes},
                            {"probability", one.probability},
                            {"behind", one.behind}});
  }
  for (const auto& effect : diagnosis.effects) out["effects"].push_back(json_of(effect));
  for (const auto& rival : diagnosis.ambiguous_with) {
    out["ambiguous_with"].push_back({{"id", rival.id},
                                     {"why", rival.why.english},
                                     {"said", to_json(rival.why)},
                                     {"component", text_or_null(rival.component)},
                                     {"channel", text_or_null(rival.channel)},
                                     {"position_mm", rival.position_mm ? json(*rival.position_mm) : json()},
                                     {"behind", rival.behind}});
  }
  if (diagnosis.suggested && !diagnosis.suggested->text.english.empty()) {
    const std::string& plan = diagnosis.suggested->plan_json;
    out["suggested_experiment"] = {{"text", diagnosis.suggested->text.english},
                                   {"said", to_json(diagnosis.suggested->text)},
                                   {"plan", plan.empty() ? json() : json::parse(plan)}};
  }
  json rmse = {{"before", json::object()},          {"refitted", json::object()},
               {"after", json::object()},           {"noise", json::object()},
               {"held_out_before", json::object()}, {"held_out_refitted", json::object()},
               {"held_out_after", json::object()}};
  for (const auto& channel : diagnosis.channels) {
    rmse["before"][channel.channel] = channel.rms_nominal;
    rmse["refitted"][channel.channel] = channel.rms_refitted;
    rmse["after"][channel.channel] = channel.rms_explained;
    rmse["noise"][channel.channel] = channel.noise;
  }
  // Several held-out recordings: the root of the mean square, and each on its own beside it.
  const auto pooled = [&](auto member) {
    std::map<std::string, std::pair<double, int>> sum;
    for (const auto& other : diagnosis.held_out) {
      for (const auto& [channel, rms] : other.*member) {
        sum[channel].first += rms * rms;
        ++sum[channel].second;
      }
    }
    json values = json::object();
    for (const auto& [channel, s] : sum) values[channel] = std::sqrt(s.first / s.second);
    return values;
  };
  rmse["held_out_before"] = pooled(&HeldOut::nominal);
  rmse["held_out_refitted"] = pooled(&HeldOut::refitted);
  rmse["held_out_after"] = pooled(&HeldOut::explained);
  out["rmse"] = rmse;
  out["channels"] = json::array();
  for (const auto& channel : diagnosis.channels) {
    json one = {{"channel", channel.channel},
                {"verdict", std::string(name_of(channel.verdict))},
                {"rms_before", channel.rms_nominal},
                {"rms_after", channel.rms_explained},
                {"noise", channel.noise},
                {"missing_heat_W", channel.missing_heat_W},
                {"time_s", json::array()}};
    for (const auto& [from_s, to_s] : channel.time_s) one["time_s"].push_back({from_s, to_s});
    out["channels"].push_back(std::move(one));
  }
  for (const auto& other : diagnosis.held_out) {
    out["held_out"].push_back({{"recording", other.recording},
                               {"before", other.nominal},
                               {"refitted", other.refitted},
                               {"after", other.explained}});
  }
  for (const auto& one : diagnosis.detectable) {
    json& least = out["could_have_detected"][one.id] = {{"key", one.key}, {"value", one.value}};
    if (one.at_rpm > 0.0) least["at_rpm"] = one.at_rpm;
  }
  out["findings"] = json::array();
  for (const auto& [recording, finding] : diagnosis.findings) {
    json one = analysis::to_json({finding}).front();
    one["recording"] = recording;
    out["findings"].push_back(std::move(one));
  }
  out["said"] = json::array();
  for (const auto& sentence : diagnosis.sentences) {
    out["sentences"].push_back(sentence.english);
    out["said"].push_back(to_json(sentence));
  }
  return out;
}

}  // namespace zerodrift::diagnosis
