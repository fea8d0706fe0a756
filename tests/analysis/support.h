#pragma once
// Recordings made up for tests: a machine of a few first-order lumps, with the faults that real recordings have.

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/base/noise.h"
#include "core/recording/recording.h"

namespace zerodrift::analysis::test {

inline constexpr double missing = std::numeric_limits<double>::quiet_NaN();

struct MachineCase {
  std::vector<double> speeds_rpm{3000.0};  // one step each
  double step_s = 4.0 * 3600.0;
  double period_s = 10.0;
  double error_period_s = 60.0;
  double noise_C = 0.1;
  double resolution_C = 0.0625;
  double error_noise_um = 0.2;
  double start_C = 20.0;
  std::uint64_t seed = 1;
};

/// Twenty sensors on five bodies: in each group of four, time constants and rises are alike. True errors depend on the
/// noise-free temperatures of five of them; dX falls while dZ grows.
inline recording::Recording machine_run(const MachineCase& c) {
  const int bodies = 5;
  const double tau_s[] = {900.0, 2400.0, 5400.0, 9000.0, 16000.0};
  const double rise_K[] = {14.0, 9.0, 6.0, 4.0, 2.5};  // at 3000 rpm after long
  recording::Recording r;
  r.name = "made up";
  const auto rows = static_cast<std::size_t>(static_cast<double>(c.speeds_rpm.size()) * c.step_s / c.period_s) + 1;
  std::vector<std::vector<double>> sensors(20);
  std::vector<double> rpm;
  std::vector<double> dx;
  std::vector<double> dy;
  std::vector<double> dz;
  std::vector<double> state(bodies, 0.0);
  Noise noise(c.seed);
  for (std::size_t i = 0; i < rows; ++i) {
    const double t = static_cast<double>(i) * c.period_s;
    const auto step = std::min(static_cast<std::size_t>(t / c.step_s), c.speeds_rpm.size() - 1);
    const double n = c.speeds_rpm[step] / 3000.0;
    r.time_s.push_back(t);
    rpm.push_back(c.speeds_rpm[step]);
    const double drive[] = {n, 0.6 * n + 0.4 * n * n, n, n * n, n};
    for (int b = 0; b < bodies; ++b) {
      if (i > 0) {
        const double a = std::exp(-c.period_s / tau_s[b]);
        state[b] = a * state[b] + (1.0 - a) * rise_K[b] * drive[b];
      }
    }
    for (int s = 0; s < 20; ++s) {
      const int b = s / 4;
      const double share = 1.0 - 0.06 * (s % 4);
      const double offset = 0.05 * ((s * 7) % 5 - 2);
      const double value = c.start_C + offset + share * state[b] + c.noise_C * noise.normal();
      const double step_C = c.resolution_C;
      sensors[s].push_back(step_C > 0.0 ? std::round(value / step_C) * step_C : value);
    }
    const bool measured = std::fmod(t + 1e-6, c.error_period_s) < 1e-3;
    const double e = c.error_noise_um;
    dx.push_back(measured ? -1.1 * state[0] + 0.8 * state[3] + e * noise.normal() : missing);
    dy.push_back(measured ? 0.9 * state[1] + 1.2 * state[2] + e * noise.normal() : missing);
    dz.push_back(measured ? 2.4 * state[0] + 1.5 * state[1] - 1.8 * state[4] + e * noise.normal() : missing);
  }
  r.channels.push_back({"spindle_rpm", rpm});
  for (int s = 0; s < 20; ++s) r.channels.push_back({"T" + std::to_string(s + 1) + "_C", sensors[s]});
  r.channels.push_back({"dX_um", dx});
  r.channels.push_back({"dY_um", dy});
  r.channels.push_back({"dZ_um", dz});
  return r;
}

}  // namespace zerodrift::analysis::test
