// The operator's endpoint: each knob does what it says, and nothing else is taken.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "app/machine/http/loopback_server.h"
#include "app/machine/rig/operator_endpoint.h"
#include "core/base/json.h"
#include "core/compensation/table.h"

namespace zerodrift::machine {
namespace {

using nlohmann::json;

class OperatorTest : public ::testing::Test {
 protected:
  void SetUp() override {
    auto started = OperatorEndpoint::start(machine);
    ASSERT_TRUE(started);
    endpoint = std::move(*started);
    client.emplace("127.0.0.1", endpoint->port());
    machine.start();
  }
  void TearDown() override {
    endpoint.reset();
    machine.stop();
  }
  struct Reply {
    int status;
    json body;
  };
  Reply post_text(const std::string& path, const std::string& body) {
    const auto result = client->Post(path.c_str(), body, "application/json");
    return result ? Reply{result->status, json::parse(result->body)} : Reply{0, {}};
  }
  Reply post(const std::string& path, const json& body) { return post_text(path, json_text(body)); }
  json state() { return json::parse(client->Get("/state")->body); }

  static compensation::Table table(double um_per_K = -3.0) {
    compensation::Table one;
    one.machine = "Virtual five-axis";
    one.version = 7;
    compensation::AxisTable axis;
    axis.offset_um = 1.5;
    axis.terms.push_back({"T3_C", um_per_K, 20.0, 0.0});
    axis.terms.push_back({"ambient_C", 0.5, 20.0, 0.0});
    one.axes["Z"] = axis;
    return one;
  }

  LiveMachine machine{build_machine(7), 240, {}};
  std::unique_ptr<OperatorEndpoint> endpoint;
  std::optional<httplib::Client> client;
};

const json done = {{"done", true}};

TEST_F(OperatorTest, AnswersWhenTheSpindleTurns) {
  EXPECT_EQ(post("/spindle", {{"rpm", 3000}}).body, done);
  EXPECT_NEAR(state()["rpm"], 3000.0, 0.5);
  EXPECT_EQ(post("/spindle", {{"rpm", 0}}).body, done);
  EXPECT_EQ(state()["rpm"], 0.0);
}

TEST_F(OperatorTest, AnswersWhenTheAxesAreThere) {
  EXPECT_EQ(post("/move", {{"X", 100.5}, {"Y", -20}, {"Z", 3}}).body, done);
  const json now = state();
  EXPECT_EQ(now["position_mm"], (json{{"X", 100.5}, {"Y", -20.0}, {"Z", 3.0}}));
  EXPECT_EQ(now["moving"], false);
}

TEST_F(OperatorTest, SwitchesCoolantAndCycle) {
  EXPECT_EQ(post("/coolant", {{"on", true}}).body, done);
  EXPECT_EQ(post("/cycle", {{"on", true}}).body, done);
  EXPECT_EQ(state()["coolant_on"], true);
  EXPECT_EQ(state()["cycle"], true);
  EXPECT_EQ(post("/cycle", {{"on", false}}).body, done);
  EXPECT_EQ(state()["cycle"], false);
}

TEST_F(OperatorTest, RefusesWrongBodiesWithASentence) {
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"/spindle", ""},
      {"/spindle", "{"},
      {"/spindle", "[1]"},
      {"/spindle", R"({"rpm": "fast"})"},
      {"/spindle", R"({"rpm": 8001})"},
      {"/spindle", R"({"speed": 100})"},
      {"/spindle", R"({"rpm": 100, "direction": 1})"},
      {"/coolant", R"({"on": 1})"},
      {"/coolant", R"({})"},
      {"/cycle", R"({"on": null})"},
      {"/move", R"({"X": 0, "Y": 0})"},
      {"/move", R"({"X": 0, "Y": 0, "Z": 201})"},
      {"/compensation", R"({"on": "yes"})"},
      {"/offset", R"({"X": 201, "Y": 0, "Z": 0})"},
      {"/table", R"({"format": "zerodrift-table/2", "axes": {}})"},
  };
  for (const auto& [path, body] : wrong) {
    const Reply reply = post_text(path, body);
    EXPECT_EQ(reply.status, 400) << path << ' ' << body;
    const auto sentence = reply.body.value("error", "");
    EXPECT_TRUE(sentence.ends_with(".")) << sentence;
  }
  EXPECT_EQ(state()["rpm"], 0.0);
  EXPECT_EQ(state()["coolant_on"], false);
}

