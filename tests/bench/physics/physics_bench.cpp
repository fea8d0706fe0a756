// Prints how long the simulation, its derivatives and a whole diagnosis take. Nothing is asserted: times belong to the
// machine they were taken on. Usage: physics_bench [--diagnoses N] [--seed S]

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>

#include "core/diagnosis/diagnosis.h"
#include "core/physics/builder.h"
#include "core/physics/prediction.h"
#include "tests/physics/machines.h"
#include "tests/proof/case_generator.h"

namespace zerodrift {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int repetitions = 200;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

/// The fastest is what the code costs; the median is what it cost on this machine with everything that ran beside it.
void print_times(const char* name, const std::vector<double>& times_ms, const char* must) {
  std::printf("  %-58s fastest %8.3f ms  median %8.3f ms  must %s\n", name, quantile(times_ms, 0.0),
              quantile(times_ms, 0.5), must);
}

template <class Work>
std::vector<double> timed(int count, Work work) {
  std::vector<double> times_ms;
  for (int i = 0; i < count; ++i) {
    const auto start = Clock::now();
    work();
    times_ms.push_back(milliseconds_since(start));
  }
  return times_ms;
}

/// The contract's spindle; painted, its film depends on its temperature.
physics::Machine spindle(bool painted) {
  nlohmann::json document = physics::test::spindle_json();
  if (painted) {
    document["effects"].push_back("radiation");
    document["effect_parameters"]["radiation"]["emissivity"] = 0.9;
  }
  return physics::machine_from_json(document, "spindle.json").value();
}

void bench_simulation(const char* name, const physics::Machine& machine) {
  constexpr double period_s = 30.0;
  const recording::Recording run =
      recording::slice(physics::test::stepped_run(720.0 * period_s / 3600.0, period_s), 0, 720);
  const physics::Network network = physics::build_network(machine, run, {40});
  const physics::InputSet inputs = physics::make_inputs(network, run);
  const std::vector<double> values = network.start_values();
  double kept = 0.0;  // so that nothing is optimised away
  print_times((std::string(name) + ", field alone").c_str(),
              timed(repetitions, [&] { kept += physics::run_network(network, inputs, values).probes.back(); }),
              "0.4 ms");
  print_times(
      (std::string(name) + ", with sensors and elongation").c_str(),
      timed(repetitions, [&] { kept += physics::predict(network, inputs, values).channels.front().values.back(); }),
      "0.4 ms");
  std::vector<int> all;
  for (int i = 0; i < static_cast<int>(network.parameters.size()); ++i) all.push_back(i);
  const auto times = timed(repetitions / 10, [&] {
    kept += physics::predict(network, inputs, values, all).channels.front().derivatives.back();
  });
  print_times((std::string(name) + ", with derivatives by " + std::to_string(all.size()) + " parameters").c_str(),
              times, "-");
  if (kept == 0.5) std::printf(" ");
}

void bench_diagnosis(int count, std::uint64_t seed) {
  std::vector<double> times_ms;
  double longest = 0.0;
  for (int i = 0; i < count; ++i) {
    const proof::Case one = proof::make_case(seed + static_cast<std::uint64_t>(i));
    const auto machine = physics::machine_from_json(one.machine, one.name);
    const auto start = Clock::now();
    const auto found = diagnosis::diagnose(*machine, one.recordings);
    if (!found) std::printf("  %s: %s\n", one.name.c_str(), describe(found.error()).c_str());
    times_ms.push_back(milliseconds_since(start));
    longest = std::max(longest, times_ms.back());
  }
  print_times(("whole diagnosis, " + std::to_string(count) + " concealed cases").c_str(), times_ms, "2000 ms (median)");
  std::printf("  %-58s longest %8.0f ms  90 %% within %.0f ms\n", "", longest, quantile(times_ms, 0.9));
}

}  // namespace
}  // namespace zerodrift

int main(int argc, char** argv) {
  CLI::App app("Times of simulation and diagnosis");
  int diagnoses = 20;
  std::uint64_t seed = 1;
  app.add_option("--diagnoses", diagnoses, "How many concealed cases to diagnose");
  app.add_option("--seed", seed, "Seed of the first case");
  CLI11_PARSE(app, argc, argv);
  std::printf("One rod of 40 cells, 720 samples of 30 s\n");
  zerodrift::bench_simulation("constant films", zerodrift::spindle(false));
  zerodrift::bench_simulation("radiation: a factorisation each step", zerodrift::spindle(true));
  if (diagnoses > 0) zerodrift::bench_diagnosis(diagnoses, seed);
  return 0;
}
