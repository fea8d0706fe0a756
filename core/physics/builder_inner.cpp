// The inside of a rod that is not one body: shaft in a cartridge, or the axis of solid steel.
#include <cmath>

#include "core/physics/effects/laws.h"

namespace zerodrift::physics {
namespace {

/// The part of a heat that enters one of the two bodies; `at` is where the share stands among the law's parameters.
Law part_of_heat(Law whole, std::size_t at, bool inside) {
  return [whole = std::move(whole), at, inside](const LawPoint& point) {
    Strength s = whole(point);
    const double share = point.values[at];
    const double part = inside ? share : 1.0 - share;
    const double value = s.value;
    s.value *= part;
    s.by_driver *= part;
    s.by_environment *= part;
    for (std::size_t k = 0; k < at; ++k) s.by_parameter[k] *= part;
    s.by_parameter[at] = inside ? value : -value;
    return s;
  };
}

/// g (1 + rise sqrt(n / n_full)): the air in a gap turns over, rolling balls carry heat across.
Law gap_law(int speed, double full_rpm) {
  return [=](const LawPoint& at) {
    Strength s;
    const double root = std::sqrt(std::abs(at.held[speed]) / full_rpm);
    s.by_parameter[0] = 1.0 + at.values[1] * root;
    s.by_parameter[1] = at.values[0] * root;
    s.value = at.values[0] * s.by_parameter[0];
    return s;
  };
}

/// How far a reading may be from its section's mean, K per W/m of a steady source. A bearing or a motor sits all
/// around: a fifth of what its flux makes between the surface and the mean of a cylinder. A guideway lies on one side:
/// the first mode around a ring of the section, q' R / (pi k t).
double near_field_width_K_W(const Component& component, const HeatSource& source) {
  constexpr double pi = 3.14159265358979;
  const double k_W_mK = component.material.conductivity_W_mK;
  if (source.kind != SourceKind::guide) return 0.2 / (8.0 * pi * k_W_mK);
  const double wall_m = 0.5 * m_per_mm * (component.outer_diameter_mm - component.bore_diameter_mm);
  const double radius_m = 0.5 * (m_per_mm * component.outer_diameter_mm - wall_m);
  return radius_m / (pi * k_W_mK * wall_m);
}

Parameter share_parameter(const std::string& key, const std::string& component, double mean, double sigma) {
  Parameter share;
  share.key = key;
  share.component = component;
  share.mean = share.start = mean;
  share.sigma = sigma;
  share.low = 0.0;
  share.high = 1.0;
  return share;
}

}  // namespace

void NetworkBuilder::add_inner_body(const Component& component, Network::Place& at) {
  const InnerBody& inner = *component.inner;
  const double section_m2 = inner.section_share * component.section_m2();
  at.inner = static_cast<int>(m_network.nodes());
  add_cells(component, at.inner, at.count, section_m2, "/inner_conduction");
  Parameter coupling;
  coupling.key = "inner_coupling_W_mK";
  coupling.component = component.id;
  coupling.mean = coupling.start = inner.coupling_W_mK;
  coupling.logarithmic = true;
  // A sensor in a hole, a hollow section or a simulation of one dimension leave little of the difference.
  coupling.sigma = inner.shaft_in_cartridge ? 0.8 : 1.0;
  Parameter rise;
  rise.key = "inner_coupling_rise";
  rise.component = component.id;
  rise.mean = rise.start = inner.coupling_rise;
  rise.sigma = inner.shaft_in_cartridge ? 0.5 : 0.0;
  rise.low = 0.0;
  const int rise_at = add_parameter(rise);
  Term across;
  across.kind = TermKind::link;
  across.label = component.id + "/inner_coupling";
  for (int i = 0; i < at.count; ++i) across.links.push_back({at.first + i, at.inner + i, at.cell_m});
  across.parameters = {add_parameter(coupling), rise_at};
  across.law = gap_law(held_speed(), m_network.full_speed_rpm);
  add(std::move(across));
  m_network.places.push_back(at);
  for (const auto& source : component.sources) {
    const auto share = inner.heat_share.find(source.id);
    if (share != inner.heat_share.end()) {
      m_heat_share[source.id] = add_parameter(share_parameter("inner_heat_share:" + source.id, component.id,
                                                              share->second, inner.shaft_in_cartridge ? 0.25 : 0.0));
    }
    if (inner.contact_W_K.count(source.id) != 0) add_contact(component, source, rise_at);
  }
  m_network.places.pop_back();
}

void NetworkBuilder::add_contact(const Component& component, const HeatSource& bearing, int rise) {
  const auto& at = place(component.id);
  Parameter contact;
  contact.key = "inner_contact_W_K:" + bearing.id;
  contact.component = component.id;
  contact.mean = contact.start = component.inner->contact_W_K.at(bearing.id);
  contact.logarithmic = true;
  contact.sigma = 0.8;
  Term across = source_over(component.id, bearing.from_mm, bearing.to_mm);
  across.kind = TermKind::link;
  across.label = component.id + "/" + bearing.id + "_contact";
  for (std::size_t i = 0; i < across.weights.size(); ++i) {
    const int node = across.first_node + static_cast<int>(i);
    across.links.push_back({node, node - at.first + at.inner, across.weights[i]});
  }
  across.weights.clear();
  across.parameters = {add_parameter(contact), rise};
  across.law = gap_law(held_speed(), m_network.full_speed_rpm);
  add(std::move(across));
}

void NetworkBuilder::add_heat(const std::string& component, Term term, int share) {
  const auto at = place(component);
  if (at.inner < 0 || share < 0) {
    add(std::move(term));
    return;
  }
  const std::size_t last = term.parameters.size();
  term.parameters.push_back(share);
  Term inside = term;
  inside.label += "/inside";
  inside.first_node += at.inner - at.first;
  inside.law = part_of_heat(term.law, last, true);
  term.law = part_of_heat(term.law, last, false);
  add(std::move(term));
  add(std::move(inside));
}

int NetworkBuilder::heat_share_of_effect(const EffectSpec& spec, int index, const std::string& component) {
  const Component& described = *m_machine.find(component);
  if (!described.inner || !described.inner->shaft_in_cartridge) return -1;
  Parameter share = share_parameter("inner_heat_share", component, 0.35, 0.3);
  share.effect = index;
  share.start = spec.number_or(share.key, share.mean);
  if (!spec.candidate) share.mean = share.start, share.sigma = 0.0;
  return add_parameter(share);
}

void NetworkBuilder::add_near_field(const Component& component, const Sensor& sensor, Observation& seen) {
  const HeatSource* found = component.source_near(sensor.position_mm);
  const auto known = component.inner->near_field_K_W.find(sensor.channel);
  if (found == nullptr || known == component.inner->near_field_K_W.end()) return;
  const double width_m = m_per_mm * std::max(found->to_mm - found->from_mm, 0.5 * component.outer_diameter_mm);
  Parameter gain;
  gain.key = "near_field_K_W";
  gain.component = component.id;
  gain.channel = sensor.channel;
  gain.mean = gain.start = known->second;
  gain.sigma = near_field_width_K_W(component, *found) / width_m;
  Parameter lag;
  lag.key = "near_lag_s";
  lag.component = component.id;
  lag.mean = lag.start = component.inner->near_lag_s;
  lag.sigma = 0.0;
  StructureTerm term;
  term.gain = add_parameter(gain);
  term.lag = add_parameter(lag);
  const HeatSource source = *found;
  const int speed = held_speed();
  const double full_rpm = m_network.full_speed_rpm;
  term.signal = signal({"near heat", [=](const double* held, const double*, double) {
                          return nominal_heat_W(source, held[speed], full_rpm);
                        }});
  seen.structure.push_back(term);
}

Probe NetworkBuilder::length_probe(const Network::Place& at, int first, double factor) const {
  Probe length;
  for (int i = 0; i < at.count; ++i) length.emplace_back(first + i, factor);
  return length;
}

}  // namespace zerodrift::physics
