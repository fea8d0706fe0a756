// Nothing of a job goes to another machine than its own.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/flow/steps/inputs.h"
#include "tests/commissioning/temporary_folder.h"

namespace zerodrift::flow {

using commissioning::Job;
using commissioning::NewArtefact;
using commissioning::TemporaryFolder;
using nlohmann::json;

namespace {

json tested(std::uint32_t serial) {
  return {{"identity", {{"name", "VMC"}, {"serial", serial}}}};
}

}  // namespace

TEST(SameMachine, TheOneThatWasTestedAndTheOneThatWasMeasured) {
  const TemporaryFolder folder;
  auto job = Job::create(folder / "a.zdj");
  ASSERT_TRUE(job);
  EXPECT_EQ(same_machine(*job, "upload", 17).error().code, ErrorCode::step_blocked);

  ASSERT_TRUE(job->put(NewArtefact::of("machine", tested(17))));
  EXPECT_TRUE(same_machine(*job, "upload", 17));
  const Status other = same_machine(*job, "upload", 18);
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().code, ErrorCode::data_does_not_fit);
  EXPECT_EQ(other.error().context.at("found"), "serial 18 connected");
  EXPECT_EQ(other.error().context.at("expected"), "serial 17");

  // Testing the other machine in this job does not make the run one of the other machine.
  const auto run = job->start_series("warmup", {"T1_C"}, R"({"machine_serial": 17})");
  ASSERT_TRUE(run);
  ASSERT_TRUE(job->put(NewArtefact::of("warmup", json{{"series", *run}})));
  ASSERT_TRUE(job->put(NewArtefact::of("machine", tested(18))));
  EXPECT_EQ(same_machine(*job, "upload", 18).error().context.at("expected"), "serial 17");
}

TEST(SameMachine, AnImportedRunNamesNone) {
  const TemporaryFolder folder;
  auto job = Job::create(folder / "a.zdj");
  ASSERT_TRUE(job);
  const auto run = job->start_series("warmup", {"T1_C"}, R"({"machine_serial": 0})");
  ASSERT_TRUE(run);
  ASSERT_TRUE(job->put(NewArtefact::of("warmup", json{{"series", *run}})));
  ASSERT_TRUE(job->put(NewArtefact::of("machine", tested(18))));
  EXPECT_TRUE(same_machine(*job, "upload", 18));
}

}  // namespace zerodrift::flow
