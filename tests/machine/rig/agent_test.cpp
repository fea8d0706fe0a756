// The MTConnect agent's documents, read with a parser of their own.
#include <gtest/gtest.h>

#include <map>
#include <pugixml.hpp>

#include "app/machine/http/loopback_server.h"
#include "app/machine/rig/agent_documents.h"
#include "app/machine/rig/agent_server.h"

namespace zerodrift::machine {
namespace {

const UtcTime noon{std::chrono::milliseconds(1'800'000'000'250)};

struct StreamsDocument {
  pugi::xml_document xml;
  explicit StreamsDocument(const std::string& text) {
    EXPECT_TRUE(xml.load_string(text.c_str())) << text;
    EXPECT_STREQ(root().attribute("xmlns").value(), "urn:mtconnect.org:MTConnectStreams:1.5");
  }
  pugi::xml_node root() const { return xml.child("MTConnectStreams"); }
  std::uint64_t header(const char* name) const { return root().child("Header").attribute(name).as_ullong(); }
  /// The observations by data item; the last one counts.
  std::map<std::string, pugi::xml_node> items() const {
    std::map<std::string, pugi::xml_node> found;
    for (const auto& node : root().select_nodes("//*[@dataItemId]")) {
      found[node.node().attribute("dataItemId").value()] = node.node();
    }
    return found;
  }
};

class AgentDocumentsTest : public ::testing::Test {
 protected:
  AgentDocumentsTest() { documents.observe(machine, noon); }
  Machine machine{build_machine(7)};
  AgentDocuments documents{"uuid-1", 42};
};

TEST_F(AgentDocumentsTest, CurrentHoldsEveryItem) {
  const StreamsDocument document(documents.current(noon));
  EXPECT_EQ(document.header("instanceId"), 42U);
  EXPECT_EQ(document.header("firstSequence"), 1U);
  EXPECT_EQ(document.header("lastSequence"), 11U);
  EXPECT_EQ(document.header("nextSequence"), 12U);
  EXPECT_STREQ(document.root().child("Header").attribute("creationTime").value(), "2027-01-15T08:00:00.250Z");
  const auto items = document.items();
  ASSERT_EQ(items.size(), 11U);
  EXPECT_EQ(items.at("S1speed").text().as_double(), 0.0);
  EXPECT_STREQ(items.at("S1speed").name(), "RotaryVelocity");
  EXPECT_STREQ(items.at("S1speed").parent().parent().attribute("component").value(), "Rotary");
  EXPECT_STREQ(items.at("S1load").name(), "Wattage");
  EXPECT_STREQ(items.at("avail").text().get(), "AVAILABLE");
  for (const char* axis : {"Xact", "Yact", "Zact"}) EXPECT_EQ(items.at(axis).text().as_double(-1.0), 0.0);
  EXPECT_NEAR(items.at("T17").text().as_double(), machine.raw_temperature(17) / 16.0, 0.006);
  EXPECT_NEAR(items.at("room").text().as_double(), machine.raw_temperature(0) / 16.0, 0.006);
  EXPECT_STREQ(items.at("T20").attribute("timestamp").value(), "2027-01-15T08:00:00.250Z");
  EXPECT_GT(items.at("T20").attribute("sequence").as_ullong(), 0U);
}

TEST_F(AgentDocumentsTest, AnObservationIsMadeWhereAValueChanges) {
  machine.motion().move_to({1.0, 0.0, 0.0});
  machine.advance_to(0.5);
  documents.observe(machine, noon + std::chrono::milliseconds(500));
  const auto sample = documents.sample(12, 100, noon);
  ASSERT_TRUE(sample);
  const StreamsDocument document(*sample);
  const auto items = document.items();
  ASSERT_EQ(items.size(), 1U) << "X alone moved, and no second has passed for a temperature";
  EXPECT_EQ(items.at("Xact").text().as_double(), 1.0);
  EXPECT_EQ(items.at("Xact").attribute("sequence").as_ullong(), 12U);
  EXPECT_EQ(document.header("nextSequence"), 13U);
  EXPECT_EQ(StreamsDocument(documents.current(noon)).items().size(), 11U);
}

TEST_F(AgentDocumentsTest, SamplesGoOnFromTheNextSequence) {
  std::uint64_t from = documents.first_sequence();
  std::size_t found = 0;
  for (int i = 0; i < 3; ++i) {
    const auto sample = documents.sample(from, 4, noon);
    ASSERT_TRUE(sample);
    const StreamsDocument document(*sample);
    found += document.items().size();
    from = document.header("nextSequence");
  }
  EXPECT_EQ(found, 11U);
  EXPECT_EQ(from, documents.next_sequence());
  const auto none = documents.sample(from, 4, noon);
  ASSERT_TRUE(none) << "the next one that will be made";
  EXPECT_TRUE(StreamsDocument(*none).items().empty());
}

TEST_F(AgentDocumentsTest, RefusesWhatItDoesNotKeep) {
  EXPECT_EQ(documents.sample(0, 10, noon).error().code, "OUT_OF_RANGE");
  EXPECT_EQ(documents.sample(13, 10, noon).error().code, "OUT_OF_RANGE");
  EXPECT_EQ(documents.sample(1, 0, noon).error().code, "OUT_OF_RANGE");
  EXPECT_EQ(documents.sample(1, AgentDocuments::buffer_size + 1, noon).error().code, "OUT_OF_RANGE");
  pugi::xml_document xml;
  ASSERT_TRUE(xml.load_string(documents.error({"OUT_OF_RANGE", "a < b"}, noon).c_str()));
  const auto error = xml.child("MTConnectError").child("Errors").child("Error");
  EXPECT_STREQ(error.attribute("errorCode").value(), "OUT_OF_RANGE");
  EXPECT_STREQ(error.text().get(), "a < b");
}

TEST_F(AgentDocumentsTest, TheOldestObservationsLeaveTheBuffer) {
  for (int second = 1; documents.next_sequence() < AgentDocuments::buffer_size + 100; ++second) {
    machine.advance_to(second);
    documents.observe(machine, noon);
  }
  EXPECT_EQ(documents.next_sequence() - documents.first_sequence(), AgentDocuments::buffer_size);
  EXPECT_FALSE(documents.sample(1, 10, noon));
  EXPECT_TRUE(documents.sample(documents.first_sequence(), 10, noon));
  EXPECT_EQ(StreamsDocument(documents.current(noon)).items().size(), 11U) << "also what last changed long ago";
}

TEST_F(AgentDocumentsTest, ADeadSensorIsUnavailable) {
  machine.set_sensor_fault({SensorFault::Kind::dead, true, 17});
  machine.advance_to(2.0);
  documents.observe(machine, noon);
  const StreamsDocument document(documents.current(noon));
  EXPECT_STREQ(document.items().at("T17").text().get(), "UNAVAILABLE");
  EXPECT_GT(document.items().at("T18").text().as_double(), 10.0);
}

TEST_F(AgentDocumentsTest, ProbeDescribesEveryItemOfTheStream) {
  pugi::xml_document xml;
  ASSERT_TRUE(xml.load_string(documents.probe(noon).c_str()));
  EXPECT_STREQ(xml.child("MTConnectDevices").attribute("xmlns").value(), "urn:mtconnect.org:MTConnectDevices:1.5");
  const StreamsDocument stream(documents.current(noon));
  std::size_t described = 0;
  for (const auto& found : xml.select_nodes("//DataItem")) {
    const auto items = stream.items();
    const auto at = items.find(found.node().attribute("id").value());
    ASSERT_NE(at, items.end()) << found.node().attribute("id").value();
    EXPECT_STREQ(found.node().parent().parent().attribute("id").value(),
                 at->second.parent().parent().attribute("componentId").value());
    ++described;
  }
  EXPECT_EQ(described, 11U);
}

TEST(AgentServer, AnswersWithTheMachineOfThisMoment) {
  LiveMachine machine(build_machine(7), 240, {});
  machine.start();
  const auto server = AgentServer::start(machine, 1.0 / 240);
  ASSERT_TRUE(server);
  httplib::Client client("127.0.0.1", (*server)->port());
  machine.with([](Machine& now) {
    now.motion().move_to({2.5, -1.25, 0.0});
    now.advance_to(now.time_s() + 1.0);
  });
  const auto current = client.Get("/current");
  ASSERT_TRUE(current);
  EXPECT_EQ(current->status, 200);
  const StreamsDocument document(current->body);
  EXPECT_EQ(document.items().at("Xact").text().as_double(), 2.5);
  EXPECT_EQ(document.items().at("Yact").text().as_double(), -1.25);
  const auto sample = client.Get("/sample?from=1&count=5");
  ASSERT_TRUE(sample);
  EXPECT_EQ(StreamsDocument(sample->body).items().size(), 5U);
  EXPECT_EQ(client.Get("/")->body.find("MTConnectStreams"), std::string::npos);
  EXPECT_EQ(client.Get("/sample?from=99999999")->status, 404);
  EXPECT_EQ(client.Get("/sample?from=abc")->status, 400);
  EXPECT_EQ(client.Get("/sample?count=-3")->status, 400);
  const auto other = client.Get("/assets");
  EXPECT_EQ(other->status, 404);
  EXPECT_NE(other->body.find("MTConnectError"), std::string::npos);
  machine.stop();
}

}  // namespace
}  // namespace zerodrift::machine
