#pragma once
// The air of the shop: the day's wave, the heating's cycle, and wandering; the same for the same seed.

#include <cstdint>

#include "app/machine/parameters.h"
#include "core/base/noise.h"

namespace zerodrift::machine {

class Room {
 public:
  explicit Room(const MachineParameters& parameters);
  /// Steps forward; returns the temperature at the end of the step.
  double advance(double duration_s);
  double temperature_C() const { return m_temperature_C; }

 private:
  double wave(double time_s) const;

  double m_start_C;
  double m_amplitude_K;
  double m_phase_h;
  double m_time_s = 0.0;
  double m_wander_K = 0.0;
  double m_temperature_C;
  Noise m_noise;
};

}  // namespace zerodrift::machine
