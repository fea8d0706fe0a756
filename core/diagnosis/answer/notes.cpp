#include "core/diagnosis/answer/notes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/diagnosis/answer/detectable.h"
#include "core/diagnosis/input/channels.h"
#include "core/physics/initial_state.h"

namespace zerodrift::diagnosis::answer {

namespace {

/// What ran without being logged looks like nothing the library has, or like something that came and went.
std::vector<std::string> inputs_not_logged(const PosteriorSummary& summary) {
  std::vector<std::string> missing;
  const bool spindle = summary.described.rated_speed_rpm() > 0.0;  // a printer is not advised to log its coolant
  for (const char* column : {"coolant_on", "spindle_load_W"}) {
    const bool logged = std::any_of(summary.recordings.begin(), summary.recordings.end(),
                                    [&](const auto& one) { return one.find(column) != nullptr; });
    if (spindle && !logged) missing.emplace_back(column);
  }
  return missing;
}

/// What the networks had to assume, and numbers that the description states too well.
std::vector<Note> assumed(const PosteriorSummary& summary) {
  std::vector<Note> list;
  const auto& codes = summary.best.model().network(0).notes;
  for (const std::string& code : codes) {
    const std::size_t colon = code.find(':');
    const std::string of = colon == std::string::npos ? "" : code.substr(colon + 1);
    for (const NoteCode known : {NoteCode::room_given, NoteCode::room_is_initial_temperature, NoteCode::room_not_logged,
                                 NoteCode::capacity_unknown, NoteCode::conductance_unknown, NoteCode::warm_start}) {
      if (code.substr(0, colon) != diagnosis::name_of(known)) continue;
      const auto before = std::find_if(list.begin(), list.end(), [&](const Note& note) { return note.code == known; });
      if (known == NoteCode::capacity_unknown && before != list.end()) {
        before->facts["components"] += ", " + of;
        continue;
      }
      Note note{known, {}};
      if (!of.empty()) note.facts[known == NoteCode::capacity_unknown ? "components" : "component"] = of;
      if (known == NoteCode::room_not_logged) note.facts["column"] = summary.described.room.channel;
      if (known == NoteCode::warm_start) {
        const double above_K = physics::start_above_room_K(summary.described, of, summary.recordings.front());
        const bool sensor_wrong = std::any_of(summary.named.begin(), summary.named.end(), [](const Name& name) {
          return physics::find_effect(name.id)->traits.room_reads_wrong;
        });
        if (above_K != 0.0 && !sensor_wrong) note.facts["above"] = fmt::format("{:.1f}", above_K);
      }
      list.push_back(std::move(note));
    }
  }
  if (const auto& raised = summary.described.tolerances.raised; !raised.empty())
    list.push_back({NoteCode::tolerances_raised, {{"keys", fmt::format("{}", fmt::join(raised, ","))}}});
  return list;
}

}  // namespace

void add_notes(const PosteriorSummary& summary, Diagnosis& answer) {
  std::vector<Note>& notes = answer.notes;
  for (Note& one : assumed(summary)) notes.push_back(std::move(one));
  for (Note& one : limits_of(summary.described, summary.recordings)) notes.push_back(std::move(one));
  const bool blind = summary.options.details && answer.verdict == Verdict::consistent &&
                     shows_too_little(summary.posterior, answer.detectable);
  if (blind) notes.push_back({NoteCode::shows_too_little, {}});
  const auto add = [&](NoteCode code, const char* key, const std::vector<std::string>& values) {
    if (!values.empty()) notes.push_back({code, {{key, fmt::format("{}", fmt::join(values, ","))}}});
  };
  if (answer.verdict == Verdict::unexplained || blind) {
    add(NoteCode::inputs_not_logged, "columns", inputs_not_logged(summary));
  } else {
    add(NoteCode::not_recorded, "columns", columns_lacking(summary.described, summary.recordings));
    if (summary.options.details) {
      add(NoteCode::never_driven, "effects", never_driven(summary.posterior, answer.detectable));
      add(NoteCode::cannot_show, "effects", cannot_show(answer));
    }
    const bool open_door = std::any_of(answer.effects.begin(), answer.effects.end(),
                                       [](const FoundEffect& found) { return !found.intervals_s.empty(); });
    if (open_door) add(NoteCode::inputs_not_logged, "columns", inputs_not_logged(summary));
  }
  notes.insert(notes.end(), summary.runs.notes.begin(), summary.runs.notes.end());
}

}  // namespace zerodrift::diagnosis::answer
