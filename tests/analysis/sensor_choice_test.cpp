#include "core/analysis/sensor_choice.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/analysis/budget.h"
#include "core/analysis/evaluate.h"
#include "tests/analysis/support.h"

namespace zerodrift::analysis {
namespace {

test::MachineCase stepped(double noise_C, std::uint64_t seed = 1) {
  test::MachineCase c;
  c.speeds_rpm = {3000.0, 0.0, 1500.0, 4000.0};
  c.step_s = 3600.0;
  c.noise_C = noise_C;
  c.seed = seed;
  return c;
}

double largest_um_per_K(const TrainingSet& set, const std::vector<std::string>& sensors) {
  const auto recipe = make_recipe(Method::ridge, sensors, set);
  const auto x = *design(set, recipe.features);
  double largest = 0.0;
  for (const auto& group : error_groups(set)) {
    const Rows rows = rows_of(set, x, group.samples, group.errors.front());
    const auto fits = *fit_rows(rows, errors_at(set, group, group.samples), recipe, set);
    for (const auto& f : fits) largest = std::max(largest, f.raw_coefficients().norm());
  }
  return largest;
}

}  // namespace

TEST(ReadingNoise, IsFoundInTheRecordingItself) {
  for (const double noise_C : {0.05, 0.1, 0.3}) {
    const auto set = make_training({test::machine_run(stepped(noise_C))}, {});
    ASSERT_TRUE(set);
    const double steps = 0.0625 * 0.0625 / 12.0;  // variance of the rounding
    const double expected = std::sqrt(noise_C * noise_C + steps);
    for (const double n : set->noise_C) {
      EXPECT_GT(n, 0.95 * expected);
      EXPECT_LT(n, 1.15 * expected);  // a straight line does not follow the kinks where the speed changes
    }
  }
}

TEST(ReadingNoise, SpikesDoNotCount) {
  auto r = test::machine_run(stepped(0.1));
  for (std::size_t i = 7; i < r.time_s.size(); i += 150) r.channels[3].values[i] += 5.0;
  const auto set = make_training({r}, {});
  ASSERT_TRUE(set);
  for (const double n : set->noise_C) EXPECT_LT(n, 0.13);
}

TEST(NoisyReadings, CoefficientsGiveUpWhatOnlyDifferencesOfReadingsSay) {
  const auto quiet = make_training({test::machine_run(stepped(0.01))}, {});
  const auto noisy = make_training({test::machine_run(stepped(0.5))}, {});
  ASSERT_TRUE(quiet && noisy);
  const std::vector<std::string> sensors{"T1_C", "T5_C", "T9_C", "T13_C", "T17_C"};
  EXPECT_LT(largest_um_per_K(*noisy, sensors), 0.9 * largest_um_per_K(*quiet, sensors));
}

/// By hand: one feature of variance 4 read with variance 1 keeps 4/5 of its coefficient; two equal ones 8/9 each.
TEST(NoisyReadings, ByHand) {
  RidgeFit fit;
  fit.mean = Eigen::VectorXd::Zero(1);
  fit.scale = Eigen::VectorXd::Ones(1);
  fit.beta = Eigen::VectorXd::Constant(1, 5.0);
  fit.covariance = Eigen::MatrixXd::Zero(1, 1);
  Eigen::MatrixXd x(2, 1);
  x << 2.0, -2.0;
  EXPECT_NEAR(for_noisy_readings(fit, x, Eigen::VectorXd::Ones(1)).beta(0), 4.0, 1e-9);
  fit.mean = Eigen::VectorXd::Zero(2);
  fit.scale = Eigen::VectorXd::Ones(2);
  fit.beta = Eigen::VectorXd::Constant(2, 9.0);
  fit.covariance = Eigen::MatrixXd::Zero(2, 2);
  Eigen::MatrixXd twins(2, 2);
  twins << 2.0, 2.0, -2.0, -2.0;
  EXPECT_NEAR(for_noisy_readings(fit, twins, Eigen::VectorXd::Ones(2)).beta(0), 8.0, 1e-9);
}

TEST(SensorChoice, TakesWhatIsToBeExpectedToLeaveLeastAndSaysWhy) {
  const auto set = make_training({test::machine_run(stepped(0.1))}, {});
  ASSERT_TRUE(set);
  ChoiceOptions options;
  options.sensitive_points = {"T1_C", "T2_C"};  // of one body out of five
  const auto choice = choose_sensor_set(*set, options);
  ASSERT_TRUE(choice) << describe(choice.error());
  ASSERT_GE(choice->sets.size(), 4U);
  const SensorSet& best = choice->sets[choice->chosen];
  EXPECT_NE(best.kind, SetKind::sensitive_points);
  for (const auto& s : choice->sets) {
    EXPECT_GE(s.expected_um, s.held_out_rms_um);
    EXPECT_LE(best.expected_um, s.expected_um);
    if (s.kind == SetKind::sensitive_points) {
      EXPECT_GT(s.expected_um, 2.0 * best.expected_um);
    }
  }
  EXPECT_NE(choice->reason.find("sensitive points"), std::string::npos);
}

TEST(SensorChoice, OneCycleRanksNothingSoAllAreTakenNearestFirst) {
  const auto set = make_training({test::machine_run({})}, {});
  ASSERT_TRUE(set);
  ChoiceOptions options;
  options.sensitive_points = {"T1_C", "T5_C", "T9_C", "T13_C", "T17_C"};
  const auto choice = choose_sensor_set(*set, options);
  ASSERT_TRUE(choice) << describe(choice.error());
  EXPECT_EQ(choice->sets[choice->chosen].sensors, *nearest_order(*set));
  EXPECT_EQ(choice->nested(), (std::vector<std::size_t>{2, 3, 4, 5, 6, 8}));
  EXPECT_NE(choice->reason.find("one cycle"), std::string::npos);
  options.most = 12;
  const auto twelve = choose_sensor_set(*set, options);
  ASSERT_TRUE(twelve) << describe(twelve.error());
  EXPECT_EQ(twelve->sets[twelve->chosen].sensors.size(), 12U);
}

TEST(SensorChoice, NoSetIsLargerThanAllowed) {
  const auto set = make_training({test::machine_run(stepped(0.1))}, {});
  ASSERT_TRUE(set);
  ChoiceOptions options;
  options.sensitive_points = {"T1_C", "T5_C", "T9_C", "T13_C", "T17_C"};
  options.most = 4;
  const auto choice = choose_sensor_set(*set, options);
  ASSERT_TRUE(choice);
  for (const auto& s : choice->sets) EXPECT_LE(s.sensors.size(), 4U);
}

}  // namespace zerodrift::analysis
