// Prints what remains of the virtual machine's errors under the table of a fit, mean over seeds: the continuation of
// the warm-up as the commissioning verifies it, and another day at other speeds; beside the plain peers of
// analysis_bench. Usage: virtual_bench FIRST_SEED COUNT.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "core/analysis/fit.h"
#include "core/analysis/predict.h"
#include "tests/bench/analysis/peers.h"
#include "tests/bench/analysis/virtual_runs.h"

namespace zerodrift::bench {
namespace {

std::vector<RunStep> warm_up(bool one_speed) {
  if (one_speed) return {{14400, 3000, true, true}};
  return {{7200, 3000, true, true}, {2880, 6000, true, true}, {2160, 1500, false, true}, {2160, 0, false, false}};
}
std::vector<RunStep> verification() {
  return {{1620, 0, false, false}, {1620, 1500, false, true}, {2160, 6000, true, true}, {5400, 3000, true, true}};
}
std::vector<RunStep> other_day() {
  return {{600, 0, false, false},    {3600, 4500, true, true}, {2400, 1500, true, true},
          {3600, 2250, false, true}, {2400, 5500, true, true}, {1800, 0, false, false}};
}

struct Totals {
  std::array<double, 3> peak{};
  std::array<double, 3> worst{};
  std::array<double, 3> noise{};
  std::array<double, 3> removed{};
  double of_largest = 0.0;  // removed of the largest error of any axis
  int count = 0;
  void add(const Remaining& r) {
    for (std::size_t a = 0; a < 3; ++a) {
      peak[a] += r.peak_um[a];
      worst[a] = std::max(worst[a], r.peak_um[a]);
      noise[a] += r.noise_um[a];
      removed[a] += 100.0 * (1.0 - r.peak_um[a] / r.before_um[a]);
    }
    of_largest += 100.0 * (1.0 - *std::max_element(r.peak_um.begin(), r.peak_um.end()) /
                                     *std::max_element(r.before_um.begin(), r.before_um.end()));
    ++count;
  }
  void print(const char* what) const {
    std::printf("    %-12s", what);
    for (std::size_t a = 0; a < 3; ++a) {
      std::printf("  %c peak %5.2f worst %5.2f noise %4.2f removed %5.1f %%", "XYZ"[a], peak[a] / count, worst[a],
                  noise[a] / count, removed[a] / count);
    }
    std::printf("  axes' mean %5.1f %%, of the largest %5.1f %%\n", (removed[0] + removed[1] + removed[2]) / 3 / count,
                of_largest / count);
  }
};

/// Coverage and half-width of the band on another day, which counts from its own first five minutes.
struct BandTotals {
  std::array<double, 3> covered{};
  std::array<double, 3> least{1.0, 1.0, 1.0};
  std::array<double, 3> half_width_um{};
  int count = 0;
  void add(const analysis::Model& model, const VirtualRun& run) {
    const auto prediction = analysis::predict(model, run.recording, analysis::Zero::start);
    if (!prediction) return;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto& p = prediction->errors[a];
      const auto truth = [&](std::size_t row) {
        return run.thermal_um[static_cast<std::size_t>(prediction->time_s[row])][a];
      };
      constexpr std::size_t first = 30;
      double zero = 0.0;
      for (std::size_t i = 0; i < first; ++i) zero += (truth(i) - p.value_um[i]) / first;
      double inside = 0.0;
      const auto rows = static_cast<double>(p.value_um.size());
      for (std::size_t i = 0; i < p.value_um.size(); ++i) {
        if (std::abs(truth(i) - p.value_um[i] - zero) <= p.half_width_um[i]) inside += 1.0 / rows;
        half_width_um[a] += p.half_width_um[i] / rows;
      }
      covered[a] += inside;
      least[a] = std::min(least[a], inside);
    }
    ++count;
  }
  void print() const {
    if (count == 0) return;
    std::printf("    band        ");
    for (std::size_t a = 0; a < 3; ++a) {
      std::printf("  %c covers %5.1f %% (least %5.1f %%), half-width %4.1f um", "XYZ"[a], 100.0 * covered[a] / count,
                  100.0 * least[a], half_width_um[a] / count);
    }
    std::printf("\n");
  }
};

struct Way {
  std::string name;
  std::optional<Peer> peer{};
  int most = 0;
  Totals same{};
  Totals other{};
  BandTotals band{};
};

/// The table of one way on one run; our ways also add their band on another day.
std::vector<analysis::TableTerms> fitted(Way& way, const VirtualRun& train, const VirtualRun& other) {
  if (way.peer) {
    const auto set = analysis::make_training({train.recording}, {});
    return set ? table_of(*way.peer, *set) : std::vector<analysis::TableTerms>{};
  }
  analysis::FitOptions options;
  options.method = analysis::Method::ridge;  // what a controller runs
  options.max_sensors = way.most;
  const auto model = analysis::fit({train.recording}, options);
  if (!model) {
    std::printf("%s: %s\n", way.name.c_str(), describe(model.error()).c_str());
    return {};
  }
  way.band.add(*model, other);
  return model->table;
}

void run(std::uint64_t first, int count, double filter_s, bool one_speed) {
  std::vector<Way> ways;
  for (const Peer peer : all_peers()) ways.push_back({name_of(peer), peer});
  ways.push_back({"ours"});
  ways.push_back({"ours, at most 12 sensors", {}, 12});
  ways.push_back({"ours, at most 8 sensors", {}, 8});
  for (std::uint64_t seed = first; seed < first + static_cast<std::uint64_t>(count); ++seed) {
    machine::Machine machine(machine::build_machine(seed));
    machine.advance_to(2600.0);
    const VirtualRun train = run_machine(machine, warm_up(one_speed), 120.0, seed);
    const VirtualRun same = run_machine(machine, verification(), 120.0, seed + 500);
    auto tomorrow = machine::build_machine(seed);
    tomorrow.noise_day = 1;
    tomorrow.room_start_C += 1.5;
    tomorrow.room_phase_h += 5.0;
    machine::Machine later(tomorrow);
    later.advance_to(1800.0);
    const VirtualRun other = run_machine(later, other_day(), 120.0, seed + 900);
    for (Way& way : ways) {
      const auto table = fitted(way, train, other);
      if (table.empty()) continue;
      way.same.add(run_table(table, same, filter_s, false));
      way.other.add(run_table(table, other, filter_s, true));
    }
  }
  for (const Way& way : ways) {
    std::printf("%s\n", way.name.c_str());
    way.same.print("continued");
    way.other.print("another day");
    way.band.print();
  }
}

}  // namespace
}  // namespace zerodrift::bench

int main(int argc, char** argv) {
  CLI::App app("What remains of the virtual machine's errors under a fitted table");
  std::uint64_t first = 1;
  int count = 5;
  double filter_s = 10.0;
  app.add_option("first", first, "First seed");
  app.add_option("count", count, "Number of seeds");
  app.add_option("--filter", filter_s, "Low-pass of the controller's temperatures, s");
  bool one_speed = false;
  app.add_flag("--one-speed", one_speed, "Train on four hours at 3000 rpm instead of the stepped plan");
  CLI11_PARSE(app, argc, argv);
  zerodrift::bench::run(first, count, filter_s, one_speed);
  return 0;
}
