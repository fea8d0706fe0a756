#include "core/diagnosis/answer/sentences.h"

#include <array>
#include <cctype>
#include <nlohmann/json.hpp>

#include "core/physics/effects/effect.h"

namespace zerodrift::diagnosis {
namespace {

struct Entry {
  std::string_view id;
  std::string_view english;
};

constexpr std::array catalogue{
    Entry{"verdict_consistent",
          "Nothing is missing: the simulation agrees with the recording within its tolerances and the sensors' noise."},
    Entry{"verdict_consistent_in_part",
          "Nothing is missing of what this recording can show: the simulation agrees with it within its tolerances and "
          "the sensors' noise."},
    Entry{"verdict_unexplained",
          "Something is missing that the library does not explain: worst at {channel}, {@regime}, about {watts} W."},
    Entry{
        "verdict_unexplained_too_hot",
        "Something is missing that the library does not explain: worst at {channel}, {@regime}, where about {watts} W "
        "too much heat is simulated."},
    Entry{"verdict_unexplained_off",
          "Something is missing that the library does not explain: {channel} is off the best "
          "simulation by {rms} {unit} (rms), {@regime}."},
    Entry{"unexplained_when", "It shows most at {+spans} min."},
    Entry{"unexplained_where", "As heat it would come in between {from} and {to} mm of {component}."},
    Entry{"verdict_missing_effect", "The simulation left out {+effects}."},
    Entry{"effect_found",
          "{@regime}, {channel} is {before} {unit} (rms) off the best simulation without it. Adding {@name}{@where} "
          "({parameters}) removes {removed_percent} % of that{@heat}. Typical of it: {@fingerprint}."},
    Entry{"effect_found_weak",
          "{@regime}, adding {@name}{@where} ({parameters}) brings {channel} from {before} to {after} {unit} (rms), of "
          "which {noise} {unit} is its noise{@heat}. Typical of it: {@fingerprint}."},
    Entry{"effect_found_course",
          "{@regime}, adding {@name}{@where} ({parameters}) explains how {channel} goes (log evidence {evidence}), but "
          "leaves it {before} {unit} (rms) off{@heat}. Typical of it: {@fingerprint}."},
    Entry{"clock_late",
          "What drives the machine was recorded about {seconds} s after it acted, and was taken as that much earlier: "
          "give all columns one clock."},
    Entry{"clock_early",
          "What drives the machine was recorded about {seconds} s before it acted, and was taken as that much later: "
          "give all columns one clock."},
    Entry{"heat_none", ""},
    Entry{"heat_brought", "; it brings {watts} on average while it acts"},
    Entry{"heat_taken", "; it takes away {watts} on average while it acts"},
    Entry{"rival_left",
          "This recording is explained almost as well by {@name}{@where} (log evidence {behind} behind): it cannot be "
          "excluded."},
    Entry{
        "cannot_show",
        "This recording cannot tell whether there is {|effects}: even as strong as it can be at all, it would not have "
        "shown here."},
    Entry{"coarse_rows",
          "The rows are {seconds} s apart, and when speed or coolant switched in between is known no better: record a "
          "row "
          "every 60 s or more often to be surer."},
    Entry{"never_driven",
          "This recording cannot tell whether there is {|effects}: what drives that never acted in it."},
    Entry{
        "verdict_consistent_bent",
        "No effect of the library is missing, but the simulation agrees with the recording only with numbers far from "
        "those described."},
    Entry{"verdict_consistent_blind",
          "This recording cannot tell whether anything is missing: the simulation agrees with it, but most effects of "
          "usual size would not have shown. Record for longer, until the temperatures settle, with several speeds and "
          "stops."},
    Entry{"verdict_unexplained_misplaced",
          "Nothing can be named: the sensors are not where the description has them. Correct that first."},
    Entry{"verdict_unexplained_misshapen",
          "Nothing can be named: the machine does not have the sizes described. Correct that first."},
    Entry{"other_end",
          "The sensors of {component} read as if their places were told from the other end than those of its heat "
          "sources: count both from the fixed end."},
    Entry{"datum",
          "The sensors of {component} read as if all of them sat about {fits} mm farther from the fixed end than "
          "described: check from where their places are told."},
    Entry{"datum_nearer",
          "The sensors of {component} read as if all of them sat about {fits} mm nearer to the fixed end than "
          "described: check from where their places are told."},
    Entry{"diameter",
          "{component} is described {described} mm thick: about {fits} mm explains the recording far better. Measure "
          "its outer diameter."},
    Entry{
        "overlong",
        "{component} is described {described} mm long, with nothing on its last {bare} mm: a length of about {fits} mm "
        "explains the recording far better. Measure it."},
    Entry{"misplaced",
          "{channel} reads as a sensor about {at} mm from the fixed end would, not one at {described} mm as described: "
          "check its place, and that it is in millimetres."},
    Entry{"clock_jumped",
          "In {recording} the clock jumps ahead by {by} min at {at} min: the machine went on as if no time had passed, "
          "and the "
          "times were taken so."},
    Entry{"load_in_other_unit",
          "In {recording} the spindle's load is at most {most} W, next to nothing for this motor: is spindle_load_W in "
          "{unit}?"},
    Entry{"places_in",
          "The sensors read as if their places were described in {unit}, not in mm: correct the description."},
    Entry{"exchanged",
          "{channel} and {other} read as if they had changed places: check their cables and the order of the columns."},
    Entry{"room_not_logged",
          "The recording has no column {column}: how the room went had to be guessed from the machine's own "
          "temperatures, and what follows the room can hardly be told from it."},
    Entry{"inputs_not_logged",
          "The recording has no column {columns}: what acts with it cannot be found. If the machine has it, log it and "
          "record again."},
    Entry{"not_recorded", "The recording has no column {columns}: what shows in it alone cannot be found."},
    Entry{"starts_warm",
          "The recording starts with {part} {above} K above its room: what ran before is not recorded and had to be "
          "fitted as well. Start after a rest of some hours to be surer."},
    Entry{"starts_cold",
          "The recording starts with {part} {above} K below its room: what ran before is not recorded and had to be "
          "fitted as well. Start after a rest of some hours to be surer."},
    Entry{"few_sensors",
          "Temperature sensors on {part} that were used: {count}. Where along it something happens can hardly be told "
          "from so few; three or more, spread over its length, show places."},
    Entry{
        "tolerances_raised",
        "The description states a smaller tolerance for {+quantities} than anybody can know such a number to: {values} "
        "was taken instead."},
    Entry{"far_from_description",
          "To fit, {@quantity} of {part} had to become {factor} times what is described, {widths} times its tolerance: "
          "check units, sizes and powers."},
    Entry{
        "far_joint",
        "To fit, the joint {part} had to conduct {factor} times what is described, {widths} times its tolerance: look "
        "at its seat, its bolts and what fills its gap, and then at its figure."},
    Entry{"quantity_heat", "the heat"},
    Entry{"quantity_conductivity", "the conductivity"},
    Entry{"quantity_capacity", "the heat capacity"},
    Entry{"quantity_expansion", "the expansion"},
    Entry{"quantity_film", "the film to the room"},
    Entry{"quantity_conductance", "the conductance of joints"},
    Entry{
        "verdict_unexplained_too_much",
        "The description holds {@name}, which the recording does not show; without it nothing is missing. Take it out "
        "of the description, or check its numbers."},
    Entry{"described_not_there",
          "The description holds {@name}, which the recording does not show: what is named is beside the description "
          "without it. Take it out, or check its numbers."},
    Entry{"verdict_unexplained_doubtful",
          "Nothing can be named: the simulation follows the recording only with numbers far from those described. "
          "Check the units of the recording and the sizes and powers of the description first."},
    Entry{"run_lacks_column", "Recording {recording} has no column {column}, which {other} has: it was left out."},
    Entry{"run_lacks_what_other_has",
          "Recording {recording} has no column {column}, which {other} has: what that switches is not simulated, and "
          "{other} may be missed for it."},
    Entry{"run_unknown_columns",
          "Recording {recording}: the machine description does not name {columns}, which was not used."},
    Entry{"run_input_gaps",
          "In {recording} the column {column} has no value in {percent} % of the rows: what it was there had to be "
          "assumed."},
    Entry{"run_left_out", "Recording {@what}."},
    Entry{"run_finding", "Recording {recording}: {@what}."},
    Entry{
        "run_gauge_never_changes",
        "Recording {recording}: {channel} never changes (it is always {value}) although {um} µm are simulated: is the "
        "gauge connected? It was not used."},
    Entry{"run_fahrenheit",
          "Recording {recording}: the temperatures may be in degrees Fahrenheit but were taken as degrees Celsius; "
          "give their unit in the column map."},
    Entry{"run_kelvin",
          "Recording {recording}: the temperatures may be in kelvin but were taken as degrees Celsius; give their unit "
          "in the column map."},
    Entry{"no_excitation", "Nothing drives the machine in this recording: little can be learned from it."},
    Entry{"sign_turned", "With its sign turned, {channel} is as described: check which way it counts as positive."},
    Entry{"experiment_show", "To see whether there is {@rival}, {minutes} min in all: {@run}."},
    Entry{"channels_left", "Beside what is named, {channels} show more that the library does not explain."},
    Entry{"capacity_unknown",
          "The heat capacity of {parts} is not described and was assumed: watts, W/K and J/K are in proportion to it, "
          "the times are not."},
    Entry{"experiment_run", "To tell {@best} from {@rival}, {minutes} min in all: {@run}."},
    Entry{"nothing_to_simulate", "The profile holds no machine description, so there is nothing to simulate."},
    Entry{"simulation_differs",
          "The simulation differs most from the recording at {channel}: {rms} {unit} rms, {largest} {unit} at the most "
          "after {minutes} min."},
    Entry{"sensor_region",
          "The temperature of {component} between {from} and {to} mm from its fixed end follows the elongation best: a "
          "sensor belongs there."},
    Entry{"where_nowhere", ""},
    Entry{"where_channel", " on {place_channel}"},
    Entry{"where_position", " at {position} mm of {component}"},
    Entry{"where_between", " between {from} and {to} mm"},
    Entry{"where_component", " of {component}"},
    Entry{"and", " and "},
    Entry{"or", " or "},
    Entry{"comma", ", "},
};

std::vector<Entry> names_of_effects() {
  std::vector<Entry> names;
  for (const physics::Effect* effect : physics::all_effects()) {
    names.push_back({effect->id, effect->name});
    for (const physics::NamedForm& form : effect->named_forms) names.push_back({form.id, form.name});
  }
  return names;
}

const Entry* listed(std::string_view id) {
  static const std::vector<Entry> names = names_of_effects();
  for (const Entry& entry : catalogue) {
    if (entry.id == id) return &entry;
  }
  for (const Entry& entry : names) {
    if (entry.id == id) return &entry;
  }
  return nullptr;
}

std::string_view english_of(std::string_view id) {
  const Entry* entry = listed(id);
  return entry == nullptr ? std::string_view{} : entry->english;
}

bool is_listed(std::string_view id) {
  return listed(id) != nullptr;
}

class Speaker {
 public:
  Speaker(const Sentence& sentence, const Translate& translate) : m_facts(sentence.facts), m_translate(translate) {}

