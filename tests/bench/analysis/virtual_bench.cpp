// Prints what remains of the virtual machine's errors under the table of a fit, seed by seed: the continuation of the
// warm-up as the commissioning verifies it, and another day at other speeds. Usage: virtual_bench FIRST_SEED COUNT.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "core/analysis/clustering.h"
#include "core/analysis/fit.h"
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
  int count = 0;
  void add(const Remaining& r) {
    for (std::size_t a = 0; a < 3; ++a) {
      peak[a] += r.peak_um[a];
      worst[a] = std::max(worst[a], r.peak_um[a]);
      noise[a] += r.noise_um[a];
      removed[a] += 100.0 * (1.0 - r.peak_um[a] / r.before_um[a]);
    }
    ++count;
  }
  void print(const char* what) const {
    std::printf("    %-14s", what);
    for (std::size_t a = 0; a < 3; ++a) {
      std::printf("  %c peak %5.2f worst %5.2f noise %4.2f removed %5.1f %%", "XYZ"[a], peak[a] / count, worst[a],
                  noise[a] / count, removed[a] / count);
    }
    std::printf("\n");
  }
};

struct Way {
  std::string name;
  Totals same;
  Totals other;
};

void run(std::uint64_t first, int count, double filter_s, bool one_speed) {
  std::vector<Way> ways{{"sensitive points", {}, {}}, {"spread 5", {}, {}}, {"auto", {}, {}}, {"all", {}, {}}};
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
    analysis::ClusterOptions cluster_options;
    cluster_options.suggest = cluster_options.stability = false;
    const auto clusters = analysis::cluster(train.recording, cluster_options);
    if (!clusters) continue;
    const auto& spread = clusters->spread_order;
    for (Way& way : ways) {
      analysis::FitOptions options;
      options.method = analysis::Method::ridge;
      if (way.name == "sensitive points") options.sensors = clusters->sensitive_points;
      if (way.name == "spread 5") options.sensors.assign(spread.begin(), spread.begin() + 5);
      if (way.name == "all") options.sensors = spread;
      const auto model = analysis::fit({train.recording}, options);
      if (!model) {
        std::printf("seed %llu, %s: %s\n", static_cast<unsigned long long>(seed), way.name.c_str(),
                    describe(model.error()).c_str());
        continue;
      }
      const Remaining a = run_table(model->table, same, filter_s, false);
      const Remaining b = run_table(model->table, other, filter_s, true);
      way.same.add(a);
      way.other.add(b);
      std::printf(
          "seed %llu %-18s Z %5.2f of %4.1f (noise %4.2f), other day %5.2f of %4.1f; X %5.2f %5.2f  Y %5.2f %5.2f;",
          static_cast<unsigned long long>(seed), way.name.c_str(), a.peak_um[2], a.before_um[2], a.noise_um[2],
          b.peak_um[2], b.before_um[2], a.peak_um[0], b.peak_um[0], a.peak_um[1], b.peak_um[1]);
      for (const auto& s : model->sensors) {
        if (model->sensors.size() <= 8) std::printf(" %s", s.c_str());
      }
      std::printf("\n");
    }
  }
  for (const Way& way : ways) {
    std::printf("%s\n", way.name.c_str());
    way.same.print("continued");
    way.other.print("another day");
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
