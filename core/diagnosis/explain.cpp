#include "core/diagnosis/explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/diagnosis/sentences.h"
#include "core/physics/effects/effect.h"

namespace zerodrift::diagnosis {
namespace {

std::string unit_of(const std::string& channel) {
  return channel.size() > 3 && channel.compare(channel.size() - 3, 3, "_um") == 0 ? "µm" : "K";
}

/// How a parameter is shown: a sign that is the same in every language, its unit, and the factor to that unit.
struct Shown {
  std::string_view key;
  std::string_view sign;
  std::string_view unit;
  double factor = 1.0;
};

constexpr std::array shown_parameters{Shown{"h_W_m2K", "h", "W/m²K"},
                                      Shown{"a_W_m2K", "a", "W/m²K"},
                                      Shown{"exponent", "m", ""},
                                      Shown{"emissivity", "ε", ""},
                                      Shown{"temperature_C", "T", "°C"},
                                      Shown{"beta_1_K", "β", "%/K", 100.0},
                                      Shown{"growth_1_K", "κ", "%/K", 100.0},
                                      Shown{"speed_share", "κn", "%", 100.0},
                                      Shown{"constant_share", "κ0", "%", 100.0},
                                      Shown{"power_W", "P", "W"},
                                      Shown{"resistance_m2K_W", "R", "mm²K/W", 1e6},
                                      Shown{"half_width_mm", "b", "mm"},
                                      Shown{"um_per_K", "g", "µm/K"},
                                      Shown{"um_per_W", "g", "µm/W"},
                                      Shown{"room_um_per_K", "g(room)", "µm/K"},
                                      Shown{"lag_s", "τ", "s"},
                                      Shown{"second_lag_s", "τ2", "s"},
                                      Shown{"offset_K", "ΔT", "K"},
                                      Shown{"drift_K_per_h", "drift", "K/h"},
                                      Shown{"gain_error", "gain", "%", 100.0},
                                      Shown{"share", "η", "%", 100.0},
                                      Shown{"excess_share", "excess", "%", 100.0},
                                      Shown{"step_um", "step", "µm"},
                                      Shown{"time_s", "t", "min", 1.0 / 60.0},
                                      Shown{"from_s", "from", "min", 1.0 / 60.0},
                                      Shown{"to_s", "to", "min", 1.0 / 60.0},
                                      Shown{"colder_K", "ΔT", "K"},
                                      Shown{"conductance_W_K", "G", "W/K"},
                                      Shown{"contact_W_K", "G", "W/K"},
                                      Shown{"room_lag_s", "τ(room)", "h", 1.0 / 3600.0},
                                      Shown{"heat_capacity_J_K", "C", "J/K"},
                                      Shown{"period_s", "period", "s"},
                                      Shown{"mean_W", "P", "W"},
                                      Shown{"slope_1_K", "slope", "%/K", 100.0}};

/// "12.7" with as many digits as the uncertainty deserves.
std::string number_of(double value, double sigma) {
  const double size = sigma > 0.0 ? sigma : std::abs(value) * 0.05;
  const int digits = size > 0.0 ? std::max(0, 1 - static_cast<int>(std::floor(std::log10(size)))) : 0;
  return fmt::format("{:.{}f}", value, std::min(digits, 6));
}

/// All parameters in the order of the table: amplitudes before times.
std::string parameters_in_words(const FoundEffect& effect) {
  std::string text;
  for (const Shown& shown : shown_parameters) {
    const auto at = effect.parameters.find(std::string(shown.key));
    if (at == effect.parameters.end()) continue;
    const auto sigma = effect.sigma.find(at->first);
    if (!text.empty()) text += ", ";
    text += parameter_in_words(at->first, at->second, sigma == effect.sigma.end() ? 0.0 : sigma->second);
  }
  return text;
}

void put_place(Sentence& s, const std::string& channel, const std::optional<double>& position_mm,
               const std::string& component) {
  s.facts["where"] = "where_nowhere";
  if (!channel.empty()) {
    s.facts["where"] = "where_channel";
    s.facts["place_channel"] = channel;
  } else if (position_mm) {
    s.facts["where"] = "where_position";
    s.facts["position"] = fmt::format("{:.0f}", *position_mm);
    s.facts["component"] = component;
  } else if (!component.empty()) {
    s.facts["where"] = "where_component";
    s.facts["component"] = component;
  }
}

std::string regime_or_always(const std::string& regime) {
  return regime.empty() ? "all the time" : regime;
}

Sentence finished(Sentence s) {
  s.english = said(s);
  return s;
}

}  // namespace

std::string parameter_in_words(const std::string& key, double value, double sigma) {
  for (const Shown& shown : shown_parameters) {
    if (shown.key != key) continue;
    const double width = sigma * shown.factor;
    std::string text = fmt::format("{} = {}", shown.sign, number_of(value * shown.factor, width));
    if (width > 0.0) text += " ± " + number_of(width, width);
    return shown.unit.empty() ? text : fmt::format("{} {}", text, shown.unit);
  }
  return {};
}

Sentence explain_effect(const FoundEffect& effect, const Mismatch& mismatch, double share_removed, double before,
                        const std::string& worst_channel) {
  Sentence s;
  s.id = "effect_found";
  s.facts = {{"name", effect.id},
             {"parameters", parameters_in_words(effect)},
             {"channel", worst_channel},
             {"before", fmt::format("{:.2g}", before)},
             {"unit", unit_of(worst_channel)},
             {"removed_percent", fmt::format("{:.0f}", 100.0 * share_removed)},
             {"fingerprint", std::string(physics::find_effect(effect.id)->fingerprint)},
             {"regime", regime_or_always(mismatch.regime)}};
  put_place(s, effect.channel, effect.position_mm, effect.component);
  const auto from = effect.parameters.find("from_mm");
  const auto to = effect.parameters.find("to_mm");
  if (from != effect.parameters.end() && to != effect.parameters.end()) {
    s.facts["where"] = "where_between";
    s.facts["from"] = fmt::format("{:.0f}", from->second);
    s.facts["to"] = fmt::format("{:.0f}", to->second);
  }
  return finished(std::move(s));
}

Sentence explain_rival(const Rival& rival) {
  Sentence s;
  s.id = rival.behind < 0.0 ? "rival_hidden" : "rival_left";
  s.facts = {{"name", rival.id}, {"behind", fmt::format("{:.1f}", rival.behind)}};
  put_place(s, rival.channel, rival.position_mm, rival.component);
  return finished(std::move(s));
}

Sentence explain_verdict(const Diagnosis& diagnosis) {
  Sentence s;
  s.id = "verdict_" + std::string(name_of(diagnosis.verdict));
  const bool bent = std::any_of(diagnosis.notes.begin(), diagnosis.notes.end(),
                                [](const auto& note) { return note.starts_with("far_from_description:"); });
  if (diagnosis.verdict == Verdict::consistent && bent) s.id += "_bent";
  if (diagnosis.doubtful) {
    s.id += "_doubtful";
  } else if (diagnosis.verdict == Verdict::unexplained) {
    const std::string channel = diagnosis.mismatch.channels.empty() ? "" : diagnosis.mismatch.channels.front();
    s.facts = {{"channel", channel}, {"regime", regime_or_always(diagnosis.mismatch.regime)}};
    for (const auto& report : diagnosis.channels) {
      if (report.channel != channel || report.temperature) continue;
      s.id += "_length";  // no heat is missing where a displacement alone is off
      s.facts["um"] = fmt::format("{:.2g}", report.rms_refitted);
    }
    if (s.facts.count("um") == 0) s.facts["watts"] = fmt::format("{:.0f}", diagnosis.mismatch.missing_heat_W);
  }
  if (diagnosis.verdict == Verdict::missing_effect) {
    std::string list;
    for (const auto& effect : diagnosis.effects) list += (list.empty() ? "" : ",") + effect.id;
    s.facts = {{"effects", list}};
  }
  return finished(std::move(s));
}

Sentence explain_note(const std::string& id, std::map<std::string, std::string> facts) {
  return finished({id, std::move(facts), ""});
}

Sentence explain_unseen(const std::vector<std::string>& effects) {
  return finished({"cannot_show", {{"effects", fmt::format("{}", fmt::join(effects, ","))}}, ""});
}

Sentence explain_experiment(const std::string& best_effect, const std::string& rival_effect, const std::string& run,
                            int minutes) {
  Sentence s{"experiment_show", {{"rival", rival_effect}, {"run", run}, {"minutes", std::to_string(minutes)}}, ""};
  if (best_effect.empty()) return finished(std::move(s));
  s.id = "experiment_run";
  s.facts["best"] = best_effect;
  return finished(std::move(s));
}

}  // namespace zerodrift::diagnosis
