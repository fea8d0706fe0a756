// What this recording cannot tell from the answer.

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/diagnosis/diagnoser.h"
#include "core/diagnosis/explain.h"
#include "core/diagnosis/refine.h"
#include "core/diagnosis/refined.h"

namespace zerodrift::diagnosis {

/// One speed and one state of the coolant from start to end: what follows them cannot be told from a tolerance.
bool Diagnoser::steady_inputs() const {
  for (const auto& channel : recording().channels) {
    const auto kind = channel.kind();
    const bool load = kind == recording::ChannelKind::load;  // measured, and it follows the speed
    if (!recording::is_input(kind) || load) continue;
    double low = 1e300, high = -1e300;
    for (const double v : channel.values) {
      if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
    }
    if (high - low > 0.02 * std::max(std::abs(low), std::abs(high))) return false;
  }
  return m_facts.has_speed;
}

/// Nothing is named, but the run could hardly have shown it: effects that the data rather like.
void Diagnoser::hidden_by_steadiness() {
  std::vector<std::shared_ptr<Model>> liked;
  std::set<std::string> ids;
  for (const auto& level : m_selection.levels) {
    for (const auto& fit : level) {
      if (fit->log_evidence() < m_selection.base->log_evidence()) continue;
      if (liked.size() < 3 && ids.insert(fit->machine().effects.back().id).second) liked.push_back(fit);
    }
  }
  tell_rivals(std::move(liked));
}

void Diagnoser::rivals() {
  if (m_out.verdict == Verdict::consistent && steady_inputs()) return hidden_by_steadiness();
  if (m_out.verdict != Verdict::missing_effect || m_selection.effects().empty()) return;
  const double best = evidence_of(*m_selection.best);
  // What of a strong effect's law is not quite right must not exclude a rival; where the description is good that is
  // little.
  const double not_quite = m_limits.own_misfit && !m_wide ? 0.003 : 0.02;
  constexpr double beyond_doubt = 100.0;
  const double margin = std::clamp(not_quite * (best - m_selection.base->log_evidence()), 8.0, beyond_doubt);
  std::vector<std::shared_ptr<Model>> others;
  const bool one_by_one = m_options.details && (m_out.effects.size() > 1 || m_out.drift_factor > 1.0);
  if (one_by_one) {
    for (const std::size_t index : m_selection.effects()) {
      for (auto& fit : in_place_of(*m_selection.best, index, m_facts, false)) others.push_back(std::move(fit));
    }
  } else {
    const std::size_t size = m_selection.best->machine().effects.size();
    for (const auto& level : m_selection.levels) {
      for (const auto& fit : level) {
        if (fit->machine().effects.size() == size && fit != m_selection.best) others.push_back(fit);
      }
    }
  }
  std::map<std::string, std::shared_ptr<Model>> families;
  for (const auto& fit : others) {
    const std::string& id = fit->machine().effects.back().id;
    const bool own = std::any_of(m_out.effects.begin(), m_out.effects.end(), [&](auto& e) { return e.id == id; });
    if (own || best - evidence_of(*fit) > margin) continue;
    auto& kept = families[id];
    if (kept == nullptr || evidence_of(*fit) > evidence_of(*kept)) kept = fit;
  }
  std::vector<std::shared_ptr<Model>> nearest;
  for (const auto& [id, fit] : families) nearest.push_back(fit);
  std::sort(nearest.begin(), nearest.end(), [](auto& a, auto& b) { return evidence_of(*a) > evidence_of(*b); });
  if (nearest.size() > 3) nearest.resize(3);
  tell_rivals(std::move(nearest));
}

void Diagnoser::tell_rivals(std::vector<std::shared_ptr<Model>> nearest) {
  const double best = evidence_of(*m_selection.best);
  for (const auto& fit : nearest) {
    Rival rival;
    rival.id = fit->machine().effects.back().id;
    const physics::EffectSpec spec = fitted_effect(*fit, fit->machine().effects.size() - 1);
    rival.component = spec.word_or("component", "");
    rival.channel = spec.word_or("channel", "");
    if (spec.numbers.count("position_mm") != 0) rival.position_mm = spec.numbers.at("position_mm");
    rival.behind = best - evidence_of(*fit);
    rival.why = explain_rival(rival);
    m_out.ambiguous_with.push_back(rival);
  }
  m_rivals = std::move(nearest);
}

}  // namespace zerodrift::diagnosis
