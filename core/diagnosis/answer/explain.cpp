#include "core/diagnosis/answer/explain.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/diagnosis/answer/sentences.h"
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
                                      Shown{"ln_decay_s", "τ", "min", 1.0 / 60.0},
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

std::string with_sigma(double value, double sigma) {
  return number_of(value, sigma) + (sigma > 0.0 ? " ± " + number_of(sigma, sigma) : "");
}

/// Heat over speed: its ramps in sum, at each quarter of full speed.
std::string curve_in_words(const FoundEffect& effect) {
  std::vector<std::string> watts;
  double sum_W = 0.0;
  for (const char* ramp : {"watts_to_25", "watts_25_to_50", "watts_50_to_75", "watts_75_to_100"}) {
    const auto at = effect.parameters.find(ramp);
    if (at == effect.parameters.end()) return {};
    sum_W += at->second;
    watts.push_back(number_of(sum_W, 0.0));
  }
  return fmt::format("P(25, 50, 75, 100 %) = {} W", fmt::join(watts, ", "));
}

double rpm_of(const std::map<std::string, double>& at_rpm, const std::string& key) {
  const auto at = at_rpm.find(key);
  return at == at_rpm.end() ? 0.0 : at->second;
}

/// The neighbour's name, then all parameters in the order of the table: amplitudes before times.
std::string parameters_in_words(const FoundEffect& effect) {
  const auto neighbour = effect.words.find("neighbour");
  std::string text = neighbour == effect.words.end() ? curve_in_words(effect) : neighbour->second;
  for (const Shown& shown : shown_parameters) {
    const auto at = effect.parameters.find(std::string(shown.key));
    if (at == effect.parameters.end()) continue;
    const auto sigma = effect.sigma.find(at->first);
    if (at->first == "to_s" && sigma == effect.sigma.end()) continue;  // not before the recording ended
    if (!text.empty()) text += ", ";
    text += parameter_in_words(at->first, at->second, sigma == effect.sigma.end() ? 0.0 : sigma->second,
                               rpm_of(effect.at_rpm, at->first));
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

/// In the form that was found.
std::string name_of_form(const FoundEffect& effect) {
  for (const physics::NamedForm& form : physics::find_effect(effect.id)->named_forms) {
    if (effect.parameters.count(std::string(form.number)) != 0) return std::string(form.id);
  }
  return effect.id;
}

/// Where the size of the effect is its heat already, that is not said twice.
void put_heat(Sentence& s, const FoundEffect& effect) {
  s.facts["heat"] = "heat_none";
  const bool said_before = effect.parameters.count("power_W") != 0 && effect.at_rpm.count("power_W") == 0;
  if (!effect.heat || said_before) return;
  s.facts["heat"] = effect.heat->mean_W > 0.0 ? "heat_brought" : "heat_taken";
  s.facts["watts"] = watts_in_words(std::abs(effect.heat->mean_W), effect.heat->sigma_W);
}

std::string regime_or_always(const std::string& regime) {
  return regime.empty() ? "all the time" : regime;
}

Sentence finished(Sentence s) {
  s.english = said(s);
  return s;
}

}  // namespace

std::map<std::string, double> speeds_of_figures(const std::map<std::string, double>& numbers,
                                                const std::map<std::string, std::string>& words, double full_rpm) {
  std::map<std::string, double> at_rpm;
  const auto law = words.find("law");
  const bool by_speed = law != words.end() && (law->second == "n" || law->second == "n2");
  for (const auto& [key, value] : numbers) {
    if (key == "a_W_m2K" || key == "speed_share" || (key == "power_W" && by_speed)) at_rpm[key] = full_rpm;
  }
  return at_rpm;
}

std::string parameter_in_words(const std::string& key, double value, double sigma, double at_rpm) {
  if (key.starts_with("ln_")) {  // the width of a logarithm is relative
    value = std::exp(value);
    sigma *= value;
  }
  for (const Shown& shown : shown_parameters) {
    if (shown.key != key) continue;
    const double width = sigma * shown.factor;
    const std::string sign = at_rpm > 0.0 ? fmt::format("{}({:.0f} rpm)", shown.sign, at_rpm) : std::string(shown.sign);
    const std::string text = fmt::format("{} = {}", sign, with_sigma(value * shown.factor, width));
    return shown.unit.empty() ? text : fmt::format("{} {}", text, shown.unit);
  }
  return {};
}

std::string watts_in_words(double mean_W, double sigma_W) {
  return with_sigma(mean_W, sigma_W) + " W";
}

/// Moments close together need a decimal.
static std::string in_minutes(double time_s, double apart_s) {
  return fmt::format("{:.{}f}", time_s / 60.0, apart_s < 300.0 ? 1 : 0);
}

static std::string regime_of_intervals(const std::vector<std::pair<double, double>>& intervals_s, double end_s) {
  const double from_s = std::max(0.0, intervals_s.front().first), to_s = intervals_s.back().second;
  const std::string from = in_minutes(from_s, to_s - from_s), to = in_minutes(std::min(to_s, end_s), to_s - from_s);
  if (intervals_s.size() > 1) return fmt::format("{} times between {} and {} min", intervals_s.size(), from, to);
  return to_s < end_s ? fmt::format("from {} to {} min", from, to) : fmt::format("from {} min on", from);
}

std::string regime_of_effect(const FoundEffect& effect, double end_s) {
  if (!effect.intervals_s.empty()) return regime_of_intervals(effect.intervals_s, end_s);
  struct Regime {
    std::string_view by;
    const char* words;
  };
  static constexpr Regime regimes[] = {{"coolant_on", "while the coolant runs"},
                                       {"spindle_load_W", "while the machine cuts"},
                                       {"spindle_rpm", "while the spindle turns"},
                                       {"ambient_C", "as the room changes"}};
  static constexpr Regime laws[] = {{"on", "while the spindle turns"},
                                    {"n", "in step with the spindle speed"},
                                    {"n2", "with the square of the spindle speed"}};
  const auto number = [&](const char* key) {
    const auto at = effect.parameters.find(key);
    return at == effect.parameters.end() ? std::nan("") : at->second;
  };
  const auto word = [&](const char* key) {
    const auto at = effect.words.find(key);
    return at == effect.words.end() ? std::string() : at->second;
  };
  const double from_s = std::isfinite(number("from_s")) ? number("from_s") : number("time_s");
  if (std::isfinite(from_s)) {
    if (!(number("to_s") < end_s)) return fmt::format("from {:.0f} min on", from_s / 60.0);
    return fmt::format("from {:.0f} to {:.0f} min", from_s / 60.0, number("to_s") / 60.0);
  }
  for (const Regime& law : laws) {
    if (law.by == word("law")) return law.words;
  }
  for (const Regime& regime : regimes) {
    if (regime.by == physics::find_effect(effect.id)->acts_with && word("fluid").empty()) return regime.words;
  }
  return "all the time";
}

namespace {

/// What it is, how large and where, and when it acts.
Sentence about_effect(const FoundEffect& effect, double end_s, const std::string& worst_channel) {
  Sentence s;
  s.facts = {{"name", name_of_form(effect)},
             {"parameters", parameters_in_words(effect)},
             {"channel", worst_channel},
             {"fingerprint", std::string(physics::find_effect(effect.id)->fingerprint)},
             {"regime", regime_of_effect(effect, end_s)}};
  const auto bearing = effect.words.find("bearing");
  put_place(s, effect.channel, effect.position_mm, bearing == effect.words.end() ? effect.component : bearing->second);
  if (effect.position_mm && effect.position_sigma_mm > 0.0)
    s.facts["position"] = with_sigma(*effect.position_mm, effect.position_sigma_mm);
  put_heat(s, effect);
  const auto from = effect.parameters.find("from_mm");
  const auto to = effect.parameters.find("to_mm");
  std::optional<std::pair<double, double>> between_mm = effect.between_mm;
  if (from != effect.parameters.end() && to != effect.parameters.end()) between_mm = {from->second, to->second};
  if (between_mm) {
    s.facts["where"] = "where_between";
    s.facts["from"] = fmt::format("{:.0f}", between_mm->first);
    s.facts["to"] = fmt::format("{:.0f}", between_mm->second);
  }
  return s;
}

}  // namespace

Sentence explain_effect(const FoundEffect& effect, double end_s, const ShownBy& shown) {
  Sentence s = about_effect(effect, end_s, shown.channel);
  constexpr double told = 0.05;  // how it goes can be explained where how far it is off is not
  constexpr double much = 0.3;   // of less the most is noise, which nothing removes
  const double removed = 1.0 - shown.after / std::max(shown.before, 1e-12);
  s.id = removed < told ? "effect_found_course" : removed < much ? "effect_found_weak" : "effect_found";
  s.facts["before"] = fmt::format("{:.2g}", shown.before);
  s.facts["after"] = fmt::format("{:.2g}", shown.after);
  s.facts["noise"] = fmt::format("{:.2g}", std::min(shown.noise, shown.after));
  s.facts["unit"] = unit_of(shown.channel);
  s.facts["removed_percent"] = fmt::format("{:.0f}", 100.0 * removed);
  s.facts["evidence"] = fmt::format("{:.0f}", effect.log_evidence_gain);
  return finished(std::move(s));
}

Sentence explain_rival(const Rival& rival) {
  Sentence s;
  s.id = "rival_left";
  s.facts = {{"name", rival.id}, {"behind", fmt::format("{:.1f}", rival.behind)}};
  put_place(s, rival.channel, rival.position_mm, rival.component);
  return finished(std::move(s));
}

Sentence explain_verdict(const Diagnosis& diagnosis) {
  Sentence s;
  s.id = "verdict_" + std::string(name_of(diagnosis.verdict));
  const auto noted = [&](std::initializer_list<NoteCode> codes) {
    return std::any_of(diagnosis.notes.begin(), diagnosis.notes.end(), [&](const Note& note) {
      return std::find(codes.begin(), codes.end(), note.code) != codes.end();
    });
  };
  if (noted({NoteCode::shows_too_little})) {
    s.id += "_blind";
  } else if (diagnosis.verdict == Verdict::consistent && noted({NoteCode::far_from_description})) {
    s.id += "_bent";
  } else if (diagnosis.verdict == Verdict::consistent && noted({NoteCode::never_driven, NoteCode::not_recorded})) {
    s.id += "_in_part";
  }
  if (diagnosis.doubtful) {
    const auto extra = std::find_if(diagnosis.notes.begin(), diagnosis.notes.end(),
                                    [](const Note& note) { return note.code == NoteCode::described_not_there; });
    if (extra != diagnosis.notes.end()) s.facts["name"] = extra->facts.at("effect");
    const bool misshapen = noted({NoteCode::overlong, NoteCode::diameter});
    const bool misplaced =
        noted({NoteCode::misplaced, NoteCode::exchanged, NoteCode::places_in, NoteCode::other_end, NoteCode::datum});
    s.id += misshapen                        ? "_misshapen"
            : misplaced                      ? "_misplaced"
            : extra != diagnosis.notes.end() ? "_too_much"
                                             : "_doubtful";
  } else if (diagnosis.verdict == Verdict::unexplained) {
    constexpr double told_W = 0.5;  // less would read "about 0 W"
    const std::string channel = diagnosis.mismatch.channels.empty() ? "" : diagnosis.mismatch.channels.front();
    const double missing_W = diagnosis.mismatch.missing_heat_W;
    s.facts = {{"channel", channel}, {"regime", regime_or_always(diagnosis.mismatch.regime)}};
    const auto report = std::find_if(diagnosis.channels.begin(), diagnosis.channels.end(),
                                     [&](const auto& one) { return one.channel == channel; });
    const bool seen = report != diagnosis.channels.end();
    if (seen && (!report->temperature || std::abs(missing_W) < told_W)) {
      s.id += "_off";  // no heat is missing where a displacement alone is off
      s.facts["rms"] = fmt::format("{:.2g}", report->rms_refitted);
      s.facts["unit"] = unit_of(channel);
    } else {
      if (missing_W < 0.0) s.id += "_too_hot";
      s.facts["watts"] = fmt::format("{:.0f}", std::abs(missing_W));
    }
  }
  if (diagnosis.verdict == Verdict::missing_effect) {
    std::vector<std::string> kinds;  // a machine of many parts lacks the same in most of them
    for (const auto& effect : diagnosis.effects) {
      if (std::count(kinds.begin(), kinds.end(), effect.id) == 0) kinds.push_back(effect.id);
    }
    s.facts = {{"effects", fmt::format("{}", fmt::join(kinds, ","))}};
  }
  return finished(std::move(s));
}

std::vector<Sentence> explain_unexplained(const Diagnosis& diagnosis) {
  constexpr double all_the_time = 0.85;
  constexpr double all_along = 0.5;
  constexpr std::size_t most_spans = 4;
  constexpr double worth_telling_s = 600.0;
  const Mismatch& off = diagnosis.mismatch;
  std::vector<Sentence> told;
  if (diagnosis.verdict != Verdict::unexplained || diagnosis.doubtful || diagnosis.time_s.empty()) return told;
  double off_s = 0.0;
  std::vector<std::string> spans;
  for (const auto& [from_s, to_s] : off.time_s) {
    if (to_s - from_s < worth_telling_s) continue;
    off_s += to_s - from_s;
    spans.push_back(fmt::format("{:.0f}–{:.0f}", from_s / 60.0, to_s / 60.0));
  }
  const double whole_s = diagnosis.time_s.back() - diagnosis.time_s.front();
  if (!spans.empty() && spans.size() <= most_spans && off_s < all_the_time * whole_s) {
    told.push_back(explain_note("unexplained_when", {{"spans", fmt::format("{}", fmt::join(spans, ","))}}));
  }
  const auto worst = std::find_if(diagnosis.channels.begin(), diagnosis.channels.end(), [&](const auto& channel) {
    return !off.channels.empty() && channel.channel == off.channels.front();
  });
  const bool warm = worst != diagnosis.channels.end() && worst->temperature;
  if (!warm || !off.position_mm || off.scan_position_mm.empty() || off.component.empty()) return told;
  const auto [from_mm, to_mm] = *off.position_mm;
  if (to_mm - from_mm > all_along * off.scan_position_mm.back()) return told;
  told.push_back(explain_note(
      "unexplained_where",
      {{"from", fmt::format("{:.0f}", from_mm)}, {"to", fmt::format("{:.0f}", to_mm)}, {"component", off.component}}));
  return told;
}

Sentence explain_left(const Diagnosis& diagnosis) {
  if (diagnosis.verdict != Verdict::missing_effect) return {};
  std::vector<std::string> channels;
  for (const ChannelReport& one : diagnosis.channels) {
    if (one.verdict == ChannelVerdict::unexplained) channels.push_back(one.channel);
  }
  if (channels.empty()) return {};
  return explain_note("channels_left", {{"channels", fmt::format("{}", fmt::join(channels, ", "))}});
}

Sentence explain_note(const std::string& id, std::map<std::string, std::string> facts) {
  return finished({id, std::move(facts), ""});
}

Sentence explain_raised(const physics::Tolerances& taken) {
  struct Quantity {
    std::string_view key;
    std::string_view id;
    double value;
  };
  const Quantity all[] = {{"conductivity", "quantity_conductivity", taken.conductivity},
                          {"heat_capacity", "quantity_capacity", taken.heat_capacity},
                          {"heat_source_power", "quantity_heat", taken.heat_source_power},
                          {"film", "quantity_film", taken.film},
                          {"expansion", "quantity_expansion", taken.expansion},
                          {"conductance", "quantity_conductance", taken.conductance}};
  std::string ids, values;
  for (const Quantity& one : all) {
    if (std::count(taken.raised.begin(), taken.raised.end(), one.key) == 0) continue;
    if (!ids.empty()) ids += ",", values += ", ";
    ids += one.id;
    values += fmt::format("{:g}", one.value);
  }
  return finished({"tolerances_raised", {{"quantities", ids}, {"values", values}}, ""});
}

Sentence sentence_of(const Note& note) {
  const auto fact = [&](const char* key) {
    const auto at = note.facts.find(key);
    return at == note.facts.end() ? std::string() : at->second;
  };
  std::map<std::string, std::string> facts = note.facts;
  switch (note.code) {
    case NoteCode::missing_channel:
    case NoteCode::room_given:
    case NoteCode::room_is_initial_temperature:
    case NoteCode::conductance_unknown:
    case NoteCode::shows_too_little:   // the verdict says it
    case NoteCode::tolerances_raised:  // explain_raised()
      return {};
    case NoteCode::warm_start:
      if (fact("above").empty()) return {};
      facts = {{"part", fact("component")}, {"above", fact("above").substr(fact("above").front() == '-' ? 1 : 0)}};
      return explain_note(fact("above").front() == '-' ? "starts_cold" : "starts_warm", facts);
    case NoteCode::never_changes:
      return fact("um").empty() ? Sentence{} : explain_note("run_gauge_never_changes", facts);
    case NoteCode::capacity_unknown:
      return explain_note("capacity_unknown", {{"parts", fact("components")}});
    case NoteCode::few_sensors:
      return explain_note("few_sensors", {{"part", fact("component")}, {"count", fact("count")}});
    case NoteCode::described_not_there:
      return explain_note("described_not_there", {{"name", fact("effect")}});
    case NoteCode::datum:
      return explain_note(fact("nearer").empty() ? "datum" : "datum_nearer", facts);
    case NoteCode::far_from_description: {
      std::string part = fact("of");
      std::replace(part.begin(), part.end(), '_', ' ');
      return explain_note(fact("quantity") == "conductance" ? "far_joint" : "far_from_description",
                          {{"quantity", "quantity_" + fact("quantity")},
                           {"part", part},
                           {"factor", fact("factor")},
                           {"widths", fact("sigmas")}});
    }
    case NoteCode::unknown_columns:
    case NoteCode::lacks_column:
    case NoteCode::lacks_what_other_has:
    case NoteCode::left_out:
    case NoteCode::input_gaps:
      return explain_note("run_" + std::string(name_of(note.code)), facts);
    default:
      return explain_note(std::string(name_of(note.code)), facts);
  }
}

Note far_from_description(const std::string& quantity, const std::string& of, double factor, double sigmas) {
  return {NoteCode::far_from_description,
          {{"quantity", quantity},
           {"of", of},
           {"factor", fmt::format("{:.2g}", factor)},
           {"sigmas", fmt::format("{:.0f}", sigmas)}}};
}

std::vector<Sentence> explain_findings(const std::vector<RunFinding>& findings, const std::vector<Note>& notes) {
  std::vector<Sentence> list;
  std::set<std::string> units;
  for (const auto& [recording, finding] : findings) {
    const auto said_already = [&, &recording = recording, &finding = finding](const Note& note) {
      return note.code == NoteCode::never_changes && note.facts.count("um") != 0 &&
             note.facts.at("recording") == recording && note.facts.at("channel") == finding.channel;
    };
    if (std::any_of(notes.begin(), notes.end(), said_already)) continue;
    const std::string kind(analysis::name_of(finding.kind));
    const bool unit =
        finding.kind == analysis::FindingKind::fahrenheit || finding.kind == analysis::FindingKind::kelvin;
    const auto alike = std::count_if(findings.begin(), findings.end(),
                                     [&recording = recording, &finding = finding](const RunFinding& other) {
                                       return other.recording == recording && other.finding.kind == finding.kind;
                                     });
    if (!unit || alike == 1) {
      list.push_back(explain_note("run_finding", {{"recording", recording}, {"what", analysis::describe(finding)}}));
    } else if (units.insert(recording + kind).second) {
      list.push_back(explain_note("run_" + kind, {{"recording", recording}}));
    }
  }
  return list;
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
