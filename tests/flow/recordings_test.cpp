#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/base/resources.h"
#include "core/flow/flow.h"
#include "core/flow/steps/diagnose_step.h"
#include "core/flow/steps/fit_step.h"
#include "core/flow/steps/import_step.h"
#include "core/flow/steps/recordings_step.h"
#include "core/flow/steps/sensors_step.h"

namespace zerodrift::flow {
namespace {

using commissioning::Job;
using nlohmann::json;
using recording::Recording;

/// Two bodies that warm up over hours at a speed and cool after it; Z follows both.
Recording run_at(double strength, int rows = 300) {
  Recording run;
  for (int i = 0; i < rows; ++i) run.time_s.push_back(60.0 * i);
  const auto shape = [&](double tau_s, int i) {
    const double half_s = 30.0 * rows;
    const double t = 60.0 * i;
    const double warm = 1.0 - std::exp(-std::min(t, half_s) / tau_s);
    return strength * warm * (t > half_s ? std::exp(-(t - half_s) / tau_s) : 1.0);
  };
  for (int s = 1; s <= 4; ++s) {
    auto& sensor = run.ensure("T" + std::to_string(s) + "_C");
    for (int i = 0; i < rows; ++i) {
      sensor.values[static_cast<std::size_t>(i)] =
          20.0 + 8.0 * shape(900.0 * s, i) + 0.02 * std::sin(12.9 * i + 78.2 * s);
    }
  }
  auto& z = run.ensure("dZ_um");
  for (int i = 0; i < rows; ++i)
    z.values[static_cast<std::size_t>(i)] = 20.0 * shape(900.0, i) + 15.0 * shape(3600.0, i);
  return run;
}

Recording without(Recording run, const std::string& channel) {
  std::erase_if(run.channels, [&](const auto& one) { return one.name == channel; });
  return run;
}

class RecordingsTest : public testing::Test {
 protected:
  RecordingsTest() {
    std::string pattern = (std::filesystem::temp_directory_path() / "zerodrift-recordings-XXXXXX").string();
    folder = mkdtemp(pattern.data());
    job.emplace(std::move(*Job::create(folder / "a.zdj")));
    EXPECT_TRUE(commissioning::set_kind(*job, commissioning::JobKind::files));
  }
  ~RecordingsTest() override {
    job.reset();
    std::filesystem::remove_all(folder);
  }
  void take_warmup() {
    const auto made = flow.take_in(
        *job, "warmup",
        [](Job& in, const TaskContext&) { return import_warmup(in, run_at(1.0), "first.csv", json::object()); }, {});
    ASSERT_TRUE(made) << describe(made.error());
  }
  Result<commissioning::Artefact> add(const Recording& run, const std::string& file, RecordingRole role) {
    return flow.take_in(*job, "recordings",
                        [&](Job& in, const TaskContext&) { return add_recording(in, run, file, role); }, {});
  }
  json fitted() {
    const auto sensors = flow.perform(
        *job, "sensors", [](Job& in, const TaskContext& context) { return choose_sensors(in, {}, context); }, {});
    EXPECT_TRUE(sensors) << describe(sensors.error());
    const auto model = flow.perform(
        *job, "fit", [](Job& in, const TaskContext& context) { return fit_model(in, {"ridge"}, context); }, {});
    EXPECT_TRUE(model) << describe(model.error());
    return model ? *model->document() : json();
  }

