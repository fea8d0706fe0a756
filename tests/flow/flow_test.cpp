#include "core/flow/flow.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "core/commissioning/job.h"
#include "core/flow/commission.h"

namespace zerodrift::flow {
namespace {

using commissioning::Job;
using commissioning::NewArtefact;
using Ids = std::set<std::string>;

class FlowTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "zerodrift-flow-XXXXXX").string();
    folder = mkdtemp(pattern.data());
    auto made = Job::create(folder / "a.zdj");
    ASSERT_TRUE(made);
    job.emplace(std::move(*made));
  }
  void TearDown() override {
    job.reset();
    std::filesystem::remove_all(folder);
  }

  /// Does a step with a result that is told apart by `content`.
  Result<commissioning::Artefact> perform(const std::string& id, int content) {
    const auto run = [&](const Job&, const TaskContext&) -> Result<NewArtefact> {
      return NewArtefact::of(find_step(id)->makes, {{"content", content}});
    };
    return flow.perform(*job, id, run, {});
  }
  void perform_all() {
    for (const StepInfo& step : standard_steps()) {
      if (step.branch) continue;
      ASSERT_TRUE(perform(step.id, 1)) << step.id;
    }
  }
  StepStatus of(const std::string& id) { return status_of(*job, id); }
  Ids in(StepState state) {
    Ids ids;
    const auto status = flow.status(*job);
    for (const StepStatus& one : *status) {
      if (one.state == state) ids.insert(one.step->id);
    }
    return ids;
  }
  std::string next() {
    const auto status = flow.status(*job);
    const StepStatus* step = Flow::next(*status);
    return step == nullptr ? "" : step->step->id;
  }

  std::filesystem::path folder;
  std::optional<Job> job;
  Flow flow;
};

TEST(Steps, StandAfterThoseTheyNeed) {
  Ids made;
  Ids ids;
  for (const StepInfo& step : standard_steps()) {
    for (const auto& kind : step.needs) EXPECT_TRUE(made.contains(kind)) << step.id << " needs " << kind;
    for (const auto& kind : step.uses) EXPECT_TRUE(made.contains(kind)) << step.id << " uses " << kind;
    EXPECT_TRUE(made.insert(step.makes).second);
    EXPECT_TRUE(ids.insert(step.id).second);
    EXPECT_EQ(find_step(step.id), &step);
  }
  EXPECT_EQ(find_step("nothing"), nullptr);
}

TEST_F(FlowTest, ANewJobBeginsWithTheMachine) {
  EXPECT_EQ(in(StepState::ready), (Ids{"machine", "describe", "axis"}));
  EXPECT_EQ(in(StepState::current), Ids{});
  EXPECT_EQ(next(), "machine");
  const auto fit = of("fit");
  EXPECT_EQ(fit.state, StepState::blocked);
  EXPECT_EQ(fit.reason, "warmup");
  ASSERT_EQ(fit.reasons.size(), 2u);
  EXPECT_EQ(fit.reasons[0].cause, Cause::missing);
  EXPECT_EQ(fit.reasons[0].step, "warmup");
  EXPECT_EQ(fit.reasons[1].step, "sensors");
}

TEST_F(FlowTest, GoesOnStepByStep) {
  ASSERT_TRUE(perform("machine", 1));
  ASSERT_TRUE(perform("calibrate", 1));
  EXPECT_EQ(in(StepState::current), (Ids{"machine", "calibrate"}));
  EXPECT_EQ(in(StepState::ready), (Ids{"warmup", "describe", "axis"}));
  EXPECT_EQ(next(), "warmup");
}

