#include "core/recording/import/header_map.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/recording/import/units.h"

namespace zerodrift::recording {

TEST(HeaderMap, ReadsTheContractsExample) {
  const char* text = R"json({"columns": {"Temp 1 (degC)": {"channel": "T1_C"},
    "CH5": {"channel": "dZ_um", "scale": 1000, "offset": 0, "unit": "mm"}, "Remark": null},
    "time": {"column": "Time", "format": "%d.%m.%Y %H:%M:%S", "unit": "s"}})json";
  const auto map = header_map_from_json(nlohmann::json::parse(text), "map.json", nullptr);
  ASSERT_TRUE(map.has_value()) << describe(map.error());
  EXPECT_EQ(map->columns.at("CH5")->scale, 1000.0);
  EXPECT_FALSE(map->columns.at("Remark").has_value());
  EXPECT_EQ(map->time.columns, std::vector<std::string>{"Time"});
  EXPECT_EQ(header_map_from_json(to_json(*map), "again", nullptr)->columns.size(), 3U);
}

TEST(HeaderMap, FindsColumnsByNameLabelAndPlace) {
  HeaderMap map;
  map.columns = {
      {"CH1", ColumnRule{"T1_C", {}, {}, {}}}, {"#3", ColumnRule{"T3_C", {}, {}, {}}}, {"PROBE", std::nullopt}};
  EXPECT_EQ((*map.rule_for("CH1", "", 0))->channel, "T1_C");
  EXPECT_EQ((*map.rule_for("x", "", 2))->channel, "T3_C");
  EXPECT_FALSE(map.rule_for("CH6", "PROBE", 5)->has_value());
  EXPECT_EQ(map.rule_for("y", "", 7), nullptr);
  EXPECT_EQ(map.names_without_column({"CH1", "b"}, {"", ""}), (std::vector<std::string>{"#3", "PROBE"}));
}

TEST(HeaderMap, FaultsAreNamed) {
  for (const char* text :
       {R"({"columns": {"a": {"unit": "mm"}}})", R"({"columns": {"a": {"channel": "b", "unit": "furlong"}}})",
        R"({"columns": {"a": {"channel": "b", "scale": 0}}})", R"({"time": {"unit": "mm"}})", R"({"decimal": ";"})"}) {
    EXPECT_FALSE(header_map_from_json(nlohmann::json::parse(text), "map.json", nullptr).has_value()) << text;
  }
}

TEST(Units, AreReadFromNames) {
  struct Case {
    const char* header;
    const char* name;
    const char* suffix;
    double scale;
    double offset;
  };
  for (const Case& one :
       {Case{"Temp 1 (degC)", "Temp 1", "C", 1, 0}, Case{"101 (C)", "101", "C", 1, 0},
        Case{"T / \xC2\xB0"
             "C",
             "T", "C", 1, 0},
        Case{"T1_F", "T1", "C", 5.0 / 9.0, -160.0 / 9.0}, Case{"Motor [K]", "Motor", "C", 1, -273.15},
        Case{"Probe \xC2\xB5m", "Probe", "um", 1, 0}, Case{"Probe [\xCE\xBCin]", "Probe", "um", 0.0254, 0},
        Case{"dZ (mil)", "dZ", "um", 25.4, 0}, Case{"dZ_mm", "dZ", "um", 1000, 0}, Case{"n [1/s]", "n", "rpm", 60, 0},
        Case{"feed_X_mm_min", "feed_X", "mm_min", 1, 0}, Case{"P (kW)", "P", "W", 1000, 0},
        Case{"Temp, \xC2\xB0"
             "C (LGR S/N: 1, SEN S/N: 1, LBL: Bearing)",
             "Bearing", "C", 1, 0},
        Case{"Temperatur in \xC2\xB0"
             "C",
             "Temperatur", "C", 1, 0}}) {
    const NameWithUnit split = split_unit(one.header);
    EXPECT_EQ(split.name, one.name) << one.header;
    const auto unit = unit_from(split.unit);
    ASSERT_TRUE(unit.has_value()) << one.header;
    EXPECT_EQ(unit->suffix, one.suffix) << one.header;
    EXPECT_NEAR(unit->scale, one.scale, 1e-12) << one.header;
    EXPECT_NEAR(unit->offset, one.offset, 1e-9) << one.header;
  }
  for (const char* name : {"Motor C", "Zone F", "Temp 1", "execution", "CH1", "a_b"}) {
    EXPECT_EQ(split_unit(name).unit, "") << name;
  }
}

}  // namespace zerodrift::recording
