// The joint likelihood, held against what it is computed from: dense covariances, brute force, simulated noise.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>

#include "core/diagnosis/answer/fitted_description.h"
#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/inference/adequacy.h"
#include "core/diagnosis/search/intervals.h"
#include "core/diagnosis/search/run_facts.h"
#include "core/diagnosis/search/score_test.h"
#include "core/diagnosis/search/stepwise_search.h"
#include "tests/diagnosis/heated_rod.h"

namespace zerodrift::diagnosis {
namespace {

using inference::Evidence;
using inference::Fit;
using inference::JointModel;
using inference::RowMatrix;

std::shared_ptr<const Evidence> evidence_of(const physics::Machine& machine,
                                            const std::vector<recording::Recording>& runs) {
  return std::make_shared<const Evidence>(machine, runs, DiagnosisSettings{});
}

Fit fit_of(const std::shared_ptr<const Evidence>& evidence, std::vector<inference::HeldEffect> effects = {}) {
  inference::Hypothesis hypothesis{evidence->machine(), std::move(effects), 0.0};
  return Fit(std::make_shared<JointModel>(std::move(hypothesis), evidence), evidence->usual_sizes());
}

}  // namespace

TEST(Whitener, AgreesWithTheDenseCovariance) {
  inference::MeasuredSeries series;
  series.white = 0.05;
  series.slow = 0.2;
  std::vector<double> time_s;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  for (int k = 0; k < 40; ++k) {
    time_s.push_back((k == 0 ? 0.0 : time_s.back()) + 5.0 + 60.0 * any(random));
    series.present.push_back(k % 7 != 3);
    series.values.push_back(any(random));
    series.timing.push_back(0.0);
  }
  constexpr double size = 1.4, correlation_s = 300.0;
  std::vector<int> there;
  for (int k = 0; k < 40; ++k) {
    if (series.present[static_cast<std::size_t>(k)]) there.push_back(k);
  }
  const auto n = static_cast<Eigen::Index>(there.size());
  Eigen::MatrixXd covariance(n, n);
  Eigen::VectorXd value(n);
  const double rate = std::sqrt(3.0) / correlation_s;
  for (Eigen::Index i = 0; i < n; ++i) {
    value[i] = series.values[static_cast<std::size_t>(there[static_cast<std::size_t>(i)])];
    for (Eigen::Index j = 0; j < n; ++j) {
      const double apart = rate * std::abs(time_s[static_cast<std::size_t>(there[static_cast<std::size_t>(i)])] -
                                           time_s[static_cast<std::size_t>(there[static_cast<std::size_t>(j)])]);
      covariance(i, j) = std::pow(size * series.slow, 2) * (1.0 + apart) * std::exp(-apart);
    }
    covariance(i, i) += series.white * series.white;
  }
  const inference::Whitener whitener(series, time_s, size, correlation_s);
  Eigen::VectorXd innovations(40);
  whitener.apply(series.values.data(), innovations.data());
  const Eigen::LLT<Eigen::MatrixXd> factors(covariance);
  EXPECT_NEAR(innovations.squaredNorm(), value.dot(factors.solve(value)), 1e-8);
  EXPECT_NEAR(whitener.log_determinant(), 2.0 * factors.matrixLLT().diagonal().array().log().sum(), 1e-8);
}

TEST(Adequacy, RejectsWhiteInnovationsAsOftenAsItSays) {
  std::mt19937 random(3);
  std::normal_distribution<double> white(0.0, 1.0);
  constexpr int trials = 4000;
  int below_5 = 0, below_1 = 0;
  for (int i = 0; i < trials; ++i) {
    std::vector<double> innovations(240);
    for (double& one : innovations) one = white(random);
    const double p = inference::p_of_blocks(innovations, std::vector<bool>(240, true), 20);
    below_5 += p < 0.05 ? 1 : 0;
    below_1 += p < 0.01 ? 1 : 0;
  }
  EXPECT_NEAR(below_5, 0.05 * trials, 4.0 * std::sqrt(0.05 * trials));
  EXPECT_NEAR(below_1, 0.01 * trials, 4.0 * std::sqrt(0.01 * trials));
}

TEST(Fit, MarginalisesTheRepeatableGainsExactly) {
  const physics::Machine machine = rod(R"(["convection"])", R"({"convection": {"h_W_m2K": 10}})");
  const auto evidence = evidence_of(machine, {measured(machine, inputs(0.4, {{200.0, 900.0}}), 5)});
  Fit fit = fit_of(evidence);
  fit.fit({12, true});
  inference::Sizes sizes = fit.sizes();
  sizes.repeatable[0] = 2;
  fit.set_sizes(sizes);
  const inference::Quadratic quadratic = fit.quadratic();

  // The same with the whitened basis as unknowns beside the others: Schur complement of the dense normal equations.
  const auto& gains = evidence->gains()[0];
  const auto n = static_cast<Eigen::Index>(fit.model().unknowns());
  const auto rows = static_cast<Eigen::Index>(evidence->runs()[0].rows());
  Eigen::MatrixXd all = Eigen::MatrixXd::Identity(n + gains.count, n + gains.count);
  const double size = evidence->settings().repeatable_sizes[2].size;
  all.bottomRightCorner(gains.count, gains.count) = gains.prior_precision / (size * size);
  for (std::size_t i = 0; i < gains.series.size(); ++i) {
    const std::size_t c = gains.series[i];
    const auto& white = evidence->whitened(c, sizes);
    RowMatrix j(rows, n);
    white.whitener[0].apply(fit.columns(0).middleRows(static_cast<Eigen::Index>(c) * rows, rows), j);
    const RowMatrix& basis = white.basis[0];
    all.topLeftCorner(n, n) += j.transpose() * j;
    all.block(0, n + gains.first[i], n, basis.cols()) += j.transpose() * basis;
    all.block(n + gains.first[i], 0, basis.cols(), n) += basis.transpose() * j;
    all.block(n + gains.first[i], n + gains.first[i], basis.cols(), basis.cols()) += basis.transpose() * basis;
  }
  const Eigen::MatrixXd inverse = all.inverse();
  const Eigen::MatrixXd marginal = inverse.topLeftCorner(n, n).inverse();
  EXPECT_LT((marginal - quadratic.curvature).norm(), 1e-6 * quadratic.curvature.norm());
}

TEST(ScoreTest, PromisesWhatAFitGains) {
  const physics::Machine described = rod(R"(["convection"])", R"({"convection": {"h_W_m2K": 10}})");
  const physics::Machine truth =
      rod(R"(["convection", "sensor_offset"])",
          R"({"convection": {"h_W_m2K": 10}, "sensor_offset": {"channel": "T2_C", "offset_K": 0.6}})");
  const auto evidence = evidence_of(described, {measured(truth, inputs(2.0, on_and_off), 7)});
  Fit base = fit_of(evidence);
  base.fit({20, true});
  const search::Candidate candidate{
      {{"sensor_offset", true, {{"offset_K", 0.0}, {"offset_K_prior_sigma", 1.2}}, {{"channel", "T2_C"}}}, -1}, 0.0};
  const search::Score score = search::score_test(base, {candidate}).front();
  Fit with = fit_of(evidence, {candidate.effect});
  with.fit({20, true});
  // The reading is linear in its offset: the linear promise is kept.
  EXPECT_GT(score.log_odds, 3.0);
  EXPECT_NEAR(score.log_odds, with.log_evidence() - base.log_evidence(), 0.02 * std::abs(score.log_odds) + 0.2);
}

TEST(Intervals, FindsTheStretchesThatWereSampled) {
  constexpr int hats = 40;
  search::HatScores scores;
  scores.information = Eigen::MatrixXd::Identity(hats, hats) * 25.0;
  for (int i = 0; i + 1 < hats; ++i) scores.information(i, i + 1) = scores.information(i + 1, i) = 5.0;
  Eigen::VectorXd truth = Eigen::VectorXd::Zero(hats);
  for (const int i : {5, 6, 7, 20, 21, 22, 23, 24, 33}) truth[i] = 2.0;
  std::mt19937 random(9);
  std::normal_distribution<double> white(0.0, 1.0);
  Eigen::VectorXd noise(hats);
  for (double& one : noise) one = white(random);
  const Eigen::MatrixXd root = Eigen::LLT<Eigen::MatrixXd>(scores.information).matrixL();
  scores.slope = scores.information * truth + root * noise;
  auto found = search::best_stretches(scores, 5.0, true, 2.0 * std::log(hats));
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, (std::vector<std::pair<int, int>>{{5, 7}, {20, 24}, {33, 33}}));
}

