#include "app/machine/room.h"

#include <cmath>
#include <numbers>

namespace zerodrift::machine {
namespace {

constexpr double day_s = 86400.0;
constexpr double heating_period_s = 1500.0;
constexpr double heating_amplitude_K = 0.12;
constexpr double wander_sigma_K = 0.25;
constexpr double wander_memory_s = 5400.0;

}  // namespace

Room::Room(const MachineParameters& parameters)
    : m_start_C(parameters.room_start_C),
      m_amplitude_K(parameters.room_day_amplitude_K),
      m_phase_h(parameters.room_phase_h),
      m_temperature_C(parameters.room_start_C),
      m_noise(parameters.seed * 31 + 5 + parameters.noise_day * 1000003) {}

double Room::wave(double time_s) const {
  const double turn = 2.0 * std::numbers::pi;
  // coldest at four in the morning, warmest at four in the afternoon
  const auto day = [&](double t) { return -std::cos(turn * (t / day_s + (m_phase_h - 4.0) / 24.0)); };
  return m_amplitude_K * (day(time_s) - day(0.0)) + heating_amplitude_K * std::sin(turn * time_s / heating_period_s);
}

double Room::advance(double duration_s) {
  m_time_s += duration_s;
  const double memory = std::exp(-duration_s / wander_memory_s);
  m_wander_K = memory * m_wander_K + wander_sigma_K * std::sqrt(1.0 - memory * memory) * m_noise.normal();
  m_temperature_C = m_start_C + wave(m_time_s) + m_wander_K;
  return m_temperature_C;
}

}  // namespace zerodrift::machine
