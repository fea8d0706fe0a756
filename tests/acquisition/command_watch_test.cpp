// What a run commands and what the machine does are compared: two programs on one controller must not both record
// "good".
#include <gtest/gtest.h>

#include "core/acquisition/recorder.h"
#include "fake_machine.h"
#include "memory_sink.h"

namespace zerodrift::acquisition {
namespace {

class CommandWatch : public testing::Test {
 protected:
  CommandWatch() {
    plan.name = "test";
    plan.sample_period_s = 10.0;
    plan.measure_period_s = 120.0;
    plan.measure_position_mm = {{"X", 0.0}, {"Y", 0.0}, {"Z", 0.0}};
    plan.steps = {{1200.0, 3000.0, true, true}};
  }

  void run() {
    Recorder recorder(machine, errors, clock, sink, options);
    ASSERT_TRUE(recorder.run(plan, {}));
  }

  ManualClock clock;
  FakeMachine machine{clock};
  FakeErrors errors{clock};
  MemorySink sink;
  Plan plan;
  RecorderOptions options;
};

TEST_F(CommandWatch, AnotherSpeedThanCommandedIsNamedWhileItLasts) {
  machine.change = [&](MachineSample& sample) {
    if (machine.now_s() > 300.0 && machine.now_s() < 600.0) sample.spindle_rpm = 6000.0;
  };
  run();
  EXPECT_EQ(sink.count("problem"), 1);
  EXPECT_EQ(sink.count("cleared"), 1);
}

TEST_F(CommandWatch, ASpindleThatRunsUpIsNone) {
  machine.change = [&](MachineSample& sample) {
    if (sample.spindle_rpm > 0.0) sample.spindle_rpm = std::min(3000.0, 100.0 * machine.now_s());
  };
  run();
  EXPECT_EQ(sink.count("problem"), 0);
}

}  // namespace
}  // namespace zerodrift::acquisition
