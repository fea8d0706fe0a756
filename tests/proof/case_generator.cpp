#include "tests/proof/case_generator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "core/base/noise.h"

namespace zerodrift::proof {
namespace {

using nlohmann::json;
using recording::Recording;

constexpr double pi = 3.14159265358979;

struct Bearing {
  double from, to, dm, f0, f1, load, nu;  // m, m, mm, 1, 1, N, mm2/s
};

struct Truth {
  double length, outer, bore;  // m, diameters
  double k, rho, c, alpha;
  double motor_from, motor_to, motor_W, efficiency, rated_rpm;
  std::vector<Bearing> bearings;
  double h;
  std::vector<double> sensors;  // m
  double start_C;
  std::vector<double> scale;  // motor, bearings
  double end_h = 0;
  // hidden
  double speed_a = 0, speed_m = 0.7, eps = 0, cool_h = 0, cool_from = 0, cool_to = 0, cool_C = 20;
  double beta = 0, preload_T = 0, preload_n = 0, preload_0 = 0;
  double extra_W = 0, extra_x = 0, contact_R = 0, contact_x = 0, cut_share = 0;
  int extra_law = 0;
  double ambient_g = 0, ambient_tau = 4000, bend_g = 0, bend_tau = 2000;
  int bend_driver = 0;
  int lag_channel = -1, offset_channel = -1;
  double lag_s = 0, offset_K = 0;
  double wander_W = 0, wander_x = 0, creep_um = 0, backlash_um = 0, film_patch = 0;
  std::uint64_t wander_seed = 0;
};

struct Schedule {
  std::vector<double> time, rpm, coolant, load, room;
};

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
    s.room.push_back(room0 + drift * t / 3600 + swing * (std::sin(2 * pi * t / 20000 + phase) - std::sin(phase)) +
                     wander);
  }
  return s;
}

double bearing_W(const Truth& m, const Bearing& b, double n, double temperature, double scale) {
  if (n <= 0) return 0;
  const double nu_n = b.nu * std::exp(-m.beta * (temperature - m.start_C)) * n;
  const double dm3 = b.dm * b.dm * b.dm;
  const double relative = n / m.rated_rpm;
  double p = 1 + m.preload_T * (temperature - m.start_C) + m.preload_n * relative * relative + m.preload_0;
  p = std::max(0.0, p);
  const double torque =
      (nu_n >= 2000 ? 1e-7 * b.f0 * std::cbrt(nu_n * nu_n) * dm3 : 160e-7 * b.f0 * dm3) + b.f1 * b.load * p * b.dm;
  return scale * 1.047e-4 * n * torque;
}

/// Axisymmetric field, cells [z][r]; heat enters where it arises: motor and bearings at the outer surface.
class Field {
 public:
  Field(const Truth& m, Noise wander) : m_m(m), m_wander(std::move(wander)) {
    m_dz = m.length / nz;
    m_dr = (m.outer - m.bore) / 2 / nr;
    for (int j = 0; j < nr; ++j) {
      const double r0 = m.bore / 2 + j * m_dr, r1 = r0 + m_dr;
      m_area[j] = pi * (r1 * r1 - r0 * r0);
      m_face[j] = 2 * pi * r1 * m_dz;
    }
    m_t.assign(nz * nr, m.start_C);
    m_rate = m_t;
  }

  struct Inputs {
    double rpm, coolant, load, room, time;
  };

  void advance(const Inputs& in, double dt) {
    const double limit = 0.22 * m_m.rho * m_m.c / m_m.k / (1 / (m_dz * m_dz) + 1 / (m_dr * m_dr));
    const int steps = std::max(1, static_cast<int>(std::ceil(dt / limit)));
    for (int s = 0; s < steps; ++s) {
      rates(m_t, in);
      m_half = m_t;
      for (std::size_t i = 0; i < m_t.size(); ++i) m_half[i] += 0.5 * dt / steps * m_rate[i];
      rates(m_half, in);
      for (std::size_t i = 0; i < m_t.size(); ++i) m_t[i] += dt / steps * m_rate[i];
    }
  }

