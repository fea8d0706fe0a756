// Looking for devices: ports of this computer, units on a line, listeners on a network; the test of one device, and the
// live values of a profile that is set up.

#include "core/controller/find_devices.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/controller/live_signals.h"
#include "core/controller/modbus_server.h"
#include "core/controller/profile_draft.h"
#include "fixtures.h"
#include "serial_device.h"

namespace zerodrift::controller {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

std::unique_ptr<ModbusServer> temperatures(int unit = 1) {
  ModbusServerOptions options;
  options.unit = unit;
  options.read = [](int address, int count) -> RegisterReply {
    if (address + count > 8) return tl::unexpected(ModbusException::illegal_address);
    std::vector<std::uint16_t> words;
    for (int i = 0; i < count; ++i) words.push_back(static_cast<std::uint16_t>(200 + address + i));
    return words;
  };
  options.write = [](int, std::span<const std::uint16_t>) { return ModbusException::illegal_function; };
  return std::move(*ModbusServer::start(std::move(options)));
}

json module_at(int port) {
  return {{"id", "module"}, {"kind", "modbus-tcp"}, {"host", "127.0.0.1"},
          {"port", port},   {"timeout_ms", 300},    {"register_map", "temperature-module-8-ds18b20"}};
}

}  // namespace

TEST(FindDevices, PortsAreListedByTheNamesThatStay) {
  const fs::path dev = fs::path(testing::TempDir()) / ("dev-" + std::to_string(::getpid()));
  fs::create_directories(dev / "serial" / "by-id");
  for (const char* name : {"ttyUSB0", "ttyUSB1", "tty0", "null"}) std::ofstream(dev / name) << "";
  fs::create_symlink("../../ttyUSB1", dev / "serial" / "by-id" / "usb-Adapter_A17-port0");
  const auto ports = serial_ports(dev);
  ASSERT_EQ(ports.size(), 2u);
  EXPECT_EQ(fs::path(ports[0].path).filename(), "usb-Adapter_A17-port0");
  EXPECT_EQ(fs::path(ports[0].device).filename(), "ttyUSB1");
  EXPECT_EQ(fs::path(ports[1].path).filename(), "ttyUSB0");
  fs::remove_all(dev);
}

TEST(FindDevices, TheUnitThatAnswersIsFoundAmongThoseThatDoNot) {
  SerialHabits habits;
  habits.unit = 3;
  const SerialDevice device(habits);
  ControllerSettings line = device.settings();
  line.timeout_ms = 40;
  std::vector<int> found;
  std::vector<double> shown;
  TaskContext context;
  context.report = [&](const Progress& progress) { shown.push_back(progress.fraction); };
  const Status done = find_units(line, 1, 5, context, [&](const FoundUnit& unit) { found.push_back(unit.unit); });
  ASSERT_TRUE(done) << describe(done.error());
  EXPECT_EQ(found, std::vector<int>{3});
  EXPECT_EQ(shown.size(), 5u);
}

TEST(FindDevices, ASearchEndsAtAPortThatIsNotThereAndWhenItIsStopped) {
  ControllerSettings line;
  line.kind = LinkKind::rtu;
  line.device = "/dev/no-such-port";
  line.timeout_ms = 40;
  const Status none = find_units(line, 1, 247, {}, [](const FoundUnit&) {});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::machine_unreachable);

  const SerialDevice device;
  std::stop_source stop;
  TaskContext context;
  context.stop = stop.get_token();
  int asked = 0;
  context.report = [&](const Progress&) {
    if (++asked == 3) stop.request_stop();
  };
  line = device.settings();
  line.timeout_ms = 40;
  const Status stopped = find_units(line, 1, 247, context, [](const FoundUnit&) {});
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::cancelled);
  EXPECT_LE(asked, 4);
}

TEST(FindDevices, ListenersAreFoundAmongClosedPorts) {
  const auto server = temperatures();
  std::vector<HostPort> addresses;
  for (int i = 0; i < 100; ++i) addresses.push_back({"127.0.0.1", 1});  // nobody listens
  addresses.push_back({"127.0.0.1", server->port()});
  std::vector<int> found;
  ASSERT_TRUE(find_listeners(addresses, {}, [&](const HostPort& at) { found.push_back(at.port); }));
  EXPECT_EQ(found, std::vector<int>{server->port()});
}

TEST(FindDevices, TheOwnNetworkIsBounded) {
  const auto addresses = own_network();
  EXPECT_LE(addresses.size(), std::size_t{4 * 2 * 254});
  for (const auto& address : addresses) {
    EXPECT_FALSE(address.host.starts_with("127.")) << address.host;
    EXPECT_TRUE(address.port == modbus_port || address.port == agent_port);
  }
}

TEST(TestDevice, SaysRoundTripAndValues) {
  const auto server = temperatures();
  ProfileDraft draft;
  const auto device = draft.device(draft.add_device(module_at(server->port())));
  ASSERT_TRUE(device) << describe(device.error());
  const auto test = test_device(*device, {}, {});
  ASSERT_TRUE(test) << describe(test.error());
  EXPECT_GT(test->round_trip_s, 0.0);
  EXPECT_LT(test->round_trip_s, 0.3);
  ASSERT_EQ(test->values.size(), 8u);
  EXPECT_EQ(test->values[2].first, "temperature_C[3]");
  EXPECT_NEAR(test->values[2].second, 20.2, 1e-9);
}

TEST(TestDevice, SaysTheFaultOfOneThatIsNotThere) {
  ProfileDraft draft;
  const auto device = draft.device(draft.add_device(module_at(1)));
  ASSERT_TRUE(device);
  const auto test = test_device(*device, {}, {});
  ASSERT_FALSE(test);
  EXPECT_EQ(test.error().code, ErrorCode::machine_unreachable);
}

TEST(LiveSignals, EachRowHasItsValueAndTheControlIsReadToo) {
  const auto module = temperatures();
  const auto control = temperatures();
  json document = ProfileDraft().document();
  document["controller"] = {{"kind", "modbus-tcp"},
                            {"host", "127.0.0.1"},
                            {"port", control->port()},
                            {"register_map", "temperature-module-8-ds18b20"}};
  ProfileDraft draft(document, "");
  draft.add_device(module_at(module->port()));
  draft.add_sensor("module-1", "temperature_C[5]");
  draft.add_sensor("", "");  // the second of the control's
  draft.assign("ambient", "module-1", "temperature_C[8]");
  const auto profile = draft.profile();
  ASSERT_TRUE(profile) << describe(profile.error());
  const auto live = LiveSignals::open(*profile, signal_rows(draft.document()));
  ASSERT_TRUE(live) << describe(live.error());
  std::map<std::string, LiveValue> values;
  for (int i = 0; i < 200 && values.size() < 3; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    values = (*live)->values();
  }
  EXPECT_NEAR(values["sensors[0]"].value, 20.4, 1e-9);
  EXPECT_NEAR(values["sensors[1]"].value, 20.1, 1e-9);
  EXPECT_NEAR(values["ambient"].value, 20.7, 1e-9);
  EXPECT_GT(values["ambient"].rounds, 0);
  EXPECT_FALSE(values.contains("speed")) << "nobody reads it";
}

}  // namespace zerodrift::controller