TEST(Intervals, FindNothingInNoise) {
  constexpr int hats = 40;
  std::mt19937 random(11);
  std::normal_distribution<double> white(0.0, 1.0);
  int found = 0;
  for (int trial = 0; trial < 100; ++trial) {
    search::HatScores scores;
    scores.information = Eigen::MatrixXd::Identity(hats, hats);
    scores.slope = Eigen::VectorXd::NullaryExpr(hats, [&](Eigen::Index) { return white(random); });
    const auto stretches = search::best_stretches(scores, 5.0, false, 2.0 * std::log(hats));
    found += stretches.size() > 1 ? 1 : 0;  // the first is proposed for the score test; further ones have to earn it
  }
  EXPECT_LE(found, 5);
}

TEST(StepwiseSearch, NamesConvectionThatWasLeftOutAndItsSize) {
  const physics::Machine truth = rod(R"(["convection"])", R"({"convection": {"h_W_m2K": 12}})");
  const physics::Machine described = rod("[]", "{}");
  const auto answer = diagnose(described, {measured(truth, inputs(2.0, on_and_off), 13)});
  ASSERT_TRUE(answer.has_value());
  EXPECT_EQ(answer->verdict, Verdict::missing_effect);
  ASSERT_FALSE(answer->effects.empty());
  EXPECT_EQ(answer->effects.front().id, "convection");
  EXPECT_GT(answer->effects.front().confidence, 0.95);
  EXPECT_NEAR(answer->effects.front().parameters.at("h_W_m2K"), 12.0, 1.5);
}

