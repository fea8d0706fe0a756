// Every operation on a controller over a cable that spoils one byte of it, byte after byte: a named outcome, never a
// hang, and the next operation works.

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <set>

#include "bad_cable.h"
#include "core/controller/modbus_machine.h"
#include "core/controller/register_view.h"
#include "core/controller/table_words.h"
#include "core/controller/upload.h"
#include "fake_controller.h"
#include "tests/support/amount.h"

namespace zerodrift::controller {
namespace {

using Operation = std::function<Status(ModbusMachine&)>;
using Fault = BadCable::Fault;

struct Named {
  const char* name;
  Operation run;
};

template <class T>
Status status_of(const Result<T>& result) {
  return result.map([](const auto&) {});
}

std::vector<Named> operations() {
  return {
      {"identify", [](ModbusMachine& m) { return status_of(m.identify()); }},
      {"read a sample", [](ModbusMachine& m) { return status_of(m.read()); }},
      {"command", [](ModbusMachine& m) { return m.command(1500.0, true, false); }},
      {"move",
       [](ModbusMachine& m) {
         return m.move_to({{"X", 10.0}, {"Z", -2.0}});
       }},
      {"switch", [](ModbusMachine& m) { return m.switch_compensation(false); }},
      {"host offset",
       [](ModbusMachine& m) -> Status {
         ZD_CHECK(m.switch_compensation(true));
         const Status written = m.write_host_offset({1.0, -2.0, 3.0});
         ZD_CHECK(m.switch_compensation(false));
         return written;
       }},
      {"read the active table", [](ModbusMachine& m) { return status_of(read_active(m)); }},
      {"list the registers",
       [](ModbusMachine& m) -> Status {
         for (const auto& value : read_all(m.link(), m.map())) {
           if (!value.result) return fail(value.result.error());
         }
         return {};
       }},
  };
}

/// What a fault of the cable may be called. A byte turned over in a value of ours or of the device is not seen by
/// Modbus TCP itself: there the device may refuse, or what it says may not fit.
const std::set<ErrorCode> names = {
    ErrorCode::machine_silent,    ErrorCode::machine_link_lost,   ErrorCode::machine_bad_reply,
    ErrorCode::machine_busy,      ErrorCode::machine_exception,   ErrorCode::machine_unreachable,
    ErrorCode::machine_gateway,   ErrorCode::machine_failed,      ErrorCode::machine_function_missing,
    ErrorCode::machine_not_ready, ErrorCode::machine_unsupported, ErrorCode::interlock_compensation_off,
    ErrorCode::data_does_not_fit, ErrorCode::limit_exceeded};

}  // namespace

class BadCableOperation : public testing::TestWithParam<Fault> {};

TEST_P(BadCableOperation, IsNamedAndEndsInTime) {
  const bool harmless = GetParam() == Fault::cut || GetParam() == Fault::delay || GetParam() == Fault::stall ||
                        GetParam() == Fault::split;
  const long stride = amount(19, 1);
  int tried = 0;
  int failed = 0;
  double longest_s = 0.0;
  for (const Named& operation : operations()) {
    FakeController device;
    Profile profile = device.profile();
    BadCable cable(profile.controller.port);
    profile.controller.port = cable.port();
    profile.controller.timeout_ms = 80;
    cable.set_delay(std::chrono::milliseconds(120));
    auto opened = ModbusMachine::open(profile, engineer());
    ASSERT_TRUE(opened);
    ModbusMachine& machine = **opened;
    ASSERT_TRUE(operation.run(machine)) << operation.name;
    cable.strike(GetParam(), -1);
    ASSERT_TRUE(operation.run(machine)) << operation.name;
    const long all = cable.passed();
    for (long n = 0; n < all; n += stride, ++tried) {
      device.reset_state();
      cable.strike(GetParam(), n);
      const auto start = std::chrono::steady_clock::now();
      const Status done = operation.run(machine);
      const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
      longest_s = std::max(longest_s, took.count());
      if (judges_durations()) {
        ASSERT_LT(took.count(), 10.0) << operation.name << ", byte " << n;
      }
      ASSERT_TRUE(cable.struck()) << operation.name << ", byte " << n;
      failed += done ? 0 : 1;
      if (!done) {
        ASSERT_TRUE(names.count(done.error().code) == 1)
            << operation.name << ", byte " << n << ": " << describe(done.error());
      }
      if (harmless) {
        ASSERT_TRUE(done) << operation.name << ", byte " << n << ": " << describe(done.error());
      }
      device.reset_state();
      cable.strike(GetParam(), -1);
      const Status after = operation.run(machine);
      ASSERT_TRUE(after) << operation.name << " after the fault at byte " << n << ": " << describe(after.error());
    }
  }
  std::printf("%d faults, %d refused by name, the rest overcome; the longest operation took %.2f s\n", tried, failed,
              longest_s);
}

/// A machine behind a cable, with what it has been asked once.
struct Wired {
  Wired() : cable(device.profile().controller.port) {
    Profile profile = device.profile();
    profile.controller.port = cable.port();
    profile.controller.timeout_ms = 80;
    machine = std::move(*ModbusMachine::open(profile, engineer()));
  }
  long bytes_of_a_sample() {
    cable.strike(Fault::cut, -1);
    EXPECT_TRUE(machine->read());
    return cable.passed();
  }
  FakeController device;
  BadCable cable;
  std::unique_ptr<ModbusMachine> machine;
};

// A doubled byte shifts the value of a write: the echo tells, and it is written again before anybody relies on it.
TEST(BadCable, AWriteWhoseEchoDiffersIsWrittenAgain) {
  Wired wired;
  ASSERT_TRUE(wired.machine->switch_compensation(false));
  wired.cable.strike(Fault::duplicate, 9);  // the low byte of the address
  const auto start = std::chrono::steady_clock::now();
  const Status done = wired.machine->switch_compensation(false);
  ASSERT_TRUE(done) << describe(done.error());
  if (judges_durations()) {
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
  }
  EXPECT_TRUE(wired.cable.struck());
  EXPECT_EQ(wired.device.word(76), 0);
  EXPECT_EQ(wired.device.word(17), 0);
}

// Nought may be the echo of a register that clears itself; here it is what came over of a command to switch on.
TEST(BadCable, ACommandThatCameOverSpoiltIsGivenAgain) {
  Wired wired;
  ASSERT_TRUE(wired.machine->switch_compensation(false));
  wired.cable.strike(Fault::duplicate, 10);  // the high byte of the value
  const auto start = std::chrono::steady_clock::now();
  const Status done = wired.machine->switch_compensation(true);
  ASSERT_TRUE(done) << describe(done.error());
  if (judges_durations()) {
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
  }
  EXPECT_TRUE(wired.cable.struck());
  EXPECT_EQ(wired.device.word(17), 1);
}

// A spoilt address is refused once; that does not make the device one that refuses gaps for good.
TEST(BadCable, ASpoiltRequestIsNoRefusalOfGaps) {
  Wired wired;
  const long before = wired.bytes_of_a_sample();
  wired.cable.strike(Fault::corrupt, 8);  // the high byte of the address: beyond the device's registers
  ASSERT_TRUE(wired.machine->read());
  EXPECT_TRUE(wired.cable.struck());
  EXPECT_EQ(wired.bytes_of_a_sample(), before);
}

INSTANTIATE_TEST_SUITE_P(Cable, BadCableOperation,
                         testing::Values(Fault::cut, Fault::corrupt, Fault::duplicate, Fault::delay, Fault::stall,
                                         Fault::drop, Fault::reorder, Fault::split));

}  // namespace zerodrift::controller
