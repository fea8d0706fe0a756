// Numbers that no sensor says and that a file may hold all the same: the fit names what is wrong, or makes a model of
// finite numbers that says finite things.

#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>

#include "core/analysis/fit.h"
#include "core/analysis/predict.h"
#include "tests/analysis/support.h"

namespace zerodrift::analysis {
namespace {

using Recording = recording::Recording;

Recording small_run() {
  test::MachineCase c;
  c.step_s = 2.0 * 3600.0;
  c.period_s = 60.0;
  c.error_period_s = 120.0;
  return test::machine_run(c);
}

/// What is given to the fit is named in it, or the fit does without.
void expect_named_or_finite(const Recording& recording, const std::string& what) {
  FitOptions options;
  options.method = Method::ridge;
  const auto model = fit({recording}, options);
  if (!model) {
    EXPECT_FALSE(describe(model.error()).empty());
    return;
  }
  const auto document = to_json(*model);
  EXPECT_TRUE(model_from_json(nlohmann::json::parse(document.dump()), "written")) << what;
  const auto prediction = predict(*model, small_run());
  ASSERT_TRUE(prediction) << what << ": " << describe(prediction.error());
  for (const auto& error : prediction->errors) {
    for (const double value : error.value_um) ASSERT_TRUE(std::isfinite(value)) << what << ", " << error.error;
  }
}

constexpr std::array hostile = {1e300, -1e300, 1e150, 5e-324, std::numeric_limits<double>::infinity(), test::missing};

}  // namespace

TEST(HostileNumbers, InEveryKindOfChannel) {
  for (const double value : hostile) {
    for (const char* channel : {"T3_C", "spindle_rpm", "dZ_um"}) {
      for (const std::size_t every : {std::size_t{1}, std::size_t{2}, std::size_t{40}}) {
        auto recording = small_run();
        auto& column = recording.find(channel)->values;
        for (std::size_t i = 0; i < column.size(); i += every) column[i] = value;
        expect_named_or_finite(recording, std::string(channel) + " " + std::to_string(value));
      }
    }
  }
}

TEST(HostileNumbers, InTime) {
  for (const double step : {5e-324, 1e-300, 1e300}) {
    auto recording = small_run();
    for (std::size_t i = 0; i < recording.time_s.size(); ++i) recording.time_s[i] = step * double(i) / 200.0;
    expect_named_or_finite(recording, "time in steps of " + std::to_string(step));
  }
}

TEST(HostileNumbers, TooLittleOfEverything) {
  const auto whole = small_run();
  for (const std::size_t rows : {std::size_t{0}, std::size_t{1}, std::size_t{2}}) {
    Recording few = whole;
    few.time_s.resize(rows);
    for (auto& channel : few.channels) channel.values.resize(rows);
    EXPECT_FALSE(fit({few})) << rows << " rows";
  }
  EXPECT_FALSE(fit({}));
  Recording nothing = whole;
  nothing.channels.clear();
  EXPECT_FALSE(fit({nothing}));
}

// What no run names while it goes on: a slow drift, and two sensors swapped that read alike. The fit chooses its
// sensors itself; the model is judged on another day, when the sensor tells the truth again.
namespace {

double worst_removed_percent(const Recording& training) {
  const auto model = fit({training});
  if (!model) return std::nan("");
  test::MachineCase other;
  other.speeds_rpm = {1500.0, 4000.0, 0.0, 2500.0};
  other.step_s = 3600.0;
  other.error_noise_um = 0.0;
  other.start_C = 21.5;
  other.seed = 7;
  const auto prediction = predict(*model, test::machine_run(other));
  if (!prediction) return std::nan("");
  double worst = 100.0;
  for (const auto& error : prediction->errors) worst = std::min(worst, error.residual.removed_percent);
  return worst;
}

test::MachineCase stepped_run() {
  test::MachineCase c;
  c.speeds_rpm = {3000.0, 1000.0, 4000.0, 0.0};
  c.step_s = 2.0 * 3600.0;
  c.error_period_s = 120.0;
  return c;
}

}  // namespace

TEST(LyingSensors, ASlowDriftDoesNotCarryTheModelAway) {
  const double truthful = worst_removed_percent(test::machine_run(stepped_run()));
  double worst = 100.0;
  for (const char* sensor : {"T1_C", "T6_C", "T18_C"}) {
    for (const double K_per_h : {0.1, 0.5, 2.0}) {
      auto recording = test::machine_run(stepped_run());
      auto& values = recording.find(sensor)->values;
      for (std::size_t i = 0; i < values.size(); ++i) values[i] += K_per_h * recording.time_s[i] / 3600.0;
      const double removed = worst_removed_percent(recording);
      EXPECT_GT(removed, truthful - 5.0) << sensor << " " << K_per_h;
      worst = std::min(worst, removed);
    }
  }
  std::printf("a drifting sensor: %.1f %% removed on another day at worst, %.1f %% without drift\n", worst, truthful);
}

TEST(LyingSensors, SwappedThatReadAlikeChangeLittle) {
  auto recording = test::machine_run(stepped_run());
  auto& one = recording.find("T5_C")->values;
  auto& other = recording.find("T7_C")->values;
  for (std::size_t i = one.size() / 2; i < one.size(); ++i) std::swap(one[i], other[i]);
  const double truthful = worst_removed_percent(test::machine_run(stepped_run()));
  const double removed = worst_removed_percent(recording);
  EXPECT_GT(removed, truthful - 5.0);
  std::printf("two swapped: %.1f %% removed on another day, %.1f %% without\n", removed, truthful);
}

// The only sensor of its body drifts, and there is no other to lean on: the held-out error of the model tells it.
TEST(LyingSensors, ALonelyDriftingSensorIsToldByWhatWasHeldOut) {
  const auto held_out_um = [](double K_per_h) {
    auto recording = test::machine_run(stepped_run());
    auto& values = recording.find("T9_C")->values;
    for (std::size_t i = 0; i < values.size(); ++i) values[i] += K_per_h * recording.time_s[i] / 3600.0;
    std::erase_if(recording.channels, [](const auto& channel) {
      return channel.name == "T10_C" || channel.name == "T11_C" || channel.name == "T12_C";
    });
    const auto model = fit({recording});
    return model ? model->find("dY_um")->held_out.rms_um : std::nan("");
  };
  const double truthful = held_out_um(0.0);
  const double drifting = held_out_um(2.0);
  std::printf("lonely: held out %.2f um with drift, %.2f um without\n", drifting, truthful);
  EXPECT_GT(drifting, 2.0 * truthful);
}

}  // namespace zerodrift::analysis