TEST_F(FlowTest, AJobFromFilesNeedsNoController) {
  EXPECT_EQ(commissioning::kind_of(*job).value(), commissioning::JobKind::machine);  // as jobs before there were kinds
  ASSERT_TRUE(commissioning::set_kind(*job, commissioning::JobKind::files));
  const Ids unneeded = {"machine", "calibrate", "upload", "verify"};
  EXPECT_EQ(in(StepState::not_needed), unneeded);
  EXPECT_EQ(next(), "warmup");
  EXPECT_EQ(of("report").reason, "warmup");
  for (const char* step : {"warmup", "sensors", "fit", "physics", "report"}) EXPECT_TRUE(perform(step, 1)) << step;
  EXPECT_EQ(next(), "");
  EXPECT_EQ(in(StepState::stale), Ids{});
  ASSERT_TRUE(perform("describe", 1));
  EXPECT_EQ(of("physics").state, StepState::stale);  // it was simulated without it
  ASSERT_TRUE(perform("warmup", 2));
  EXPECT_EQ(of("report").state, StepState::stale);
  EXPECT_EQ(in(StepState::not_needed), unneeded);
  ASSERT_TRUE(commissioning::set_kind(*job, commissioning::JobKind::machine));
  EXPECT_EQ(next(), "machine");
}

TEST_F(FlowTest, ARunWithoutErrorsLeadsToPhysics) {
  const auto keep_run = [&](const std::string& channel) {
    const auto run = [&](Job& in, const TaskContext&) -> Result<NewArtefact> {
      ZD_TRY(const auto series, in.start_series("warm-up", {"T1_C", channel}));
      ZD_CHECK(in.finish_series(series));
      return NewArtefact::of("warmup", {{"series", series}});
    };
    return flow.take_in(*job, "warmup", run, {});
  };
  ASSERT_TRUE(commissioning::set_kind(*job, commissioning::JobKind::files));
  ASSERT_TRUE(keep_run("heater_on"));
  EXPECT_EQ(in(StepState::not_needed), (Ids{"machine", "calibrate", "sensors", "fit", "upload", "verify"}));
  EXPECT_EQ(next(), "physics");
  EXPECT_EQ(of("report").state, StepState::ready);
  ASSERT_TRUE(keep_run("dZ_um"));
  EXPECT_EQ(next(), "sensors");

  ASSERT_TRUE(commissioning::set_kind(*job, commissioning::JobKind::machine));
  ASSERT_TRUE(keep_run("heater_on"));
  EXPECT_EQ(in(StepState::not_needed), (Ids{"sensors", "fit", "upload", "verify"}));
}

TEST_F(FlowTest, IsCompleteWithoutTheBranch) {
  perform_all();
  EXPECT_EQ(next(), "");
  EXPECT_EQ(of("axis").state, StepState::ready);
}

TEST_F(FlowTest, RedoingTheClusteringMakesStaleWhatFollows) {
  perform_all();
  const auto before = of("sensors").artefact;
  ASSERT_TRUE(perform("sensors", 2));
  EXPECT_EQ(in(StepState::stale), (Ids{"fit", "upload", "verify", "report"}));
  const auto fit = of("fit");
  ASSERT_EQ(fit.reasons.size(), 1u);
  EXPECT_EQ(fit.reasons[0].cause, Cause::changed);
  EXPECT_EQ(fit.reasons[0].kind, "sensors");
  EXPECT_EQ(fit.reasons[0].used, before);
  EXPECT_EQ(fit.reasons[0].latest, of("sensors").artefact);
  const auto upload = of("upload");
  ASSERT_EQ(upload.reasons.size(), 1u);
  EXPECT_EQ(upload.reasons[0].cause, Cause::upstream);
  EXPECT_EQ(upload.reasons[0].step, "fit");
  EXPECT_EQ(next(), "fit");

  ASSERT_TRUE(perform("fit", 2));
  EXPECT_EQ(in(StepState::stale), (Ids{"upload", "verify", "report"}));
  EXPECT_EQ(of("upload").reasons[0].cause, Cause::changed);
}

TEST_F(FlowTest, RedoingWithAnEqualResultChangesNothing) {
  perform_all();
  ASSERT_TRUE(perform("sensors", 1));
  EXPECT_EQ(in(StepState::stale), Ids{});
}

TEST_F(FlowTest, LookingAtTheMachineAgainChangesNothing) {
  const auto look = [&](double round_trip_ms) {
    const auto run = [&](const Job&, const TaskContext&) -> Result<NewArtefact> {
      auto made = NewArtefact::of("machine", {{"serial", 7}, {"round_trip_ms", round_trip_ms}});
      made.observed = {"round_trip_ms"};
      return made;
    };
    return flow.perform(*job, "machine", run, {});
  };
  ASSERT_TRUE(look(1.0));
  ASSERT_TRUE(perform("calibrate", 1));
  ASSERT_TRUE(look(2.0));
  EXPECT_EQ(of("calibrate").state, StepState::current);
}