  double surface(double x) const {
    const double u = std::clamp(x / m_dz - 0.5, 0.0, nz - 1.0);
    const int i = std::min(static_cast<int>(u), nz - 2);
    return (1 - (u - i)) * m_t[i * nr + nr - 1] + (u - i) * m_t[(i + 1) * nr + nr - 1];
  }
  double elongation_um() const {
    double sum = 0, total = 0;
    for (int j = 0; j < nr; ++j) total += m_area[j];
    for (int i = 0; i < nz; ++i) {
      for (int j = 0; j < nr; ++j) sum += m_area[j] / total * (m_t[i * nr + j] - m_m.start_C) * m_dz;
    }
    return 1e6 * m_m.alpha * sum;
  }
  double mean_over(double from, double to, const std::vector<double>& t) const {
    double sum = 0, weight = 0;
    for (int i = 0; i < nz; ++i) {
      const double o = overlap(from, to, i);
      sum += o * t[i * nr + nr - 1];
      weight += o;
    }
    return sum / weight;
  }
  double bearing_heat = 0, motor_heat = 0;

 private:
  static constexpr int nz = 48, nr = 3;

  double overlap(double from, double to, int i) const {
    return std::max(0.0, std::min(to, (i + 1) * m_dz) - std::max(from, i * m_dz));
  }
  /// Adds watts to the outer cells between two places.
  void heat(double watts, double from, double to) {
    for (int i = 0; i < nz; ++i) {
      const double o = overlap(from, to, i);
      if (o > 0) m_rate[i * nr + nr - 1] += watts * o / (to - from) / (m_m.rho * m_m.c * m_area[nr - 1] * m_dz);
    }
  }

  void rates(const std::vector<double>& t, const Inputs& in) {
    const Truth& m = m_m;
    std::fill(m_rate.begin(), m_rate.end(), 0.0);
    const int joint = m.contact_R > 0 ? static_cast<int>(std::lround(m.contact_x / m_dz)) : -1;
    for (int i = 0; i < nz; ++i) {
      for (int j = 0; j < nr; ++j) {
        const int at = i * nr + j;
        if (i + 1 < nz) {
          double per_area = m_dz / m.k;
          if (i + 1 == joint) per_area += m.contact_R;
          const double flow = m_area[j] / per_area * (t[at + nr] - t[at]);
          m_rate[at] += flow / (m.rho * m.c * m_area[j] * m_dz);
          m_rate[at + nr] -= flow / (m.rho * m.c * m_area[j] * m_dz);
        }
        if (j + 1 < nr) {
          const double flow = m.k * m_face[j] / m_dr * (t[at + 1] - t[at]);
          m_rate[at] += flow / (m.rho * m.c * m_area[j] * m_dz);
          m_rate[at + 1] -= flow / (m.rho * m.c * m_area[j + 1] * m_dz);
        }
      }
      const int outer = i * nr + nr - 1;
      const double x = (i + 0.5) * m_dz;
      double h = m.h + (m.speed_a > 0 ? m.speed_a * std::pow(std::max(1e-9, in.rpm / m.rated_rpm), m.speed_m) : 0);
      if (m.film_patch > 0 && in.time > 7000 && in.time < 13000) h += m.film_patch * (x / m.length);
      const double a = t[outer] + 273.15, b = in.room + 273.15;
      h += m.eps * 5.67e-8 * (a + b) * (a * a + b * b);
      double flow = h * (in.room - t[outer]);
      if (x > m.cool_from && x < m.cool_to) flow += in.coolant * m.cool_h * (m.cool_C - t[outer]);
      m_rate[outer] += flow * m_face[nr - 1] / (m.rho * m.c * m_area[nr - 1] * m_dz);
    }
    for (int j = 0; j < nr; ++j) {
      for (const int i : {0, nz - 1}) m_rate[i * nr + j] += m.end_h * (in.room - t[i * nr + j]) / (m.rho * m.c * m_dz);
    }
    motor_heat = m.scale[0] * m.motor_W * (1 - m.efficiency) * in.rpm / m.rated_rpm;
    heat(motor_heat, m.motor_from, m.motor_to);
    bearing_heat = 0;
    for (std::size_t q = 0; q < m.bearings.size(); ++q) {
      const Bearing& one = m.bearings[q];
      const double watts = bearing_W(m, one, in.rpm, mean_over(one.from, one.to, t), m.scale[q + 1]);
      heat(watts, one.from, one.to);
      bearing_heat += watts;
    }
    const double n = in.rpm / m.rated_rpm;
    const double law[] = {1.0, n > 0.01 ? 1.0 : 0.0, n, n * n};
    const double half = 0.02 * m.length;
    if (m.extra_W > 0)
      heat(m.extra_W * law[m.extra_law], std::max(0.0, m.extra_x - half), std::min(m.length, m.extra_x + half));
    if (m.cut_share > 0) heat(m.cut_share * in.load, 0.97 * m.length, m.length);
    if (m.wander_W > 0) {  // comes and goes by itself
      const double level =
          std::sin(in.time / 3100.0 + 1.3 * std::sin(in.time / 1234.0 + static_cast<double>(m.wander_seed % 7)));
      heat(m.wander_W * std::max(0.0, level), std::max(0.0, m.wander_x - half), std::min(m.length, m.wander_x + half));
    }
  }

