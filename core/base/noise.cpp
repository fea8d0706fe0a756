#include "core/base/noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace zerodrift {

double Noise::uniform() {
  return static_cast<double>(m_engine() >> 11U) * 0x1.0p-53;
}

double Noise::uniform(double low, double high) {
  return low + (high - low) * uniform();
}

double Noise::normal() {
  if (m_has_spare) {
    m_has_spare = false;
    return m_spare;
  }
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  const double angle = 2.0 * std::numbers::pi * uniform();
  m_spare = radius * std::sin(angle);
  m_has_spare = true;
  return radius * std::cos(angle);
}

std::uint64_t Noise::index(std::uint64_t count) {
  return std::min(count - 1, static_cast<std::uint64_t>(uniform() * static_cast<double>(count)));
}

}  // namespace zerodrift
