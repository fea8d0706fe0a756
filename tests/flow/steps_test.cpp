// Steps on data made here: what a verification is compared with, and which sensors are proposed.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "core/acquisition/job_sink.h"
#include "core/flow/steps/import_step.h"
#include "core/flow/steps/sensors_step.h"
#include "core/flow/steps/upload_step.h"
#include "core/flow/steps/verify_compare.h"
#include "core/flow/steps/verify_step.h"
#include "core/flow/steps/warmup_step.h"
#include "core/report/limits.h"

namespace zerodrift::flow {
namespace {

using commissioning::Job;
using commissioning::NewArtefact;
using nlohmann::json;

constexpr int rows = 240;

double warming(double time_s, double end, double tau_s) {
  return end * (1.0 - std::exp(-time_s / tau_s));
}

/// Four hours at two speeds, six sensors of different bodies; Z follows the first and the fourth.
recording::Recording warm_up() {
  recording::Recording run;
  run.name = "made here";
  auto& speed = run.ensure("spindle_rpm");
  for (int i = 0; i < rows; ++i) run.time_s.push_back(60.0 * i);
  speed.values.assign(rows, 3000.0);
  for (int i = rows / 2; i < rows; ++i) speed.values[static_cast<std::size_t>(i)] = 0.0;
  const auto shape = [&](double tau_s, int i) {
    const double t = 60.0 * i;
    const double half = 30.0 * rows;
    return t <= half ? warming(t, 1.0, tau_s) : warming(half, 1.0, tau_s) * std::exp(-(t - half) / tau_s);
  };
  for (int s = 1; s <= 6; ++s) {
    auto& sensor = run.ensure("T" + std::to_string(s) + "_C");
    for (int i = 0; i < rows; ++i) {
      // A reading's own small scatter, the same in every run of the test.
      const double scatter = 0.02 * std::sin(12.9898 * i + 78.233 * s);
      sensor.values[static_cast<std::size_t>(i)] = 20.0 + (2.0 + s) * shape(500.0 * s, i) + scatter;
    }
  }
  auto& z = run.ensure("dZ_um");
  for (int i = 0; i < rows; ++i) {
    z.values[static_cast<std::size_t>(i)] = 20.0 * shape(500.0, i) + 15.0 * shape(2000.0, i);
  }
  return run;
}

/// A proposal holds the limit of the condition number, or it says what a set within the limit does without.
void expect_limit_held_or_told(const json& body) {
  const json& told = body.at("choice").at("condition");
  const double condition = body.at("condition_number").at("chosen");
  if (told.is_null() || told.at("held")) {
    EXPECT_LE(condition, report::limits::condition_number) << told;
  } else {
    EXPECT_GT(condition, report::limits::condition_number);
    EXPECT_TRUE(body.at("choice").at("one_cycle") || told.at("fewer_than_clusters") ||
                told.at("cost_um").get<double>() > report::limits::lost_against_all_um)
        << told;
  }
  EXPECT_TRUE(told.is_null() || !told.at("left").empty());
}

class StepsTest : public testing::Test {
 protected:
  StepsTest() {
    std::string pattern = (std::filesystem::temp_directory_path() / "zerodrift-steps-XXXXXX").string();
    folder = mkdtemp(pattern.data());
    job.emplace(std::move(*Job::create(folder / "a.zdj")));
  }
  ~StepsTest() override {
    job.reset();
    std::filesystem::remove_all(folder);
  }

  /// The run in the job, with these faults named by it.
  void keep_run(const json& happened) {
    auto made = import_warmup(*job, warm_up(), "run.csv");
    ASSERT_TRUE(made) << describe(made.error());
    json body = json::parse(made->body);
    body["happened"] = happened;
    ASSERT_TRUE(job->put(NewArtefact::of("warmup", body, made->inputs)));
  }
  json chosen_with(const SensorsOptions& options) {
    const auto made = choose_sensors(*job, options, {});
    EXPECT_TRUE(made) << describe(made.error());
    const json body = made ? json::parse(made->body) : json();
    if (made && options.chosen.empty()) expect_limit_held_or_told(body);
    return body;
  }
  static bool has(const json& list, const std::string& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
  }

