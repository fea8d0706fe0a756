// Consent and audit: what nobody has agreed to is not written, and what is written stands in the job's trail.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/access/access.h"
#include "core/commissioning/job.h"
#include "core/flow/commission.h"
#include "core/flow/flow.h"
#include "core/flow/machine_write.h"
#include "core/flow/steps/fit_step.h"
#include "core/flow/steps/sensors_step.h"

namespace zerodrift::flow {
namespace {

using commissioning::Job;
using commissioning::NewArtefact;
using nlohmann::json;

constexpr int recorded_rows = 240;

class ConsentTest : public testing::Test {
 protected:
  ConsentTest() {
    std::string pattern = (std::filesystem::temp_directory_path() / "zerodrift-consent-XXXXXX").string();
    folder = mkdtemp(pattern.data());
    job.emplace(std::move(*Job::create(folder / "a.zdj")));
  }
  ~ConsentTest() override {
    job.reset();
    std::filesystem::remove_all(folder);
  }

  /// A profile of a controller that is not there.
  static json profile_document() {
    json document = {{"format", "zerodrift-profile/1"},
                     {"name", "nobody"},
                     {"controller", {{"kind", "modbus-tcp"}, {"host", "127.0.0.1"}, {"port", 1}, {"timeout_ms", 200}}},
                     {"errors", {{"source", "probes"}}},
                     {"sensors", json::array()}};
    for (int s = 1; s <= 4; ++s) {
      document["sensors"].push_back({{"channel", "T" + std::to_string(s) + "_C"}, {"label", "sensor"}});
    }
    return document;
  }

  /// A warm-up in which Z follows T1 and T2.
  void record() {
    const std::vector<std::string> channels = {"spindle_rpm", "T1_C", "T2_C", "T3_C", "T4_C", "dZ_um"};
    const auto series = job->start_series("warm-up", channels);
    ASSERT_TRUE(series);
    for (int i = 0; i < recorded_rows; ++i) {
      std::vector<double> row = {3000.0};
      for (int s = 0; s < 4; ++s) row.push_back(20.0 + 10.0 * (1.0 - std::exp(-i / (20.0 + 30.0 * s))));
      for (int s = 1; s <= 4; ++s) row[std::size_t(s)] += 0.03 * std::sin(0.9 * i * s);
      row.push_back(2.0 * (row[1] - 20.0) + 1.0 * (row[2] - 20.0));
      ASSERT_TRUE(job->append(*series, 60.0 * i, row));
    }
    ASSERT_TRUE(job->finish_series(*series));
    put("machine",
        {{"profile", profile_document()}, {"identity", {{"name", "nobody"}, {"serial", 7}, {"accepts_table", true}}}});
    put("calibration", {{"source", "probes"}});
    const json plan = {{"name", "p"},
                       {"sample_period_s", 60},
                       {"measure_period_s", 60},
                       {"steps", {{{"duration_s", 60.0 * recorded_rows}, {"spindle_rpm", 3000}}}}};
    put("warmup", {{"series", *series}, {"rows", recorded_rows}, {"plan", plan}});
  }

  void put(const std::string& kind, const json& body) {
    for (const auto& step : standard_steps()) {
      if (step.makes != kind) continue;
      const auto made = Flow().perform(
          *job, step.id, [&](Job&, const TaskContext&) -> Result<NewArtefact> { return NewArtefact::of(kind, body); },
          {});
      ASSERT_TRUE(made) << describe(made.error());
    }
  }

