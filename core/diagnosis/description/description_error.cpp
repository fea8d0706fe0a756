#include "core/diagnosis/description/description_error.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/description/inner_bodies.h"

namespace zerodrift::diagnosis {
namespace {

using physics::Component;
using physics::Machine;
using physics::Sensor;

Sensor& sensor_in(Machine& machine, const std::string& channel) {
  return *std::find_if(machine.sensors.begin(), machine.sensors.end(),
                       [&](const Sensor& one) { return one.channel == channel; });
}

Component& part_in(Machine& machine, const std::string& id) {
  return *std::find_if(machine.components.begin(), machine.components.end(),
                       [&](const Component& one) { return one.id == id; });
}

/// A sensor on a source shows more than its section's mean: where that is changes with the places.
void place_near_fields(Machine& machine) {
  for (Component& part : machine.components) {
    if (!part.inner) continue;
    auto& near = part.inner->near_field_K_W;
    std::erase_if(near, [&](const auto& one) {
      const Sensor* sensor = machine.sensor(one.first);
      return sensor == nullptr || sensor->component != part.id || part.source_near(sensor->position_mm) == nullptr;
    });
    for (const Sensor& sensor : machine.sensors) {
      if (sensor.component == part.id && part.source_near(sensor.position_mm) != nullptr)
        near.try_emplace(sensor.channel, 0.0);
    }
  }
}

template <typename Change>
void change_places(Machine& machine, const std::string& component, Change change) {
  const double length_mm = machine.find(component)->length_mm;
  for (Sensor& sensor : machine.sensors) {
    if (sensor.component == component)
      sensor.position_mm = std::clamp(change(sensor.position_mm, length_mm), 0.0, length_mm);
  }
}

}  // namespace

std::string name_of(const DescriptionError& error) {
  switch (error.kind) {
    case ErrorKind::place:
      return "misplaced:" + error.of;
    case ErrorKind::exchange:
      return "exchanged:" + error.of + ":" + error.other;
    case ErrorKind::unit:
      return "places_in:" + error.other;
    case ErrorKind::datum:
      return "datum:" + error.of;
    case ErrorKind::other_end:
      return "other_end:" + error.of;
    case ErrorKind::length:
      return "overlong:" + error.of;
    case ErrorKind::diameter:
      return "diameter:" + error.of;
    case ErrorKind::heat:
      return "far_from_description:heat:" + error.of;
    case ErrorKind::number:
      return "far_from_description:" + error.other + ":" + error.of;
    case ErrorKind::sign:
      return "sign_turned:" + error.of;
    case ErrorKind::absent_effect:
      return "described_not_there:" + error.of;
    case ErrorKind::clock:
      return error.value > 0.0 ? "clock_late" : "clock_early";
  }
  return {};
}

Machine set_right(Machine machine, const DescriptionError& error) {
  switch (error.kind) {
    case ErrorKind::place: {
      Sensor& sensor = sensor_in(machine, error.of);
      sensor.component = error.other;
      sensor.position_mm = error.value;
      break;
    }
    case ErrorKind::exchange: {
      Sensor& one = sensor_in(machine, error.of);
      Sensor& two = sensor_in(machine, error.other);
      std::swap(one.component, two.component);
      std::swap(one.position_mm, two.position_mm);
      break;
    }
    case ErrorKind::unit:
      change_places(machine, error.of, [&](double at_mm, double) { return at_mm * error.value; });
      break;
    case ErrorKind::datum:
      change_places(machine, error.of, [&](double at_mm, double) { return at_mm + error.value; });
      break;
    case ErrorKind::other_end:
      change_places(machine, error.of, [](double at_mm, double length_mm) { return length_mm - at_mm; });
      break;
    case ErrorKind::length:
      part_in(machine, error.of).length_mm = error.value;
      break;
    case ErrorKind::diameter: {
      constexpr double thinnest_wall = 0.1;  // of the diameter
      Component& part = part_in(machine, error.of);
      part.outer_diameter_mm = error.value;
      part.bore_diameter_mm = std::min(part.bore_diameter_mm, (1.0 - thinnest_wall) * part.outer_diameter_mm);
      if (part.inner) {  // its inside follows from the drawing
        part.inner.reset();
        machine = with_inner_bodies(std::move(machine));
      }
      break;
    }
    case ErrorKind::heat:
      for (physics::HeatSource& source : part_in(machine, error.of).sources) source.scale *= error.value;
      break;
    case ErrorKind::sign:
      for (auto& displacement : machine.displacements) {
        if (displacement.channel == error.of) displacement.sign = -displacement.sign;
      }
      break;
    case ErrorKind::absent_effect: {
      const auto found = std::find_if(machine.effects.begin(), machine.effects.end(), [&](const auto& spec) {
        return spec.id == error.of && spec.word_or("component", "") == error.other;
      });
      if (found != machine.effects.end()) machine.effects.erase(found);
      break;
    }
    case ErrorKind::number:
    case ErrorKind::clock:
      break;
  }
  place_near_fields(machine);
  return machine;
}

Machine set_right(Machine described, const std::vector<DescriptionError>& errors) {
  for (const DescriptionError& error : errors) described = set_right(std::move(described), error);
  return described;
}

recording::Recording set_right(const recording::Recording& logged, const std::vector<DescriptionError>& errors) {
  recording::Recording moved = logged;
  for (const DescriptionError& error : errors) {
    if (error.kind != ErrorKind::clock) continue;
    const recording::Recording before = moved;
    const std::vector<double>& time_s = before.time_s;
    for (std::size_t k = 0; k < before.rows(); ++k) {
      const double acted_s = time_s[k] + error.value;
      const auto after = std::upper_bound(time_s.begin(), time_s.end(), acted_s + 1e-6);
      const bool unknown = after == time_s.begin();
      const bool rests = unknown && acted_s < time_s.front() + (1.0 - error.before) * error.value;
      const auto row = static_cast<std::size_t>(after - time_s.begin() - (unknown ? 0 : 1));
      for (std::size_t c = 0; c < before.channels.size(); ++c) {
        if (!recording::is_input(before.channels[c].kind())) continue;
        moved.channels[c].values[k] = rests ? 0.0 : before.channels[c].values[row];
      }
    }
  }
  return moved;
}

std::string quantity_of_number(const std::string& key) {
  if (key.starts_with("scale:")) return "quantity_heat";
  if (key == "conductivity_W_mK") return "quantity_conductivity";
  if (key == "heat_capacity_J_kgK" || key == "heat_capacity_J_K") return "quantity_capacity";
  if (key == "expansion_1_K") return "quantity_expansion";
  if (key == "h_W_m2K") return "quantity_film";
  if (key == "conductance_W_K") return "quantity_conductance";
  return {};
}

bool is_sought(const DescriptionError& error) {
  return error.kind != ErrorKind::number && error.spread > 0.0;
}

bool is_about(const DescriptionError& error, const physics::Parameter& parameter) {
  return error.kind == ErrorKind::number && parameter.key == error.other && parameter.component == error.of &&
         parameter.channel == error.channel && parameter.owner() != physics::Owner::recording;
}

}  // namespace zerodrift::diagnosis
