#include "core/compensation/table.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/base/hash.h"
#include "core/base/json.h"
#include "core/compensation/interlock.h"
#include "core/compensation/sign.h"

namespace zerodrift::compensation {
namespace {

Table sample() {
  Table table;
  table.machine = "VMC";
  table.version = 3;
  AxisTable& z = table.axes["Z"];
  z.offset_um = 1.0;
  z.terms = {{"T3_C", 2.0, 20.0, 10.0}, {"ambient_C", -1.0, 20.0, 0.0}};
  z.points = {{0.0, 0.0, 1.0, 0.0}, {100.0, 10.0, 12.0, 0.5}};
  z.max_um = 30.0;
  table.valid["T3_C"] = {18.0, 41.0};
  return table;
}

}  // namespace

TEST(Sign, IsStatedOnce) {
  EXPECT_DOUBLE_EQ(error_from_positions_um(100.010, 100.0), 1000.0 * (100.010 - 100.0));
  EXPECT_DOUBLE_EQ(compensation_from_error_um(10.0), -10.0);
}

TEST(Interlock, ForbidsWhatWouldBeWrong) {
  EXPECT_TRUE(allow_model_measurement(false));
  EXPECT_EQ(allow_model_measurement(true).error().code, ErrorCode::interlock_compensation_on);
  EXPECT_TRUE(allow_staging(false));
  EXPECT_EQ(allow_staging(true).error().code, ErrorCode::interlock_compensation_on);
  EXPECT_TRUE(allow_offset_write(true));
  EXPECT_EQ(allow_offset_write(false).error().code, ErrorCode::interlock_compensation_off);
}

TEST(Table, EvaluatesTermsSlopeAndPoints) {
  const Table table = sample();
  const Temperatures t{{"T3_C", 24.0}, {"ambient_C", 21.0}};
  // 1 + (2 + 10 * 0.05) * 4 - 1 * 1 + 5 (up) + 0.25 * 4
  EXPECT_DOUBLE_EQ(error_um(table, "Z", 50.0, Approach::up, t).value(), 1.0 + 2.5 * 4.0 - 1.0 + 5.0 + 0.25 * 4.0);
  EXPECT_DOUBLE_EQ(error_um(table, "Z", 50.0, Approach::down, t).value(), 1.0 + 2.5 * 4.0 - 1.0 + 6.5 + 0.25 * 4.0);
  EXPECT_DOUBLE_EQ(
      compensation_um(table.axes.at("Z"), -10.0, Approach::up, {{"T3_C", 20.0}, {"ambient_C", 20.0}}).value(), -1.0);
  EXPECT_DOUBLE_EQ(error_um(table, "Z", 1e4, Approach::up, t).value(), 30.0);  // limited
  EXPECT_DOUBLE_EQ(error_um(table, "X", 1e4, Approach::up, t).value(), 0.0);
}

TEST(Table, MissingAndDeadSensorsAreNamed) {
  const Table table = sample();
  EXPECT_EQ(error_um(table, "Z", 0.0, Approach::up, {{"T3_C", 20.0}}).error().code, ErrorCode::channel_missing);
  EXPECT_EQ(error_um(table, "Z", 0.0, Approach::up, {{"T3_C", std::nan("")}}).error().code, ErrorCode::sensor_dead);
  EXPECT_EQ(outside_valid_range(table, {{"T3_C", 43.1}}),
            (std::vector<std::string>{"T3_C 43.10 C (valid 18.00 to 41.00)"}));
  EXPECT_TRUE(outside_valid_range(table, {{"T3_C", 30.0}}).empty());
  EXPECT_EQ(sensors_of(table), (std::vector<std::string>{"T3_C", "ambient_C"}));
}

TEST(Table, SteepCoefficientsAreNamed) {
  Table table = sample();
  EXPECT_TRUE(check_steepness(table, 50.0));
  table.axes["Z"].max_um_per_K = 1.0;
  const auto steep = check_steepness(table, 50.0);
  ASSERT_FALSE(steep);
  EXPECT_EQ(steep.error().code, ErrorCode::limit_exceeded);
  EXPECT_NE(steep.error().context.at("what").find("axis Z"), std::string::npos);
  EXPECT_EQ(table_from_json(to_json(table), "t.json")->axes.at("Z").max_um_per_K, 1.0);
}

TEST(Table, JsonRoundTripAndCheckSum) {
  const Table table = sample();
  const auto document = to_json(table);
  std::vector<std::string> warnings;
  const auto back = table_from_json(nlohmann::json::parse(document.dump()), "t.json", &warnings);
  ASSERT_TRUE(back) << describe(back.error());
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(to_json(*back), document);
  auto edited = document;
  edited["axes"]["Z"]["temperature"]["offset_um"] = 2.0;
  const auto refused = table_from_json(edited, "t.json", &warnings);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::json_bad_value);
  EXPECT_EQ(refused.error().context.at("key"), "crc32");
  edited["crc32"] = 17;
  EXPECT_FALSE(table_from_json(edited, "t.json", &warnings));
  edited.erase("crc32");  // made by hand
  EXPECT_TRUE(table_from_json(edited, "t.json", &warnings));
  // Of a version that knew fewer keys.
  auto older = document;
  older["axes"]["Z"]["limits"].erase("max_um_per_K");
  older.erase("crc32");
  older["crc32"] = fmt::format("{:08x}", crc32_of(json_text(older)));
  EXPECT_TRUE(table_from_json(older, "t.json", &warnings));
}