TEST(StepwiseSearch, NamesNothingWhereNothingIsMissing) {
  const physics::Machine machine = rod(R"(["convection"])", R"({"convection": {"h_W_m2K": 12}})");
  for (const unsigned seed : {17u, 18u, 19u}) {
    const auto answer = diagnose(machine, {measured(machine, inputs(2.0, on_and_off), seed)});
    ASSERT_TRUE(answer.has_value());
    EXPECT_EQ(answer->verdict, Verdict::consistent) << seed;
    EXPECT_TRUE(answer->effects.empty()) << seed;
    for (const auto& channel : answer->channels) EXPECT_EQ(channel.verdict, ChannelVerdict::consistent);
  }
}

TEST(StepwiseSearch, FindsWhenASensorReadWrong) {
  const physics::Machine described = rod(R"(["convection"])", R"({"convection": {"h_W_m2K": 12}})");
  recording::Recording run = measured(described, inputs(2.0, on_and_off), 23);
  auto& reading = run.find("T2_C")->values;
  for (std::size_t k = 0; k < run.rows(); ++k)
    reading[k] += run.time_s[k] >= 3000.0 && run.time_s[k] < 3600.0 ? -2.0 : 0.0;
  const auto answer = diagnose(described, {run});
  ASSERT_TRUE(answer.has_value());
  ASSERT_FALSE(answer->effects.empty());
  const FoundEffect& found = answer->effects.front();
  EXPECT_EQ(found.id, "sensor_offset");
  EXPECT_EQ(found.channel, "T2_C");
  ASSERT_EQ(found.intervals_s.size(), 1u);
  EXPECT_NEAR(found.intervals_s[0].first, 3000.0, 60.0);
  EXPECT_NEAR(found.intervals_s[0].second, 3600.0, 60.0);
  EXPECT_NEAR(found.parameters.at("offset_K"), -2.0, 0.1);
}

