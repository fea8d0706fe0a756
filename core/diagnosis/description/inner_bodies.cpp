#include "core/diagnosis/description/inner_bodies.h"

#include <algorithm>
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
constexpr double fast_s = 25.0;                  // a section that evens out quicker is one body

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

}  // namespace

physics::Machine with_inner_bodies(physics::Machine machine) {
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
    component.inner->near_lag_s = 0.25 * evens_out_s;
    for (const auto& sensor : machine.sensors) {
      if (sensor.component == component.id && component.source_near(sensor.position_mm) != nullptr) {
        component.inner->near_field_K_W[sensor.channel] = 0.0;
      }
    }
  }
  return machine;
}

bool has_unknown_heat(const physics::Machine& machine) {
  return std::any_of(machine.components.begin(), machine.components.end(), [](const auto& component) {
    return std::any_of(component.sources.begin(), component.sources.end(),
                       [](const auto& source) { return source.power_unknown; });
  });
}

}  // namespace zerodrift::diagnosis
