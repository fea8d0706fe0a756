#include "tests/bench/analysis/virtual_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/noise.h"

namespace zerodrift::bench {
namespace {

constexpr double measure_noise_um = 0.2;
constexpr const char* error_names[] = {"dX_um", "dY_um", "dZ_um"};

void add_row(const machine::Machine& machine, bool measured, Noise& noise, recording::Recording& out) {
  const auto add = [&](const std::string& channel, double value) { out.find(channel)->values.push_back(value); };
  add("spindle_rpm", machine.commanded_rpm());
  for (int axis = 0; axis < 3; ++axis) {
    add(fmt::format("feed_{}_mm_min", "XYZ"[axis]), machine.motion().mean_feed_mm_min(axis));
  }
  add("coolant_on", machine.coolant_on() ? 1.0 : 0.0);
  add("ambient_C", machine.raw_temperature(0) / 16.0);
  for (int s = 1; s <= machine::sensor_count; ++s) add(fmt::format("T{}_C", s), machine.raw_temperature(s) / 16.0);
  for (int axis = 0; axis < 3; ++axis) {
    const double um = machine.thermal().errors().um[static_cast<std::size_t>(axis)];
    add(error_names[axis],
        measured ? um + measure_noise_um * noise.normal() : std::numeric_limits<double>::quiet_NaN());
  }
}

int sensor_of(const std::string& channel) {
  return channel == "ambient_C" ? 0 : std::stoi(channel.substr(1));
}

}  // namespace

VirtualRun run_machine(machine::Machine& machine, const std::vector<RunStep>& plan, double measure_s,
                       std::uint64_t noise_seed) {
  constexpr int period_s = 10;
  VirtualRun run;
  run.recording.name = "virtual machine";
  run.recording.ensure("spindle_rpm");
  for (const char axis : {'X', 'Y', 'Z'}) run.recording.ensure(fmt::format("feed_{}_mm_min", axis));
  run.recording.ensure("coolant_on");
  run.recording.ensure("ambient_C");
  for (int s = 1; s <= machine::sensor_count; ++s) run.recording.ensure(fmt::format("T{}_C", s));
  for (const char* name : error_names) run.recording.ensure(name);
  Noise noise(noise_seed);
  const double start_s = machine.time_s();
  int second = 0;
  for (const auto& step : plan) {
    machine.command_speed(step.speed_rpm);
    machine.command_coolant(step.coolant_on);
    if (step.cycle) {
      machine.motion().start_cycle();
    } else {
      machine.motion().move_to({0.0, 0.0, 0.0});
    }
    for (int i = 0; i < static_cast<int>(step.duration_s); ++i, ++second) {
      machine.advance_to(start_s + second);
      run.time_s.push_back(second);
      auto& reading = run.reading_C.emplace_back();
      for (int s = 0; s <= machine::sensor_count; ++s)
        reading[static_cast<std::size_t>(s)] = machine.raw_temperature(s) / 16.0;
      run.thermal_um.push_back(machine.thermal().errors().um);
      if (second % period_s != 0) continue;
      run.recording.time_s.push_back(second);
      add_row(machine, second % static_cast<int>(measure_s) == 0, noise, run.recording);
    }
  }
  return run;
}

Remaining run_table(const std::vector<analysis::TableTerms>& table, const VirtualRun& run, double filter_s,
                    bool own_zero) {
  Remaining out;
  constexpr std::size_t settle = 60;
  for (const auto& terms : table) {
    const auto axis = static_cast<std::size_t>(std::find(std::begin(error_names), std::end(error_names), terms.error) -
                                               std::begin(error_names));
    std::vector<double> residual;
    std::vector<double> filtered(terms.terms.size());
    for (std::size_t i = 0; i < run.time_s.size(); ++i) {
      double asked = terms.offset_um;
      for (std::size_t k = 0; k < filtered.size(); ++k) {
        const double now = run.reading_C[i][static_cast<std::size_t>(sensor_of(terms.terms[k].sensor))];
        filtered[k] = i == 0 ? now : filtered[k] + (now - filtered[k]) / filter_s;
        asked += terms.terms[k].um_per_K * (filtered[k] - terms.terms[k].reference_C);
      }
      residual.push_back(run.thermal_um[i][axis] - asked);
    }
    double zero = 0.0;
    double thermal_zero = 0.0;
    if (own_zero) {  // the axes are set to zero in the first minutes of the day
      constexpr std::size_t first = 300;
      for (std::size_t i = 0; i < first; ++i) zero += residual[i] / first;
      thermal_zero = run.thermal_um.front()[axis];
    }
    double square = 0.0;
    double fast = 0.0;
    const std::size_t last = residual.size();
    for (std::size_t i = settle; i < last; ++i) {
      const double r = residual[i] - zero;
      out.before_um[axis] = std::max(out.before_um[axis], std::abs(run.thermal_um[i][axis] - thermal_zero));
      out.peak_um[axis] = std::max(out.peak_um[axis], std::abs(r));
      square += r * r / static_cast<double>(last - settle);
      double mean = 0.0;
      for (std::size_t k = i - settle; k < i; ++k) mean += residual[k] / settle;
      fast += std::pow(residual[i - settle / 2] - mean, 2) / static_cast<double>(last - settle);
    }
    out.rms_um[axis] = std::sqrt(square);
    out.noise_um[axis] = std::sqrt(fast);
  }
  return out;
}

}  // namespace zerodrift::bench