TEST_F(FlowTest, GoingBackToAnEarlierResultMakesItCurrentAgain) {
  perform_all();
  ASSERT_TRUE(perform("sensors", 2));
  ASSERT_TRUE(perform("sensors", 1));
  EXPECT_EQ(in(StepState::stale), Ids{});
}

TEST_F(FlowTest, AnAxisTableThatCameLaterIsToBeTakenIn) {
  perform_all();
  ASSERT_TRUE(perform("axis", 1));
  const auto upload = of("upload");
  EXPECT_EQ(upload.state, StepState::stale);
  EXPECT_EQ(upload.reasons.at(0).cause, Cause::added);
  EXPECT_EQ(upload.reason, "axis_table");
  EXPECT_EQ(of("fit").state, StepState::current);
  ASSERT_TRUE(perform("upload", 2));
  EXPECT_EQ(of("upload").state, StepState::current);
}

TEST_F(FlowTest, AStepMayTakeSeveralOfAKind) {
  ASSERT_TRUE(perform("machine", 1));
  ASSERT_TRUE(perform("calibrate", 1));
  const auto first = perform("warmup", 1);
  const auto second = perform("warmup", 2);
  ASSERT_TRUE(perform("sensors", 1));
  const auto run = [&](const Job&, const TaskContext&) -> Result<NewArtefact> {
    return NewArtefact::of("model", {{"content", 1}}, {first->id, second->id});
  };
  const auto model = flow.perform(*job, "fit", run, {});
  ASSERT_TRUE(model);
  EXPECT_EQ(model->inputs.size(), 3u) << "both runs, and the sensors that were there";
  EXPECT_EQ(of("fit").state, StepState::current);
}

TEST_F(FlowTest, ABlockedStepSaysWhatItNeeds) {
  const auto made = perform("fit", 1);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::step_blocked);
  EXPECT_EQ(made.error().context.at("needs"), "warmup, sensors");
}

TEST_F(FlowTest, AStepThatFailsLeavesNothing) {
  const auto failing = [](const Job&, const TaskContext&) -> Result<NewArtefact> {
    return fail(ErrorCode::machine_silent);
  };
  EXPECT_FALSE(flow.perform(*job, "machine", failing, {}));
  std::stop_source stop;
  stop.request_stop();
  const auto made = [](const Job&, const TaskContext&) -> Result<NewArtefact> {
    return NewArtefact::of("machine", {});
  };
  EXPECT_EQ(flow.perform(*job, "machine", made, {stop.get_token(), {}}).error().code, ErrorCode::cancelled);
  EXPECT_TRUE(job->history("machine")->empty());
}

TEST(Commission, CorrectsOnceAndAgainOnlyWhereTheCorrectedTableFailed) {
  const nlohmann::json model = {{"kind", "upload"}};
  const nlohmann::json corrected = {{"kind", "correction"}};
  const nlohmann::json passed = {{"verdict", "passed"}};
  const nlohmann::json failed = {{"verdict", "failed"}};
  EXPECT_TRUE(correction_due(passed, model)) << "a part error is above its threshold";
  EXPECT_TRUE(correction_due(failed, model));
  EXPECT_FALSE(correction_due(passed, corrected)) << "what is left is the run's own wave";
  EXPECT_TRUE(correction_due(failed, corrected));
}

TEST_F(FlowTest, SurvivesReopening) {
  perform_all();
  ASSERT_TRUE(perform("warmup", 2));
  const Ids stale = in(StepState::stale);
  job.reset();
  auto again = Job::open(folder / "a.zdj");
  ASSERT_TRUE(again);
  job.emplace(std::move(*again));
  EXPECT_EQ(in(StepState::stale), stale);
  EXPECT_EQ(stale, (Ids{"sensors", "fit", "physics", "upload", "verify", "report"}));
}

}  // namespace
}  // namespace zerodrift::flow
