// A verification proves one table: the one that was active from its first sample to its last.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/controller/upload.h"
#include "core/flow/steps/upload_step.h"
#include "core/flow/steps/verify_step.h"
#include "tests/acquisition/fake_machine.h"
#include "tests/commissioning/temporary_folder.h"
#include "tests/controller/fake_controller.h"
#include "tests/controller/fixtures.h"

namespace zerodrift::flow {

using acquisition::FakeMachine;
using acquisition::MachineSample;
using commissioning::Job;
using commissioning::NewArtefact;
using nlohmann::json;

namespace {

constexpr double quick = 600.0;  // machine seconds a second

/// A machine that moves and measures by itself; its table is in a controller that another program can reach.
class VerificationTest : public testing::Test {
 protected:
  VerificationTest() : m_clock(quick), m_link(controller::open(m_device.profile())) {
    m_job.emplace(std::move(*Job::create(m_folder / "a.zdj")));
    devices.profile = m_device.profile();
    devices.profile.time_factor = quick;
    devices.profile.error_source = controller::ErrorSourceKind::probes;
    devices.profile.measure_position_mm = {{"X", 0.0}, {"Y", 0.0}, {"Z", 0.0}};
    devices.permit = controller::engineer();
    auto machine = std::make_unique<FakeMachine>(m_clock);
    machine->move_s = 0.1;
    machine->change = [this](MachineSample& sample) {
      sample.axes = {{"X", 0.0}, {"Y", 0.0}, {"Z", 0.0}};
      sample.compensation_on = true;
      sample.probes_um = {0.0, 0.0, 0.0, 0.0, 0.0};
      sample.probes_at = host_clock().steady();
      if (while_measuring) while_measuring(sample);
    };
    machine->identity.has_probes = true;
    devices.machine = std::move(machine);
    devices.link = m_link.get();
  }

  /// A job whose table was written and is active.
  void prepare() {
    const json plan = {{"name", "p"},
                       {"sample_period_s", 20},
                       {"measure_period_s", 120},
                       {"steps", {{{"duration_s", 1200}, {"spindle_rpm", 0}}}}};
    const auto series =
        m_job->start_series("warm-up", {"T1_C", "dX_um", "dY_um", "dZ_um"}, R"({"machine_serial": 4711})");
    ASSERT_TRUE(series);
    for (int i = 0; i < 60; ++i) {
      const std::vector<double> row = {20.0 + 0.1 * i, 0.1 * i, 0.0, 0.5 * i};
      ASSERT_TRUE(m_job->append(*series, 20.0 * i, row));
    }
    ASSERT_TRUE(m_job->finish_series(*series));
    const auto record = controller::upload_table(*m_link, controller::sample_table(1.0), {}, {});
    ASSERT_TRUE(record.result) << describe(record.result.error());
    put("machine", {{"identity", {{"name", "Fake"}, {"serial", 4711}}}});
    put("calibration", {{"source", "probes"}});
    put("warmup", {{"series", *series}, {"plan", plan}, {"zero_um", {0.0, 0.0, 0.0}}});
    put("upload", upload_body(record, controller::sample_table(1.0), controller::TableOrigin::upload));
  }

  void put(const std::string& kind, const json& body) {
    const auto made = m_job->put(NewArtefact::of(kind, body));
    ASSERT_TRUE(made) << describe(made.error());
  }

  commissioning::TemporaryFolder m_folder;
  std::optional<Job> m_job;
  SystemClock m_clock;
  controller::FakeController m_device;
  std::unique_ptr<controller::ModbusMachine> m_link;
  Devices devices;
  std::function<void(const MachineSample&)> while_measuring;
};

}  // namespace

TEST_F(VerificationTest, ATableThatStaysActiveIsVerified) {
  ASSERT_NO_FATAL_FAILURE(prepare());
  const auto made = verify(*m_job, devices, {}, {});
  ASSERT_TRUE(made) << describe(made.error());
  EXPECT_EQ(made->kind, "verification");
}

TEST_F(VerificationTest, AnotherTableWrittenMeanwhileEndsItByTheVersion) {
  ASSERT_NO_FATAL_FAILURE(prepare());
  int samples = 0;
  while_measuring = [&](const MachineSample&) {
    if (++samples != 20) return;
    const auto other = controller::upload_table(*m_link, controller::sample_table(2.0), {}, {});
    EXPECT_TRUE(other.result) << controller::text_of(other.result);
  };
  const auto made = verify(*m_job, devices, {}, {});
  EXPECT_GE(samples, 20);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::table_not_active) << describe(made.error());
  EXPECT_EQ(made.error().context.at("version"), "1");
  EXPECT_EQ(made.error().context.at("found"), "version 2");
}

}  // namespace zerodrift::flow
