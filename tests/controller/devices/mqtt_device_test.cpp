// Topics of a broker, against mosquitto itself.

#include "core/controller/devices/mqtt_device.h"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>

#include "broker.h"
#include "core/base/clock.h"

namespace zerodrift::controller {
namespace {

std::unique_ptr<Device> opened(const DeviceProfile& profile, const std::vector<std::string>& signals) {
  auto device = open_device(profile, signals);
  EXPECT_TRUE(device) << describe(device.error());
  return device ? std::move(*device) : nullptr;
}

/// The readings once they are as wanted; the last ones when they never are.
std::vector<Reading> readings_when(Device& device, const std::function<bool(const std::vector<Reading>&)>& wanted) {
  std::vector<Reading> last;
  EXPECT_TRUE(eventually([&] {
    auto readings = device.read();
    if (readings) last = *readings;
    return readings && wanted(last);
  })) << text_of(device.read());
  return last;
}

bool all_there(const std::vector<Reading>& readings) {
  return std::ranges::all_of(readings, [](const Reading& r) { return !std::isnan(r.value); });
}

class MqttDevice : public testing::Test {
 protected:
  void SetUp() override {
    if (!Broker::installed()) GTEST_SKIP() << "the program mosquitto is not installed";
  }
};

}  // namespace

TEST_F(MqttDevice, GivesTheLastValueOfEachSignalAndWhenItArrived) {
  Broker broker;
  broker.start();
  const auto device = opened(broker.profile(), {"shop/T1", "shop/box#/sensors/1/celsius", "shop/box#/coolant",
                                                "shop/box#/text", "shop/silent"});
  ASSERT_EQ(text_of(device->read()), "ok");
  const Seconds before = host_clock().steady();
  broker.publish("shop/T1", "19.5");
  broker.publish("shop/T1", " 21.25\n");
  broker.publish("shop/box", R"({"sensors": [{}, {"celsius": 33.5}], "coolant": true, "text": "-1.5e1"})");
  const auto readings = readings_when(
      *device, [](const auto& r) { return r[0].value == 21.25 && !std::isnan(r[1].value) && !std::isnan(r[3].value); });
  const Seconds after = host_clock().steady();
  EXPECT_EQ(readings[1].value, 33.5);
  EXPECT_EQ(readings[2].value, 1.0);
  EXPECT_EQ(readings[3].value, -15.0);
  EXPECT_TRUE(std::isnan(readings[4].value));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_GE(readings[i].at.count(), before.count());
    EXPECT_LE(readings[i].at.count(), after.count());
  }
  EXPECT_TRUE(device->remarks().empty());
}

TEST_F(MqttDevice, ARetainedValueIsMissingUntilALiveOneComes) {
  Broker broker;
  broker.start();
  broker.publish("shop/T1", "55", true);
  const auto device = opened(broker.profile(), {"shop/T1"});
  EXPECT_TRUE(eventually([&] {
    const auto readings = device->read();
    EXPECT_TRUE(!readings || std::isnan(readings->front().value));
    return has_remark(*device, "shop/T1: a retained message is not used");
  }));
  broker.publish("shop/T1", "56", true);  // to those who listen already it comes as live
  EXPECT_EQ(readings_when(*device, all_there).front().value, 56.0);
}

TEST_F(MqttDevice, AValueOlderThanTheLimitIsMissing) {
  Broker broker;
  broker.start();
  DeviceProfile profile = broker.profile();
  profile.stale_after_s = 0.2;
  const auto device = opened(profile, {"shop/T1"});
  ASSERT_EQ(text_of(device->read()), "ok");
  const Seconds before = host_clock().steady();
  broker.publish("shop/T1", "20");
  const auto readings = readings_when(*device, [&](const auto& r) {
    return std::isnan(r[0].value) && r[0].at >= before && host_clock().steady() - r[0].at > Seconds(0.2);
  });
  EXPECT_EQ(readings.size(), 1);
}

TEST_F(MqttDevice, ReadsFailWithoutTheBrokerAndGoOnWhenItIsBack) {
  Broker broker;
  broker.start();
  const auto device = opened(broker.profile(), {"shop/T1"});
  ASSERT_EQ(text_of(device->read()), "ok");
  broker.publish("shop/T1", "20");
  readings_when(*device, all_there);
  broker.stop();
  std::string fault;
  EXPECT_TRUE(eventually([&] {
    const auto readings = device->read();
    if (!readings) fault = describe(readings.error());
    return !readings;
  }));
  EXPECT_TRUE(fault.starts_with("machine_link_lost") || fault.starts_with("machine_unreachable")) << fault;
  EXPECT_NE(fault.find(std::to_string(broker.port())), std::string::npos) << fault;
  broker.start();
  readings_when(*device, [](const auto&) { return true; });
  broker.publish("shop/T1", "30");
  readings_when(*device, [](const auto& r) { return r[0].value == 30.0; });
  EXPECT_TRUE(has_remark(*device, "the connection to the broker was lost and opened anew"));
}

