// The devices beside the control: the profile that names them, the lines that ask them, a serial port that is shared,
// and a control without a link.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <deque>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/controller/device_readings.h"
#include "core/controller/devices/manual_control.h"
#include "core/controller/manual_upload.h"
#include "core/controller/modbus_server.h"
#include "core/controller/serial_line.h"
#include "fake_controller.h"
#include "fixtures.h"

namespace zerodrift::controller {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

/// Eight temperatures in 0.1 C, and how they answer.
struct Module {
  explicit Module(int first_tenth) {
    ModbusServerOptions options;
    options.read = [this, first_tenth](int address, int count) -> RegisterReply {
      if (address + count > 8) return tl::unexpected(ModbusException::illegal_address);
      std::vector<std::uint16_t> words;
      for (int i = 0; i < count; ++i) words.push_back(static_cast<std::uint16_t>(first_tenth + 10 * (address + i)));
      return words;
    };
    options.write = [](int, std::span<const std::uint16_t>) { return ModbusException::illegal_function; };
    options.fault = [this](bool) {
      return ReplyFault{dead ? ReplyFault::Kind::drop : ReplyFault::Kind::none, 0ms, ModbusException::busy};
    };
    server = std::move(*ModbusServer::start(std::move(options)));
  }

  json profile(const std::string& id) const {
    return {{"id", id},
            {"kind", "modbus-tcp"},
            {"host", "127.0.0.1"},
            {"port", server->port()},
            {"timeout_ms", 200},
            {"poll_period_s", 0.02},
            {"stale_after_s", 0.3},
            {"register_map_document",
             {{"format", "zerodrift-register-map/1"},
              {"name", "eight"},
              {"registers", {{"temperature_C", {{"address", 0}, {"type", "int16"}, {"count", 8}, {"scale", 0.1}}}}}}}};
  }

  std::atomic<bool> dead{false};
  std::unique_ptr<ModbusServer> server;
};

json sensor(const std::string& channel, const std::string& device, const std::string& signal) {
  return {{"channel", channel}, {"device", device}, {"signal", signal}};
}

json manual_profile(const json& devices, const json& sensors) {
  json all = devices;
  all.push_back({{"id", "cnc"}, {"kind", "manual"}, {"serial", 7}});
  return {{"format", "zerodrift-profile/1"},
          {"name", "Old mill"},
          {"devices", all},
          {"sensors", sensors},
          {"limits", {{"max_um", 100}, {"max_um_per_s", 1000}}}};
}

std::string refusal(const json& profile) {
  const auto read = profile_from_json(profile, "rig.json");
  return read ? "taken" : describe(read.error());
}

bool within(std::chrono::milliseconds patience, const std::function<bool()>& holds) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!holds()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(5ms);
  }
  return true;
}

/// Does what is asked, and keeps it.
class Person : public Operator {
 public:
  Result<OperatorAnswer> ask(const OperatorRequest& request) override {
    asked.push_back(request);
    if (!refuses.empty()) return fail(ErrorCode::operator_declined, {{"request", "it"}, {"reason", refuses}});
    return OperatorAnswer{compensation_on, check};
  }
  std::vector<std::string> acts() const {
    std::vector<std::string> names;
    for (const auto& one : asked) names.emplace_back(name_of(one.act));
    return names;
  }

  std::vector<OperatorRequest> asked;
  bool compensation_on = false;
  std::string check;
  std::string refuses;
};

std::unique_ptr<ManualControl> control_of(const std::shared_ptr<Person>& person) {
  const auto profile = profile_from_json(manual_profile(json::array(), json::array()), "mill.json");
  return std::move(*ManualControl::open(*profile, person, engineer()));
}

}  // namespace