  std::filesystem::path folder;
  std::optional<Job> job;
  Flow flow;
};

TEST_F(RecordingsTest, NeedAWarmUpRunFirst) {
  const auto made = add(run_at(0.5), "second.csv", RecordingRole::training);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::step_blocked);
}

TEST_F(RecordingsTest, ServeTheFitByTheirRole) {
  take_warmup();
  ASSERT_TRUE(add(run_at(0.5), "second.csv", RecordingRole::training));
  ASSERT_TRUE(add(run_at(0.7), "later.csv", RecordingRole::other_day));
  ASSERT_TRUE(add(without(run_at(0.4), "dZ_um"), "night.csv", RecordingRole::cooling));  // heat alone: not fitted
  const auto list = further_recordings(*job);
  ASSERT_TRUE(list);
  ASSERT_EQ(list->size(), 3u);
  EXPECT_EQ((*list)[0].name, "second");
  EXPECT_EQ((*list)[1].role, RecordingRole::other_day);
  EXPECT_EQ((*list)[2].errors, 0);
  EXPECT_EQ((*list)[2].temperatures, 4);
  const json model = fitted();
  EXPECT_EQ(model["fitted_too"], json::array({"second"}));
  ASSERT_EQ(model["tests"].size(), 1u);
  EXPECT_EQ(model["tests"][0]["recording"], "later");
  EXPECT_EQ(model["tests"][0]["errors"][0]["channel"], "dZ_um");
  EXPECT_LT(model["tests"][0]["errors"][0]["rms_um"].get<double>(), 2.0);
  const auto all = further_runs(*job);
  ASSERT_TRUE(all);
  EXPECT_EQ(all->size(), 3u);
  EXPECT_EQ((*all)[2].name, "night");
  EXPECT_EQ(status_of(*job, "fit").state, StepState::current);
}

TEST_F(RecordingsTest, ChangedListMakesTheFitStaleAndComesBack) {
  take_warmup();
  fitted();
  ASSERT_TRUE(add(run_at(0.5), "second.csv", RecordingRole::training));
  EXPECT_EQ(status_of(*job, "fit").state, StepState::stale);
  fitted();
  const auto before = further_recordings(*job);
  ASSERT_TRUE(before);
  ASSERT_TRUE(job->put(with_recordings({})));  // removed
  EXPECT_TRUE(further_recordings(*job)->empty());
  EXPECT_EQ(status_of(*job, "fit").state, StepState::stale);
  ASSERT_TRUE(job->put(with_recordings(*before)));  // undone: the run itself was never lost
  EXPECT_EQ(status_of(*job, "fit").state, StepState::current);
  EXPECT_EQ(training_runs(*job, run_at(1.0))->size(), 2u);
}

// The first further recording is added and taken back: the fit that knew none is what it was.
TEST_F(RecordingsTest, AListThatIsEmptyAgainLeavesTheFitAsItWas) {
  take_warmup();
  fitted();
  ASSERT_TRUE(add(run_at(0.5), "second.csv", RecordingRole::training));
  EXPECT_EQ(status_of(*job, "sensors").state, StepState::stale);
  EXPECT_EQ(status_of(*job, "fit").state, StepState::stale);
  ASSERT_TRUE(job->put(with_recordings({})));
  EXPECT_EQ(status_of(*job, "sensors").state, StepState::current);
  EXPECT_EQ(status_of(*job, "fit").state, StepState::current);
}

TEST_F(RecordingsTest, OfOneFileHaveNamesOfTheirOwn) {
  take_warmup();
  ASSERT_TRUE(add(run_at(0.5), "run.csv", RecordingRole::training));
  ASSERT_TRUE(add(run_at(0.6), "run.csv", RecordingRole::training));
  EXPECT_EQ((*further_recordings(*job))[1].name, "run 2");
}

TEST_F(RecordingsTest, OfAnotherMachineAreRefused) {
  take_warmup();
  Recording foreign = run_at(0.5);
  for (auto& channel : foreign.channels) channel.name = "other_" + channel.name;
  const auto made = add(foreign, "foreign.csv", RecordingRole::training);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::data_does_not_fit);
  EXPECT_EQ(made.error().context.at("what"), "foreign.csv");
}

/// A job of the version before holds no list: it opens, is fitted as before, and takes further recordings.
TEST_F(RecordingsTest, ComeIntoAJobOfAnEarlierVersion) {
  const auto sample = find_resource("samples/sample.zdj");
  ASSERT_TRUE(sample);
  job.reset();
  std::filesystem::copy_file(*sample, folder / "old.zdj");
  std::filesystem::permissions(folder / "old.zdj", std::filesystem::perms::owner_write,
                               std::filesystem::perm_options::add);
  auto opened = Job::open(folder / "old.zdj");
  ASSERT_TRUE(opened) << describe(opened.error());
  job.emplace(std::move(*opened));
  EXPECT_TRUE(further_recordings(*job)->empty());
  EXPECT_EQ(status_of(*job, "fit").state, StepState::current);
  const auto kept = job->latest("warmup");
  ASSERT_TRUE(kept && *kept);
  const auto first = job->read_series((*kept)->document()->at("series").get<commissioning::SeriesId>());
  ASSERT_TRUE(first);
  ASSERT_TRUE(add(*first, "again.csv", RecordingRole::other_day));
  EXPECT_EQ(status_of(*job, "fit").state, StepState::stale);
  EXPECT_EQ(test_runs(*job, *first)->size(), 1u);
}

}  // namespace
}  // namespace zerodrift::flow
