#include "core/diagnosis/description/inner_bodies.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace zerodrift::diagnosis {
namespace {

using physics::Component;
using physics::HeatSource;
using physics::InnerBody;
using physics::SourceKind;

constexpr double air_gap_W_m2K = 135.0;  // conduction through 0.2 mm of air
constexpr double gap_rise = 0.7;         // at full speed, as the air in it turns over and the balls roll
constexpr double bearing_contact_W_K = 30.0;
constexpr double shaft_of_mean_diameter = 0.93;  // the balls' circle is a little wider than the shaft
constexpr double iron_J_m3K = 3.6e6, iron_m2_s = 1.4e-5;
constexpr double fast_s = 25.0;  // a section that evens out quicker is one body

/// Mean diameter of the bearings, 0 without any.
double bearing_diameter_mm(const Component& component) {
  double sum = 0.0;
  int count = 0;
  for (const HeatSource& source : component.sources) {
    if (source.kind == SourceKind::bearing) sum += source.mean_diameter_mm, ++count;
  }
  return count > 0 ? sum / count : 0.0;
}

InnerBody shaft_of(const Component& component, double shaft_mm) {
  const auto square = [](double d) { return d * d; };
  const double bore2 = square(component.bore_diameter_mm);
  InnerBody inner;
  inner.shaft_in_cartridge = true;
  inner.section_share = (square(shaft_mm) - bore2) / (square(component.outer_diameter_mm) - bore2);
  inner.coupling_W_mK = air_gap_W_m2K * std::numbers::pi * 1e-3 * shaft_mm;
  inner.coupling_rise = gap_rise;
  inner.growth_share = 0.8;  // most probes look at the nose of the shaft
  for (const HeatSource& source : component.sources) {
    inner.heat_share[source.id] = source.kind == SourceKind::bearing ? 0.35 : 0.4;
    if (source.kind == SourceKind::bearing) inner.contact_W_K[source.id] = bearing_contact_W_K;
  }
  return inner;
}

/// Two rings of equal section; the outer is as much warmer than the mean as the surface of a cylinder with a steady
/// flux is: q' / (8 pi k), less where a bore leaves a thin wall.
InnerBody axis_of(const Component& component) {
  InnerBody inner;
  const double wall = 1.0 - component.bore_diameter_mm / component.outer_diameter_mm;
  inner.coupling_W_mK = 2.0 * std::numbers::pi * component.material.conductivity_W_mK / wall;
  return inner;
}

bool is_heated_on_one_side(const Component& component) {
  return std::any_of(component.sources.begin(), component.sources.end(),
                     [](const HeatSource& source) { return source.kind == SourceKind::guide; });
}

/// Time constant of the first mode around a ring of the section: R^2 / a.
double around_s(const Component& component) {
  const physics::Material& m = component.material;
  const double radius_m = 0.25e-3 * (component.outer_diameter_mm + component.bore_diameter_mm);
  return radius_m * radius_m * m.density_kg_m3 * m.heat_capacity_J_kgK / m.conductivity_W_mK;
}

/// Heat that enters a part at one side reaches the other after L^2 / (pi^2 a), the slowest mode of a wall (Carslaw and
/// Jaeger 1959, 3.3).
double crosses_s(double length_m, double diffusivity_m2_s) {
  return length_m * length_m / (std::numbers::pi * std::numbers::pi * diffusivity_m2_s);
}

/// Edge of a lump, as a cube of iron of its capacity.
std::optional<double> edge_m(const Component& lump) {
  if (!lump.heat_capacity_J_K || lump.capacity_is_guessed) return std::nullopt;
  return std::cbrt(*lump.heat_capacity_J_K / iron_J_m3K);
}

/// A rod that carries other parts is a casting, a column with its guideways, a lantern with its flange: the section
/// that is described is a mean, and no stretch of about half a diameter has to be like the next. Where the section
/// changes or something touches it, the heat's way is longer or shorter by a part of a diameter.
void add_uneven_conduction(physics::Machine& machine) {
  constexpr double fewest = 2.0, most = 8.0, longer = 0.15;
  for (Component& part : machine.components) {
    if (part.lump || part.prescribed || !touches_lump(machine, part.id)) continue;
    if (part.conduction_shares.empty()) {
      const double stretches = std::clamp(std::round(2.0 * part.length_mm / part.outer_diameter_mm), fewest, most);
      part.conduction_shares.assign(static_cast<std::size_t>(stretches), 1.0);
    }
    const double stretch_mm = part.length_mm / static_cast<double>(part.conduction_shares.size());
    part.conduction_sigma = longer * part.outer_diameter_mm / stretch_mm;
  }
}

/// How late a sensor may be on a part whose section the description takes as even though nobody knows where in it the
/// heat enters: a lump, taken as a cube of iron of its capacity, and a rod that exchanges heat with one.
std::optional<double> lateness_s(const physics::Machine& machine, const Component& part) {
  if (part.prescribed) return std::nullopt;
  if (part.lump) {
    const auto edge = edge_m(part);
    return edge ? std::optional(crosses_s(*edge, iron_m2_s)) : std::nullopt;
  }
  if (!touches_lump(machine, part.id)) return std::nullopt;
  const physics::Material& m = part.material;
  return crosses_s(1e-3 * part.outer_diameter_mm, m.conductivity_W_mK / (m.density_kg_m3 * m.heat_capacity_J_kgK));
}

void add_sensor_lags(physics::Machine& machine) {
  for (auto& sensor : machine.sensors) {
    const Component* part = machine.find(sensor.component);
    const auto late_s = part == nullptr ? std::nullopt : lateness_s(machine, *part);
    if (!late_s) continue;
    sensor.lag_sigma_s = *late_s;
    if (sensor.lag_s == 0.0) sensor.lag_s = 0.25 * *late_s;
  }
}

}  // namespace