TEST(StepwiseSearch, FindsHeatThatNobodyLogged) {
  const physics::Machine described = rod(R"(["convection"])", R"({"convection": {"h_W_m2K": 12}})");
  // The heater's column is withheld in two of its three stretches.
  recording::Recording truth =
      measured(described, inputs(3.0, {{600.0, 1800.0}, {4200.0, 5400.0}, {7800.0, 9000.0}}), 29);
  recording::Recording logged = truth;
  auto& heater = logged.find("heater_on")->values;
  for (std::size_t k = 0; k < logged.rows(); ++k) heater[k] = logged.time_s[k] < 3000.0 ? heater[k] : 0.0;
  const auto answer = diagnose(described, {logged});
  ASSERT_TRUE(answer.has_value());
  ASSERT_FALSE(answer->effects.empty());
  const FoundEffect& found = answer->effects.front();
  EXPECT_EQ(found.id, "switched_heat");
  ASSERT_EQ(found.intervals_s.size(), 2u);
  EXPECT_NEAR(found.intervals_s[0].first, 4200.0, 60.0);
  EXPECT_NEAR(found.intervals_s[1].second, 9000.0, 60.0);
  EXPECT_NEAR(found.parameters.at("power_W"), 8.0, 1.0);
}

TEST(StepwiseSearch, NamesAFilmThatALoggedInputDrives) {
  const physics::Machine described = rod(R"(["convection"])", R"({"convection": {"h_W_m2K": 12}})");
  const physics::Machine truth = rod(
      R"(["convection", "film_driver"])",
      R"({"convection": {"h_W_m2K": 12}, "film_driver": {"component": "rod", "driver": "fan_percent", "h_W_m2K": 30, "full": 100}})");
  recording::Recording run = inputs(2.5, {{600.0, 8000.0}});
  recording::Channel fan{"fan_percent", {}}, rows{"row_counter", {}};
  for (std::size_t k = 0; k < run.rows(); ++k) {
    const double t = run.time_s[k];
    fan.values.push_back((t > 3000.0 && t < 4500.0) || t > 6500.0 ? 80.0 : 0.0);
    rows.values.push_back(static_cast<double>(k));
  }
  run.channels.push_back(fan);
  run.channels.push_back(rows);
  const auto answer = diagnose(described, {measured(truth, run, 37)}, {false});
  ASSERT_TRUE(answer.has_value());
  ASSERT_EQ(answer->effects.size(), 1u);
  EXPECT_EQ(answer->effects.front().id, "film_driver");
  EXPECT_EQ(answer->effects.front().words.at("driver"), "fan_percent");
}

TEST(FittedDescription, SimulatesToWhatWasReported) {
  const physics::Machine truth = rod(R"(["convection"])", R"({"convection": {"h_W_m2K": 12}})");
  const recording::Recording run = measured(truth, inputs(2.0, on_and_off), 31);
  const auto answer = diagnose(rod("[]", "{}"), {run});
  ASSERT_TRUE(answer.has_value());
  const auto read = physics::machine_from_json(physics::to_json(answer->refined), "refined.json");
  ASSERT_TRUE(read.has_value());
  const auto simulated = physics::simulate(*read, run);
  ASSERT_TRUE(simulated.has_value());
  for (const auto& one : physics::compare(simulated->prediction, run)) {
    for (const auto& channel : answer->channels) {
      if (channel.channel != one.channel) continue;
      EXPECT_NEAR(one.rms, channel.rms_explained, 1e-3) << one.channel;
    }
  }
}

}  // namespace zerodrift::diagnosis