  /// An entry of the catalogue, else a text in English.
  std::string say(const std::string& id) const {
    const std::string english = is_listed(id) ? std::string(english_of(id)) : id;
    if (english.empty()) return {};
    return filled(m_translate ? m_translate(english) : english);
  }

 private:
  std::string filled(const std::string& text) const {
    std::string out;
    std::size_t at = 0;
    while (at < text.size()) {
      const std::size_t open = text.find('{', at);
      const std::size_t close = open == std::string::npos ? open : text.find('}', open);
      if (close == std::string::npos) break;
      out += text.substr(at, open - at) + fact(text.substr(open + 1, close - open - 1));
      at = close + 1;
    }
    return out + text.substr(at);
  }

  std::string fact(const std::string& name) const {
    const bool entry = name.front() == '@';
    const bool either = name.front() == '|';
    const bool list = name.front() == '+' || either;
    const auto found = m_facts.find(entry || list ? name.substr(1) : name);
    if (found == m_facts.end()) return {};
    if (entry) return say(found->second);
    if (!list) return found->second;
    std::string joined;
    std::size_t from = 0;
    while (from < found->second.size()) {
      const std::size_t comma = std::min(found->second.find(',', from), found->second.size());
      const bool last = comma == found->second.size();
      joined += (joined.empty() ? ""
                                : say(!last    ? "comma"
                                      : either ? "or"
                                               : "and")) +
                say(found->second.substr(from, comma - from));
      from = comma + 1;
    }
    return joined;
  }