physics::Machine with_inner_bodies(physics::Machine machine) {
  add_sensor_lags(machine);
  add_uneven_conduction(machine);
  for (Component& component : machine.components) {
    if (component.lump || component.prescribed || component.inner) continue;
    const physics::Material& m = component.material;
    const double shaft_mm = shaft_of_mean_diameter * bearing_diameter_mm(component);
    const bool cartridge = shaft_mm > 1.2 * component.bore_diameter_mm && shaft_mm < 0.8 * component.outer_diameter_mm;
    const double half_wall_m = 0.5e-3 * (component.outer_diameter_mm - component.bore_diameter_mm);
    const double evens_out_s =
        half_wall_m * half_wall_m * m.density_kg_m3 * m.heat_capacity_J_kgK / m.conductivity_W_mK;
    if (cartridge) {
      component.inner = shaft_of(component, shaft_mm);
    } else if (evens_out_s > fast_s) {
      component.inner = axis_of(component);
    } else {
      continue;
    }
    component.inner->near_lag_s = is_heated_on_one_side(component) ? around_s(component) : 0.25 * evens_out_s;
    for (const auto& sensor : machine.sensors) {
      if (sensor.component == component.id && component.source_near(sensor.position_mm) != nullptr) {
        component.inner->near_field_K_W[sensor.channel] = 0.0;
      }
    }
  }
  return machine;
}

bool touches_lump(const physics::Machine& machine, const std::string& component) {
  const auto is_lump = [&](const std::string& id) {
    const Component* part = machine.find(id);
    return part != nullptr && part->lump;
  };
  return std::any_of(machine.couplings.begin(), machine.couplings.end(), [&](const physics::Coupling& joint) {
    const std::string &first = joint.first.component, &second = joint.second.component;
    return (first == component && is_lump(second)) || (second == component && is_lump(first));
  });
}

bool has_unknown_heat(const physics::Machine& machine) {
  return std::any_of(machine.components.begin(), machine.components.end(), [](const auto& component) {
    return std::any_of(component.sources.begin(), component.sources.end(),
                       [](const auto& source) { return source.power_unknown; });
  });
}

}  // namespace zerodrift::diagnosis