  const Truth& m_m;
  Noise m_wander;
  double m_dz, m_dr;
  double m_area[nr]{}, m_face[nr]{};
  std::vector<double> m_t, m_half, m_rate;
};

struct Readings {
  std::vector<std::vector<double>> temperatures;  // [sensor][row]
  std::vector<double> dz, dy;
};

/// First-order lag by small exact steps towards the mean of the interval.
double follow(double y, double u, double dt, double tau) {
  return u + (y - u) * std::exp(-dt / tau);
}

Readings run(const Truth& m, const Schedule& s) {
  Field field(m, Noise(m.wander_seed));
  Readings out;
  out.temperatures.resize(m.sensors.size());
  double room_lag = 0, bend = 0, bend_room = 0, lagged = m.start_C;
  const double share = 0.37;  // inputs switch inside the interval
  for (std::size_t k = 0; k < s.time.size(); ++k) {
    if (k > 0) {
      const double dt = s.time[k] - s.time[k - 1];
      const int parts = 6;
      for (int q = 0; q < parts; ++q) {
        const double f = (q + 0.5) / parts;
        const std::size_t row = f > 1 - share ? k : k - 1;
        const double room = s.room[k - 1] + f * (s.room[k] - s.room[k - 1]);
        field.advance({s.rpm[row], s.coolant[row], s.load[row], room, s.time[k - 1] + f * dt}, dt / parts);
        const double rise = room - m.start_C;
        room_lag = follow(room_lag, rise, dt / parts, m.ambient_tau);
        const double typical = m.motor_W * (1 - m.efficiency);
        const double driver = m.bend_driver == 0   ? 10 * field.bearing_heat / typical
                              : m.bend_driver == 1 ? 10 * field.motor_heat / typical
                                                   : field.surface(0.95 * m.length) - room;
        bend = follow(bend, driver, dt / parts, m.bend_tau);
        bend_room = follow(bend_room, rise, dt / parts, m.bend_tau);
        if (m.lag_channel >= 0) lagged = follow(lagged, field.surface(m.sensors[m.lag_channel]), dt / parts, m.lag_s);
      }
    }
    for (std::size_t j = 0; j < m.sensors.size(); ++j) {
      double value = field.surface(m.sensors[j]);
      if (static_cast<int>(j) == m.lag_channel) value = lagged;
      if (static_cast<int>(j) == m.offset_channel) value += m.offset_K;
      out.temperatures[j].push_back(value);
    }
    const double creep = m.creep_um * std::log1p(s.time[k] / 900.0);
    const double slack = m.backlash_um * std::tanh((field.elongation_um() - 12.0) / 4.0);
    out.dz.push_back(field.elongation_um() + m.ambient_g * room_lag + creep + slack - m.backlash_um * std::tanh(-3.0));
    out.dy.push_back(m.bend_g * (bend + 0.3 * bend_room));
  }
  return out;
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
  const double area_h = m.h * pi * m.outer * m.length;
  m.motor_W = std::round(noise.uniform(8, 28) * area_h / (1 - m.efficiency));
  m.scale = {1, 1, 1};
  for (Bearing& b : m.bearings) {
    const double share = noise.uniform(4, 12) * area_h / bearing_W(m, b, m.rated_rpm, m.start_C, 1.0);
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

/// The real machine differs from its description by the tolerances.
void perturb(Truth& m, Noise& noise) {
  const auto off = [&](double share) { return std::exp(share * std::clamp(noise.normal(), -1.8, 1.8)); };
  m.k *= off(0.04);
  m.c *= off(0.03);
  m.alpha *= off(0.04);
  m.h *= off(0.13);
  for (double& s : m.scale) s *= off(0.09);
  m.end_h = noise.uniform(0, 1.2) * m.h;
}

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
  if (id == "unlisted:wandering_heat")
    m.wander_W = around(0.15, 0.4) * heat_W, m.wander_x = m.length * noise.uniform(0.15, 0.85);
  if (id == "unlisted:creep") m.creep_um = (noise.uniform() < 0.5 ? -1 : 1) * around(2, 6);
  if (id == "unlisted:patch_of_air") m.film_patch = around(25, 70);
  if (id == "unlisted:slack") m.backlash_um = around(3, 9);
  return hidden;
}

Recording measure(const Truth& m, const Schedule& s, const Readings& r, Noise& noise, bool noisy,
                  const std::vector<double>& offsets) {
  Recording out;
  out.time_s = s.time;
  out.channels = {{"spindle_rpm", s.rpm}, {"coolant_on", s.coolant}, {"spindle_load_W", s.load}, {"ambient_C", s.room}};
  const double step = 0.05;
  for (std::size_t j = 0; j < m.sensors.size(); ++j) {
    std::vector<double> values = r.temperatures[j];
    for (std::size_t k = 0; noisy && k < values.size(); ++k) {
      values[k] = step * std::round((values[k] + offsets[j] + 0.05 * noise.normal()) / step);
      if (noise.uniform() < 5e-4) values[k] += noise.uniform(3, 9);
      if (noise.uniform() < 2e-3) values[k] = std::nan("");
    }
    out.channels.push_back({"T" + std::to_string(j + 1) + "_C", values});
  }
  for (const auto& [name, series] : {std::pair{"dZ_um", &r.dz}, std::pair{"dY_um", &r.dy}}) {
    std::vector<double> values = *series;
    for (double& v : values) v += noisy ? 0.3 * noise.normal() : 0.0;
    out.channels.push_back({name, values});
  }
  return out;
}

const std::vector<std::string>& listed() {
  static const std::vector<std::string> ids = {
      "convection",      "speed_convection",  "radiation",          "coolant",           "bearing_viscosity",
      "bearing_preload", "extra_heat_source", "contact_resistance", "structure_ambient", "structure_bending",
      "sensor_lag",      "sensor_offset",     "cutting_heat"};
  return ids;
}

double rms_change(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

/// Hidden effects' change of each channel in noise widths: the largest names the worst channel.
std::pair<std::string, double> largest_change(const Truth& with, const Truth& without, const Schedule& s) {
  const Readings a = run(with, s), b = run(without, s);
  std::string worst;
  double largest = 0;
  const auto look = [&](const std::string& name, double change) {
    if (change > largest) largest = change, worst = name;
  };
  for (std::size_t j = 0; j < with.sensors.size(); ++j) {
    look("T" + std::to_string(j + 1) + "_C", rms_change(a.temperatures[j], b.temperatures[j]) / 0.055);
  }
  look("dZ_um", rms_change(a.dz, b.dz) / 0.36);
  look("dY_um", rms_change(a.dy, b.dy) / 0.36);
  return {worst, largest};
}

}  // namespace

Case make_case(std::uint64_t seed, const std::string& kind) {
  Noise noise(seed * 7919 + 17);
  for (int i = 0; i < 5; ++i) noise.uniform();
  Truth nominal = draw_machine(noise);
  nominal.wander_seed = seed;
  Truth real = nominal;
  perturb(real, noise);
  std::vector<std::string> ids;
  const double draw = noise.uniform();
  std::string what = kind;
  if (what.empty())
    what = draw < 0.15   ? "none"
           : draw < 0.27 ? "pair"
           : draw < 0.36 ? "unlisted"
                         : listed()[noise.index(listed().size())];
  if (what == "pair") {
    ids.push_back(listed()[1 + noise.index(listed().size() - 1)]);
    do ids.resize(1), ids.push_back(listed()[1 + noise.index(listed().size() - 1)]);
    while (ids[0] == ids[1] || (ids[0].rfind("sensor", 0) == 0 && ids[1].rfind("sensor", 0) == 0));
  } else if (what == "unlisted") {
    static const char* odd[] = {"unlisted:wandering_heat", "unlisted:creep", "unlisted:patch_of_air", "unlisted:slack"};
    ids.push_back(odd[noise.index(4)]);
  } else if (what != "none") {
    ids.push_back(what);
  }
  const bool poor = noise.uniform() < 0.06;
  Case out;
  out.name = what + "-" + std::to_string(seed);
  std::vector<Schedule> schedules;
  bool strong = false;
  for (int attempt = 0; attempt < 12 && !strong; ++attempt) {
    schedules = {make_schedule(noise, nominal, poor), make_schedule(noise, nominal, false)};
    Truth trial = real;
    out.hidden.clear();
    const double strength = std::exp(noise.uniform(-0.5, 0.5)) * (1.0 + 0.25 * attempt);
    for (const auto& id : ids) out.hidden.push_back(hide(trial, id, noise, strength));
    strong = true;
    // Each hidden effect must show by two to three noise widths at least, else the case proves nothing.
    for (std::size_t e = 0; e < ids.size(); ++e) {
      if (ids[e] == "convection") continue;
      Truth without = trial;
      if (ids[e] == "speed_convection") without.speed_a = 0;
      if (ids[e] == "radiation") without.eps = 0;
      if (ids[e] == "coolant") without.cool_h = 0;
      if (ids[e] == "bearing_viscosity") without.beta = 0;
      if (ids[e] == "bearing_preload") without.preload_T = without.preload_n = 0;
      if (ids[e] == "extra_heat_source") without.extra_W = 0;
      if (ids[e] == "contact_resistance") without.contact_R = 0;
      if (ids[e] == "structure_ambient") without.ambient_g = 0;
      if (ids[e] == "structure_bending") without.bend_g = 0;
      if (ids[e] == "sensor_lag") without.lag_channel = -1;
      if (ids[e] == "sensor_offset") without.offset_channel = -1;
      if (ids[e] == "cutting_heat") without.cut_share = 0;
      if (ids[e].rfind("unlisted", 0) == 0)
        without.wander_W = without.creep_um = without.film_patch = without.backlash_um = 0;
      strong = strong && largest_change(trial, without, schedules[0]).second > (ids[e] == "radiation" ? 5.0 : 3.0);
    }
    if (strong) real = trial;
  }
  if (!strong) return make_case(seed + 1000003, kind);
  Truth bare = nominal;
  bare.scale = real.scale;
  Truth without = real;
  without.speed_a = without.eps = without.cool_h = without.beta = without.preload_T = without.preload_n =
      without.extra_W = 0;
  without.contact_R = without.ambient_g = without.bend_g = without.cut_share = without.wander_W = without.creep_um = 0;
  without.film_patch = without.backlash_um = 0;
  without.lag_channel = without.offset_channel = -1;
  if (what == "convection") without.h = without.end_h = 0;
  if (what != "none") out.worst_channel = largest_change(real, without, schedules[0]).first;
  out.machine = describe(nominal, what != "convection");
  std::vector<double> offsets;
  for (std::size_t j = 0; j < real.sensors.size(); ++j) offsets.push_back(0.04 * std::clamp(noise.normal(), -2.0, 2.0));
  for (std::size_t i = 0; i < 2; ++i) {
    const Readings readings = run(real, schedules[i]);
    out.recordings.push_back(measure(real, schedules[i], readings, noise, true, offsets));
    out.clean.push_back(measure(real, schedules[i], readings, noise, false, offsets));
    out.recordings.back().name = out.name + (i == 0 ? "-A" : "-B");
  }
  return out;
}

}  // namespace zerodrift::proof
