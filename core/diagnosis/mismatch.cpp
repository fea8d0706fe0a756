// Where, when and in which regime simulation and recording differ.
#include <algorithm>
#include <cmath>

#include "core/diagnosis/diagnoser.h"
#include "core/diagnosis/locate.h"
#include "core/physics/effects/effect.h"

namespace zerodrift::diagnosis {

/// The scan's heat is linear between knots and its last knot lies beyond the run: the map ends with the run.
static HeatMap map_of(const SourceScan& scan, double end_s) {
  constexpr std::size_t columns_a_block = 3;
  HeatMap heat;
  heat.component = scan.component;
  heat.position_mm = scan.position_mm;
  if (scan.time_s.size() < 2) return heat;
  const double start_s = scan.time_s.front();
  const double block_s = scan.time_s[1] - start_s;
  const std::size_t last = columns_a_block * (scan.time_s.size() - 1);
  for (std::size_t c = 0; c <= last; ++c) {
    heat.time_s.push_back(start_s + (end_s - start_s) * static_cast<double>(c) / static_cast<double>(last));
  }
  for (const auto& knots : scan.watts_by_position) {
    std::vector<double>& row = heat.watts.emplace_back();
    for (const double time_s : heat.time_s) {
      const double place = (time_s - start_s) / block_s;
      const std::size_t before = std::min(static_cast<std::size_t>(place), knots.size() - 2);
      row.push_back(std::lerp(knots[before], knots[before + 1], place - static_cast<double>(before)));
    }
  }
  return heat;
}

/// The channel that switches the strongest named effect; empty: none of them.
std::string Diagnoser::driver_of_first() const {
  const auto named = m_selection.effects();
  if (named.empty()) return {};
  const auto* effect = physics::find_effect(m_selection.best->machine().effects[named.front()].id);
  return effect ? std::string(effect->driven_by) : std::string();
}

void Diagnoser::mismatch() {
  Mismatch& m = m_out.mismatch;
  if (m_out.verdict == Verdict::consistent) return;
  std::vector<const ChannelReport*> order;
  for (const auto& channel : m_out.channels) order.push_back(&channel);
  std::sort(order.begin(), order.end(), [](auto* a, auto* b) { return a->score > b->score; });
  for (const auto* channel : order) {
    if (channel->score > std::max(1.0, 0.15 * order.front()->score)) m.channels.push_back(channel->channel);
  }
  if (m.channels.empty() && !order.empty()) m.channels.push_back(order.front()->channel);
  if (!m_moved_elsewhere.empty()) m.channels = {m_moved_elsewhere};
  if (!m_selection.settling.empty()) {
    std::erase(m.channels, m_selection.settling);
    m.channels.insert(m.channels.begin(), m_selection.settling);
  }
  locate();
  times();
  // What only moves a displacement is no heat, and does not follow what heat does.
  const auto first = std::find_if(m_out.channels.begin(), m_out.channels.end(),
                                  [&](const auto& channel) { return channel.channel == m.channels.front(); });
  if (m.channels.empty() || first == m_out.channels.end() || first->temperature || m_lumps_only) return;
  m.regime = regime_of(history_of(recording(), first->measured, first->refitted), recording(), driver_of_first());
}

/// The part of the channel with the largest mismatch; where it has none, or a given one, the first that is not given,
/// rods before lumps.
std::string Diagnoser::where_to_look() const {
  const std::string channel = m_out.mismatch.channels.empty() ? "" : m_out.mismatch.channels.front();
  const physics::Sensor* sensor = m_machine.sensor(channel);
  const auto moved = std::find_if(m_machine.displacements.begin(), m_machine.displacements.end(),
                                  [&](const auto& displacement) { return displacement.channel == channel; });
  const physics::Component* part = sensor != nullptr                        ? m_machine.find(sensor->component)
                                   : moved != m_machine.displacements.end() ? m_machine.find(moved->component)
                                                                            : nullptr;
  if (part != nullptr && !part->prescribed) return part->id;
  std::string any;
  for (const auto& component : m_machine.components) {
    if (component.prescribed) continue;
    if (!component.lump) return component.id;
    if (any.empty()) any = component.id;
  }
  return any;
}

void Diagnoser::map_of_first_rod(const Model& nominal) {
  for (const auto& component : m_machine.components) {
    if (component.lump || component.prescribed) continue;
    m_out.heat = map_of(scan_sources(nominal, component.id), m_out.time_s.back());
    return;
  }
}

void Diagnoser::locate() {
  Mismatch& m = m_out.mismatch;
  m.component = where_to_look();
  if (m.component.empty()) return;
  const physics::Component& part = *m_machine.find(m.component);
  Model nominal(m_bodies, m_default_data);
  nominal.fit({0, 0.05, true});
  const SourceScan scan = scan_sources(nominal, m.component);
  m.regime = regime_of({scan.time_s, scan.watts}, recording(), driver_of_first());
  double sum = 0.0;
  double net = 0.0;
  for (const double w : scan.watts) {
    sum += std::abs(w);
    net += w;
  }
  const bool has_scale = !part.lump || part.heat_capacity_J_K;
  if (has_scale && !scan.watts.empty())
    m.missing_heat_W = std::copysign(sum / static_cast<double>(scan.watts.size()), net);
  if (part.lump) return map_of_first_rod(nominal);
  m.position_mm = {scan.from_mm, scan.to_mm};
  m.best_position_mm = scan.best_mm;
  m.scan_position_mm = scan.position_mm;
  m.scan_evidence = scan.evidence;
  m_out.heat = map_of(scan, m_out.time_s.back());
}

/// Means over a block about each time: of single rows most is noise.
static std::vector<double> over_blocks(const std::vector<double>& size, const std::vector<double>& time_s,
                                       double block_s) {
  std::vector<double> sum(size.size() + 1, 0.0);
  for (std::size_t k = 0; k < size.size(); ++k) sum[k + 1] = sum[k] + size[k];
  std::vector<double> mean(size.size(), 0.0);
  std::size_t first = 0, last = 0;
  for (std::size_t k = 0; k < size.size(); ++k) {
    while (time_s[k] - time_s[first] > 0.5 * block_s) ++first;
    while (last < size.size() && time_s[last] - time_s[k] <= 0.5 * block_s) ++last;
    mean[k] = (sum[last] - sum[first]) / static_cast<double>(last - first);
  }
  return mean;
}

/// Stretches, no nearer to each other than a block, in which the mismatch is above a third of its largest.
void Diagnoser::times() {
  constexpr double block_s = 900.0;
  std::vector<double> size = m_contribution_in_time;
  if (size.empty()) {
    size.assign(recording().rows(), 0.0);
    for (const auto& channel : m_out.channels) {
      const auto& named = m_out.mismatch.channels;
      if (std::count(named.begin(), named.end(), channel.channel) == 0) continue;
      for (std::size_t k = 0; k < size.size(); ++k) {
        const double d = (channel.measured[k] - channel.refitted[k]) / std::max(1e-9, channel.noise);
        if (std::isfinite(d)) size[k] += d * d - 1.0;
      }
    }
    size = over_blocks(size, m_out.time_s, block_s);
  }
  const double largest = *std::max_element(size.begin(), size.end());
  bool inside = false;
  for (std::size_t k = 0; k < size.size(); ++k) {
    const bool above = size[k] > largest / 9.0;
    if (above && !inside) m_out.mismatch.time_s.emplace_back(m_out.time_s[k], m_out.time_s[k]);
    if (above) m_out.mismatch.time_s.back().second = m_out.time_s[k];
    inside = above || (inside && m_out.time_s[k] - m_out.mismatch.time_s.back().second < block_s);
  }
}

/// A named place is better known than the hypothesis-free scan's.
void Diagnoser::place_from_effect() {
  for (const auto& effect : m_out.effects) {
    if (!effect.position_mm) continue;
    if (!effect.component.empty()) m_out.mismatch.component = effect.component;
    const double half_mm = std::max(1.0, 2.0 * effect.position_sigma_mm);
    m_out.mismatch.position_mm =
        effect.between_mm.value_or(std::pair{*effect.position_mm - half_mm, *effect.position_mm + half_mm});
    m_out.mismatch.position_mm->first = std::max(0.0, m_out.mismatch.position_mm->first);
    m_out.mismatch.best_position_mm = *effect.position_mm;
    return;
  }
}

}  // namespace zerodrift::diagnosis
