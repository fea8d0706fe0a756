#pragma once
// Displacement probes as the source of errors (V5), read by the control or by an amplifier of their own: five-probe
// nest, X1 X2 Y1 Y2 Z in um, pair 1 at the nose. Error = reading - zero; the mean of several readings that were taken
// since the machine stands, their scatter is the uncertainty.

#include <optional>

#include "core/acquisition/error_source.h"
#include "core/acquisition/machine_io.h"

namespace zerodrift::controller {

class ProbeErrorSource : public acquisition::ErrorSource {
 public:
  /// The machine must outlive the source and is used from the same thread.
  explicit ProbeErrorSource(acquisition::MachineIo& machine, int readings = 5)
      : m_machine(machine), m_readings(readings) {}

  Status take_zero(const acquisition::Stand& stand, const TaskContext& context) override;
  Result<acquisition::ErrorSample> measure(const acquisition::Stand& stand, const TaskContext& context) override;
  std::string name() const override { return "probes"; }
  std::optional<std::array<double, 3>> zero_um() const override { return m_zero_um; }
  bool restore_zero_um(const std::array<double, 3>& zero_um) override {
    m_zero_um = zero_um;
    return true;
  }

 private:
  struct Nose {
    std::array<double, 3> mean_um{};
    std::array<double, 3> sigma_um{};
    bool valid = false;
  };
  Result<Nose> read_nose(Seconds since, const TaskContext& context);
  Result<std::optional<std::array<double, 5>>> newer_than(Seconds& at, const TaskContext& context);

  acquisition::MachineIo& m_machine;
  int m_readings;
  std::array<double, 3> m_zero_um{};
};

}  // namespace zerodrift::controller
