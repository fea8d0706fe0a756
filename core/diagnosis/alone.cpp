// What one gauge has to itself: a displacement that moves by itself, a sensor without which nothing is missing.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <string>

#include "core/diagnosis/diagnoser.h"
#include "core/diagnosis/parallel.h"
#include "core/diagnosis/places_tried.h"

namespace zerodrift::diagnosis {

/// What follows a room that goes one way all the time looks like what drifts by itself.
void Diagnoser::moving_alone() {
  constexpr double in_doubt = 6.0;  // log evidence: the confidence is then below 0.9
  if (!m_selection.settling.empty()) {
    m_out.notes.push_back("settles_by_itself:" + m_selection.settling);
    m_out.sentences.push_back(explain_note("moves_by_itself", {{"channel", m_selection.settling}}));
    return;
  }
  if (m_out.verdict != Verdict::missing_effect) return;
  for (const auto& [channel, lead] : m_selection.lead_over_moving_alone) {
    if (lead < in_doubt) m_out.sentences.push_back(explain_note("follows_or_drifts", {{"channel", channel}}));
  }
}

/// Heat that nobody described spreads; what a single sensor sees is the sensor, or hardly more than it.
void Diagnoser::sensor_alone() {
  if (m_out.verdict != Verdict::unexplained || m_lumps_only || wrong_set_up() || m_warmth_left <= least_evident) return;
  struct Without {
    std::size_t channel = 0;
    double left = 0.0;  // excess of what is slow in the others
  };
  std::vector<Without> tried;
  for (std::size_t c = 0; c < m_default_data->channels.size(); ++c) {
    const MeasuredChannel& channel = m_default_data->channels[c];
    if (channel.temperature && channel.samples > 0) tried.push_back({c});
  }
  constexpr std::size_t fewest = 4;  // without one the others still show how heat spreads
  if (tried.size() < fewest) return;
  const auto least_left = [&](const physics::Machine& machine) {
    in_parallel(tried.size(), [&](std::size_t i) {
      auto data = std::make_shared<Dataset>(*m_default_data);
      MeasuredChannel& channel = data->channels[tried[i].channel];
      std::fill(channel.present.begin(), channel.present.end(), false);
      channel.samples = 0;
      data->prepare();
      Model others(machine, data);
      others.fit({});
      tried[i].left = excess_of(others).largest;
    });
    return *std::min_element(tried.begin(), tried.end(), [](const auto& a, const auto& b) { return a.left < b.left; });
  };
  Without best = least_left(m_selection.base->machine());
  std::string beside;  // what explains the others
  if (best.left > least_evident) {
    const physics::Machine sound = without_sensor_faults(m_selection.best->machine());
    std::set<std::string> ids;
    for (const physics::EffectSpec& spec : sound.effects) {
      if (spec.candidate) ids.insert(spec.id);
    }
    beside = fmt::format("{}", fmt::join(ids, ","));
    if (beside.empty()) return;
    best = least_left(sound);
  }
  if (best.left > least_evident) return;
  const std::string& name = m_default_data->channels[best.channel].name;
  m_out.notes.push_back("sensor_alone:" + name);
  m_out.sentences.push_back(beside.empty()
                                ? explain_note("sensor_alone", {{"channel", name}})
                                : explain_note("sensor_alone_beside", {{"channel", name}, {"effects", beside}}));
}

}  // namespace zerodrift::diagnosis
