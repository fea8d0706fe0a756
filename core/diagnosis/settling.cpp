// Does a displacement only move by itself? What creeps - a nest, a clamped probe - passes for a structure that was
// out of balance when the recording began: both move on their own and slow down. A probe that drifts passes for one
// that follows a room which goes one way all the time. The structure must show that it follows the room.
#include <algorithm>
#include <limits>

#include "core/diagnosis/elsewhere.h"
#include "core/diagnosis/selector.h"

namespace zerodrift::diagnosis {
namespace {

constexpr double in_doubt = 8.0;

ModelPtr moving_alone(const ModelPtr& model, const physics::EffectSpec& alone) {
  ModelPtr rival = extended(*model, {alone, 0, 0, {}});
  rival->fit({20, 0.05, true});
  return rival;
}

}  // namespace

double Selector::lead_over_moving_alone(std::size_t effect, const std::string& channel) const {
  const ModelPtr best = std::make_shared<Model>(*m_result.best);
  const ModelPtr less = reduced(*best, effect);
  less->fit({0, 1.0, true});
  double lead = std::numeric_limits<double>::infinity();
  for (const auto& alone : {physics::settling_by_itself(channel), physics::drifting_by_itself(channel)}) {
    const ModelPtr rival = with_ordinary(moving_alone(less, alone));
    const double here = total_gain(*best, *rival);
    if (m_options.others.empty() || happened_once(*best) || here > in_doubt) {
      lead = std::min(lead, here);
      continue;
    }
    std::vector<ModelPtr> asked = {best, rival};
    ask_elsewhere(asked, *less, m_options.others);
    // One of them may not fit there at all.
    if (asked.size() == 1) {
      if (asked.front() == rival) return -std::numeric_limits<double>::infinity();
    } else {
      lead = std::min(lead, here + best->elsewhere - rival->elsewhere);
    }
  }
  return lead;
}

bool Selector::settles_beside_nothing(const std::string& channel) const {
  const Model& none = *m_result.base;
  const ModelPtr rival = with_ordinary(moving_alone(m_result.base, physics::settling_by_itself(channel)));
  const double gained = total_gain(*rival, none);
  if (m_options.others.empty()) return gained > m_options.together;
  if (gained < speaks_against) return false;
  std::vector<ModelPtr> asked = {rival};
  ask_elsewhere(asked, none, m_options.others);
  return gained + rival->elsewhere > m_options.together;
}

void Selector::try_settling() {
  m_result.settling.clear();
  m_result.lead_over_moving_alone.clear();
  if (!m_options.own_misfit) return;
  const Model& best = *m_result.best;
  if (m_result.best == m_result.base) {
    for (const MeasuredChannel& channel : best.data().channels) {
      const bool seen = !channel.temperature && channel.samples > 0;
      if (seen && settles_beside_nothing(channel.name)) m_result.settling = channel.name;
    }
    return;
  }
  for (std::size_t i = 0; i < best.unknowns(); ++i) {
    const physics::Parameter& unknown = best.unknown(i);
    const bool of_a_candidate = unknown.effect >= static_cast<int>(m_result.described);
    if (!of_a_candidate || !unknown.per_recording || unknown.channel.empty()) continue;
    const double lead = lead_over_moving_alone(static_cast<std::size_t>(unknown.effect), unknown.channel);
    m_result.lead_over_moving_alone[unknown.channel] = lead;
    if (lead < 0.0) m_result.settling = unknown.channel;
  }
}

}  // namespace zerodrift::diagnosis
