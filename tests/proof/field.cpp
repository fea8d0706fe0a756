// The axisymmetric field and what sensors and probes show of it.
#include <algorithm>
#include <cmath>

#include "tests/proof/truth.h"

namespace zerodrift::proof {
namespace {

constexpr double pi = 3.14159265358979;

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
  double bearing_heat = 0, motor_heat = 0, coolant_heat = 0;

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
    coolant_heat = 0;
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
      if (m.draught_h > 0 && in.time > m.draught_from_s && in.time < m.draught_to_s) h += m.draught_h * (x / m.length);
      const double a = t[outer] + 273.15, b = in.room + 273.15;
      h += m.eps * 5.67e-8 * (a + b) * (a * a + b * b);
      const bool cooled = x > m.cool_from && x < m.cool_to;
      const double cooling = cooled ? in.coolant * m.cool_h * (m.cool_C - t[outer]) : 0.0;
      coolant_heat += cooling * m_face[nr - 1];
      const double flow = h * (in.room - t[outer]) + cooling;
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
    if (m.travel_W > 0 && in.rpm > 0) {  // under a nut or slide that goes to and fro
      const double share = 0.5 - 0.5 * std::cos(2 * pi * in.time / m.travel_s);
      const double at = m.travel_from + share * (m.travel_to - m.travel_from);
      heat(m.travel_W, at - half, at + half);
    }
  }

  const Truth& m_m;
  Noise m_wander;
  double m_dz, m_dr;
  double m_area[nr]{}, m_face[nr]{};
  std::vector<double> m_t, m_half, m_rate;
};

/// First-order lag by small exact steps towards the mean of the interval.
double follow(double y, double u, double dt, double tau) {
  return u + (y - u) * std::exp(-dt / tau);
}

}  // namespace

Readings run(const Truth& m, const Schedule& s) {
  Field field(m, Noise(m.wander_seed));
  Readings out;
  out.temperatures.resize(m.sensors.size());
  double room_lag = 0, bend = 0, bend_room = 0, lagged = m.start_C;
  double coolant_J = 0, flows_s = 0;
  double held = 0;            // growth that the seat has let through
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
        coolant_J += field.coolant_heat * dt / parts;
        flows_s += s.coolant[row] * dt / parts;
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
    const double grown = field.elongation_um();
    const double slack = m.backlash_um * std::tanh((grown - 12.0) / 4.0);
    held = std::clamp(held, grown - m.stick_um, grown + m.stick_um);
    out.dz.push_back(held + m.ambient_g * room_lag + creep + slack - m.backlash_um * std::tanh(-3.0));
    out.dy.push_back(m.bend_g * (bend + 0.3 * bend_room));
  }
  out.coolant_W = flows_s > 0 ? coolant_J / flows_s : 0.0;
  return out;
}

}  // namespace zerodrift::proof