  std::filesystem::path folder;
  std::optional<Job> job;
};

compensation::Table table_of(double um_per_K) {
  compensation::Table table;
  table.axes["Z"].terms = {{"T1_C", um_per_K, 20.0, 0.0}};
  return table;
}

/// Back and forth between two tables does not end: when an earlier run found the opposite, it is said.
TEST_F(StepsTest, RunsThatDisagreeAboutTwoTablesAreTold) {
  const auto table_of = [](double offset_um, int version) {
    compensation::Table table;
    table.version = version;
    table.axes["Z"].offset_um = offset_um;
    return table;
  };
  const auto write = [&](double offset_um, int version, std::uint16_t word) {
    const json body = {{"table", compensation::to_json(table_of(offset_um, version))},
                       {"version", version},
                       {"record", {{"new_words", {1, 2, word}}}}};
    return job->put(NewArtefact::of("upload", body, {}))->id;
  };
  ResidualSamples samples;
  const auto left = [&](double residual_um) {
    compensation::ResidualSample sample;
    sample.residual_um = residual_um;
    samples["Z"].assign(20, sample);
  };
  write(0.0, 1, 10);
  const auto second = write(4.0, 2, 11);
  left(-4.0);  // without the second table's 4 um nothing would be left
  const json first_look = version_before(*job, second, samples, table_of(4.0, 2));
  ASSERT_TRUE(first_look.is_object());
  EXPECT_TRUE(first_look["axes"][0]["worse"]);
  EXPECT_FALSE(first_look["contradicted"]);
  ASSERT_TRUE(job->put(NewArtefact::of("verification", {{"version_before", first_look}}, {})));
  const auto back = write(0.0, 3, 10);  // the first table again
  left(4.0);                            // and now the second one would have been right
  const json second_look = version_before(*job, back, samples, table_of(0.0, 3));
  EXPECT_TRUE(second_look["axes"][0]["worse"]);
  EXPECT_TRUE(second_look["contradicted"]);
}

/// A run that nobody ended is a warm-up as far as it went, without its machine.
TEST_F(StepsTest, AnInterruptedRunIsEndedWithoutItsMachine) {
  EXPECT_EQ(end_interrupted_warmup(*job).error().code, ErrorCode::step_blocked);  // no machine was tested
  const auto machine = job->put(NewArtefact::of("machine", {{"health", json::array()}}, {}));
  ASSERT_TRUE(machine);
  ASSERT_TRUE(job->put(NewArtefact::of("calibration", {{"source", "camera"}}, {machine->id})));
  EXPECT_EQ(end_interrupted_warmup(*job).error().code, ErrorCode::step_blocked);  // nothing was begun
  acquisition::JobSink sink(*job);
  acquisition::RunStart start;
  start.name = "warm-up";
  start.channels = {"T1_C", "dX_um", "dZ_um"};
  start.plan.steps = {{3600.0, 3000.0, false, false}};
  start.plan.sample_period_s = 10.0;
  start.zero_um = std::array<double, 3>{1.0, 2.0, 3.0};
  ASSERT_TRUE(sink.begin(start));
  const double none = std::nan("");
  // Six samples, a measurement of which one direction is missing, which lasts to 80 s, a hole of three periods, a whole
  // measurement.
  for (int i = 0; i < 6; ++i) ASSERT_TRUE(sink.append(10.0 * i, std::array{20.0 + i, none, none}));
  ASSERT_TRUE(sink.append(65.0, std::array{26.0, none, 7.0}));
  ASSERT_TRUE(sink.append(120.0, std::array{27.0, none, none}));
  ASSERT_TRUE(sink.append(150.0, std::array{28.0, -2.0, 9.0}));
  ASSERT_TRUE(sink.event({60.0, "problem", "sensor_dead", R"({"context": {"sensor": "T1_C"}})"}));
  ASSERT_TRUE(sink.flush());
  const auto made = end_interrupted_warmup(*job);
  ASSERT_TRUE(made) << describe(made.error());
  const json body = json::parse(made->body);
  EXPECT_EQ(body["rows"], 9);
  EXPECT_EQ(body["measurements"], 2);
  EXPECT_EQ(body["refused"], 1);
  EXPECT_EQ(body["lost_samples"], 3);
  EXPECT_EQ(body["duration_s"], 150.0);
  EXPECT_EQ(body["peak_um"]["Z"], 9.0);
  EXPECT_EQ(body["zero_um"], json::array({1.0, 2.0, 3.0}));
  ASSERT_EQ(body["happened"].size(), 1u);
  EXPECT_EQ(body["source"], "camera");
  EXPECT_FALSE(*acquisition::interrupted_run(*job, "warm-up"));
  EXPECT_EQ(end_interrupted_warmup(*job).error().code, ErrorCode::step_blocked);  // it was ended
}

/// What was measured with one table is not gone on with under another.
TEST_F(StepsTest, AnInterruptedVerificationIsGoneOnWithUntilATableIsWritten) {
  ASSERT_TRUE(job->put(NewArtefact::of("upload", {{"version", 1}}, {})));
  EXPECT_FALSE(*interrupted_verification(*job));
  acquisition::JobSink sink(*job);
  acquisition::RunStart start;
  start.name = "verification";
  start.channels = {"T1_C", "dZ_um"};
  start.plan.steps = {{3600.0, 3000.0, false, false}};
  ASSERT_TRUE(sink.begin(start));
  ASSERT_TRUE(sink.append(0.0, std::array{20.0, 1.5}));
  ASSERT_TRUE(sink.append(60.0, std::array{21.0, 2.5}));
  ASSERT_TRUE(sink.flush());
  const auto found = interrupted_verification(*job);
  ASSERT_TRUE(found && *found);
  EXPECT_EQ((*found)->series, sink.series());
  EXPECT_EQ((*found)->summary.rows, 2);
  EXPECT_FALSE(*interrupted_warmup(*job));
  std::this_thread::sleep_for(std::chrono::milliseconds(5));  // times are kept to the millisecond
  ASSERT_TRUE(job->put(NewArtefact::of("upload", {{"version", 2}}, {})));
  EXPECT_FALSE(*interrupted_verification(*job));
}

}  // namespace

/// Three cycles tell that sensors beside others bring nothing: they are not proposed, and it is told what that costs.
TEST_F(StepsTest, WhereTheCurveIsFlatFewerSensorsAreProposed) {
  constexpr int cycles = 3;
  const recording::Recording once = warm_up();
  recording::Recording run = once;
  for (auto& channel : run.channels) {
    for (int c = 1; c < cycles; ++c)
      channel.values.insert(channel.values.end(), once.find(channel.name)->values.begin(),
                            once.find(channel.name)->values.end());
  }
  run.time_s.clear();
  for (int i = 0; i < cycles * rows; ++i) run.time_s.push_back(60.0 * i);
  for (int s = 1; s <= 4; ++s) {
    const auto values = run.find("T" + std::to_string(s) + "_C")->values;
    auto& beside = run.ensure("T" + std::to_string(s + 6) + "_C").values;
    beside = values;
    for (std::size_t i = 0; i < beside.size(); ++i) beside[i] += 0.02 * std::sin(45.233 * static_cast<double>(i) + s);
  }
  const auto made = import_warmup(*job, run, "run.csv");
  ASSERT_TRUE(made) << describe(made.error());
  ASSERT_TRUE(job->put(*made));
  SensorsOptions options;
  options.clusters = 3;
  const json body = chosen_with(options);
  const json& choice = body["choice"];
  EXPECT_FALSE(choice["one_cycle"]);
  EXPECT_FALSE(choice["flat"]["left"].empty()) << choice["reason"];
  EXPECT_LE(choice["flat"]["cost_um"].get<double>(), 0.05);
  EXPECT_GE(body["chosen"].size(), 3U);
  for (const auto& set : choice["sets"]) {
    const json& condition = choice["condition"];
    const auto for_condition = condition.is_object() && condition["held"] ? condition["left"].size() : 0;
    const auto size = body["chosen"].size() + choice["flat"]["left"].size() + for_condition;
    EXPECT_TRUE(!set["chosen"] || set["sensors"].size() == size) << set;
  }
  SensorsOptions hand = options;
  hand.chosen = {"T1_C", "T4_C", "T7_C", "T8_C"};
  const json by_hand = chosen_with(hand);
  EXPECT_EQ(by_hand["chosen"].size(), 4U);
  EXPECT_TRUE(by_hand["choice"]["flat"]["left"].empty());
}

/// A real choice among twenty sensors: the condition number of the best set is far beyond the limit.
TEST(SensorsOfTheSample, HoldTheLimitOfTheConditionNumberOrSayWhatItCosts) {
  std::string pattern = (std::filesystem::temp_directory_path() / "zerodrift-sample-XXXXXX").string();
  const std::filesystem::path folder = mkdtemp(pattern.data());
  const auto file = folder / "sample.zdj";
  std::filesystem::copy_file(ZERODRIFT_SOURCE_DIR "/resources/samples/sample.zdj", file);
  std::filesystem::permissions(file, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  {
    const auto job = Job::open(file);
    ASSERT_TRUE(job) << describe(job.error());
    const auto made = choose_sensors(*job, {}, {});
    ASSERT_TRUE(made) << describe(made.error());
    const json body = json::parse(made->body);
    const json& told = body["choice"]["condition"];
    ASSERT_TRUE(told.is_object());
    EXPECT_GT(told["without"].get<double>(), report::limits::condition_number);
    expect_limit_held_or_told(body);
  }
  std::filesystem::remove_all(folder);
}

TEST_F(StepsTest, ASensorThatTheRunNamedIsLeftOutWithTheReason) {
  SensorsOptions options;
  options.clusters = 3;
  keep_run(json::array());
  const json before = chosen_with(options);
  ASSERT_FALSE(before["chosen"].empty());
  EXPECT_TRUE(before["left_out"].empty());
  const std::string best = before["chosen"].at(0);
  keep_run({{{"name", "sensor_stuck"}, {"what", json::array({best})}, {"count", 1}, {"overcome", false}},
            {{"name", "machine_busy"}, {"what", json::array()}, {"count", 3}, {"overcome", true}}});
  const json after = chosen_with(options);
  EXPECT_FALSE(has(after["chosen"], best));
  ASSERT_EQ(after["left_out"].size(), 1U);
  EXPECT_EQ(after["left_out"][0]["channel"], best);
  EXPECT_NE(after["left_out"][0]["reason"].get<std::string>().find("stuck"), std::string::npos);
  // By hand it may be taken all the same; the table still says what the run said of it.
  SensorsOptions hand = options;
  hand.chosen = {best, after["chosen"].at(0)};
  const json taken = chosen_with(hand);
  EXPECT_TRUE(has(taken["chosen"], best));
  EXPECT_TRUE(taken["left_out"].empty());
  for (const auto& row : taken["table"]) {
    EXPECT_EQ(row["note"].get<std::string>().empty(), row["channel"] != best) << row;
  }
}

// Measured = error + applied: less what was applied it is the very same run without compensation.
TEST(VerificationReference, IsTheSameRunWithoutWhatWasApplied) {
  const auto warmup = warm_up();
  recording::Recording after = warmup;
  auto& applied = after.ensure("applied_Z_nm");
  auto* z = after.find("dZ_um");
  for (std::size_t r = 0; r < after.rows(); ++r) {
    applied.values[r] = -1000.0 * (0.9 * warmup.find("dZ_um")->values[r]);
    z->values[r] += 1e-3 * applied.values[r];
  }
  const auto reference = reference_of(after, warmup);
  ASSERT_TRUE(reference.same_run);
  for (std::size_t r = 0; r < after.rows(); ++r) {
    EXPECT_NEAR(reference.without.find("dZ_um")->values[r], warmup.find("dZ_um")->values[r], 1e-9);
  }
  const auto compared = report::compare_runs(reference.without, after);
  ASSERT_EQ(compared.axes.size(), 1U);
  EXPECT_NEAR(compared.axes[0].removed_percent, 90.0, 1e-6);
  // Nothing applied was recorded: the warm-up run stands for it, and that is said.
  EXPECT_FALSE(reference_of(warmup, warmup).same_run);
}

TEST(AgainstBefore, NamesTheAxisThatGotWorse) {
  ResidualSamples samples;
  for (int i = 0; i < 50; ++i) {
    compensation::ResidualSample sample;
    sample.temperatures["T1_C"] = 20.0 + 0.1 * i;
    const double error_um = 2.0 * (sample.temperatures["T1_C"] - 20.0);  // of the machine: 2 um/K
    sample.residual_um = error_um - 1.5 * (sample.temperatures["T1_C"] - 20.0);
    samples["Z"].push_back(sample);
  }
  const auto worse = against_before(samples, table_of(1.5), table_of(2.0));
  ASSERT_EQ(worse.size(), 1U);
  EXPECT_TRUE(worse[0].worse);
  EXPECT_NEAR(worse[0].peak_before_um, 0.0, 1e-9);
  EXPECT_NEAR(worse[0].peak_now_um, 2.45, 1e-9);
  EXPECT_FALSE(against_before(samples, table_of(1.5), table_of(1.0))[0].worse);
  EXPECT_FALSE(against_before(samples, table_of(1.5), table_of(1.49))[0].worse);  // the same, as far as one can tell
}

// What a job wrote is known from the job, for a computer that has no log of the machine; jobs of any age.
TEST(OutsideRange, NamesTheSensorsThatWentFurthest) {
  compensation::Table table;
  for (const char* sensor : {"T1_C", "T2_C", "T3_C", "T4_C", "T5_C"}) table.valid[sensor] = {20.0, 30.0};
  recording::Recording run;
  run.time_s = {0.0, 60.0, 120.0};
  const double gap = std::nan("");
  run.ensure("T1_C").values = {25.0, 30.4, 30.0};  // within its noise
  run.ensure("T2_C").values = {25.0, 33.0, 34.5};
  run.ensure("T3_C").values = {18.0, gap, 25.0};
  run.ensure("T4_C").values = {25.0, 31.0, 25.0};
  run.ensure("T5_C").values = {25.0, 31.5, gap};
  EXPECT_EQ(furthest_outside(run, table),
            (std::vector<std::string>{"T2_C 34.50 C (valid 20.00 to 30.00)", "T3_C 18.00 C (valid 20.00 to 30.00)",
                                      "T5_C 31.50 C (valid 20.00 to 30.00)"}));
  EXPECT_TRUE(furthest_outside(run, {}).empty());
}

TEST_F(StepsTest, TheTablesAJobWroteAreKnown) {
  const auto body = [](int version, json more) {
    json made = {{"table", compensation::to_json(table_of(1.0))},
                 {"version", version},
                 {"record",
                  {{"serial", 7},
                   {"started", "2026-01-01T00:00:00.000Z"},
                   {"sequence", version},
                   {"new_words", {1, 0, version}}}}};
    made.update(more);
    return made;
  };
  ASSERT_TRUE(job->put(NewArtefact::of("upload", body(1, json::object()))));
  ASSERT_TRUE(job->put(NewArtefact::of("upload", body(2, {{"kind", "correction"}}))));
  ASSERT_TRUE(job->put(NewArtefact::of("upload", body(3, {{"rolled_back", true}}))));  // as older versions said it
  const auto tables = tables_of(*job, 7);
  ASSERT_EQ(tables.size(), 3U);
  EXPECT_EQ(tables[0].origin, controller::TableOrigin::upload);
  EXPECT_EQ(tables[1].origin, controller::TableOrigin::correction);
  EXPECT_EQ(tables[2].origin, controller::TableOrigin::rollback);
  EXPECT_EQ(tables[2].version, 3);
  EXPECT_FALSE(tables[2].time.empty());
  EXPECT_TRUE(tables_of(*job, 8).empty());
}

}  // namespace zerodrift::flow
