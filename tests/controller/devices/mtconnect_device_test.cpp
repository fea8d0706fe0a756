// An MTConnect agent, against a server that answers as agents do, and as they should not.

#include "core/controller/devices/mtconnect_device.h"

#include <gtest/gtest.h>
#include <httplib.h>

#include <atomic>
#include <cmath>
#include <mutex>
#include <thread>

#include "core/base/clock.h"
#include "device_fixtures.h"

namespace zerodrift::controller {
namespace {

using namespace std::string_literals;

struct ProbeItem {
  const char* id;
  const char* attributes;
};

constexpr std::array probe_items = {
    ProbeItem{"c1", R"(name="Tspindle" category="SAMPLE" type="TEMPERATURE" units="CELSIUS" nativeUnits="FAHRENHEIT")"},
    ProbeItem{"f1", R"(name="Tbed" category="SAMPLE" type="TEMPERATURE" nativeUnits="FAHRENHEIT")"},
    ProbeItem{"s1", R"(name="S" category="SAMPLE" type="ROTARY_VELOCITY" units="REVOLUTION/MINUTE")"},
    ProbeItem{"x1", R"(name="Xabs" category="SAMPLE" type="PATH_POSITION" units="MILLIMETER")"},
    ProbeItem{"y1", R"(name="Yabs" category="SAMPLE" type="POSITION" units="INCH")"},
    ProbeItem{"w1", R"(name="load" category="SAMPLE" type="WATTAGE" units="WATT")"},
    ProbeItem{"k1", R"(name="power" category="SAMPLE" type="WATTAGE" nativeUnits="KILOWATT")"},
    ProbeItem{"p1", R"(name="load" category="SAMPLE" type="LOAD" units="PERCENT")"},
    ProbeItem{"v1", R"(name="table" category="EVENT" type="BLOCK")"},
    ProbeItem{"q1", R"(category="SAMPLE" type="PRESSURE" units="PASCAL")"},
    ProbeItem{"cond", R"(category="CONDITION" type="TEMPERATURE")"},
};

std::string probe_document(const std::string& instance) {
  std::string items;
  for (const ProbeItem& item : probe_items) items += fmt::format(R"(<DataItem id="{}" {}/>)", item.id, item.attributes);
  return fmt::format(
      R"(<?xml version="1.0"?><MTConnectDevices xmlns="urn:mtconnect.org:MTConnectDevices:1.7"><Header instanceId="{}"/>)"
      R"(<Devices><Device id="d"><DataItems>{}</DataItems></Device></Devices></MTConnectDevices>)",
      instance, items);
}

/// All time stamps are years old: these values have not changed for so long.
std::string current_document(const std::string& instance, const std::string& observations,
                             const std::string& prefix = "") {
  return fmt::format(
      R"(<?xml version="1.0"?><{0}MTConnectStreams xmlns{3}="urn:mtconnect.org:MTConnectStreams:1.7">)"
      R"(<{0}Header creationTime="2026-01-01T00:00:00Z" instanceId="{1}"/><{0}Streams><{0}Samples>{2}</{0}Samples>)"
      R"(</{0}Streams></{0}MTConnectStreams>)",
      prefix, instance, observations, prefix.empty() ? "" : ":" + prefix.substr(0, prefix.size() - 1));
}

std::string sample(const std::string& id, const std::string& value) {
  return fmt::format(
      R"(<Temperature dataItemId="{}" sequence="7" timestamp="2019-05-06T07:08:09.123Z">{}</Temperature>)", id, value);
}

/// The agent: answers can be replaced while it runs.
class Agent {
 public:
  using Handler = std::function<void(const httplib::Request&, httplib::Response&)>;

  Agent() {
    m_server.Get("/probe", [this](const auto& request, auto& response) { answer(m_probe, request, response); });
    m_server.Get("/current", [this](const auto& request, auto& response) { answer(m_current, request, response); });
    m_port = m_server.bind_to_any_port("127.0.0.1");
    m_thread = std::thread([this] { m_server.listen_after_bind(); });
    eventually([this] { return m_server.is_running(); });
    set_probe(xml(probe_document("1")));
  }
  ~Agent() {
    m_server.stop();
    m_thread.join();
  }
  Agent(const Agent&) = delete;
  Agent& operator=(const Agent&) = delete;

  static Handler xml(const std::string& text, int status = 200) {
    return [=](const auto&, httplib::Response& response) {
      response.status = status;
      response.set_content(text, "text/xml");
    };
  }
  void set_probe(Handler handler) {
    const std::scoped_lock guard(m_lock);
    m_probe = std::move(handler);
  }
  void set_current(Handler handler) {
    const std::scoped_lock guard(m_lock);
    m_current = std::move(handler);
  }
  DeviceProfile profile() const {
    DeviceProfile profile;
    profile.id = "cnc";
    profile.kind = DeviceKind::mtconnect;
    profile.url = fmt::format("http://127.0.0.1:{}/", m_port);
    profile.timeout_ms = 20000;
    return profile;
  }

