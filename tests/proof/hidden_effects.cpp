// Effects that the proof hides: sizes, places and laws drawn at random.
#include <algorithm>
#include <array>
#include <cmath>

#include "tests/proof/truth.h"

namespace zerodrift::proof {

HiddenEffect hide(Truth& m, const std::string& id, Noise& noise, double strength) {
  HiddenEffect hidden{id, -1, ""};
  const auto around = [&](double low, double high) { return strength * noise.uniform(low, high); };
  const double heat_W = m.motor_W * (1 - m.efficiency);
  if (id == "speed_convection") m.speed_a = around(10, 45);
  if (id == "radiation") m.eps = std::min(1.0, around(0.45, 0.95));
  if (id == "coolant") {
    m.cool_h = around(20, 120);
    const int region = static_cast<int>(noise.index(3));
    m.cool_from = region == 0 ? 0 : region == 1 ? m.motor_from : m.bearings[1].from - 0.06 * m.length;
    m.cool_to = region == 0   ? m.length
                : region == 1 ? m.motor_to
                              : std::min(m.length, m.bearings[1].to + 0.06 * m.length);
    m.cool_C = m.start_C + noise.uniform(-2, 1);
  }
  if (id == "bearing_viscosity") m.beta = around(0.015, 0.04);
  if (id == "bearing_preload") {
    if (noise.uniform() < 0.5) {
      m.preload_T = around(0.02, 0.08);
    } else {
      m.preload_n = around(0.6, 2.5);
    }
  }
  if (id == "extra_heat_source") {
    m.extra_W = around(0.08, 0.35) * heat_W;
    m.extra_x = m.length * noise.uniform(0.1, 0.92);
    m.extra_law = static_cast<int>(noise.index(4));
    hidden.law = std::array{"constant", "on", "n", "n2"}[static_cast<std::size_t>(m.extra_law)];
    hidden.position_mm = 1e3 * m.extra_x;
  }
  if (id == "contact_resistance") {
    m.contact_R = around(3e-4, 2.5e-3);
    m.contact_x = m.length * std::round(48 * noise.uniform(0.2, 0.8)) / 48;
    hidden.position_mm = 1e3 * m.contact_x;
  }
  if (id == "structure_ambient") {
    m.ambient_g = (noise.uniform() < 0.5 ? -1 : 1) * around(2, 7);
    m.ambient_tau = noise.uniform(1500, 8000);
    hidden.channel = "dZ_um";
  }
  if (id == "structure_bending") {
    m.bend_g = (noise.uniform() < 0.5 ? -1 : 1) * around(0.5, 3);
    m.bend_tau = noise.uniform(800, 6000);
    m.bend_driver = static_cast<int>(noise.index(3));
    hidden.channel = "dY_um";
  }
  if (id == "sensor_lag" || id == "sensor_offset") {
    const int j = static_cast<int>(noise.index(m.sensors.size()));
    hidden.channel = "T" + std::to_string(j + 1) + "_C";
    if (id == "sensor_lag") m.lag_channel = j, m.lag_s = around(90, 400);
    if (id == "sensor_offset") m.offset_channel = j, m.offset_K = (noise.uniform() < 0.5 ? -1 : 1) * around(0.5, 1.6);
  }
  if (id == "cutting_heat") m.cut_share = around(0.015, 0.06);
  if (id == "draught") {
    m.draught_h = around(25, 70);
    m.draught_from_s = noise.uniform(4000, 9000);
    m.draught_to_s = m.draught_from_s + noise.uniform(3000, 7000);
  }
  if (id == "unlisted:wandering_heat")
    m.wander_W = around(0.15, 0.4) * heat_W, m.wander_x = m.length * noise.uniform(0.15, 0.85);
  if (id == "unlisted:creep") m.creep_um = (noise.uniform() < 0.5 ? -1 : 1) * around(2, 6);
  if (id == "unlisted:slack") m.backlash_um = around(3, 9);
  if (id == "unlisted:stiction") m.stick_um = around(2, 6);
  if (id == "unlisted:travelling_heat") {
    m.travel_W = around(0.15, 0.4) * heat_W;
    m.travel_from = m.length * noise.uniform(0.1, 0.4);
    m.travel_to = m.length * noise.uniform(0.6, 0.9);
    m.travel_s = noise.uniform(3600, 14400);
  }
  return hidden;
}

void rescale(Truth& m, const std::string& id, double factor) {
  if (id == "speed_convection") m.speed_a *= factor;
  if (id == "radiation") m.eps = std::min(1.0, m.eps * factor);
  if (id == "coolant") m.cool_h *= factor;
  if (id == "bearing_viscosity") m.beta = std::min(0.06, m.beta * factor);
  if (id == "bearing_preload") m.preload_T *= factor, m.preload_n *= factor;
  if (id == "extra_heat_source") m.extra_W *= factor;
  if (id == "contact_resistance") m.contact_R *= factor;
  if (id == "structure_ambient") m.ambient_g *= factor;
  if (id == "structure_bending") m.bend_g *= factor;
  if (id == "sensor_lag") {
    m.lag_s *= factor;
    if (factor == 0.0) m.lag_channel = -1;
  }
  if (id == "sensor_offset") m.offset_K *= factor;
  if (id == "cutting_heat") m.cut_share *= factor;
  if (id == "draught") m.draught_h *= factor;
  if (id.rfind("unlisted", 0) == 0)
    for (double* size : {&m.wander_W, &m.creep_um, &m.backlash_um, &m.stick_um, &m.travel_W}) *size *= factor;
}

const std::vector<std::string>& listed() {
  static const std::vector<std::string> ids = {
      "convection",      "speed_convection",  "radiation",          "coolant",           "bearing_viscosity",
      "bearing_preload", "extra_heat_source", "contact_resistance", "structure_ambient", "structure_bending",
      "sensor_lag",      "sensor_offset",     "cutting_heat"};
  return ids;
}

}  // namespace zerodrift::proof