TEST_F(OperatorTest, AnOffsetActsWhileTheCompensationIsOn) {
  const auto applied_um = [&] {
    return machine.with([](const Machine& now) { return now.compensator().applied_um(0); });
  };
  EXPECT_EQ(post("/offset", {{"X", 30}, {"Y", 0}, {"Z", 0}}).body, done);
  EXPECT_EQ(applied_um(), 0.0) << "the compensation is off";
  EXPECT_EQ(post("/compensation", {{"on", true}}).body, done);
  EXPECT_DOUBLE_EQ(applied_um(), 30.0);
  machine.with([](Machine& now) { now.advance_to(now.time_s() + 60.0); });
  EXPECT_DOUBLE_EQ(applied_um(), 30.0) << "no watchdog waits for a host";
  EXPECT_EQ(post("/offset", {{"X", 0}, {"Y", 0}, {"Z", 0}}).body, done);
  EXPECT_EQ(applied_um(), 0.0);
  EXPECT_EQ(post("/offset", {{"X", 10}, {"Y", 0}, {"Z", 0}}).body, done);
  EXPECT_EQ(post("/compensation", {{"on", false}}).body, done);
  machine.with([](Machine& now) { now.advance_to(now.time_s() + 30.0); });
  EXPECT_EQ(applied_um(), 0.0);
  EXPECT_EQ(state()["offset_um"]["X"], 10.0) << "it is kept for the next time";
  EXPECT_EQ(state()["compensation_on"], false);
}

TEST_F(OperatorTest, TakesATableAndShowsItsCheckValues) {
  EXPECT_EQ(state()["check"], "");
  const compensation::Table one = table();
  const Reply reply = post("/table", compensation::to_json(one));
  ASSERT_EQ(reply.status, 200) << reply.body;
  EXPECT_EQ(reply.body["done"], true);
  EXPECT_EQ(reply.body["check"], compensation::to_json(one)["crc32"]);
  EXPECT_EQ(reply.body["version"], 7);
  const json now = state();
  EXPECT_EQ(now["check"], reply.body["check"]);
  EXPECT_EQ(now["check_words"], reply.body["check_words"]);
  machine.with([](const Machine& m) {
    ASSERT_EQ(m.compensator().table().size(), 1U);
    const AxisRecord& record = m.compensator().table().front();
    EXPECT_EQ(record.axis, 2);
    EXPECT_EQ(record.offset_um, -1.5) << "a compensation is the error turned";
    ASSERT_EQ(record.terms.size(), 2U);
    EXPECT_EQ(record.terms[0].sensor, 3);
    EXPECT_EQ(record.terms[0].um_per_K, 3.0);
    EXPECT_EQ(record.terms[1].sensor, 0);
  });
}

TEST_F(OperatorTest, KeepsItsTableWhenItRefusesAnother) {
  ASSERT_EQ(post("/table", compensation::to_json(table())).status, 200);
  const json before = state();
  json changed = compensation::to_json(table());
  changed["version"] = 8;
  EXPECT_EQ(post("/table", changed).status, 400) << "its check sum does not fit";
  const Reply steep = post("/table", compensation::to_json(table(-80.0)));
  EXPECT_EQ(steep.status, 409) << "beyond the control's 50 um/K";
  EXPECT_TRUE(steep.body["error"].get<std::string>().ends_with("."));
  compensation::Table foreign = table();
  foreign.axes["Z"].terms[0].sensor = "T21_C";
  EXPECT_EQ(post("/table", compensation::to_json(foreign)).status, 400) << "no such sensor";
  ASSERT_EQ(post("/compensation", {{"on", true}}).body, done);
  EXPECT_EQ(post("/table", compensation::to_json(table(-2.0))).status, 409) << "the compensation is on";
  EXPECT_EQ(state()["check"], before["check"]);
  EXPECT_EQ(state()["check_words"], before["check_words"]);
}

TEST(OperatorEndpoint, SaysWhenTheAxesWereSentElsewhere) {
  LiveMachine machine(build_machine(7), 1, {});  // the way to X 300 takes 0.9 s
  const auto endpoint = OperatorEndpoint::start(machine);
  ASSERT_TRUE(endpoint);
  machine.start();
  std::jthread other([port = (*endpoint)->port()] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    httplib::Client("127.0.0.1", port).Post("/cycle", R"({"on": true})", "application/json");
  });
  httplib::Client client("127.0.0.1", (*endpoint)->port());
  const auto reply = client.Post("/move", R"({"X": 300, "Y": 0, "Z": 0})", "application/json");
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->status, 409);
  EXPECT_NE(reply->body.find("sent elsewhere"), std::string::npos);
  machine.stop();
}

}  // namespace
}  // namespace zerodrift::machine
