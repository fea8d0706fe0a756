#include "core/analysis/findings.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace zerodrift::analysis {
namespace {

std::string_view sentence_of(FindingKind kind) {
  switch (kind) {
    case FindingKind::dead_sensor:
      return "gives no samples";
    case FindingKind::sensor_died:
      return "stopped during the run";
    case FindingKind::constant_sensor:
      return "never moves";
    case FindingKind::duplicate_sensor:
      return "repeats another sensor";
    case FindingKind::dropout:
      return "dropped out for a while";
    case FindingKind::spikes:
      return "has isolated spikes";
    case FindingKind::gaps:
      return "has gaps";
    case FindingKind::fahrenheit:
      return "may be in degrees Fahrenheit but was taken as degrees Celsius: give its unit in the column map";
    case FindingKind::kelvin:
      return "may be in kelvin but was taken as degrees Celsius: give its unit in the column map";
    case FindingKind::implausible:
      return "has values no machine tool reaches";
    case FindingKind::error_dead:
      return "holds no measurement";
    case FindingKind::error_never_moves:
      return "never moves";
    case FindingKind::weak_excitation:
      return "hardly warmed up in this run";
    case FindingKind::ill_conditioned:
      return "is nearly a combination of the others";
    case FindingKind::few_rows:
      return "has hardly more measurements than parameters";
    case FindingKind::extrapolation:
      return "is outside what the training saw";
    case FindingKind::not_in_every_run:
      return "is not in every recording";
    case FindingKind::doubtful_times:
      return "may not be in seconds: no machine tool warms so fast";
    case FindingKind::not_guaranteed:
      return "cannot be guaranteed from this recording";
  }
  return "";
}

}  // namespace

std::string_view name_of(FindingKind kind) {
  switch (kind) {
    case FindingKind::dead_sensor:
      return "dead_sensor";
    case FindingKind::sensor_died:
      return "sensor_died";
    case FindingKind::constant_sensor:
      return "constant_sensor";
    case FindingKind::duplicate_sensor:
      return "duplicate_sensor";
    case FindingKind::dropout:
      return "dropout";
    case FindingKind::spikes:
      return "spikes";
    case FindingKind::gaps:
      return "gaps";
    case FindingKind::fahrenheit:
      return "fahrenheit";
    case FindingKind::kelvin:
      return "kelvin";
    case FindingKind::implausible:
      return "implausible";
    case FindingKind::error_dead:
      return "error_dead";
    case FindingKind::error_never_moves:
      return "error_never_moves";
    case FindingKind::weak_excitation:
      return "weak_excitation";
    case FindingKind::ill_conditioned:
      return "ill_conditioned";
    case FindingKind::few_rows:
      return "few_rows";
    case FindingKind::extrapolation:
      return "extrapolation";
    case FindingKind::not_in_every_run:
      return "not_in_every_run";
    case FindingKind::doubtful_times:
      return "doubtful_times";
    case FindingKind::not_guaranteed:
      return "not_guaranteed";
  }
  return "";
}

std::string_view name_of(FindingAction action) {
  switch (action) {
    case FindingAction::noted:
      return "noted";
    case FindingAction::repaired:
      return "repaired";
    case FindingAction::dropped:
      return "dropped";
  }
  return "";
}

std::string describe(const Finding& finding) {
  std::string line = fmt::format("{} {}", finding.channel, sentence_of(finding.kind));
  if (!finding.detail.empty()) line += fmt::format(" ({})", finding.detail);
  if (finding.action == FindingAction::dropped) line += "; it is not used";
  return line;
}

nlohmann::json to_json(const std::vector<Finding>& findings) {
  nlohmann::json list = nlohmann::json::array();
  for (const auto& f : findings) {
    list.push_back({{"kind", name_of(f.kind)},
                    {"action", name_of(f.action)},
                    {"channel", f.channel},
                    {"detail", f.detail},
                    {"text", describe(f)}});
  }
  return list;
}

}  // namespace zerodrift::analysis
