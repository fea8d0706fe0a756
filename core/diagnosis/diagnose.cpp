#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <set>

#include "core/base/memory.h"
#include "core/diagnosis/another_clock.h"
#include "core/diagnosis/apart.h"
#include "core/diagnosis/bodies.h"
#include "core/diagnosis/checked_runs.h"
#include "core/diagnosis/confidence.h"
#include "core/diagnosis/contradiction.h"
#include "core/diagnosis/diagnoser.h"
#include "core/diagnosis/elsewhere.h"
#include "core/diagnosis/explain.h"
#include "core/diagnosis/heat_of_effect.h"
#include "core/diagnosis/locate.h"
#include "core/diagnosis/place.h"
#include "core/diagnosis/plausible.h"
#include "core/diagnosis/refined.h"
#include "core/diagnosis/thinning.h"
#include "core/diagnosis/units.h"
#include "core/physics/initial_state.h"

namespace zerodrift::diagnosis {
namespace {

using physics::Machine;
using recording::Recording;

constexpr std::size_t most_rows = 1500;
// Of the length: a joint is broad and conducts unevenly, so that its middle is not known better.
constexpr double least_of_a_joint = 0.006;
// A tenth of a cell: what is simulated knows no place better.
constexpr double least_of_a_source = 0.0025;
constexpr double sharp = 0.005;          // of the length: a peak so narrow stands for the whole distribution
constexpr double hardly_any = 0.1;       // of a mismatch: the fit without an effect bends what is described instead
constexpr double widest_point_mm = 6.0;  // what is known worse is told as a stretch

/// What is fitted to this recording keeps its meaning in others.
Machine told_at(Machine machine, const Recording& recording) {
  if (!machine.reference_temperature_C) {
    machine.reference_temperature_C = physics::mean_initial_temperature_C(machine, recording);
  }
  return machine;
}

}  // namespace

Diagnoser::Diagnoser(const Machine& machine, const std::vector<Recording>& recordings, const DiagnoseOptions& options,
                     const TaskContext& context)
    : m_machine(machine),
      m_bodies(told_at(with_inner_bodies(machine), recordings.front())),
      m_recordings(recordings),
      m_fitted(thinned(recordings.front(), most_rows)),
      m_options(options),
      m_context(context) {
  for (std::size_t i = 1; i < recordings.size(); ++i) m_other_rows.push_back(thinned(recordings[i], most_rows));
}

Result<Diagnosis> Diagnoser::run(Of use) {
  m_use = use;
  const auto start = std::chrono::steady_clock::now();
  constexpr double shortest_s = 60.0;  // nothing of a machine warms up in less
  const double whole_s = recording().time_s.back() - recording().time_s.front();
  if (whole_s < shortest_s) {
    return fail(ErrorCode::not_enough_data,
                {{"what", recording().name}, {"found", fmt::format("{:g} s", whole_s)}, {"needed", "60 s"}});
  }
  constexpr std::size_t fewest_rows = 10;
  if (recording().rows() < fewest_rows) {
    return fail(ErrorCode::not_enough_data, {{"what", recording().name},
                                             {"found", std::to_string(recording().rows()) + " samples"},
                                             {"needed", std::to_string(fewest_rows)}});
  }
  ZD_CHECK(prepare());
  if (m_data->samples() < 20) {
    return fail(ErrorCode::not_enough_data,
                {{"what", "the channels that " + m_machine.file + " and " + recording().name + " share"},
                 {"found", std::to_string(m_data->samples()) + " samples"},
                 {"needed", "20"}});
  }
  if (m_lumps_only) {
    ZD_TRY(m_selection, grow_effects(m_bodies, m_data, m_facts, m_limits, m_context));
  } else {
    ZD_CHECK(select());
  }
  held_out();
  if (m_selection.best->elsewhere != 0.0 && refuted()) {
    // What the others were asked about they do not bear out after all: the fitted one decides alone.
    m_limits.others.clear();
    m_wide = false;
    m_data = m_default_data;
    m_out.held_out.clear();
    ZD_CHECK(select());
    held_out();
  }
  m_out.notes = m_selection.base->network().notes;
  for (const auto stage : {&Diagnoser::decide, &Diagnoser::series, &Diagnoser::mismatch, &Diagnoser::effects,
                           &Diagnoser::rivals, &Diagnoser::details}) {
    if (m_context.cancelled()) return fail(ErrorCode::cancelled);
    (this->*stage)();
  }
  if (m_context.cancelled()) return fail(ErrorCode::cancelled);
  if (!m_moved_elsewhere.empty()) m_out.notes.push_back("moved_elsewhere:" + m_moved_elsewhere);
  const bool blind = shows_too_little();
  if (blind) m_out.notes.emplace_back("shows_too_little");
  std::vector<Sentence> far = far_parameters();
  if (m_wrong_geometry) m_out.notes.push_back(note_of(*m_wrong_geometry));
  if (m_misplaced) m_out.notes.push_back(note_of(*m_misplaced));
  const std::vector<std::string> asleep =
      m_out.verdict == Verdict::unexplained || blind ? std::vector<std::string>{} : never_driven();
  if (!asleep.empty()) m_out.notes.push_back(fmt::format("never_driven:{}", fmt::join(asleep, ",")));
  const std::vector<std::string> lacks = not_recorded();
  if (!lacks.empty()) m_out.notes.push_back(fmt::format("not_recorded:{}", fmt::join(lacks, ",")));
  m_out.sentences.push_back(explain_verdict(m_out));
  for (Sentence& one : explain_unexplained(m_out)) m_out.sentences.push_back(std::move(one));
  if (m_not_there && !m_out.doubtful)
    m_out.sentences.push_back(explain_note("described_not_there", {{"name", m_not_there->id}}));
  tell_wrong_set_up();
  signs_turned();
  for (const FoundEffect& found : m_out.effects) {
    const double jump_K = room_jump_K(found);
    if (jump_K == 0.0) continue;
    m_out.notes.emplace_back("room_jumps");
    m_out.sentences.push_back(
        explain_note("room_jumps", {{"kelvin", fmt::format("{:.1f}", jump_K)},
                                    {"at", fmt::format("{:.0f}", found.parameters.at("from_s") / 60.0)}}));
  }
  if (const std::string id = m_out.effects.empty() ? "" : m_selection.best->at_its_limit(); !id.empty()) {
    m_out.notes.push_back("at_its_limit:" + id);
    m_out.sentences.push_back(explain_note("at_its_limit", {{"name", id}}));
  }
  if (const double too_late = wrong_set_up() ? 0.0 : clocks_apart(); too_late != 0.0) {
    m_out.notes.emplace_back(too_late > 0.0 ? "inputs_late" : "inputs_early");
    m_out.sentences.push_back(
        explain_note(m_out.notes.back(), {{"seconds", fmt::format("{:.0f}", seconds_between_rows())}}));
  }
  m_out.sentences.insert(m_out.sentences.end(), m_misstated.begin(), m_misstated.end());
  m_out.sentences.insert(m_out.sentences.end(), far.begin(), far.end());
  if (m_out.verdict != Verdict::unexplained && !blind) cannot_show(asleep);
  notes();
  if (m_use == Of::any && (m_out.verdict == Verdict::unexplained || clocks_apart() != 0.0)) {
    m_out.clock = clock_offset();
  }
  m_out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  m_context.progress(1.0, "done");
  return std::move(m_out);
}

Status Diagnoser::select() {
  ZD_TRY(m_selection, select_effects(m_bodies, m_data, m_facts, m_limits, m_context));
  m_data = m_selection.best->shared_data();
  return choose_drift();
}

Status Diagnoser::prepare() {
  const physics::Network network = physics::build_network(m_bodies, recording());
  const physics::InputSet inputs = physics::make_inputs(network, recording());
  Dataset data = make_dataset(recording(), network);
  data.stop = m_context.stop;
  set_timing_noise(data, network, inputs);
  ZD_CHECK(check_scale(m_machine, data, physics::predict(network, inputs, network.start_values())));
  m_data = m_default_data = std::make_shared<Dataset>(std::move(data));
  for (const Recording& other : m_other_rows) {
    const physics::Network there = physics::build_network(m_bodies, other);
    auto seen = std::make_shared<Dataset>(make_dataset(other, there));
    seen->stop = m_context.stop;
    set_timing_noise(*seen, there, physics::make_inputs(there, other));
    m_limits.others.push_back(std::move(seen));
  }
  m_other_sets = m_limits.others;
  m_facts = facts_of(m_bodies, recording());
  m_lumps_only = of_lumps_alone(m_machine);
  if (m_lumps_only) {
    m_limits.most_effects = 5;
    m_limits.second_clean = 10.0;
    m_limits.own_misfit = false;
    m_limits.excess_must_fall = false;  // few parts, long chains of small effects: evidence alone decides
  }
  return {};
}

/// The slow discrepancy is as large as the evidence says: with the default an imperfect model looks certain of
/// details.
Status Diagnoser::choose_drift() {
  if (excess_of(*m_selection.best).largest <= 3.0) return {};
  const auto discrepancy = likely_discrepancy(*m_default_data, m_selection.best->prediction());
  m_data = std::make_shared<Dataset>(with_discrepancy(*m_default_data, discrepancy));
  m_wide = true;
  ZD_TRY(m_selection, reconsider(m_selection, m_data, m_facts, m_limits, m_context));
  return {};
}

/// The others know the place too, each with offsets and a start of its own. What is fitted stays the first's alone.
void Diagnoser::tell_place(FoundEffect& found, std::size_t index) {
  const physics::Component* rod = m_machine.find(found.component);
  if (rod == nullptr) return;
  const Model& best = *m_selection.best;
  if (!m_of_others) m_of_others = seen_by_all(best, m_limits.others);
  std::map<std::string, double> sigma;
  const Model& last = m_of_others->fits.empty() ? best : *m_of_others->fits.back();
  double at_mm = fitted_effect(last, index, &sigma).numbers.at("position_mm");
  double sigma_mm = sigma["position_mm"];
  std::optional<Place> place;
  if (sigma_mm > sharp * rod->length_mm) place = place_of_effect(best, *m_of_others, index);
  if (place) {
    at_mm = place->mean_mm;
    sigma_mm = place->sigma_mm;
  }
  const double least = found.id == "contact_resistance" ? least_of_a_joint : least_of_a_source;
  found.position_mm = found.parameters["position_mm"] = at_mm;
  found.position_sigma_mm = found.sigma["position_mm"] = std::hypot(sigma_mm, least * rod->length_mm);
  if (found.position_sigma_mm <= widest_point_mm) return;
  const double half_mm = 2.0 * found.position_sigma_mm;
  const auto [from_mm, to_mm] =
      place ? std::pair{place->from_mm, place->to_mm} : std::pair{at_mm - half_mm, at_mm + half_mm};
  found.between_mm = {std::max(0.0, from_mm), std::min(rod->length_mm, to_mm)};
}

/// Two lumps touch each other: the one that is warmed is told first.
void Diagnoser::turn_to_the_colder(FoundEffect& found) const {
  std::string& neighbour = found.words["neighbour"];
  for (const std::string& part : {found.component, neighbour}) {
    const physics::Component* known = m_machine.find(part);
    if (known == nullptr || known->prescribed || !known->lump) return;
  }
  const auto mean_C = [&](const std::string& part) {
    double sum_C = 0.0;
    int count = 0;
    for (std::size_t c = 0; c < m_default_data->channels.size(); ++c) {
      const MeasuredChannel& channel = m_default_data->channels[c];
      const physics::Sensor* sensor = m_machine.sensor(channel.name);
      if (sensor == nullptr || sensor->component != part) continue;
      for (std::size_t k = 0; k < channel.values.size(); ++k) {
        if (channel.present[k]) sum_C += channel.values[k], ++count;
      }
    }
    return count > 0 ? sum_C / count : std::nan("");
  };
  if (!(mean_C(found.component) > mean_C(neighbour))) return;
  std::swap(found.component, neighbour);
  found.words["component"] = found.component;
}

void Diagnoser::effects() {
  if (m_out.verdict == Verdict::unexplained && m_used == m_selection.base) return;
  const Model& best = *m_selection.best;
  const std::vector<std::size_t> named = m_selection.effects();
  for (std::size_t i = 0; i < named.size(); ++i) {
    const std::size_t index = named[i];
    const std::shared_ptr<Model>& without = m_selection.without[i];
    FoundEffect found;
    const physics::EffectSpec spec = fitted_effect(best, index, &found.sigma);
    found.id = spec.id;
    found.component = spec.word_or("component", "");
    found.channel = spec.word_or("channel", "");
    found.words = spec.words;
    if (found.id == "neighbour_heat") turn_to_the_colder(found);
    found.parameters = spec.numbers;
    found.at_rpm = speeds_of_figures(spec.numbers, spec.words, best.network().full_speed_rpm);
    if (spec.numbers.count("position_mm") != 0) {
      found.position_mm = spec.numbers.at("position_mm");
      found.position_sigma_mm = found.sigma["position_mm"];
      tell_place(found, index);
    }
    found.bounds_reached = best.bounds_reached();
    if (m_options.details) found.heat = heat_of_effect(best, index);
    found.log_evidence_gain = m_selection.shown[i];
    // One effect alone: what the table of the channels calls re-fitted is the simulation without it.
    const physics::Prediction other = named.size() == 1 ? m_selection.base->prediction() : without->prediction();
    const ShownBy shown = show_best(found, other);
    found.confidence = confidence_of(found, shown);
    // Beside numbers that had to leave all tolerance something else is wrong, which it may stand for.
    if (m_far.size() > (m_corrected ? 1 : 0)) found.confidence *= doubt::far_numbers;
    doubt_description(found, *without_kind(i));
    end_within_the_run(found);
    const std::vector<FarParameter> far = far_from_description(*without);
    const bool bent = !far.empty() && m_far.empty() && shown.before - shown.after < hardly_any * shown.before;
    found.explanation = bent ? explain_bent(found, m_out.time_s.back(), shown.channel, far.front())
                             : explain_effect(found, m_out.time_s.back(), shown);
    m_out.effects.push_back(std::move(found));
  }
  std::stable_sort(m_out.effects.begin(), m_out.effects.end(),
                   [](const auto& a, const auto& b) { return a.log_evidence_gain > b.log_evidence_gain; });
  place_from_effect();
  if (!m_out.effects.empty()) m_out.mismatch.regime = regime_of_effect(m_out.effects.front(), m_out.time_s.back());
}

/// Where an effect shows: the channel with the largest mismatch if it is the only one, else the one that it changes
/// most in widths of noise.
ShownBy Diagnoser::show_best(FoundEffect& found, const physics::Prediction& without) const {
  ShownBy best;
  double largest = 0.0;
  for (std::size_t c = 0; c < m_data->channels.size(); ++c) {
    const MeasuredChannel& channel = m_data->channels[c];
    if (channel.samples == 0) continue;
    const double before = rms_between(recording(), channel.name, without.channels[c].values);
    const double after = rms_between(recording(), channel.name, m_explained.channels[c].values);
    found.contribution[channel.name] = std::sqrt(std::max(0.0, before * before - after * after));
    const double widths = found.contribution[channel.name] / std::hypot(channel.white, channel.drift);
    const bool named = m_selection.effects().size() == 1 && m_out.mismatch.channels.front() == channel.name;
    const bool own = channel.name == found.channel;  // what is wrong with a channel shows in it
    const double weight = own ? 2e300 : widths <= 1.0 ? widths : named ? 1e300 : widths;
    if (weight < largest && !best.channel.empty()) continue;
    best = {channel.name, before, after, channel.white};
    largest = weight;
  }
  return best;
}

/// What was still going on when the recording ended has no end that it knows.
void Diagnoser::end_within_the_run(FoundEffect& found) const {
  const auto end = found.parameters.find("to_s");
  if (end == found.parameters.end() || end->second < m_out.time_s.back()) return;
  end->second = m_out.time_s.back();
  found.sigma.erase("to_s");
}

std::string_view name_of(ChannelVerdict verdict) {
  return verdict == ChannelVerdict::consistent    ? "consistent"
         : verdict == ChannelVerdict::unexplained ? "unexplained"
                                                  : "explained";
}

std::string_view name_of(Verdict verdict) {
  return verdict == Verdict::consistent    ? "consistent"
         : verdict == Verdict::unexplained ? "unexplained"
                                           : "missing_effect";
}

Result<Diagnosis> diagnose(const Machine& machine, const std::vector<Recording>& given, const DiagnoseOptions& options,
                           const TaskContext& context) {
  if (given.empty())
    return fail(ErrorCode::bad_argument, {{"what", "recordings"}, {"found", "none"}, {"expected", "at least one"}});
  keep_freed_memory();
  ZD_TRY(CheckedRuns runs, checked_runs(machine, given));
  const bool apart = falls_apart(machine);
  Result<Diagnosis> result = apart ? diagnose_apart(machine, runs.recordings, options, context)
                                   : Diagnoser(machine, runs.recordings, options, context).run();
  if (result && !apart) result = with_one_clock(std::move(*result), machine, runs.recordings, options, context);
  const ClockOffset clock = result && !apart ? result->clock : ClockOffset{};
  if (result && !apart) result = settled(std::move(*result), machine, runs.recordings, options, context);
  if (!result) return result;
  tell_clock(*result, clock);
  doubt_whole(*result, machine);
  if (const auto& raised = machine.tolerances.raised; !raised.empty()) {
    result->notes.push_back(fmt::format("tolerances_raised:{}", fmt::join(raised, ",")));
    result->sentences.push_back(explain_raised(machine.tolerances));
  }
  result->sentences.insert(result->sentences.end(), runs.told.begin(), runs.told.end());
  result->notes.insert(result->notes.end(), runs.warnings.begin(), runs.warnings.end());
  result->findings = runs.findings;
  return result;
}

}  // namespace zerodrift::diagnosis
