#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/diagnosis/diagnoser.h"
#include "core/diagnosis/experiment.h"
#include "core/diagnosis/explain.h"
#include "core/diagnosis/locate.h"
#include "core/diagnosis/plausible.h"
#include "core/diagnosis/refined.h"
#include "core/physics/effects/effect.h"
#include "core/physics/initial_state.h"

namespace zerodrift::diagnosis {

using physics::Machine;
using recording::Recording;

void Diagnoser::series() {
  m_out.time_s = recording().time_s;
  const physics::Network network = physics::build_network(m_machine, recording());
  const physics::Prediction nominal =
      physics::predict(network, physics::make_inputs(network, recording()), network.start_values());
  const physics::Prediction base = m_selection.base->prediction();
  m_explained = m_used->prediction();
  const Excess before = excess_of(*m_selection.base);
  const Excess after = excess_of(*m_used);
  if (m_used == m_selection.best) without_effects();
  for (std::size_t c = 0; c < m_data->channels.size(); ++c) {
    const MeasuredChannel& channel = m_data->channels[c];
    if (channel.samples == 0) continue;
    ChannelReport report;
    report.channel = channel.name;
    report.temperature = channel.temperature;
    report.measured = recording().find(channel.name)->values;
    report.nominal = nominal.channels[c].values;
    report.refitted = base.channels[c].values;
    report.explained = m_explained.channels[c].values;
    report.rms_nominal = rms_between(recording(), channel.name, report.nominal);
    report.rms_refitted = rms_between(recording(), channel.name, report.refitted);
    report.rms_explained = rms_between(recording(), channel.name, report.explained);
    report.noise = channel.white;
    report.excess_refitted = before.per_channel[c];
    report.excess_explained = after.per_channel[c];
    // The channel's mismatch is what the effects change in it, in noise widths; without an effect, what is left over.
    const bool nothing_told = m_used != m_selection.best;
    report.score = nothing_told             ? report.rms_refitted / usual_noise(channel.temperature)
                   : m_contribution.empty() ? std::sqrt(std::max(0.0, report.excess_refitted))
                                            : m_contribution[c] / usual_noise(channel.temperature);
    m_out.channels.push_back(std::move(report));
  }
}

/// Sensors of a kind are alike: the median of their noise, so that no channel is worst for seeming a little quieter.
double Diagnoser::usual_noise(bool temperature) const {
  std::vector<double> widths;
  for (const auto& channel : m_data->channels) {
    if (channel.samples > 0 && channel.temperature == temperature) widths.push_back(channel.white);
  }
  if (widths.empty()) return 1.0;
  std::sort(widths.begin(), widths.end());
  return widths[widths.size() / 2];
}

/// Rms of what all found effects together change in each channel: the best model with and without them.
void Diagnoser::without_effects() {
  if (m_selection.effects().empty()) return;
  Machine bare = refined_machine(*m_selection.best);
  bare.effects.resize(m_selection.described);
  const physics::Network network = physics::build_network(bare, recording());
  const physics::InputSet inputs = physics::make_inputs(network, recording());
  const Machine full = refined_machine(*m_selection.best);
  const physics::Network full_network = physics::build_network(full, recording());
  const physics::Prediction with =
      physics::predict(full_network, physics::make_inputs(full_network, recording()), full_network.start_values());
  const physics::Prediction without = physics::predict(network, inputs, network.start_values());
  m_contribution.assign(m_data->channels.size(), 0.0);
  m_contribution_in_time.assign(recording().rows(), 0.0);
  for (std::size_t c = 0; c < m_contribution.size(); ++c) {
    if (m_data->channels[c].samples == 0) continue;
    const double noise = std::hypot(m_data->channels[c].white, m_data->channels[c].drift);
    for (std::size_t k = 0; k < recording().rows(); ++k) {
      const double d = with.channels[c].values[k] - without.channels[c].values[k];
      m_contribution[c] += d * d / static_cast<double>(recording().rows());
      m_contribution_in_time[k] += d * d / (noise * noise);
    }
    m_contribution[c] = std::sqrt(m_contribution[c]);
  }
}

void Diagnoser::details() {
  if (!m_options.details) return;
  std::map<std::string, Detectable> least;
  std::vector<Candidate> asked = m_selection.screened;
  if (m_out.verdict == Verdict::missing_effect) {  // what could not be there before something else was
    std::vector<Candidate> beside = screen(*m_selection.best, m_facts);
    std::erase_if(beside, [&](const Candidate& one) {
      return std::any_of(asked.begin(), asked.end(), [&](const auto& had) { return had.spec.id == one.spec.id; });
    });
    asked.insert(asked.end(), beside.begin(), beside.end());
  }
  for (const auto& candidate : asked) {
    if (candidate.detectable <= 0.0) continue;
    const auto& parameters = physics::find_effect(candidate.spec.id)->parameters;
    std::string key;
    for (const auto& p : parameters) {
      if (p.amplitude && candidate.spec.numbers.count(std::string(p.key)) != 0 && key.empty()) key = p.key;
    }
    auto& kept = least[candidate.spec.id];
    if (kept.id.empty() || candidate.detectable < kept.value) {
      kept = {candidate.spec.id, key, candidate.detectable, candidate.usual};
      const auto at =
          speeds_of_figures(candidate.spec.numbers, candidate.spec.words, m_selection.base->network().full_speed_rpm);
      if (at.count(key) != 0) kept.at_rpm = at.at(key);
    }
  }
  for (auto& [id, detectable] : least) m_out.detectable.push_back(detectable);
  if (m_rivals.empty()) return;
  std::vector<const Model*> rivals;
  for (const auto& rival : m_rivals) rivals.push_back(rival.get());
  m_out.suggested = suggest_experiment(*m_selection.best, rivals);
}

/// Nothing is found, but nothing could have been: most effects would not show at the size that they usually have.
bool Diagnoser::shows_too_little() const {
  if (m_out.verdict != Verdict::consistent || m_out.detectable.empty()) return false;
  const auto told = [](const MeasuredChannel& channel) { return channel.temperature && channel.samples > 0; };
  if (std::none_of(m_default_data->channels.begin(), m_default_data->channels.end(), told)) return true;
  const auto hidden = std::count_if(m_out.detectable.begin(), m_out.detectable.end(),
                                    [](const Detectable& least) { return least.value > least.usual; });
  return 2 * hidden > std::ssize(m_out.detectable);
}

/// 0 too where the room's sensor is at fault: it is the room's column that is off, not the machine.
double Diagnoser::start_above_room_K(const physics::Component& component) const {
  const auto& effects = m_selection.best->machine().effects;
  const bool fault = std::any_of(effects.begin(), effects.end(),
                                 [](const auto& spec) { return spec.candidate && spec.id == "room_sensor_fault"; });
  return component.lump || fault ? 0.0 : physics::start_above_room_K(m_machine, component.id, recording());
}

void Diagnoser::tell_wrong_set_up() {
  if (m_wrong_geometry) {
    constexpr std::array ids{"overlong", "other_end", "datum", "diameter"};
    const WrongGeometry& wrong = *m_wrong_geometry;
    const bool nearer = wrong.what == WrongGeometry::What::datum && wrong.fits_mm < 0.0;
    const char* id = nearer ? "datum_nearer" : ids.at(static_cast<std::size_t>(wrong.what));
    m_out.sentences.push_back(explain_note(id, {{"component", wrong.component},
                                                {"described", fmt::format("{:.0f}", wrong.described_mm)},
                                                {"bare", fmt::format("{:.0f}", wrong.bare_mm)},
                                                {"fits", fmt::format("{:.0f}", std::abs(wrong.fits_mm))}}));
  }
  if (!m_misplaced) return;
  const std::string other = m_misplaced->exchanged_with;
  const char* id = !m_misplaced->all_in.empty() ? "places_in" : other.empty() ? "misplaced" : "exchanged";
  m_out.sentences.push_back(explain_note(id, {{"channel", m_misplaced->channel},
                                              {"other", other},
                                              {"unit", m_misplaced->all_in},
                                              {"described", fmt::format("{:.4g}", m_misplaced->described_mm)},
                                              {"at", fmt::format("{:.0f}", m_misplaced->at_mm)}}));
  if (!other.empty() || !m_misplaced->all_in.empty()) return;
  for (const physics::EffectSpec& spec : m_selection.best->machine().effects) {
    if (!spec.candidate || !spec.id.starts_with("sensor_")) continue;
    if (spec.word_or("channel", "") != m_misplaced->channel) continue;
    m_out.notes.push_back("misplaced_or_faulty:" + spec.id);
    m_out.sentences.push_back(explain_note("misplaced_or_faulty", {{"name", spec.id}}));
  }
}

/// Displacements that count the other way than described.
std::vector<std::string> Diagnoser::mirrored() const {
  std::vector<std::string> list;
  if (m_out.verdict == Verdict::consistent) return list;
  for (const MeasuredChannel& channel : m_default_data->channels) {
    if (channel.samples == 0) continue;
    const auto report = std::find_if(m_out.channels.begin(), m_out.channels.end(),
                                     [&](const ChannelReport& one) { return one.channel == channel.name; });
    if (report != m_out.channels.end() && is_mirrored(channel, report->nominal)) list.push_back(channel.name);
  }
  return list;
}

void Diagnoser::signs_turned() {
  for (const std::string& channel : mirrored()) {
    m_out.notes.push_back("sign_turned:" + channel);
    m_out.sentences.push_back(explain_note("sign_turned", {{"channel", channel}}));
  }
}

/// A simulation that agrees only with numbers far from the description's does not bear the description out.
std::vector<Sentence> Diagnoser::far_parameters() {
  constexpr std::size_t most_told = 3;
  std::vector<Sentence> told;
  const bool turned = !mirrored().empty();  // an expansion that shrank towards the other sign says only that
  for (const FarParameter& one : m_far) {
    m_out.notes.push_back(fmt::format("far_from_description:{}:{}:{:.3g}", one.quantity.substr(9), one.of, one.factor));
    if (told.size() == most_told || (turned && one.quantity == "quantity_expansion")) continue;
    told.push_back(explain_far(one));
  }
  return told;
}

/// What may be there although it is not named: no size that there can be would have shown, what drives it never acted,
/// or what it moves was not recorded.
void Diagnoser::cannot_show(const std::vector<std::string>& never_driven) {
  if (const std::string lacks = fmt::format("{}", fmt::join(not_recorded(), ", ")); !lacks.empty()) {
    m_out.sentences.push_back(explain_note("not_recorded", {{"columns", lacks}}));
  }
  std::vector<std::string> unseen;
  for (const Detectable& least : m_out.detectable) {
    const bool named = std::any_of(m_out.effects.begin(), m_out.effects.end(),
                                   [&](const auto& found) { return found.id == least.id; });
    if (named || least.key.empty() || physics::log_prior_of(least.id) < 0.0) continue;
    if (least.value > physics::find_effect(least.id)->parameter(least.key).high) unseen.push_back(least.id);
  }
  if (!unseen.empty()) m_out.sentences.push_back(explain_unseen(unseen));
  if (never_driven.empty()) return;
  m_out.sentences.push_back(
      explain_note("never_driven", {{"effects", fmt::format("{}", fmt::join(never_driven, ","))}}));
}

std::vector<std::string> Diagnoser::not_recorded() const {
  std::vector<std::string> missing;
  const auto look_for = [&](const std::string& channel) {
    if (recording().find(channel) == nullptr) missing.push_back(channel);
  };
  for (const auto& sensor : m_machine.sensors) {
    if (sensor.component != "ambient") look_for(sensor.channel);
  }
  for (const auto& displacement : m_machine.displacements) look_for(displacement.channel);
  return missing;
}

/// Inputs that the recording logs and that never acted: what acts with them alone was not asked about.
std::vector<std::string> Diagnoser::never_driven() const {
  const auto logged = [&](const char* column) { return recording().find(column) != nullptr; };
  physics::RunFacts all = m_facts;
  all.has_speed = all.has_speed || logged("spindle_rpm");
  all.has_coolant = all.has_coolant || logged("coolant_on");
  all.has_load = all.has_load || logged("spindle_load_W");
  std::vector<std::string> untold;
  for (const physics::Effect* effect : physics::all_effects()) {
    const std::string id(effect->id);
    if (physics::log_prior_of(id) < 0.0) continue;
    // More forms of it is enough: a coolant that never ran may be there beside one that always does.
    if (effect->candidates(m_machine, all).size() > effect->candidates(m_machine, m_facts).size() &&
        std::none_of(m_out.detectable.begin(), m_out.detectable.end(), [&](const auto& one) { return one.id == id; })) {
      untold.push_back(id);
    }
  }
  return untold;
}

/// What switches between two rows that are far apart has moved the machine by an unknown amount.
bool Diagnoser::rows_are_coarse() const {
  constexpr double coarse_s = 120.0;
  return seconds_between_rows() >= coarse_s && !nothing_drives();
}

void Diagnoser::coarse_rows() {
  if (!rows_are_coarse()) return;
  m_out.notes.emplace_back("coarse_rows");
  m_out.sentences.push_back(explain_note("coarse_rows", {{"seconds", fmt::format("{:.0f}", seconds_between_rows())}}));
}

double Diagnoser::seconds_between_rows() const {
  const std::vector<double>& time_s = m_recordings.front().time_s;
  return (time_s.back() - time_s.front()) / static_cast<double>(time_s.size() - 1);
}

/// The room alone says little about the machine; what cools down from warm does.
bool Diagnoser::nothing_drives() const {
  return physics::nothing_drives(m_selection.base->inputs()) && !physics::starts_warm(m_machine, recording());
}

/// Something drives the machine, and some channel shows it.
bool Diagnoser::moves() const {
  constexpr double widths = 12.0;
  return !nothing_drives() && std::any_of(m_out.channels.begin(), m_out.channels.end(), [](const ChannelReport& c) {
    double low = 1e300, high = -1e300;
    for (const double v : c.measured) {
      if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
    }
    return high - low > widths * c.noise;
  });
}

/// Two sensors fit whatever heats between them and around them.
void Diagnoser::few_sensors() {
  constexpr std::ptrdiff_t few = 2;
  for (const auto& component : m_machine.components) {
    if (component.lump) continue;
    const auto used = std::count_if(
        m_default_data->channels.begin(), m_default_data->channels.end(), [&](const MeasuredChannel& channel) {
          const physics::Sensor* sensor = m_machine.sensor(channel.name);
          return channel.samples > 0 && channel.temperature && sensor != nullptr && sensor->component == component.id;
        });
    if (used > few) continue;
    m_out.notes.push_back(fmt::format("few_sensors:{}:{}", component.id, used));
    m_out.sentences.push_back(explain_note("few_sensors", {{"part", component.id}, {"count", std::to_string(used)}}));
  }
}

/// What ran without being logged looks like nothing the library has, or like a draught.
void Diagnoser::inputs_not_logged() {
  const bool draught = std::any_of(m_out.effects.begin(), m_out.effects.end(),
                                   [](const FoundEffect& found) { return found.id == "draught"; });
  if (m_out.verdict != Verdict::unexplained && !draught) return;
  std::vector<std::string> missing;
  for (const char* column : {"coolant_on", "spindle_load_W"}) {
    if (recording().find(column) == nullptr) missing.emplace_back(column);
  }
  if (missing.empty()) return;
  const std::string columns = fmt::format("{}", fmt::join(missing, ", "));
  m_out.notes.push_back("inputs_not_logged:" + columns);
  m_out.sentences.push_back(explain_note("inputs_not_logged", {{"columns", columns}}));
}

void Diagnoser::notes() {
  few_sensors();
  moving_alone();
  sensor_alone();
  inputs_not_logged();
  if (std::count(m_out.notes.begin(), m_out.notes.end(), "room_not_logged") != 0) {
    m_out.sentences.push_back(explain_note("room_not_logged", {{"column", m_machine.room.channel}}));
  }
  for (const auto& component : m_machine.components) {
    const double above_K = start_above_room_K(component);
    if (above_K == 0.0) continue;
    m_out.sentences.push_back(
        explain_note(above_K > 0.0 ? "starts_warm" : "starts_cold",
                     {{"part", component.id}, {"above", fmt::format("{:.1f}", std::abs(above_K))}}));
  }
  coarse_rows();
  if (std::count(m_out.notes.begin(), m_out.notes.end(), "counts_from_each_start") != 0) {
    m_out.sentences.push_back(explain_note("counts_from_each_start"));
  }
  another_machine();
  worse_elsewhere();
  if (!moves()) {
    m_out.notes.emplace_back("no_excitation");
    m_out.sentences.push_back(explain_note("no_excitation"));
  }
  if (m_out.verdict == Verdict::unexplained && m_selection.falling_heat > 0.0 && !m_out.mismatch.channels.empty()) {
    m_out.notes.push_back("heat_falls_with_speed:" + m_out.mismatch.channels.front());
  }
  if (m_out.verdict == Verdict::missing_effect && m_selection.best->elsewhere != 0.0) {
    m_out.notes.push_back("decided_with_others:" + m_selection.best->machine().effects.back().id);
  }
}

}  // namespace zerodrift::diagnosis
