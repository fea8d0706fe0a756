#include "core/diagnosis/confidence.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/diagnosis/bodies.h"
#include "core/diagnosis/diagnoser.h"
#include "core/diagnosis/elsewhere.h"
#include "core/physics/initial_state.h"

namespace zerodrift::diagnosis {

/// Of the rivals of an effect: other families of the last level, the effect's absence, and what drifts by itself.
double Diagnoser::odds_against(const FoundEffect& found) const {
  const auto odds = [](double lead) { return std::exp(-lead / doubt::temperature); };
  double others = odds(found.log_evidence_gain - m_limits.first);
  std::set<std::string> seen;
  const Model& best = *m_selection.best;
  const auto& named = best.machine().effects;
  for (const auto& level : m_selection.levels) {
    for (const auto& fit : level) {
      if (fit->machine().effects.size() != named.size()) continue;
      const std::string& id = fit->machine().effects.back().id;
      // The same effects found in another order are no rivals of each other.
      const bool own = std::any_of(named.begin(), named.end(), [&](const auto& spec) { return spec.id == id; });
      if (own || !seen.insert(id).second) continue;
      others += odds(std::max(0.0, evidence_of(best) - evidence_of(*fit)));
    }
  }
  if (const auto lead = m_selection.lead_over_moving_alone.find(found.channel);
      lead != m_selection.lead_over_moving_alone.end() && found.id.starts_with("structure_")) {
    others += odds(std::max(0.0, lead->second));
  }
  return others;
}

/// The room's step between two rows, in K, at the moment when a draught is said to begin; 0: none.
double Diagnoser::room_jump_K(const FoundEffect& found) const {
  constexpr double about_s = 300.0;
  constexpr double no_air_K = 1.0;
  const recording::Channel* room = recording().find(m_machine.room.channel);
  const auto from = found.parameters.find("from_s");
  if (found.id != "draught" || room == nullptr || from == found.parameters.end()) return 0.0;
  double largest_K = 0.0;
  for (std::size_t k = 1; k < recording().rows(); ++k) {
    if (std::abs(recording().time_s[k] - from->second) > about_s) continue;
    const double step_K = room->values[k] - room->values[k - 1];
    if (std::abs(step_K) > std::max(no_air_K, std::abs(largest_K))) largest_K = step_K;
  }
  return largest_K;
}

/// Log evidence for inputs that were logged too late (above zero) or too early by another clock; 0 where one will do.
double Diagnoser::clocks_apart() const {
  constexpr double least = 10.0;  // sound recordings show 0.1
  const double late = m_selection.best->inputs_late();
  return std::abs(late) >= least ? late : 0.0;
}

/// What the recording leaves to guess.
double Diagnoser::guessed(const FoundEffect& found) const {
  const bool unlogged = found.id == "draught" && recording().find("coolant_on") == nullptr;
  if (unlogged) return doubt::unlogged_coolant;
  if (room_jump_K(found) != 0.0) return doubt::room_jumps;
  if (!m_selection.best->at_its_limit().empty()) return doubt::at_its_limit;
  if (clocks_apart() != 0.0) return doubt::apart_clocks;
  if (rows_are_coarse() && !m_lumps_only) return doubt::coarse_rows;
  constexpr double outlasted_s = 3.0 * 3600.0;
  const bool warm = std::any_of(m_machine.components.begin(), m_machine.components.end(),
                                [&](const auto& component) { return start_above_room_K(component) != 0.0; });
  if (!moves()) return doubt::never_moved;
  if (warm && m_out.time_s.back() - m_out.time_s.front() < outlasted_s) return doubt::unknown_past;
  if (m_corrected || m_not_there) return doubt::corrected_number;
  if (!m_machine.room.channel.empty() && !m_facts.room_logged) return doubt::guessed_room;
  return warm ? doubt::fitted_start : 1.0;
}

double Diagnoser::confidence_of(const FoundEffect& found, const ShownBy& shown) const {
  // What else is missing does not put in doubt what explains nearly all.
  constexpr double hardly_any_left = 0.1;
  constexpr double much_left = 3.0;
  const bool nearly_all = m_out.verdict == Verdict::missing_effect && shown.after < hardly_any_left * shown.before;
  const double poor = m_out.excess_after > much_left && !nearly_all ? doubt::more_is_missing : 1.0;
  return poor * guessed(found) * doubt::most / (1.0 + odds_against(found));
}

void doubt_whole(Diagnosis& diagnosis, const physics::Machine& machine) {
  double times = 1.0;
  // Of a lump that stands for a whole part never all is explained.
  if (diagnosis.verdict == Verdict::unexplained && !of_lumps_alone(machine)) times *= doubt::imitated;
  if (is_unknown(machine)) times *= doubt::unknown_machine;
  for (FoundEffect& effect : diagnosis.effects) effect.confidence *= times;
}

}  // namespace zerodrift::diagnosis
