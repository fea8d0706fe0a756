// What one gauge has to itself: a displacement that moves by itself, a sensor without which nothing is missing.
#include <algorithm>
#include <string>

#include "core/diagnosis/diagnoser.h"
#include "core/diagnosis/parallel.h"

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
  in_parallel(tried.size(), [&](std::size_t i) {
    auto data = std::make_shared<Dataset>(*m_default_data);
    MeasuredChannel& channel = data->channels[tried[i].channel];
    std::fill(channel.present.begin(), channel.present.end(), false);
    channel.samples = 0;
    data->prepare();
    Model others(m_selection.base->machine(), data);
    others.fit({});
    tried[i].left = excess_of(others).largest;
  });
  const auto best =
      std::min_element(tried.begin(), tried.end(), [](const Without& a, const Without& b) { return a.left < b.left; });
  if (best->left > least_evident) return;
  const std::string& name = m_default_data->channels[best->channel].name;
  m_out.notes.push_back("sensor_alone:" + name);
  m_out.sentences.push_back(explain_note("sensor_alone", {{"channel", name}}));
}

}  // namespace zerodrift::diagnosis
