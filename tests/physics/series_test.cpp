// The closed series of one-dimensional conduction (Carslaw and Jaeger 1959, 3.8 and 3.4) against the network.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/physics/builder.h"
#include "core/physics/prediction.h"
#include "tests/physics/machines.h"

namespace zerodrift::physics {
namespace {

constexpr double length_m = 0.4;
constexpr double conductivity = 44.0;
constexpr double rho_c = 7850.0 * 460.0;
constexpr double diffusivity = conductivity / rho_c;
constexpr double alpha_1_K = 1.15e-5;
constexpr double flux_W_m2 = 8000.0;
constexpr double pi = std::numbers::pi;

enum class FixedEnd { insulated, held };

/// A rod of unit section heated at its free end: the source fills the last cell, which is what a flux does.
struct Rod {
  Network network;
  InputSet inputs;
};

Rod make_rod(int cells, double end_s, double period_s, bool ramp, FixedEnd end) {
  Machine machine = test::spindle();
  machine.effects.clear();
  Component& spindle = machine.components[0];
  spindle.bore_diameter_mm = 0.0;
  HeatSource heater;
  heater.id = "flux";
  heater.kind = SourceKind::input;
  heater.channel = "flux";
  heater.from_mm = 400.0 - 400.0 / cells;
  heater.to_mm = 400.0;
  heater.watts_per_unit = flux_W_m2 * spindle.section_m2();
  spindle.sources = {heater};
  recording::Recording run;
  recording::Channel flux{"flux", {}};
  for (double t = 0.0; t <= end_s + 1e-9; t += period_s) {
    run.time_s.push_back(t);
    flux.values.push_back(ramp ? t / 600.0 : 1.0);
  }
  run.channels = {flux};
  machine.sensors.clear();
  for (const double x : {0.0, 100.0, 232.0, 300.0, 390.0}) {
    machine.sensors.push_back({"T" + std::to_string(int(x)) + "_C", "spindle", x, 0.1});
  }
  BuildOptions options;
  options.cells = cells;
  NetworkBuilder builder(machine, run, options);
  builder.build();
  if (end == FixedEnd::held) {
    // Half a cell of rod between the first node and the held end.
    Environment cold;
    cold.name = "held end";
    cold.constant_C = 20.0;
    Term film;
    film.kind = TermKind::film;
    film.law_kind = LawKind::constant;
    film.first_node = 0;
    film.weights = {conductivity * spindle.section_m2() / (0.5 * length_m / cells)};
    film.environment = builder.environment(cold);
    film.law = [](const LawPoint&) {
      Strength s;
      s.value = 1.0;
      return s;
    };
    builder.add(film);
  }
  Rod rod{builder.network(), {}};
  rod.inputs = make_inputs(rod.network, run);
  return rod;
}

/// Exact for a ramp: the input at the middle of each step.
Prediction run_rod(const Rod& rod, bool ramp) {
  std::vector<double> values = rod.network.start_values();
  values[rod.network.hold_parameter] = ramp ? 0.5 : 0.0;
  SimulateOptions options;
  options.longest_step_s = 1e9;
  return predict(rod.network, rod.inputs, values, {}, options);
}

double sign(int n) {
  return n % 2 == 0 ? 1.0 : -1.0;
}

double series_theta(bool ramp, FixedEnd end, double x, double t) {
  const double q = flux_W_m2 / conductivity;
  const double rate = q / 600.0;
  const double z = x / length_m;
  double sum = 0.0;
  for (int n = 0; n < 400; ++n) {
    const double beta = (2 * n + 1) * pi / (2 * length_m);
    const double wave = n * pi / length_m;
    if (end == FixedEnd::held) {
      sum += sign(n) / std::pow(beta, ramp ? 4 : 2) * std::exp(-diffusivity * beta * beta * t) * std::sin(beta * x);
    } else if (n > 0) {
      sum += sign(n) / std::pow(n, ramp ? 4 : 2) * std::exp(-diffusivity * wave * wave * t) * std::cos(n * pi * z);
    }
  }
  const double l = length_m;
  if (end == FixedEnd::insulated && !ramp) {
    return q * (diffusivity * t / l + x * x / (2 * l) - l / 6 - 2 * l / (pi * pi) * sum);
  }
  if (end == FixedEnd::insulated) {
    return rate * (diffusivity * t * t / (2 * l) + t * l * (3 * z * z - 1) / 6 -
                   l * l * l / diffusivity * (-7.0 / 360 + z * z / 12 - z * z * z * z / 24) +
                   2 * l * l * l / (diffusivity * std::pow(pi, 4)) * sum);
  }
  if (!ramp) return q * (x - 2 / l * sum);
  return rate * (x * t - (x * l * l / 2 - x * x * x / 6) / diffusivity + 2 / (diffusivity * l) * sum);
}

struct Golden {
  bool ramp;
  FixedEnd end;
  double at_600_um;
  double at_3600_um;
};

class ClosedSeries : public testing::TestWithParam<Golden> {};

}  // namespace

TEST_P(ClosedSeries, TemperaturesAndElongation) {
  const Golden golden = GetParam();
  const Rod rod = make_rod(400, 3600.0, 5.0, golden.ramp, golden.end);
  const Prediction p = run_rod(rod, golden.ramp);
  for (const auto& channel : p.channels) {
    if (!channel.temperature) continue;
    const double x = std::stod(channel.channel.substr(1)) * 1e-3;
    if (x == 0.0 && golden.end == FixedEnd::held) continue;  // sensors at an end assume an adiabatic end
    const double expected = series_theta(golden.ramp, golden.end, x, 3600.0);
    EXPECT_NEAR(channel.values.back() - 20.0, expected, 1e-4 * std::max(1.0, std::abs(expected))) << channel.channel;
  }
  const auto& dz = p.channels[5];
  ASSERT_EQ(dz.channel, "dZ_um");
  EXPECT_NEAR(dz.values[120], golden.at_600_um, 1e-4 * golden.at_600_um);
  EXPECT_NEAR(dz.values.back(), golden.at_3600_um, 1e-4 * golden.at_3600_um);
}

INSTANTIATE_TEST_SUITE_P(All, ClosedSeries,
                         testing::Values(Golden{false, FixedEnd::insulated, 15.2866, 91.7197},
                                         Golden{false, FixedEnd::held, 15.2829, 79.5187},
                                         Golden{true, FixedEnd::insulated, 7.6433, 275.1592},
                                         Golden{true, FixedEnd::held, 7.6429, 256.7861}));

TEST(ClosedSeriesPrescribedEnd, ElongationAtTenKelvinInTenMinutes) {
  // The free end follows f(t) = 10 K t / 600 s: a film of half a cell's conductance towards a ramped surrounding.
  Machine machine = test::spindle();
  machine.effects.clear();
  machine.components[0].sources.clear();
  recording::Recording run;
  recording::Channel ramp{"ramp_C", {}};
  for (double t = 0.0; t <= 600.0; t += 2.0) {
    run.time_s.push_back(t);
    ramp.values.push_back(20.0 + t / 60.0);
  }
  run.channels = {ramp};
  BuildOptions options;
  options.cells = 400;
  NetworkBuilder builder(machine, run, options);
  builder.build();
  Environment end;
  end.series = builder.linear("ramp_C");
  Term film;
  film.kind = TermKind::film;
  film.law_kind = LawKind::constant;
  film.first_node = 399;
  film.weights = {conductivity * machine.components[0].section_m2() / (0.5 * length_m / 400)};
  film.environment = builder.environment(end);
  film.law = [](const LawPoint&) {
    Strength s;
    s.value = 1.0;
    return s;
  };
  builder.add(film);
  const InputSet inputs = make_inputs(builder.network(), run);
  const Prediction p = predict(builder.network(), inputs, builder.network().start_values());
  for (const auto& channel : p.channels) {
    if (channel.channel != "dZ_um") continue;
    EXPECT_NEAR(channel.values.back(), 7.397, 1e-3);
  }
}

TEST(Order, SecondInTimeAndSpace) {
  // Smooth start: a ramped flux. Thirds of the cell divide the error by nine (232 mm is a cell centre on both grids),
  // halves of the step divide it by four.
  const auto error = [](int cells, double period_s) {
    const Rod rod = make_rod(cells, 1920.0, period_s, true, FixedEnd::held);
    const Prediction p = run_rod(rod, true);
    const auto& channel = p.channels[2];
    return std::abs(channel.values.back() - 20.0 - series_theta(true, FixedEnd::held, 0.232, 1920.0));
  };
  EXPECT_NEAR(error(25, 4.0) / error(75, 4.0), 9.0, 1.0);
  // In time against the same grid with a tiny step, so that the grid's error cancels.
  const auto at = [](double period_s) {
    const Rod rod = make_rod(60, 1920.0, period_s, true, FixedEnd::held);
    return run_rod(rod, true).channels[4].values.back();
  };
  const double exact = at(2.0);
  const double ratio = std::abs(at(240.0) - exact) / std::abs(at(120.0) - exact);
  EXPECT_GT(ratio, 3.4);
  EXPECT_LT(ratio, 4.8);
}

}  // namespace zerodrift::physics
