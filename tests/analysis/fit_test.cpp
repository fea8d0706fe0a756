#include "core/analysis/fit.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/analysis/figures.h"
#include "core/analysis/predict.h"
#include "tests/analysis/support.h"

namespace zerodrift::analysis {
namespace {

using test::machine_run;
using test::MachineCase;
using test::missing;

/// One warm-up at 3000 rpm, four hours; the camera looks every two minutes.
MachineCase warm_up() {
  MachineCase c;
  c.error_period_s = 120.0;
  return c;
}

/// Another day at other speeds, noise-free errors to judge by.
MachineCase other_day() {
  MachineCase c;
  c.speeds_rpm = {1500.0, 4000.0, 0.0, 2500.0};
  c.step_s = 3600.0;
  c.error_noise_um = 0.0;
  c.start_C = 21.5;
  c.seed = 7;
  return c;
}

}  // namespace

TEST(Fit, StaticModelOfFiveSensorsHoldsOnAnotherDay) {
  FitOptions options;
  options.sensors = {"T1_C", "T5_C", "T9_C", "T13_C", "T17_C"};
  options.method = Method::ridge;
  const auto model = fit({machine_run(warm_up())}, options);
  ASSERT_TRUE(model) << describe(model.error());
  const auto prediction = predict(*model, machine_run(other_day()));
  ASSERT_TRUE(prediction) << describe(prediction.error());
  EXPECT_EQ(prediction->zero, Zero::start);
  for (const auto& e : prediction->errors) EXPECT_GT(e.residual.removed_percent, 90.0) << e.error;
}

TEST(Fit, TableTermsSayTheSameAsTheStaticModel) {
  FitOptions options;
  options.sensors = {"T1_C", "T5_C", "T9_C", "T13_C", "T17_C"};
  options.method = Method::mlr;
  const auto r = machine_run(warm_up());
  const auto model = fit({r}, options);
  ASSERT_TRUE(model) << describe(model.error());
  const auto prediction = predict(*model, r);
  ASSERT_TRUE(prediction);
  EXPECT_EQ(prediction->zero, Zero::training);
  const TableTerms* table = model->table_terms("dZ_um");
  ASSERT_NE(table, nullptr);
  double sum = table->offset_um;
  for (const auto& t : table->terms) sum += t.um_per_K * (r.find(t.sensor)->values[900] - t.reference_C);
  EXPECT_NEAR(prediction->errors[2].value_um[900], sum, 1e-9);
}

TEST(Fit, AutomaticChoiceIsExplainedAndSurvivesItsFile) {
  const auto model = fit({machine_run(warm_up())});
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_FALSE(model->reason.empty());
  EXPECT_GE(model->candidates.size(), 3U);
  const auto again = model_from_json(to_json(*model), "model.json");
  ASSERT_TRUE(again) << describe(again.error());
  const auto r = machine_run(other_day());
  const auto a = predict(*model, r);
  const auto b = predict(*again, r);
  ASSERT_TRUE(a && b);
  for (std::size_t e = 0; e < 3; ++e) {
    for (std::size_t i = 0; i < a->time_s.size(); i += 97) {
      EXPECT_NEAR(a->errors[e].value_um[i], b->errors[e].value_um[i], 1e-9);
      EXPECT_NEAR(a->errors[e].half_width_um[i], b->errors[e].half_width_um[i], 1e-3);
    }
  }
}

TEST(Fit, BandCoversAnotherDayAtTheSameSpeed) {
  const auto model = fit({machine_run(warm_up())});
  ASSERT_TRUE(model);
  MachineCase again = other_day();
  again.speeds_rpm = {3000.0};
  again.step_s = 4 * 3600.0;
  const auto prediction = predict(*model, machine_run(again));
  ASSERT_TRUE(prediction);
  for (const auto& e : prediction->errors) EXPECT_GT(e.coverage, 0.85) << e.error;
}

TEST(Fit, FasterThanTrainedRaisesTheAlarm) {
  FitOptions options;
  options.method = Method::dynamic;
  const auto model = fit({machine_run(warm_up())}, options);
  ASSERT_TRUE(model) << describe(model.error());
  MachineCase fast = other_day();
  fast.speeds_rpm = {6000.0};
  const auto prediction = predict(*model, machine_run(fast));
  ASSERT_TRUE(prediction);
  EXPECT_GT(prediction->extrapolation_share, 0.9);
  MachineCase slow = warm_up();
  slow.seed = 12;
  const auto inside = predict(*model, machine_run(slow));
  ASSERT_TRUE(inside);
  EXPECT_LT(inside->extrapolation_share, 0.05);
}

TEST(Fit, RecordingThatGoesOnFromTheTrainingContinuesIt) {
  MachineCase c = other_day();
  c.step_s = 4 * 3600.0;
  const auto whole = machine_run(c);
  FitOptions options;
  options.method = Method::dynamic;
  const auto model = fit({recording::slice_time(whole, 0.0, 43200.0)}, options);
  ASSERT_TRUE(model) << describe(model.error());
  const auto rest = predict(*model, recording::slice_time(whole, 43200.0, 1e9));
  const auto all = predict(*model, whole);
  ASSERT_TRUE(rest && all);
  EXPECT_TRUE(rest->continued);
  for (std::size_t e = 0; e < 3; ++e) {
    EXPECT_NEAR(rest->errors[e].value_um.back(), all->errors[e].value_um.back(), 0.3);
    EXPECT_LT(rest->errors[e].residual.rms_um, 2.0);
  }
}

TEST(Fit, SplittingARecordingChangesNothing) {
  MachineCase c = other_day();
  const auto whole = machine_run(c);
  FitOptions options;
  options.method = Method::ridge;
  options.sensors = {"T1_C", "T9_C"};
  const auto one = fit({whole}, options);
  const auto two = fit({recording::slice_time(whole, 0.0, 7200.0), recording::slice_time(whole, 7200.0, 1e9)}, options);
  ASSERT_TRUE(one && two);
  EXPECT_NEAR(one->table[2].terms[0].um_per_K, two->table[2].terms[0].um_per_K, 1e-12);
}

TEST(Fit, RefusesWhatCannotBeFitted) {
  auto r = machine_run(warm_up());
  FitOptions options;
  options.method = Method::physics;
  EXPECT_EQ(fit({r}, options).error().code, ErrorCode::bad_argument);
  options.method = Method::mlr;
  for (std::size_t i = 60; i < r.rows(); ++i) {
    for (const char* e : {"dX_um", "dY_um", "dZ_um"}) r.find(e)->values[i] = missing;
  }
  EXPECT_EQ(fit({r}, options).error().code, ErrorCode::not_enough_data);
  options.sensors = {"T99_C"};
  EXPECT_EQ(fit({r}, options).error().code, ErrorCode::channel_missing);
}

TEST(Fit, AChannelThatOneRecordingLacksIsTold) {
  const auto first = machine_run(warm_up());
  auto second = machine_run(other_day());
  std::erase_if(second.channels, [](const auto& channel) { return channel.name == "T3_C" || channel.name == "dY_um"; });
  second.name = "second.csv";
  FitOptions options;
  options.method = Method::mlr;
  for (const auto& recordings : {std::vector{first, second}, std::vector{second, first}}) {
    const auto model = fit(recordings, options);
    ASSERT_TRUE(model) << describe(model.error());
    for (const char* channel : {"T3_C", "dY_um"}) {
      EXPECT_EQ(std::count_if(model->findings.begin(), model->findings.end(),
                              [&](const Finding& f) {
                                return f.kind == FindingKind::not_in_every_run && f.channel == channel &&
                                       f.detail == "second.csv";
                              }),
                1)
          << channel;
    }
  }
}

TEST(Fit, NoNumberIsEverMissingInTheFile) {
  auto r = machine_run(warm_up());
  for (std::size_t i = 300; i < 400; ++i) r.find("T4_C")->values[i] = missing;
  r.find("T6_C")->values = r.find("T5_C")->values;
  r.find("T20_C")->values.assign(r.rows(), 20.0);
  for (const Method m : {Method::mlr, Method::ridge, Method::dynamic}) {
    FitOptions options;
    options.method = m;
    const auto model = fit({r}, options);
    ASSERT_TRUE(model) << describe(model.error());
    EXPECT_EQ(to_json(*model).dump().find("null"), std::string::npos);
  }
}

TEST(Fit, FiguresForThePages) {
  const std::vector<recording::Recording> runs{machine_run(other_day())};
  FitOptions options;
  options.sensors = {"T1_C", "T5_C", "T9_C"};
  options.method = Method::ridge;
  const auto model = fit(runs, options);
  ASSERT_TRUE(model);
  const auto figures = fit_figures(*model, runs);
  ASSERT_TRUE(figures) << describe(figures.error());
  ASSERT_EQ(figures->size(), 3U);
  const FitFigure& f = (*figures)[2];
  EXPECT_EQ(f.measured_um.size(), f.left_out_um.size());
  int counted = 0;
  for (const int c : f.histogram.counts) counted += c;
  EXPECT_EQ(counted, static_cast<int>(f.residual_um.size()));
  const auto matrix = correlation_matrix(runs.front());
  ASSERT_TRUE(matrix);
  EXPECT_EQ(matrix->names.size(), 23U);
  EXPECT_DOUBLE_EQ(matrix->r[3][22], matrix->r[22][3]);
}

TEST(LivePredictor, SaysTheSameAsPredictionOfTheWhole) {
  const auto r = machine_run(warm_up());
  FitOptions options;
  options.method = Method::dynamic;
  const auto model = fit({r}, options);
  ASSERT_TRUE(model);
  const auto whole = predict(*model, r, Zero::training);
  ASSERT_TRUE(whole);
  LivePredictor live(*model);
  for (std::size_t i = 0; i < r.rows(); ++i) {
    std::map<std::string, double> channels;
    for (const auto& c : r.channels) channels[c.name] = c.values[i];
    const auto sample = live.update(r.time_s[i], channels);
    ASSERT_TRUE(sample) << describe(sample.error());
    if (i % 200 == 0) {
      EXPECT_NEAR(sample->errors[2].predicted_um, whole->errors[2].value_um[i], 1e-9);
    }
  }
}

TEST(LivePredictor, HoldsAMissingSensorBrieflyThenRefuses) {
  const auto r = machine_run(warm_up());
  FitOptions options;
  options.sensors = {"T1_C", "T9_C"};
  options.method = Method::ridge;
  const auto model = fit({r}, options);
  ASSERT_TRUE(model);
  LivePredictor live(*model);
  ASSERT_TRUE(live.update(0.0, {{"T1_C", 21.0}, {"T9_C", 20.5}}));
  EXPECT_TRUE(live.update(20.0, {{"T1_C", 21.0}, {"T9_C", missing}}));
  const auto late = live.update(40.0, {{"T1_C", 21.0}, {"T9_C", missing}});
  ASSERT_FALSE(late);
  EXPECT_EQ(late.error().code, ErrorCode::sensor_dead);
}

TEST(Fit, OneCycleAveragesFitsOnTheNearestSensorsAndTheStructuralOne) {
  const auto run = machine_run({});
  const auto model = fit({run});
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_EQ(model->averaged, (std::vector<std::size_t>{2, 3, 4, 5, 6, 8}));
  EXPECT_GT(model->sensors.size(), 8U);
  for (const auto& e : model->errors) EXPECT_LT(e.fit.rms_um, 1.0) << e.error;
  FitOptions by_hand;
  by_hand.sensors = {"T1_C", "T5_C", "T9_C", "T13_C", "T17_C", "T2_C", "T3_C", "T4_C", "T6_C", "T7_C"};
  const auto ten = fit({run}, by_hand);
  ASSERT_TRUE(ten) << describe(ten.error());
  EXPECT_EQ(ten->sensors.size(), 10U);
  for (const auto& term : ten->table.back().terms) EXPECT_NE(term.um_per_K, 0.0) << term.sensor;  // all have their say
  const auto again = model_from_json(to_json(*ten), "test");
  ASSERT_TRUE(again) << describe(again.error());
  EXPECT_EQ(again->averaged, ten->averaged);
}

/// One cycle: the band knows that bodies may warm in other proportions, however well this run was followed.
TEST(Fit, TheBandOfOneCycleGrowsWhereTheRunLeftThingsOpen) {
  const auto run = machine_run({});
  const auto model = fit({run});
  ASSERT_TRUE(model);
  const ErrorModel& error = model->errors.back();
  EXPECT_TRUE(error.band.by_prior());
  EXPECT_DOUBLE_EQ(error.band.stated_coverage, 0.9);
  Eigen::RowVectorXd as_trained(static_cast<Eigen::Index>(model->sensors.size()));
  for (std::size_t s = 0; s < model->sensors.size(); ++s) {
    as_trained(static_cast<Eigen::Index>(s)) = model->end_C[s] - model->start_C[s];
  }
  Eigen::RowVectorXd other = as_trained;
  for (Eigen::Index s = 0; s < other.size(); s += 2) other(s) *= 1.5;
  const Eigen::RowVectorXd zero = Eigen::RowVectorXd::Zero(other.size());
  const double rest_um = model->half_width_um(error, zero, &zero)(0);
  const double trained_um = model->half_width_um(error, as_trained, &zero)(0);
  EXPECT_LT(rest_um, trained_um);
  EXPECT_GT(model->half_width_um(error, other, &zero)(0), 2.0 * trained_um);
}

/// The simulation comes as inputs; a machine whose simulation is right up to a scale needs little else.
TEST(Fit, PhysicsRunsOnTheSimulatedDisplacements) {
  auto run = machine_run(warm_up());
  EXPECT_EQ(fit({run},
                [] {
                  FitOptions o;
                  o.method = Method::physics;
                  return o;
                }())
                .error()
                .code,
            ErrorCode::bad_argument);
  for (const char* axis : {"dX", "dY", "dZ"}) {
    const auto error = run.find(std::string(axis) + "_um")->values;
    auto& simulated = run.ensure("simulated_" + std::string(axis)).values;
    double last = 0.0;
    for (std::size_t i = 0; i < error.size(); ++i)
      simulated[i] = last = std::isfinite(error[i]) ? 0.7 * error[i] : last;
  }
  FitOptions options;
  options.method = Method::physics;
  const auto model = fit({run}, options);
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_EQ(model->method, Method::physics);
  const auto p = predict(*model, run);
  ASSERT_TRUE(p) << describe(p.error());
  for (const auto& e : p->errors) EXPECT_GT(e.residual.removed_percent, 90.0) << e.error;
}

}  // namespace zerodrift::analysis