 private:
  void answer(const Handler& which, const httplib::Request& request, httplib::Response& response) {
    Handler handler;
    {
      const std::scoped_lock guard(m_lock);
      handler = which;
    }
    handler(request, response);
  }

  std::mutex m_lock;
  Handler m_probe;
  Handler m_current;
  httplib::Server m_server;
  std::thread m_thread;
  int m_port = 0;
};

std::unique_ptr<Device> open_agent(const DeviceProfile& profile, const std::vector<std::string>& signals) {
  auto device = open_device(profile, signals);
  EXPECT_TRUE(device) << describe(device.error());
  return device ? std::move(*device) : nullptr;
}

std::string fault_of(const Agent& agent, const std::vector<std::string>& signals = {"c1"}) {
  return text_of(open_agent(agent.profile(), signals)->read());
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST(MtConnectDevice, ConvertsTheUnitsOfItsDataItems) {
  Agent agent;
  agent.set_current(
      Agent::xml(current_document("1", sample("c1", "21.5") + sample("f1", "212") + sample("s1", " 6000.0\n") +
                                           sample("x1", "-12.5") + sample("y1", "2") + sample("w1", "750") +
                                           sample("k1", "1.5E0") + sample("p1", "35") + sample("v1", "4"))));
  const auto device =
      open_agent(agent.profile(), {"c1", "Tbed", "S", "Xabs", "y1", "w1", "power", "p1", "table", "c1"});
  const Seconds before = host_clock().steady();
  const auto readings = device->read();
  const Seconds after = host_clock().steady();
  ASSERT_EQ(text_of(readings), "ok");
  const std::vector<double> expected = {21.5, 100.0, 6000.0, -12.5, 50.8, 750.0, 1500.0, 35.0, 4.0, 21.5};
  ASSERT_EQ(readings->size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR((*readings)[i].value, expected[i], 1e-9) << i;
    EXPECT_GE((*readings)[i].at.count(), before.count());
    EXPECT_LE((*readings)[i].at.count(), after.count());
  }
  EXPECT_THAT(device->remarks(),
              testing::ElementsAre("table: the agent states no unit, and its values are taken as they are"));
}

TEST(MtConnectDevice, ItsSamplesOfKnownUnitsAreWhatAProfileCanName) {
  Agent agent;
  const auto samples = agent_samples(agent.profile());
  ASSERT_TRUE(samples) << describe(samples.error());
  EXPECT_THAT(*samples, testing::ElementsAre("c1", "f1", "s1", "x1", "y1", "w1", "k1", "p1"));
}

TEST(MtConnectDevice, AValueThatDoesNotChangeStaysCurrent) {
  Agent agent;
  agent.set_current(Agent::xml(current_document("1", sample("c1", "20"))));
  DeviceProfile profile = agent.profile();
  profile.stale_after_s = 1e-6;
  const auto device = open_agent(profile, {"c1"});
  Seconds last{0.0};
  for (int i = 0; i < 3; ++i) {
    const auto readings = device->read();
    ASSERT_EQ(text_of(readings), "ok");
    EXPECT_EQ(readings->front().value, 20.0);
    EXPECT_GT(readings->front().at.count(), last.count()) << "its time is that of the request";
    last = readings->front().at;
  }
}

TEST(MtConnectDevice, WhatIsNoNumberIsMissing) {
  Agent agent;
  agent.set_current(Agent::xml(current_document(
      "1", sample("c1", "UNAVAILABLE") + sample("s1", "1 2 3") + sample("x1", "nan") + sample("y1", "1"))));
  const auto device = open_agent(agent.profile(), {"c1", "s1", "x1", "y1", "w1"});
  for (int i = 0; i < 2; ++i) {
    const auto readings = device->read();
    ASSERT_EQ(text_of(readings), "ok");
    for (const std::size_t k : {0, 1, 2, 4}) EXPECT_TRUE(std::isnan((*readings)[k].value)) << k;
    EXPECT_NEAR((*readings)[3].value, 25.4, 1e-9);
  }
  EXPECT_THAT(device->remarks(),
              testing::UnorderedElementsAre("s1: a value is no number (2 times)", "x1: a value is no number (2 times)",
                                            "w1: an answer of the agent lacks the data item (2 times)"));
}

TEST(MtConnectDevice, ReadsADocumentWithNamespacePrefixes) {
  Agent agent;
  agent.set_current(Agent::xml(current_document("1", R"(<m:Temperature dataItemId="c1">20</m:Temperature>)", "m:")));
  const auto readings = open_agent(agent.profile(), {"c1"})->read();
  ASSERT_EQ(text_of(readings), "ok");
  EXPECT_EQ(readings->front().value, 20.0);
}

TEST(MtConnectDevice, ARestartOfTheAgentIsRemarkedAndItsItemsAreReadAgain) {
  Agent agent;
  agent.set_current(Agent::xml(current_document("1", sample("f1", "50"))));
  const auto device = open_agent(agent.profile(), {"f1"});
  EXPECT_NEAR(device->read()->front().value, 10.0, 1e-9);
  EXPECT_TRUE(device->remarks().empty());
  std::string probe = probe_document("2");
  const std::string fahrenheit = R"(type="TEMPERATURE" nativeUnits="FAHRENHEIT")";
  probe.replace(probe.find(fahrenheit), fahrenheit.size(), R"(type="TEMPERATURE" units="CELSIUS")");
  agent.set_probe(Agent::xml(probe));
  agent.set_current(Agent::xml(current_document("2", sample("f1", "50"))));
  EXPECT_NEAR(device->read()->front().value, 50.0, 1e-9) << "its unit is another now";
  EXPECT_TRUE(has_remark(*device, "the agent has restarted"));
  agent.set_current(Agent::xml(current_document("3", sample("f1", "50"))));
  EXPECT_TRUE(contains(text_of(device->read()), "keeps restarting")) << "probe and current never agree";
}

TEST(MtConnectDevice, DataItemsThatDoNotFitAreNamed) {
  Agent agent;
  agent.set_current(Agent::xml(current_document("1", "")));
  for (const auto& [signal, part] : std::vector<std::pair<std::string, std::string>>{
           {"Z9", "expected=one of c1, f1, s1"},
           {"", "found=missing"},
           {"load", "expected=one of the ids w1, p1 found=the name of several"},
           {"q1", "found=in PASCAL"},
           {"cond", "found=a condition"}}) {
    const std::string fault = fault_of(agent, {"c1", signal});
    EXPECT_TRUE(fault.starts_with("machine_unsupported")) << fault;
    EXPECT_TRUE(contains(fault, part)) << fault;
    EXPECT_TRUE(contains(fault, "data item " + signal)) << fault;
  }
}

TEST(MtConnectDevice, AnswersThatAreNotValuesAreNamed) {
  Agent agent;
  const std::string refusal =
      R"(<MTConnectError><Header instanceId="1"/><Errors><Error errorCode="UNSUPPORTED">No such path</Error></Errors></MTConnectError>)";
  const std::string old_refusal =
      R"(<MTConnectError><Header/><Error errorCode="QUEUE_FULL">Later</Error></MTConnectError>)";
  for (const auto& [handler, part] : std::vector<std::pair<Agent::Handler, std::string>>{
           {Agent::xml(refusal), R"(the agent reports "UNSUPPORTED No such path")"},
           {Agent::xml(refusal, 404), R"(the agent reports "UNSUPPORTED No such path")"},
           {Agent::xml(old_refusal), R"(the agent reports "QUEUE_FULL Later")"},
           {Agent::xml("<MTConnectStreams><Header></MTConnectStreams>"), "it is no XML"},
           {Agent::xml(""), "it is no XML"},
           {Agent::xml("{\"a\": 1}"), "it is no XML"},
           {Agent::xml("<html><body>Hello</body></html>"), "it is <html> instead of <MTConnectStreams>"},
           {Agent::xml(probe_document("1")), "it is <MTConnectDevices> instead of <MTConnectStreams>"},
           {Agent::xml("<MTConnectStreams/>", 503), "HTTP status 503"},
           {Agent::xml(std::string((std::size_t{8} << 20) + 1, ' ')), "it is longer than 8 MB"},
           {[](const auto&, auto& response) { response.set_redirect("http://anna:geheim@192.0.2.1/x"); },
            "the agent refers to another address, http://anna:***@192.0.2.1/x"}}) {
    agent.set_current(handler);
    const std::string fault = fault_of(agent);
    EXPECT_TRUE(fault.starts_with("machine_bad_reply")) << fault;
    EXPECT_TRUE(contains(fault, part)) << part << " in " << fault;
    EXPECT_TRUE(contains(fault, "/current")) << fault;
  }
  agent.set_current(Agent::xml(current_document("1", sample("c1", "20"))));
  EXPECT_EQ(fault_of(agent), "ok");
}

TEST(MtConnectDevice, ADeeplyNestedAnswerDoesNoHarm) {
  Agent agent;
  std::string deep = "<MTConnectStreams><Header instanceId=\"1\"/>";
  constexpr int depth = 300000;
  for (int i = 0; i < depth; ++i) deep += "<a>";
  deep += sample("c1", "20");
  for (int i = 0; i < depth; ++i) deep += "</a>";
  agent.set_current(Agent::xml(deep + "</MTConnectStreams>"));
  EXPECT_EQ(fault_of(agent), "ok");
}

TEST(MtConnectDevice, AnAgentThatIsTooSlowIsSilentAndIsReadAgain) {
  Agent agent;
  std::atomic<bool> ended = false;
  DeviceProfile profile = agent.profile();
  profile.timeout_ms = 500;
  const Agent::Handler holds = [&](const auto&, auto& response) {
    eventually([&] { return ended.load(); });
    response.set_content("", "text/xml");
  };
  // A byte now and then: each is in time, the whole is not.
  const Agent::Handler drips = [&](const auto&, auto& response) {
    response.set_chunked_content_provider("text/xml", [&](std::size_t, httplib::DataSink& sink) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      return !ended && sink.write(" ", 1);
    });
  };
  for (const auto& handler : {holds, drips}) {
    agent.set_current(handler);
    const auto device = open_agent(profile, {"c1"});
    const std::string fault = text_of(device->read());
    EXPECT_TRUE(fault.starts_with("machine_silent timeout_ms=500 what=http://127.0.0.1:")) << fault;
    agent.set_current(Agent::xml(current_document("1", sample("c1", "20"))));
    EXPECT_TRUE(eventually([&] { return device->read().has_value(); }));
  }
  ended = true;
}

TEST(MtConnectDevice, AnAnswerThatEndsTooEarlyIsALostLink) {
  Agent agent;
  agent.set_current([](const auto&, auto& response) {
    response.set_content_provider(1000, "text/xml", [](std::size_t offset, std::size_t, httplib::DataSink& sink) {
      return offset == 0 && sink.write("<MTConnectStreams>", 18);
    });
  });
  const std::string fault = fault_of(agent);
  EXPECT_TRUE(fault.starts_with("machine_link_lost")) << fault;
}

TEST(MtConnectDevice, NobodyAtTheAddressIsUnreachable) {
  DeviceProfile profile;
  profile.id = "cnc";
  profile.kind = DeviceKind::mtconnect;
  profile.url = fmt::format("http://127.0.0.1:{}", free_port());
  profile.timeout_ms = 20000;
  const std::string fault = text_of(open_agent(profile, {"c1"})->read());
  EXPECT_TRUE(fault.starts_with("machine_unreachable")) << fault;
  EXPECT_TRUE(contains(fault, "no server answers there")) << fault;
}

TEST(MtConnectDevice, GivesUserAndPasswordWhereTheAgentAsks) {
  const TestFolder folder;
  Agent agent;
  agent.set_current([](const httplib::Request& request, httplib::Response& response) {
    const bool known = request.get_header_value("Authorization") == "Basic YW5uYTpnZWhlaW0=";  // anna:geheim
    Agent::xml(current_document("1", sample("c1", "20")), known ? 200 : 401)(request, response);
  });
  const std::string fault = fault_of(agent);
  EXPECT_TRUE(fault.starts_with("machine_unreachable")) << fault;
  EXPECT_TRUE(contains(fault, "the agent refuses user or password")) << fault;
  DeviceProfile profile = agent.profile();
  profile.credentials_file = folder.write("login.json", R"({"user": "anna", "password": "geheim"})");
  const auto device = open_agent(profile, {"c1"});
  EXPECT_EQ(text_of(device->read()), "ok");
  EXPECT_TRUE(has_remark(*device, "unencrypted"));
}

TEST(MtConnectDevice, AddressesThatAreNotAnAgentsAreRefused) {
  DeviceProfile profile;
  profile.id = "cnc";
  profile.kind = DeviceKind::mtconnect;
  for (const char* url : {"", "host:5000", "ftp://host/", "http://", "http:///x", "http://host:123456/", "http://a b/",
                          "http://host/current?path=x", "http://anna:geheim@host/", "file:///etc/passwd"}) {
    profile.url = url;
    const auto device = open_device(profile, {"c1"});
    ASSERT_FALSE(device) << url;
    EXPECT_EQ(device.error().code, ErrorCode::data_does_not_fit) << url;
    EXPECT_FALSE(contains(describe(device.error()), "geheim"));
  }
  for (const char* url : {"http://host", "http://host:5000", "http://host:5000/VMC-3Axis", "http://[::1]:5000/"}) {
    profile.url = url;
    EXPECT_TRUE(open_device(profile, {"c1"})) << url;
  }
}

}  // namespace zerodrift::controller