// Names in files for controllers may hold any bytes; found by fuzzing.
TEST(Table, BytesThatAreNoTextBecomeTextInJson) {
  Table table = sample();
  table.machine = "Mill \xff\xfe";
  std::vector<std::string> warnings;
  const auto back = table_from_json(nlohmann::json::parse(json_text(to_json(table))), "t.json", &warnings);
  ASSERT_TRUE(back) << describe(back.error());
  EXPECT_TRUE(warnings.empty());  // the check sum is the written text's
  EXPECT_EQ(back->machine, "Mill \xef\xbf\xbd\xef\xbf\xbd");
}

TEST(Table, ReadsTheContractsExample) {
  const auto document = nlohmann::json::parse(R"({"format": "zerodrift-table/1", "machine": "...", "version": 3,
    "axes": {"X": {"segments": [{"from_mm": 0, "to_mm": 80, "a": 1.00017, "b_mm": -0.0014667, "r": 0.987, "points": 9}],
    "points": [{"position_mm": 0, "error_up_um": 0.0, "error_down_um": 0.0, "um_per_K": 0.0}],
    "temperature": {"offset_um": 0.0, "terms": [{"sensor": "T3_C", "um_per_K": 2.1, "reference_C": 20.0}],
    "slope_um_per_m_per_K": [], "reference_position_mm": 0}, "limits": {"max_um": 200, "max_um_per_s": 2}}},
    "valid": {"T3_C": [18, 41]}})");
  std::vector<std::string> warnings;
  const auto table = table_from_json(document, "t.json", &warnings);
  ASSERT_TRUE(table) << describe(table.error());
  EXPECT_TRUE(warnings.empty());
  EXPECT_DOUBLE_EQ(error_um(*table, "X", 0.0, Approach::up, {{"T3_C", 22.0}}).value(), 4.2);
}

TEST(Table, FaultsNameFileAndKey) {
  auto document = to_json(sample());
  document["axes"]["Z"]["points"][1]["position_mm"] = -5.0;
  const auto table = table_from_json(document, "t.json");
  ASSERT_FALSE(table);
  EXPECT_EQ(table.error().context.at("key"), "axes.Z.points[1].position_mm");
  document = to_json(sample());
  document["axes"]["Q"] = nlohmann::json::object();
  EXPECT_FALSE(table_from_json(document, "t.json"));
}

TEST(Table, DifferenceFindsTheLargestChange) {
  Table changed = sample();
  changed.axes["Z"].points[1].error_up_um = 4.0;
  changed.axes["X"].offset_um = 3.0;
  const auto rows = difference(sample(), changed, {{"T3_C", 20.0}, {"ambient_C", 20.0}}, {{"Z", 100.0}});
  ASSERT_TRUE(rows) << describe(rows.error());
  ASSERT_EQ(rows->size(), 2U);
  EXPECT_EQ((*rows)[0].axis, "X");
  EXPECT_DOUBLE_EQ((*rows)[0].largest_um, 3.0);
  EXPECT_DOUBLE_EQ((*rows)[1].largest_um, 6.0);
  EXPECT_DOUBLE_EQ((*rows)[1].largest_at_mm, 100.0);
  EXPECT_DOUBLE_EQ((*rows)[1].curve.back().old_up_um, -11.0);
}

}  // namespace zerodrift::compensation