TEST_F(MqttDevice, PayloadsWithoutANumberAreMissingAndCounted) {
  Broker broker;
  broker.start();
  const auto device = opened(broker.profile(), {"a", "b#/t"});
  ASSERT_EQ(text_of(device->read()), "ok");
  broker.publish("a", "20");
  broker.publish("b", R"({"t": 21})");
  readings_when(*device, all_there);
  for (const char* junk : {"21,5", "20 C", "inf", "0x10", "+-3"}) broker.publish("a", junk);
  for (const char* word : {"UNAVAILABLE", "", "NaN"}) broker.publish("a", word);
  broker.publish("b", "{\"t\": 21");
  broker.publish("b", "{\"u\": 21}");
  broker.publish("b", "[]");
  broker.publish("b", "{\"t\": [21]}");
  broker.publish("b", "{\"t\": null}");
  broker.publish("b", std::string((std::size_t{1} << 20) + 1, ' '));
  EXPECT_TRUE(eventually([&] { return has_remark(*device, "b#/t: a message is larger than 1 MB"); }));
  const auto readings = device->read();
  ASSERT_EQ(text_of(readings), "ok");
  for (const Reading& reading : *readings) EXPECT_TRUE(std::isnan(reading.value));
  EXPECT_THAT(device->remarks(),
              testing::UnorderedElementsAre(
                  "a: a message is no number (5 times)", "a: the device says that it has no value (3 times)",
                  "b#/t: a message is no JSON", "b#/t: a message has nothing at this path (2 times)",
                  "b#/t: a message has something other than a number at this path",
                  "b#/t: the device says that it has no value", "b#/t: a message is larger than 1 MB"));
  broker.publish("a", "22");
  readings_when(*device, [](const auto& r) { return r[0].value == 22.0; });
}

TEST_F(MqttDevice, WrongCredentialsAreNamedAndThePasswordIsNot) {
  const std::string password = "geheim-4711";
  Broker broker("allow_anonymous false\npassword_file FOLDER/users\n");
  ASSERT_TRUE(
      run({program("mosquitto_passwd"), "-c", "-b", (broker.folder().path() / "users").string(), "anna", password}));
  broker.start();
  DeviceProfile profile = broker.profile();
  const auto nobody = opened(profile, {"shop/T1"});
  EXPECT_NE(text_of(nobody->read()).find("the broker refuses user or password"), std::string::npos);
  profile.credentials_file = "login.json";  // beside the profile
  broker.folder().write("login.json", R"({"user": "anna", "password": "geheim-4712"})");
  const auto wrong = opened(profile, {"shop/T1"});
  const std::string refused = text_of(wrong->read());
  EXPECT_TRUE(refused.starts_with("machine_unreachable")) << refused;
  EXPECT_EQ(refused.find("geheim"), std::string::npos) << refused;
  broker.folder().write("login.json", R"({"user": "anna", "password": ")" + password + "\"}");
  const auto right = opened(profile, {"shop/T1"});
  EXPECT_EQ(text_of(right->read()), "ok");
  EXPECT_TRUE(has_remark(*right, "unencrypted"));
}

TEST_F(MqttDevice, TrustsTheAuthorityGivenOrTheSystems) {
  if (program("openssl").empty()) GTEST_SKIP() << "the program openssl is not installed";
  Broker broker("allow_anonymous true\ncertfile FOLDER/cert.pem\nkeyfile FOLDER/key.pem\n");
  const auto& folder = broker.folder().path();
  ASSERT_TRUE(run({program("openssl"), "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2", "-subj",
                   "/CN=broker", "-addext", "subjectAltName=IP:127.0.0.1", "-keyout", (folder / "key.pem").string(),
                   "-out", (folder / "cert.pem").string()}));
  broker.start();
  DeviceProfile profile = broker.profile();
  profile.tls = true;
  profile.ca_file = "cert.pem";
  EXPECT_EQ(text_of(opened(profile, {"shop/T1"})->read()), "ok");
  profile.ca_file = "";
  const std::string strange = text_of(opened(profile, {"shop/T1"})->read());
  EXPECT_NE(strange.find("no TLS connection"), std::string::npos) << strange;
  ::setenv("SSL_CERT_FILE", (folder / "cert.pem").c_str(), 1);
  EXPECT_EQ(text_of(opened(profile, {"shop/T1"})->read()), "ok");
  ::unsetenv("SSL_CERT_FILE");
  profile.tls = false;
  EXPECT_NE(text_of(opened(profile, {"shop/T1"})->read()), "ok") << "without TLS it must not connect";
}

