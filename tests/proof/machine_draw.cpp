// A machine drawn at random, its description, how the real one differs, and how it is run.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/proof/truth.h"

namespace zerodrift::proof {
namespace {

using nlohmann::json;

constexpr double turn = 3.14159265358979;

double nominal_bearing_W(const Bearing& b, double n) {
  const double nu_n = b.nu * n, dm3 = b.dm * b.dm * b.dm;
  const double torque =
      (nu_n >= 2000 ? 1e-7 * b.f0 * std::cbrt(nu_n * nu_n) * dm3 : 160e-7 * b.f0 * dm3) + b.f1 * b.load * b.dm;
  return 1.047e-4 * n * torque;
}

}  // namespace

Schedule make_schedule(Noise& noise, const Truth& m, bool poor) {
  Schedule s;
  const double hours = noise.uniform(4.0, 8.0);
  const double period = noise.uniform() < 0.5 ? 30.0 : 60.0;
  const double room0 = m.start_C + noise.uniform(-0.5, 0.5);
  const double drift = noise.uniform(-0.5, 0.9), swing = noise.uniform(0.2, 1.5), phase = noise.uniform(0, 6.28);
  double rpm = 0, coolant = 0, load = 0, until = noise.uniform(0.0, 600.0);
  const double constant_rpm = m.rated_rpm * noise.uniform(0.4, 0.9);
  double wander = 0;
  for (double t = 0; t <= hours * 3600; t += period) {
    if (t >= until) {
      until = t + noise.uniform(1200.0, 4500.0);
      rpm = poor ? constant_rpm : noise.uniform() < 0.22 ? 0.0 : m.rated_rpm * noise.uniform(0.2, 1.0);
      coolant = !poor && rpm > 0 && noise.uniform() < 0.4 ? 1.0 : 0.0;
      load = !poor && rpm > 0 && noise.uniform() < 0.4 ? noise.uniform(600.0, 3000.0) : 0.0;
    }
    wander = 0.995 * wander + 0.01 * noise.normal();
    s.time.push_back(t);
    s.rpm.push_back(rpm);
    s.coolant.push_back(coolant);
    s.load.push_back(load);
    s.room.push_back(room0 + drift * t / 3600 + swing * (std::sin(2 * turn * t / 20000 + phase) - std::sin(phase)) +
                     wander);
  }
  return s;
}

Truth draw_machine(Noise& noise) {
  Truth m;
  m.length = 1e-3 * std::round(noise.uniform(280, 620));
  m.outer = 1e-3 * std::round(noise.uniform(55, 95));
  m.bore = 1e-3 * std::round(noise.uniform(12, 28));
  m.k = noise.uniform(38, 50);
  m.rho = 7850;
  m.c = noise.uniform(450, 480);
  m.alpha = noise.uniform(1.08e-5, 1.2e-5);
  m.motor_from = m.length * noise.uniform(0.12, 0.25);
  m.motor_to = m.motor_from + m.length * noise.uniform(0.2, 0.3);
  m.motor_W = std::round(noise.uniform(2500, 7500));
  m.efficiency = noise.uniform(0.88, 0.94);
  m.rated_rpm = 1000 * std::round(noise.uniform(6, 14));
  const double dm = noise.uniform(55, 90);
  const double friction = std::pow(8000 / m.rated_rpm, 1.67);
  m.bearings = {{0.03 * m.length, 0.09 * m.length, dm, 1.5 * friction, 8e-4, noise.uniform(300, 900), 32},
                {m.length * 0.82, m.length * 0.9, dm * 1.05, 2.0 * friction, 1e-3, noise.uniform(500, 1500), 32}};
  m.h = noise.uniform(8, 20);
  m.start_C = noise.uniform(18, 24);
  // Losses that warm the whole spindle by 10 to 50 K at full speed.
  const double area_h = m.h * turn * m.outer * m.length;
  m.motor_W = std::round(noise.uniform(8, 28) * area_h / (1 - m.efficiency));
  m.scale = {1, 1, 1};
  for (Bearing& b : m.bearings) {
    const double share = noise.uniform(4, 12) * area_h / nominal_bearing_W(b, m.rated_rpm);
    b.f0 *= share;
    b.f1 *= share;
  }
  const int count = 6 + static_cast<int>(noise.index(5));
  for (int j = 0; j < count; ++j)
    m.sensors.push_back(m.length * std::clamp((j + 0.5 + noise.uniform(-0.25, 0.25)) / count, 0.02, 0.98));
  m.scale = {1, 1, 1};
  return m;
}

json describe(const Truth& m, bool with_convection) {
  json sources = {{{"id", "motor"},
                   {"kind", "motor"},
                   {"from_mm", 1e3 * m.motor_from},
                   {"to_mm", 1e3 * m.motor_to},
                   {"rated_power_W", m.motor_W},
                   {"efficiency", m.efficiency},
                   {"rated_speed_rpm", m.rated_rpm}}};
  const char* names[] = {"rear_bearing", "front_bearing"};
  for (std::size_t q = 0; q < m.bearings.size(); ++q) {
    const Bearing& b = m.bearings[q];
    sources.push_back({{"id", names[q]},
                       {"kind", "bearing"},
                       {"from_mm", 1e3 * b.from},
                       {"to_mm", 1e3 * b.to},
                       {"mean_diameter_mm", b.dm},
                       {"f0", b.f0},
                       {"f1", b.f1},
                       {"load_N", b.load},
                       {"oil_viscosity_mm2_s", b.nu}});
  }
  json machine = {{"format", "zerodrift-machine/1"}, {"name", "proof"}, {"initial_temperature_C", m.start_C}};
  machine["components"] = {{{"id", "spindle"},
                            {"length_mm", 1e3 * m.length},
                            {"outer_diameter_mm", 1e3 * m.outer},
                            {"bore_diameter_mm", 1e3 * m.bore},
                            {"material",
                             {{"conductivity_W_mK", m.k},
                              {"density_kg_m3", m.rho},
                              {"heat_capacity_J_kgK", m.c},
                              {"expansion_1_K", m.alpha}}},
                            {"heat_sources", sources}}};
  machine["effects"] = json::array();
  if (with_convection) {
    machine["effects"] = {"convection"};
    machine["effect_parameters"]["convection"]["h_W_m2K"] = m.h;
  }
  for (std::size_t j = 0; j < m.sensors.size(); ++j) {
    machine["sensors"].push_back({{"channel", "T" + std::to_string(j + 1) + "_C"},
                                  {"component", "spindle"},
                                  {"position_mm", 1e3 * m.sensors[j]},
                                  {"accuracy_C", 0.1}});
  }
  machine["sensors"].push_back({{"channel", "ambient_C"}, {"component", "ambient"}});
  machine["displacements"] = {{{"channel", "dZ_um"}, {"direction", "Z"}, {"component", "spindle"}},
                              {{"channel", "dY_um"}, {"direction", "Y"}, {"component", "spindle"}}};
  return machine;
}

void perturb(Truth& m, Noise& noise) {
  const auto off = [&](double share) { return std::exp(share * std::clamp(noise.normal(), -1.8, 1.8)); };
  m.k *= off(0.04);
  m.c *= off(0.03);
  m.alpha *= off(0.04);
  m.h *= off(0.13);
  for (double& s : m.scale) s *= off(0.09);
  m.end_h = noise.uniform(0, 1.2) * m.h;
}

}  // namespace zerodrift::proof