TEST(RigProfile, SaysWhichDeviceIsWrongly) {
  const Module module(200);
  const json good = module.profile("one");
  EXPECT_EQ(refusal(manual_profile(json::array({good}), json::array({sensor("T1_C", "one", "temperature_C[1]")}))),
            "taken");
  const auto holds = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  holds(refusal(manual_profile(json::array({good}), json::array({sensor("T1_C", "two", "temperature_C[1]")}))),
        "sensors[0].device");
  holds(refusal(manual_profile(json::array({good, good}), json::array())), "no other device");
  json twin = good;
  twin["id"] = "twin";
  holds(refusal(manual_profile(json::array({good, twin}), json::array())), "twin at 127.0.0.1");
  const json both = json::array({sensor("T1_C", "one", "temperature_C[1]"), sensor("T2_C", "one", "temperature_C[1]")});
  holds(refusal(manual_profile(json::array({good}), both)), "T1_C already");
  holds(refusal(manual_profile(json::array({good}), json::array({{{"channel", "T1_C"}}}))), "sensors[0].device");
  json two_controls = manual_profile(json::array({good}), json::array());
  two_controls["controller"] = {{"kind", "modbus-tcp"}, {"host", "127.0.0.1"}};
  holds(refusal(two_controls), "one control only");
  json none = two_controls;
  none.erase("controller");
  none["devices"] = json::array({good});
  holds(refusal(none), "controller");
}

TEST(DeviceReadings, ADeadDeviceDelaysNoOther) {
  const Module warm(300);
  Module dead(400);
  const auto profile = profile_from_json(
      manual_profile({warm.profile("warm"), dead.profile("dead")},
                     {sensor("T1_C", "warm", "temperature_C[1]"), sensor("T2_C", "dead", "temperature_C[3]")}),
      "rig.json");
  ASSERT_TRUE(profile) << describe(profile.error());
  const auto readings = DeviceReadings::open(*profile);
  ASSERT_TRUE(readings) << describe(readings.error());
  (*readings)->wait_for_first();
  const auto sample = [&] {
    acquisition::MachineSample out;
    (*readings)->put_into(out);
    return out;
  };
  EXPECT_NEAR(sample().temperature_C.at(0), 30.0, 1e-9);
  EXPECT_NEAR(sample().temperature_C.at(1), 42.0, 1e-9);
  EXPECT_TRUE(sample().device_faults.empty());

  dead.dead = true;
  ASSERT_TRUE(within(20s, [&] { return sample().device_faults.contains("dead"); }));
  EXPECT_TRUE(std::isnan(sample().temperature_C.at(1)));
  const long before = (*readings)->states().at(0).rounds;
  ASSERT_TRUE(within(20s, [&] { return (*readings)->states().at(0).rounds > before + 3; }));
  EXPECT_NEAR(sample().temperature_C.at(0), 30.0, 1e-9);

  dead.dead = false;
  EXPECT_TRUE(within(60s, [&] { return std::abs(sample().temperature_C.at(1) - 42.0) < 1e-9; }));
  EXPECT_TRUE(within(20s, [&] { return sample().device_faults.empty(); }));
  EXPECT_NE((*readings)->remarks().at(0).find("dead"), std::string::npos);
}

TEST(DeviceReadings, ASignalThatIsNotThereIsNamed) {
  const Module module(300);
  for (const std::string signal : {"temperature_C[9]", "temperature_C[0]", "temperature_C[x]", "pressure"}) {
    const auto profile = profile_from_json(
        manual_profile(json::array({module.profile("one")}), json::array({sensor("T1_C", "one", signal)})), "rig.json");
    ASSERT_TRUE(profile) << describe(profile.error());
    EXPECT_FALSE(DeviceReadings::open(*profile)) << signal;
  }
}

TEST(SerialLine, AnotherProgramsPortIsRefused) {
  const auto path = std::filesystem::temp_directory_path() / ("line-" + std::to_string(::getpid()));
  std::ofstream(path).put('\n');
  const int other = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_EQ(::flock(other, LOCK_EX | LOCK_NB), 0);
  const auto line = SerialLine::of(path.string());
  const Status taken = line->claim();
  ASSERT_FALSE(taken);
  EXPECT_NE(describe(taken.error()).find("another program"), std::string::npos) << describe(taken.error());
  ::close(other);
  EXPECT_TRUE(line->claim());
  EXPECT_TRUE(line->claim()) << "its own claim is no other's";
  EXPECT_EQ(SerialLine::of(path.string()), line);
  std::filesystem::remove(path);
}

TEST(SerialLine, TurnsAreInTheOrderOfAsking) {
  SerialLine line("nowhere");
  std::vector<int> served;
  std::vector<std::jthread> threads;
  {
    const SerialLine::Turn first(line);
    for (int i = 0; i < 4; ++i) {
      std::atomic<bool> begun{false};
      threads.emplace_back([&, i] {
        begun = true;
        const SerialLine::Turn turn(line);
        served.push_back(i);
      });
      ASSERT_TRUE(within(5s, [&] { return begun.load(); }));
      ASSERT_TRUE(within(5s, [&] { return line.waiting() == static_cast<std::size_t>(i) + 1; }));
    }
  }
  threads.clear();
  EXPECT_EQ(served, (std::vector<int>{0, 1, 2, 3}));
}

