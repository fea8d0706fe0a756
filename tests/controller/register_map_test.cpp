#include "core/controller/register_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/controller/register_names.h"
#include "core/controller/register_view.h"
#include "tests/controller/fake_controller.h"

namespace zerodrift::controller {
namespace {

Register entry(RegisterType type) {
  Register out;
  out.name = "r";
  out.type = type;
  return out;
}

using Words = std::vector<std::uint16_t>;

}  // namespace

TEST(RegisterMap, FloatsInEveryOrder) {
  Register r = entry(RegisterType::float32);
  EXPECT_EQ(encode(r, 123456.0).value(), (Words{0x47F1, 0x2000}));
  r.high_word_first = false;
  EXPECT_EQ(encode(r, 123456.0).value(), (Words{0x2000, 0x47F1}));
  r.high_byte_first = false;
  EXPECT_EQ(encode(r, 123456.0).value(), (Words{0x0020, 0xF147}));
  EXPECT_DOUBLE_EQ(decode(r, Words{0x0020, 0xF147}), 123456.0);
}

TEST(RegisterMap, IntegersScaleSignAndMissing) {
  Register r = entry(RegisterType::int16);
  r.scale = 0.0625;
  r.missing_raw = -32768;
  EXPECT_EQ(encode(r, -1.5).value(), (Words{0xFFE8}));
  EXPECT_DOUBLE_EQ(decode(r, Words{0xFFE8}), -1.5);
  EXPECT_TRUE(std::isnan(decode(r, Words{0x8000})));
  r.sign = -1;
  EXPECT_DOUBLE_EQ(decode(r, Words{0xFFE8}), 1.5);
  EXPECT_EQ(encode(r, 1e6).error().code, ErrorCode::limit_exceeded);
  Register u = entry(RegisterType::uint32);
  EXPECT_EQ(encode(u, 4294967295.0).value(), (Words{0xFFFF, 0xFFFF}));
  EXPECT_DOUBLE_EQ(decode(u, Words{0xFFFF, 0xFFFE}), 4294967294.0);
  Register i = entry(RegisterType::int32);
  EXPECT_DOUBLE_EQ(decode(i, encode(i, -70000.0).value()), -70000.0);
  EXPECT_FALSE(encode(i, std::nan("")).has_value());
}

TEST(RegisterMap, TheShippedMapIsTheDocumentedOne) {
  const auto map = load_register_map("zerodrift-virtual");
  ASSERT_TRUE(map) << describe(map.error());
  EXPECT_EQ(map->require("table_active")->address, 4000);
  EXPECT_EQ(map->require("temperature_C")->words(), 20);
  EXPECT_EQ(map->require("nothing").error().code, ErrorCode::machine_register_unknown);
  const auto spans = plan_reads(*map, {map->find("clock_s"), map->find("temperature_C"), map->find("probe_um")});
  ASSERT_EQ(spans.size(), 2U);
  EXPECT_EQ(spans[0].address, 8);
  EXPECT_EQ(spans[0].count, 112);
}

TEST(RegisterMap, BaseOneAndDefaults) {
  const auto document = nlohmann::json::parse(R"({"format": "zerodrift-register-map/1", "name": "plc", "base": 1,
      "word_order": "low_first", "registers": {"temperature_C": {"function": "input", "address": 1, "type": "float32"}}})");
  const auto map = register_map_from_json(document, "plc.json");
  ASSERT_TRUE(map) << describe(map.error());
  const Register r = map->require("temperature_C").value();
  EXPECT_EQ(r.address, 0);
  EXPECT_EQ(r.space, RegisterSpace::input);
  EXPECT_FALSE(r.high_word_first);
}

TEST(RegisterMap, FaultsNameFileAndKey) {
  const auto document = nlohmann::json::parse(
      R"({"format": "zerodrift-register-map/1", "name": "plc", "registers": {"a": {"address": 70000}}})");
  const auto map = register_map_from_json(document, "plc.json");
  ASSERT_FALSE(map);
  EXPECT_EQ(map.error().context.at("file"), "plc.json");
  EXPECT_EQ(map.error().context.at("key"), "registers.a.address");
}

TEST(RegisterMap, WrittenAndReadBack) {
  for (const char* name : {"zerodrift-virtual", "linuxcnc-gateway", "virtual-rig-control", "temperature-module-8-pt100",
                           "temperature-module-8-ds18b20", "probe-amplifier"}) {
    const auto map = load_register_map(name);
    ASSERT_TRUE(map) << describe(map.error());
    const auto document = to_json(*map);
    const auto back = register_map_from_json(document, "map.json");
    ASSERT_TRUE(back) << describe(back.error());
    EXPECT_EQ(to_json(*back), document);
    EXPECT_EQ(back->registers.size(), map->registers.size());
    for (const auto& [entry, value] : map->registers) EXPECT_NE(find_register_name(entry), nullptr) << entry;
  }
  for (const auto& use : uses_of(*load_register_map("zerodrift-virtual"))) EXPECT_TRUE(use.missing.empty()) << use.use;
}

// Every register of a live device, decoded; one that it refuses does not hide the others.
TEST(RegisterMap, EveryValueLive) {
  FakeController device;
  auto map = load_register_map("zerodrift-virtual").value();
  Link link(device.profile().controller);
  const auto all = read_all(link, map);
  ASSERT_EQ(all.size(), map.registers.size());
  for (const auto& one : all) EXPECT_TRUE(one.result) << one.name;
  const auto magic = std::find_if(all.begin(), all.end(), [](const auto& one) { return one.name == "magic"; });
  EXPECT_EQ(text_of(*magic, map.registers.at("magic")), std::to_string(*map.magic));
  map.registers["far_away"] = map.registers.at("magic");
  map.registers["far_away"].name = "far_away";
  map.registers["far_away"].address = 65000;
  const auto with_bad = read_all(link, map);
  ASSERT_EQ(with_bad.size(), map.registers.size());
  int refused = 0;
  for (const auto& one : with_bad) refused += one.result ? 0 : 1;
  EXPECT_LE(refused, 1);
}

}  // namespace zerodrift::controller
