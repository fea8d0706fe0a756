#pragma once
// Runs of the virtual machine without servers: the same physics, sensors and table, hours of machine time in a second.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "app/machine/machine.h"
#include "core/analysis/model.h"
#include "core/recording/recording.h"

namespace zerodrift::bench {

struct RunStep {
  double duration_s = 0.0;
  double speed_rpm = 0.0;
  bool coolant_on = false;
  bool cycle = false;
};

/// What the engineer records, and what the machine truly did, every second.
struct VirtualRun {
  recording::Recording recording;
  std::vector<double> time_s;
  std::vector<std::array<double, machine::sensor_count + 1>> reading_C;  // 0 the room
  std::vector<machine::Axes> thermal_um;
};

/// Temperatures every 10 s, errors every `measure_s` with 0.2 um of noise, counted from the machine's start.
VirtualRun run_machine(machine::Machine& machine, const std::vector<RunStep>& plan, double measure_s,
                       std::uint64_t noise_seed);

struct Remaining {
  std::array<double, 3> before_um{};  // peak
  std::array<double, 3> peak_um{};    // of what remains when the controller runs the table
  std::array<double, 3> rms_um{};
  std::array<double, 3> noise_um{};  // rms of its part faster than a minute
};
/// The machine under the model's table; the controller low-passes its readings over filter_s. With `own_zero` errors
/// and temperatures count from the run's start (another day), else from the training's.
Remaining run_table(const std::vector<analysis::TableTerms>& table, const VirtualRun& run, double filter_s,
                    bool own_zero);

}  // namespace zerodrift::bench