TEST(ManualControl, AsksOnlyForWhatChanges) {
  const auto person = std::make_shared<Person>();
  const auto control = control_of(person);
  const std::map<std::string, double> home = {{"X", 0}, {"Y", 0}, {"Z", 0}};
  ASSERT_TRUE(control->command(0, false, false));
  ASSERT_TRUE(control->move_to(home));
  ASSERT_TRUE(control->move_to(home));
  ASSERT_TRUE(control->command(3000, true, true));
  ASSERT_TRUE(control->command(3000, true, true));
  ASSERT_TRUE(control->command(3000, true, false));  // the path stops with the move
  ASSERT_TRUE(control->move_to(home));
  ASSERT_TRUE(control->command(3000, true, true));
  EXPECT_EQ(person->acts(), (std::vector<std::string>{"command", "move", "command", "move", "command"}));
  const auto sample = control->read();
  ASSERT_TRUE(sample) << describe(sample.error());
  EXPECT_EQ(sample->spindle_rpm, 3000.0);
  EXPECT_TRUE(sample->cycling);
  EXPECT_EQ(sample->axes, home);
  EXPECT_EQ(person->acts().back(), "state");
}

TEST(ManualControl, WhatCannotBeDoneIsNoChange) {
  const auto person = std::make_shared<Person>();
  const auto control = control_of(person);
  person->refuses = "the door is open";
  EXPECT_EQ(control->command(3000, true, true).error().code, ErrorCode::operator_declined);
  person->refuses.clear();
  ASSERT_TRUE(control->read());
  EXPECT_TRUE(std::isnan(control->read()->spindle_rpm));
  ASSERT_TRUE(control->command(3000, true, true));
  EXPECT_EQ(person->asked.back().act, OperatorAct::command) << "it is asked for again";
}

TEST(ManualControl, ATestOffsetNeedsTheSwitch) {
  const auto person = std::make_shared<Person>();
  const auto control = control_of(person);
  EXPECT_EQ(control->write_host_offset({10, 0, 0}).error().code, ErrorCode::interlock_compensation_off);
  ASSERT_TRUE(control->switch_compensation(true));
  EXPECT_EQ(control->write_host_offset({1000, 0, 0}).error().code, ErrorCode::limit_exceeded);
  ASSERT_TRUE(control->write_host_offset({10, 0, 0}));
  const auto locked = ManualControl::open(control->profile(), person, access::Permit::read_only());
  EXPECT_EQ((*locked)->switch_compensation(true).error().code, ErrorCode::access_locked);
}

TEST(ManualUpload, OnlyTheControlsOwnCheckValueSwitchesOn) {
  const auto person = std::make_shared<Person>();
  const auto control = control_of(person);
  compensation::Table table;
  table.machine = "Old mill";
  table.axes["Z"].offset_um = -12.0;
  table.axes["Z"].max_um = control->profile().max_um;
  ManualUploadOptions options;
  options.file = (std::filesystem::temp_directory_path() / ("table-" + std::to_string(::getpid()) + ".json")).string();
  options.old_sequence = 4;
  ASSERT_TRUE(control->command(0, false, false));

  person->compensation_on = true;
  person->check = "00000000";
  auto record = upload_by_hand(*control, table, options, {});
  ASSERT_FALSE(record.result);
  EXPECT_EQ(record.result.error().code, ErrorCode::upload_read_back) << describe(record.result.error());
  EXPECT_FALSE(*control->compensation_on()) << "switched on with an unknown table";

  table.version = 5;
  person->check = check_value(table);
  record = upload_by_hand(*control, table, options, {});
  ASSERT_TRUE(record.result) << describe(record.result.error());
  EXPECT_EQ(record.sequence, 5);
  EXPECT_TRUE(*control->compensation_on());
  std::ifstream file(options.file);
  EXPECT_EQ(json::parse(file).at("crc32"), person->check);
  std::filesystem::remove(options.file);
}

}  // namespace zerodrift::controller