  const std::map<std::string, std::string>& m_facts;
  const Translate& m_translate;
};

}  // namespace

std::string said(const Sentence& sentence, const Translate& translate) {
  if (!is_listed(sentence.id)) return {};
  std::string text = Speaker(sentence, translate).say(sentence.id);
  // A sentence that begins with a file's name keeps it as it is.
  constexpr std::string_view file_first = "{recording}";
  if (text.empty() || english_of(sentence.id).starts_with(file_first)) return text;
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return text;
}

std::string plain_name(const std::string& effect_id) {
  if (is_listed(effect_id)) return std::string(english_of(effect_id));
  std::string name = effect_id;
  for (char& c : name) {
    if (c == '_') c = ' ';
  }
  return name;
}

std::vector<std::string> sentence_texts() {
  std::vector<std::string> texts;
  for (const Entry& entry : catalogue) {
    if (!entry.english.empty()) texts.emplace_back(entry.english);
  }
  for (const Entry& entry : names_of_effects()) texts.emplace_back(entry.english);
  return texts;
}

nlohmann::json to_json(const Sentence& sentence) {
  return {{"id", sentence.id}, {"facts", sentence.facts}};
}

Sentence sentence_from_json(const nlohmann::json& document) {
  Sentence sentence;
  if (!document.is_object()) return sentence;
  sentence.id = document.value("id", "");
  sentence.facts = document.value("facts", std::map<std::string, std::string>{});
  sentence.english = said(sentence);
  return sentence;
}

}  // namespace zerodrift::diagnosis
