#include "core/diagnosis/explain.h"

#include <fmt/format.h>

#include "core/physics/effects/effect.h"

namespace zerodrift::diagnosis {
namespace {

std::string unit_of(const std::string& channel) {
  return channel.size() > 3 && channel.compare(channel.size() - 3, 3, "_um") == 0 ? "um" : "K";
}

/// "power 36.1 +- 2.0 W"
std::string parameters_in_words(const FoundEffect& effect) {
  std::string text;
  for (const auto& parameter : physics::find_effect(effect.id)->parameters) {
    const auto at = effect.parameters.find(std::string(parameter.key));
    if (at == effect.parameters.end() || at->first == "position_mm") continue;
    const auto sigma = effect.sigma.find(at->first);
    text += fmt::format("{}{} {:.3g}", text.empty() ? "" : ", ", at->first, at->second);
    if (sigma != effect.sigma.end()) text += fmt::format(" +- {:.2g}", sigma->second);
  }
  return text;
}

}  // namespace

std::string plain_name(const std::string& effect_id) {
  std::string name = effect_id;
  for (char& c : name) {
    if (c == '_') c = ' ';
  }
  return name;
}

Sentence explain_effect(const FoundEffect& effect, const Mismatch& mismatch, double share_removed, double before,
                        const std::string& worst_channel) {
  Sentence s;
  s.id = "effect_" + effect.id;
  std::string where;
  if (!effect.channel.empty()) {
    where = " on " + effect.channel;
  } else if (effect.position_mm) {
    where = fmt::format(" at {:.0f} mm of {}", *effect.position_mm, effect.component);
  } else if (effect.words.count("region") != 0) {
    where = fmt::format(" ({})", effect.words.at("region"));
  } else if (!effect.component.empty()) {
    where = " of " + effect.component;
  }
  const std::string numbers = parameters_in_words(effect);
  s.facts = {{"where", where},
             {"parameters", numbers},
             {"channel", worst_channel},
             {"before", fmt::format("{:.2g}", before)},
             {"unit", unit_of(worst_channel)},
             {"removed_percent", fmt::format("{:.0f}", 100.0 * share_removed)},
             {"regime", mismatch.regime}};
  s.english = fmt::format(
      "{}: {} differs by {:.2g} {} (rms) from the re-fitted simulation, {}. Adding {}{} ({}) removes {:.0f} % of it.",
      std::string(physics::find_effect(effect.id)->fingerprint), worst_channel, before, unit_of(worst_channel),
      mismatch.regime.empty() ? "all the time" : mismatch.regime, plain_name(effect.id), where, numbers,
      100.0 * share_removed);
  return s;
}

Sentence explain_rival(const Rival& rival) {
  Sentence s;
  s.id = "rival_" + rival.id;
  s.facts = {{"behind", fmt::format("{:.1f}", rival.behind)}};
  s.english =
      fmt::format("{} explains this recording almost as well (log evidence {:.1f} behind); it cannot be excluded.",
                  plain_name(rival.id), rival.behind);
  return s;
}

Sentence explain_verdict(const Diagnosis& diagnosis) {
  Sentence s;
  s.id = "verdict_" + std::string(name_of(diagnosis.verdict));
  if (diagnosis.verdict == Verdict::consistent) {
    s.english =
        "Nothing is missing: the simulation agrees with the recording within its tolerances and the sensors' noise.";
  } else if (diagnosis.verdict == Verdict::unexplained) {
    const std::string worst = diagnosis.mismatch.channels.empty() ? "" : diagnosis.mismatch.channels.front();
    s.facts = {{"channel", worst}, {"watts", fmt::format("{:.0f}", diagnosis.mismatch.missing_heat_W)}};
    s.english = fmt::format("Something is missing that the library does not explain: worst at {}, {}, about {:.0f} W.",
                            worst, diagnosis.mismatch.regime.empty() ? "all the time" : diagnosis.mismatch.regime,
                            diagnosis.mismatch.missing_heat_W);
  } else {
    std::string list;
    for (const auto& effect : diagnosis.effects) list += (list.empty() ? "" : " and ") + plain_name(effect.id);
    s.facts = {{"effects", list}};
    s.english = "The simulation left out " + list + ".";
  }
  return s;
}

}  // namespace zerodrift::diagnosis
