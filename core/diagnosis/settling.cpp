// Does a displacement only settle by itself? What creeps - a nest, a clamped probe - passes for a structure that was
// out of balance when the recording began: both move on their own and slow down. The structure must show that it
// follows the room.
#include <algorithm>

#include "core/diagnosis/elsewhere.h"
#include "core/diagnosis/selector.h"

namespace zerodrift::diagnosis {
namespace {

constexpr double in_doubt = 8.0;

ModelPtr with_settling(const ModelPtr& model, const std::string& channel) {
  ModelPtr rival = extended(*model, {physics::settling_by_itself(channel), 0, 0, {}});
  rival->fit({20, 0.05, true});
  return rival;
}

}  // namespace

bool Selector::settles_instead(std::size_t effect, const std::string& channel) const {
  const ModelPtr best = std::make_shared<Model>(*m_result.best);
  const ModelPtr less = reduced(*best, effect);
  less->fit({0, 1.0, true});
  const ModelPtr rival = with_ordinary(with_settling(less, channel));
  const double gained = total_gain(*rival, *best);
  if (m_options.others.empty() || happened_once(*best) || gained < -in_doubt) return gained > 0.0;
  std::vector<ModelPtr> asked = {best, rival};
  ask_elsewhere(asked, *less, m_options.others);
  // One of them may not fit there at all.
  if (asked.size() == 1) return asked.front() == rival;
  return gained + rival->elsewhere - best->elsewhere > 0.0;
}

bool Selector::settles_beside_nothing(const std::string& channel) const {
  const Model& none = *m_result.base;
  const ModelPtr rival = with_ordinary(with_settling(m_result.base, channel));
  const double gained = total_gain(*rival, none);
  if (m_options.others.empty()) return gained > m_options.together;
  if (gained < speaks_against) return false;
  std::vector<ModelPtr> asked = {rival};
  ask_elsewhere(asked, none, m_options.others);
  return gained + rival->elsewhere > m_options.together;
}

void Selector::try_settling() {
  m_result.settling.clear();
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
    if (settles_instead(static_cast<std::size_t>(unknown.effect), unknown.channel)) m_result.settling = unknown.channel;
  }
}

}  // namespace zerodrift::diagnosis