TEST(MqttDeviceFaults, NobodyAtTheAddressIsUnreachable) {
  DeviceProfile profile;
  profile.id = "bench";
  profile.kind = DeviceKind::mqtt;
  profile.host = "127.0.0.1";
  profile.port = free_port();
  profile.timeout_ms = 20000;
  const auto device = opened(profile, {"shop/T1"});
  const std::string fault = text_of(device->read());
  EXPECT_TRUE(fault.starts_with("machine_unreachable")) << fault;
  EXPECT_NE(fault.find("Connection refused"), std::string::npos) << fault;
}

TEST(MqttDeviceFaults, AServerThatNeverAnswersIsSilent) {
  const int listener = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  ASSERT_EQ(::bind(listener, reinterpret_cast<sockaddr*>(&address), size), 0);
  ASSERT_EQ(::listen(listener, 8), 0);
  ASSERT_EQ(::getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size), 0);
  DeviceProfile profile;
  profile.id = "bench";
  profile.kind = DeviceKind::mqtt;
  profile.host = "127.0.0.1";
  profile.port = ntohs(address.sin_port);
  profile.timeout_ms = 100;
  const auto device = opened(profile, {"shop/T1"});
  EXPECT_EQ(text_of(device->read()),
            "machine_silent timeout_ms=100 what=broker 127.0.0.1:" + std::to_string(profile.port));
  ::close(listener);
}

TEST(MqttDeviceFaults, SignalsThatAreNotOneTopicAreRefused) {
  DeviceProfile profile;
  profile.id = "bench";
  profile.kind = DeviceKind::mqtt;
  for (const char* signal : {"", "shop/+/T1", "shop/#", "#", "shop/#/t", "+#/t", "shop/T1#t", "shop/T1#/~2", "#/t"}) {
    const auto device = open_device(profile, {signal});
    ASSERT_FALSE(device) << signal;
    EXPECT_EQ(device.error().code, ErrorCode::data_does_not_fit) << signal;
  }
  for (const char* signal : {"a", "shop/T1", "shop/T1#/t", "shop/T1#/a~1b/0", "$SYS/broker/uptime", "shop/T 1"}) {
    EXPECT_TRUE(open_device(profile, {signal})) << signal;
  }
}

TEST(DeviceCredentials, AFileThatOthersMayReadIsRefused) {
  const TestFolder folder;
  DeviceProfile profile;
  profile.id = "bench";
  profile.kind = DeviceKind::mqtt;
  for (const unsigned mode : {0644U, 0640U, 0604U, 0620U}) {
    profile.credentials_file = folder.write("login.json", R"({"user": "anna", "password": "geheim"})", mode);
    const auto device = open_device(profile, {"a"});
    ASSERT_FALSE(device);
    EXPECT_EQ(device.error().code, ErrorCode::bad_argument);
    EXPECT_EQ(device.error().context.at("found"), fmt::format("{:04o}", mode));
  }
  for (const unsigned mode : {0600U, 0400U}) {
    profile.credentials_file = folder.write("login2.json", R"({"user": "anna", "password": "geheim"})", mode);
    EXPECT_TRUE(open_device(profile, {"a"}));
    std::filesystem::remove(profile.credentials_file);
  }
}

TEST(DeviceCredentials, NoErrorRepeatsThePassword) {
  const TestFolder folder;
  DeviceProfile profile;
  profile.id = "bench";
  for (const auto kind : {DeviceKind::mqtt, DeviceKind::mtconnect}) {
    profile.kind = kind;
    profile.url = "http://127.0.0.1:5000/";
    for (const char* text : {R"({"user": "anna", "password": "geheim)", R"({"user": "anna", "password": geheim})",
                             R"({"user": "anna", "password": ["geheim"]})", R"({"user": "geheim"})", R"("geheim")"}) {
      profile.credentials_file = folder.write("login.json", text);
      const auto device = open_device(profile, {"a"});
      ASSERT_FALSE(device) << text;
      EXPECT_EQ(describe(device.error()).find("geheim"), std::string::npos) << describe(device.error());
    }
  }
}

TEST(DeviceCredentials, AJobsProfileReadsNoFiles) {
  const TestFolder folder;
  DeviceProfile profile;
  profile.id = "bench";
  profile.kind = DeviceKind::mqtt;
  profile.of_job = true;
  profile.credentials_file = folder.write("login.json", R"({"user": "anna", "password": "geheim"})");
  EXPECT_EQ(open_device(profile, {"a"}).error().code, ErrorCode::job_reaches_out);
  profile.credentials_file = "";
  profile.tls = true;
  profile.ca_file = folder.write("ca.pem", "");
  EXPECT_EQ(open_device(profile, {"a"}).error().code, ErrorCode::job_reaches_out);
}

}  // namespace zerodrift::controller
