// A description so crude (a lump a sensor) that its discrepancy must be learned with its effects.
#include <algorithm>
#include <cmath>

#include "core/diagnosis/parallel.h"
#include "core/diagnosis/selector.h"

namespace zerodrift::diagnosis {

Result<Selection> Selector::grow(const physics::Machine& machine, std::shared_ptr<const Dataset>& data) {
  const std::shared_ptr<const Dataset> usual = data;
  ZD_TRY(m_result, run(machine, usual));
  if (m_result.best == m_result.base) return m_result;
  ModelPtr best = only_needed(with_own_discrepancy(*m_result.best, usual), usual);
  for (int round = 0; round < m_options.most_effects && best->machine().effects.size() > m_result.described; ++round) {
    if (m_context.cancelled()) return fail(ErrorCode::cancelled);
    const ModelPtr more = with_one_more(best, usual);
    if (more == nullptr) break;
    best = only_needed(more, usual);
  }
  m_result.falling_heat = falling_heat(*best, usual);
  data = best->shared_data();
  m_result.base = under(*m_result.base, data);
  m_result.best = best->machine().effects.size() == m_result.described ? m_result.base : best;
  if (m_result.best != m_result.base && swap_one()) m_result.best = under(*m_result.best, data);
  only_what_stands();
  return m_result;
}

ModelPtr Selector::with_own_discrepancy(const Model& model, const std::shared_ptr<const Dataset>& usual) {
  ModelPtr fitted = under(model, model.shared_data());
  for (int round = 0; round < 2; ++round) {
    const auto likely = likely_discrepancy(*usual, fitted->prediction());
    fitted = under(*fitted, std::make_shared<Dataset>(with_discrepancy(*usual, likely)));
  }
  return fitted;
}

ModelPtr Selector::only_needed(ModelPtr best, const std::shared_ptr<const Dataset>& usual) const {
  while (best->machine().effects.size() > m_result.described && !m_context.cancelled()) {
    const bool last = best->machine().effects.size() == m_result.described + 1;
    ModelPtr better;
    double least = last ? m_options.first : m_options.second_clean;
    for (std::size_t i = m_result.described; i < best->machine().effects.size(); ++i) {
      const ModelPtr without = with_own_discrepancy(*reduced(*best, i), usual);
      const double lost = total_gain(*best, *without);
      if (lost < least) {
        least = lost;
        better = without;
      }
      const ModelPtr simpler = without_lag(*best, i);
      if (simpler == nullptr) continue;
      const ModelPtr fitted = with_own_discrepancy(*simpler, usual);
      const double by_lag = total_gain(*best, *fitted);
      if (by_lag >= std::min(least, m_options.second_clean)) continue;
      least = by_lag;
      better = fitted;
    }
    if (better == nullptr) break;
    best = better;
  }
  return best;
}

ModelPtr Selector::without_lag(const Model& model, std::size_t effect) {
  physics::Machine machine = model.machine();
  if (machine.effects[effect].numbers.erase("room_lag_s") == 0) return nullptr;
  auto result = std::make_shared<Model>(std::move(machine), model.shared_data());
  result->start_from(model, false);
  return result;
}

ModelPtr Selector::with_one_more(const ModelPtr& best, const std::shared_ptr<const Dataset>& usual) const {
  constexpr std::size_t most_tried = 3;
  if (static_cast<int>(best->machine().effects.size() - m_result.described) >= m_options.most_effects) return nullptr;
  // A slow body that an effect more would name may look like a room that is felt late.
  std::vector<ModelPtr> starts = {best};
  for (std::size_t i = m_result.described; i < best->machine().effects.size(); ++i) {
    if (const ModelPtr simpler = without_lag(*best, i)) starts.push_back(with_own_discrepancy(*simpler, usual));
  }
  std::vector<ModelPtr> fits;
  for (const ModelPtr& start : starts) {
    std::vector<ModelPtr> more = refine(start, screen(*start, m_facts), {1, m_options.second_screen, 7});
    if (more.size() > most_tried) more.resize(most_tried);
    fits.insert(fits.end(), more.begin(), more.end());
  }
  in_parallel(fits.size(), [&](std::size_t i) { fits[i] = with_own_discrepancy(*fits[i], usual); });
  std::sort(fits.begin(), fits.end(), by_total);
  if (fits.empty() || total_gain(*fits.front(), *best) < m_options.second) return nullptr;
  return fits.front();
}

bool Selector::heat_falls(const Model& model, const std::string& component) {
  constexpr double clearly = 0.1;  // of the largest
  const physics::Network& network = model.network();
  const std::vector<double> values = model.values();
  double highest_W = 0.0;
  double fall_W = 0.0;
  for (const double share : {0.25, 0.5, 0.75, 1.0}) {
    double heat_W = 0.0;
    for (const physics::Term& term : network.terms) {
      const bool here = term.first_node == network.place(component)->first;
      if (term.kind != physics::TermKind::source || term.law_kind != physics::LawKind::inputs || !here) continue;
      std::vector<double> held(network.held_channels.size(), 0.0);
      for (std::size_t i = 0; i < held.size(); ++i) {
        if (network.held_channels[i] == "spindle_rpm") held[i] = share * network.full_speed_rpm;
      }
      std::vector<double> own;
      for (const int parameter : term.parameters) own.push_back(values[static_cast<std::size_t>(parameter)]);
      physics::LawPoint at;
      at.held = held.data();
      at.values = own.data();
      heat_W += term.law(at).value;
    }
    highest_W = std::max(highest_W, heat_W);
    fall_W = std::max(fall_W, highest_W - heat_W);
  }
  return fall_W > clearly * highest_W;
}

double Selector::falling_heat(const Model& best, const std::shared_ptr<const Dataset>& usual) const {
  double most = 0.0;
  for (const auto& component : best.machine().components) {
    const bool by_speed = std::any_of(component.sources.begin(), component.sources.end(),
                                      [](const auto& source) { return source.kind == physics::SourceKind::speed; });
    if (!m_facts.has_speed || !component.lump || !by_speed) continue;
    const Candidate free{physics::free_speed_heat(component), 0, 0, {}};
    const std::size_t count = best.machine().effects.size();
    std::vector<ModelPtr> rivals(count - m_result.described + 1);
    in_parallel(rivals.size(), [&](std::size_t i) {
      const std::size_t left_out = m_result.described + i;
      const ModelPtr less = left_out < count ? reduced(best, left_out) : nullptr;
      rivals[i] = with_own_discrepancy(*extended(less == nullptr ? best : *less, free), usual);
    });
    for (const auto& rival : rivals) {
      if (heat_falls(*rival, component.id)) most = std::max(most, total_gain(*rival, best));
    }
  }
  return most > m_options.second ? most : 0.0;
}

}  // namespace zerodrift::diagnosis
