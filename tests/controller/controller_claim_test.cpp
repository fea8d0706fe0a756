// One program at a time may write to a controller.

#include "core/controller/controller_claim.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <memory>

#include "core/controller/modbus_machine.h"
#include "fake_controller.h"

namespace zerodrift::controller {
namespace {

/// Another program, begun before this one has claimed anything. At each word it takes the controller, or gives it back.
class OtherProgram {
 public:
  OtherProgram() {
    EXPECT_EQ(::pipe(m_to), 0);
    EXPECT_EQ(::pipe(m_from), 0);
    m_process = ::fork();
    if (m_process == 0) obey();
  }
  ~OtherProgram() { end(); }
  /// True when it has the controller now.
  bool take(const ControllerSettings& settings) { return ask(static_cast<std::uint16_t>(settings.port)); }
  void give_back() { ask(0); }
  void end() {
    if (m_process <= 0) return;
    ::kill(m_process, SIGKILL);
    ::waitpid(m_process, nullptr, 0);
    m_process = 0;
    for (const int one : {m_to[0], m_to[1], m_from[0], m_from[1]}) ::close(one);
  }
  int process() const { return m_process; }

 private:
  bool ask(std::uint16_t port) {
    char said = 0;
    EXPECT_EQ(::write(m_to[1], &port, sizeof port), static_cast<ssize_t>(sizeof port));
    EXPECT_EQ(::read(m_from[0], &said, 1), 1);
    return said == '1';
  }
  [[noreturn]] void obey() {
    std::unique_ptr<ControllerClaim> held;
    for (;;) {
      std::uint16_t port = 0;
      if (::read(m_to[0], &port, sizeof port) != sizeof port) ::_exit(1);
      held.reset();
      ControllerSettings settings;
      settings.host = "localhost";
      settings.port = port;
      if (port != 0) {
        if (auto claim = ControllerClaim::take(settings)) held = std::move(*claim);
      }
      const char said = held ? '1' : '0';
      if (::write(m_from[1], &said, 1) != 1) ::_exit(1);
    }
  }

  int m_to[2] = {};
  int m_from[2] = {};
  int m_process = 0;
};

}  // namespace

TEST(ControllerClaim, SecondProgramIsRefusedByTheProcessOfTheFirst) {
  OtherProgram other;
  FakeController device;
  const Profile profile = device.profile();  // by its number, the other program by its name
  ASSERT_TRUE(other.take(profile.controller));
  const auto refused = ModbusMachine::open(profile, engineer());
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::machine_not_ready);
  const std::string said = describe(refused.error());
  EXPECT_NE(said.find("process " + std::to_string(other.process())), std::string::npos) << said;
  const auto reader = ModbusMachine::open(profile);
  ASSERT_TRUE(reader) << describe(reader.error());
  EXPECT_TRUE((*reader)->identify()) << "who only reads claims nothing";
  ControllerSettings behind_a_gateway = profile.controller;
  behind_a_gateway.unit = 2;
  EXPECT_TRUE(ControllerClaim::take(behind_a_gateway)) << "another unit is another controller";
  other.end();  // kill -9
  EXPECT_TRUE(ModbusMachine::open(profile, engineer()));
}

TEST(ControllerClaim, OneProgramSharesItAndGivesItBackWithTheLast) {
  OtherProgram other;
  FakeController device;
  const Profile profile = device.profile();
  auto first = ModbusMachine::open(profile, engineer());
  auto second = ModbusMachine::open(profile, engineer());
  ASSERT_TRUE(first);
  ASSERT_TRUE(second) << describe(second.error());
  first->reset();
  EXPECT_FALSE(other.take(profile.controller));
  second->reset();
  EXPECT_TRUE(other.take(profile.controller));
  EXPECT_FALSE(ModbusMachine::open(profile, engineer()));
  other.give_back();
  EXPECT_TRUE(ModbusMachine::open(profile, engineer()));
}

}  // namespace zerodrift::controller