  std::filesystem::path folder;
  std::optional<Job> job;
  access::Access access;  // no PIN: everybody is the engineer
};

const WriteQuestion question{"Writing the table", "VMC-850 #3 (serial 17)"};

TEST_F(ConsentTest, NobodyAgreesByDefault) {
  EXPECT_EQ(Consent().ask(question).error().code, ErrorCode::not_confirmed);
  EXPECT_EQ(Consent().possible("x").error().code, ErrorCode::not_confirmed);
  EXPECT_TRUE(Consent::given().ask(question));
  EXPECT_TRUE(Consent::given().possible("x"));
  bool asked = false;
  const auto no = Consent::by_asking([&](const WriteQuestion& what) {
    asked = what.operation == question.operation;
    return false;
  });
  EXPECT_TRUE(no.possible("x"));
  EXPECT_EQ(no.ask(question).error().code, ErrorCode::not_confirmed);
  EXPECT_TRUE(asked);
}

TEST_F(ConsentTest, EveryWriteStandsInTheTrailBeforeAndAfter) {
  const auto write = MachineWrite::begin(&*job, *access.permit("x"), Consent::given(), question);
  ASSERT_TRUE(write);
  commissioning::AuditEntry entry;
  entry.action = "switch compensation";
  std::size_t before = 0;
  EXPECT_TRUE(write->write(entry, [&]() -> Status {
    before = job->audit_trail()->size();
    return {};
  }));
  EXPECT_EQ(before, 1U);
  EXPECT_FALSE(write->write(entry, [] { return Status(fail(ErrorCode::machine_silent)); }));
  const auto trail = job->audit_trail();
  ASSERT_EQ(trail->size(), 4U);
  EXPECT_EQ((*trail)[0].result, "started");
  EXPECT_EQ((*trail)[0].machine, question.machine);
  EXPECT_EQ((*trail)[1].result, "done");
  EXPECT_EQ((*trail)[3].result, "machine_silent");
}

TEST_F(ConsentTest, WithoutRightOrConsentNothingIsBegun) {
  const auto no_right = MachineWrite::begin(&*job, access::Permit::read_only(), Consent::given(), question);
  EXPECT_EQ(no_right.error().code, ErrorCode::access_locked);
  const auto no_consent = MachineWrite::begin(&*job, *access.permit("x"), Consent(), question);
  EXPECT_EQ(no_consent.error().code, ErrorCode::not_confirmed);
  EXPECT_TRUE(job->audit_trail()->empty());
}

TEST_F(ConsentTest, ACommissioningIsNotBegunWhenItsTableCouldNotBeWritten) {
  const auto document = profile_document();
  const auto profile = controller::profile_from_json(document, "profile.json");
  ASSERT_TRUE(profile) << describe(profile.error());
  CommissionOptions options;
  options.permit = *access.permit("x");
  EXPECT_EQ(commission(*job, *profile, document, options, {}).error().code, ErrorCode::not_confirmed);
  options.permit = access::Permit::read_only();
  options.consent = Consent::given();
  EXPECT_EQ(commission(*job, *profile, document, options, {}).error().code, ErrorCode::access_locked);
  EXPECT_TRUE(job->kinds()->empty());
}

/// What is current is not done again: neither sensors chosen by hand nor the method that was asked for.
TEST_F(ConsentTest, ACommissioningKeepsWhatWasChosenByHand) {
  record();
  SensorsOptions by_hand;
  by_hand.clusters = 3;
  by_hand.chosen = {"T2_C", "T4_C"};
  const Flow flow;
  ASSERT_TRUE(
      flow.perform(*job, "sensors", [&](Job& in, const auto& c) { return choose_sensors(in, by_hand, c); }, {}));
  ASSERT_TRUE(flow.perform(*job, "fit", [&](Job& in, const auto& c) { return fit_model(in, {"mlr"}, c); }, {}));
  const auto sensors = (*job->latest("sensors"))->id;
  const auto model = (*job->latest("model"))->id;
  const auto document = profile_document();
  CommissionOptions options;
  options.plan.measure_position_mm = {{"X", 0.0}, {"Y", 0.0}, {"Z", 0.0}};
  options.permit = *access.permit("x");
  options.consent = Consent::given();
  const auto profile = controller::profile_from_json(document, "profile.json");
  EXPECT_FALSE(commission(*job, *profile, document, options, {}));  // the table goes nowhere
  EXPECT_EQ((*job->latest("sensors"))->id, sensors);
  EXPECT_EQ((*job->latest("model"))->id, model);
  EXPECT_TRUE(*job->latest("physics")) << "what was missing is done";

  // Out of date, both are made again as they were asked for.
  EXPECT_EQ(sensors_asked_for(*job)->chosen, by_hand.chosen);
  EXPECT_EQ(sensors_asked_for(*job)->clusters, 3);
  EXPECT_EQ(fit_asked_for(*job)->method, "mlr");
  by_hand.chosen = {"T1_C", "T4_C"};
  ASSERT_TRUE(
      flow.perform(*job, "sensors", [&](Job& in, const auto& c) { return choose_sensors(in, by_hand, c); }, {}));
  ASSERT_EQ(status_of(*job, "fit").state, StepState::stale);
  EXPECT_FALSE(commission(*job, *profile, document, options, {}));
  EXPECT_EQ(status_of(*job, "fit").state, StepState::current);
  EXPECT_EQ(fit_asked_for(*job)->method, "mlr");
  EXPECT_EQ(sensors_asked_for(*job)->chosen, by_hand.chosen);
}

TEST_F(ConsentTest, WithoutAnEarlierChoiceTheDefaultsAreAskedFor) {
  EXPECT_EQ(sensors_asked_for(*job)->clusters, SensorsOptions().clusters);
  EXPECT_TRUE(sensors_asked_for(*job)->chosen.empty());
  EXPECT_EQ(fit_asked_for(*job)->method, "auto");
}

TEST_F(ConsentTest, WhatComesFromElsewhereNeedsNothingAndNamesItsInputs) {
  const Flow flow;
  const auto run = [](Job&, const TaskContext&) -> Result<NewArtefact> {
    return NewArtefact::of("warmup", json::object());
  };
  EXPECT_EQ(flow.perform(*job, "warmup", run, {}).error().code, ErrorCode::step_blocked);
  const auto made = flow.take_in(*job, "warmup", run, {});
  ASSERT_TRUE(made);
  EXPECT_TRUE(made->inputs.empty());
  EXPECT_EQ(flow.take_in(*job, "nothing", run, {}).error().code, ErrorCode::bad_argument);
}

}  // namespace
}  // namespace zerodrift::flow
