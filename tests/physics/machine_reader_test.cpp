#include <gtest/gtest.h>

#include "tests/physics/machines.h"

namespace zerodrift::physics {
namespace {

using nlohmann::json;
using test::spindle_json;

Error error_of(const json& document) {
  auto machine = machine_from_json(document, "m.json");
  EXPECT_FALSE(machine.has_value());
  return machine ? Error{} : machine.error();
}

}  // namespace

TEST(MachineReader, ReadsTheContractsExample) {
  const Machine m = test::spindle();
  ASSERT_EQ(m.components.size(), 1u);
  EXPECT_EQ(m.components[0].sources.size(), 2u);
  EXPECT_EQ(m.room.channel, "ambient_C");
  EXPECT_DOUBLE_EQ(m.effect("convection")->number_or("h_W_m2K", 0), 12.0);
  EXPECT_DOUBLE_EQ(m.rated_speed_rpm(), 8000.0);
}

TEST(MachineReader, TolerancesSmallerThanAnybodyKnowsAreRaised) {
  json document = spindle_json();
  document["tolerances"] = {{"conductivity", 1e-6}, {"film", 0.15}, {"heat_source_power", 1e-6}};
  const auto machine = machine_from_json(document, "m.json");
  ASSERT_TRUE(machine.has_value());
  EXPECT_DOUBLE_EQ(machine->tolerances.conductivity, 0.01);
  EXPECT_DOUBLE_EQ(machine->tolerances.heat_source_power, 0.02);
  EXPECT_DOUBLE_EQ(machine->tolerances.film, 0.15);
  EXPECT_EQ(machine->tolerances.raised, (std::vector<std::string>{"conductivity", "heat_source_power"}));
  EXPECT_TRUE(test::spindle().tolerances.raised.empty());
}

TEST(MachineReader, NamesFileKeyAndExpectation) {
  json document = spindle_json();
  document["components"][0].erase("length_mm");
  const Error error = error_of(document);
  EXPECT_EQ(error.code, ErrorCode::json_missing_key);
  EXPECT_EQ(error.context.at("file"), "m.json");
  EXPECT_EQ(error.context.at("key"), "components[0].length_mm");
  EXPECT_NE(error.context.at("expected").find("mm"), std::string::npos);
}

TEST(MachineReader, RefusesUnitsOffByAThousand) {
  const auto with = [](const std::string& pointer, double value) {
    json document = spindle_json();
    document[json::json_pointer(pointer)] = value;
    return error_of(document);
  };
  EXPECT_NE(with("/components/0/length_mm", 0.4).context.at("expected").find("metres"), std::string::npos);
  EXPECT_EQ(with("/components/0/material/conductivity_W_mK", 0.044).context.at("key"),
            "components[0].material.conductivity_W_mK");
  EXPECT_EQ(with("/components/0/material/conductivity_W_mK", 44000).code, ErrorCode::json_bad_value);
  EXPECT_EQ(with("/components/0/material/density_kg_m3", 7.85).code, ErrorCode::json_bad_value);
  EXPECT_EQ(with("/components/0/material/heat_capacity_J_kgK", 460000).code, ErrorCode::json_bad_value);
  EXPECT_EQ(with("/components/0/material/expansion_1_K", 11.5).code, ErrorCode::json_bad_value);
  EXPECT_NE(with("/components/0/heat_sources/0/rated_power_W", 5.5).context.at("expected").find("kW"),
            std::string::npos);
  EXPECT_NE(with("/initial_temperature_C", 293.15).context.at("expected").find("kelvin"), std::string::npos);
}

TEST(MachineReader, RefusesASensorOutsideItsComponent) {
  json document = spindle_json();
  document["sensors"][2]["position_mm"] = 500;
  const Error error = error_of(document);
  EXPECT_EQ(error.context.at("key"), "sensors[2].position_mm");
  EXPECT_NE(error.context.at("expected").find("0 to 400 mm"), std::string::npos);
  document = spindle_json();
  document["sensors"][2]["component"] = "spindel";
  EXPECT_NE(error_of(document).context.at("expected").find("spindle"), std::string::npos);
}

TEST(MachineReader, KeepsUnknownKeysWithAWarning) {
  json document = spindle_json();
  document["components"][0]["colour"] = "green";
  std::vector<std::string> warnings;
  const auto machine = machine_from_json(document, "m.json", &warnings);
  ASSERT_TRUE(machine.has_value());
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("colour"), std::string::npos);
  EXPECT_EQ(to_json(*machine)["components"][0]["colour"], "green");
}

TEST(MachineReader, RefusesAnUnknownEffectAndNamesThoseItKnows) {
  json document = spindle_json();
  document["effects"] = {"convexion"};
  EXPECT_NE(error_of(document).context.at("expected").find("convection"), std::string::npos);
}

TEST(MachineReader, RefusesWhatPhysicsForbidsOfAnEffect) {
  const auto with = [](const std::string& effect, const std::string& key, double value) {
    json document = spindle_json();
    document["effects"] = {effect};
    document["effect_parameters"] = {{effect, {{key, value}}}};
    return document;
  };
  Error error = error_of(with("convection", "h_W_m2K", -12));
  EXPECT_EQ(error.code, ErrorCode::json_bad_value);
  EXPECT_EQ(error.context.at("file"), "m.json");
  EXPECT_EQ(error.context.at("key"), "effect_parameters.convection.h_W_m2K");
  EXPECT_EQ(error.context.at("found"), "-12");
  EXPECT_EQ(error.context.at("expected"), "a number of 0 or more");
  EXPECT_NE(error_of(with("radiation", "emissivity", 1.2)).context.at("expected").find("0 to 1"), std::string::npos);
  EXPECT_EQ(error_of(with("radiation", "emissivity", -0.1)).code, ErrorCode::json_bad_value);
  EXPECT_EQ(error_of(with("sensor_lag", "lag_s", -60)).code, ErrorCode::json_bad_value);
  EXPECT_EQ(error_of(with("coolant", "conductance_W_K", -1)).code, ErrorCode::json_bad_value);
  EXPECT_EQ(error_of(with("heater_body", "heat_capacity_J_K", -5)).code, ErrorCode::json_bad_value);
  EXPECT_EQ(error_of(with("contact_resistance", "resistance_m2K_W", -1e-4)).code, ErrorCode::json_bad_value);
  json beyond = with("extra_heat_source", "power_W", 20);
  beyond["effect_parameters"]["extra_heat_source"]["position_mm"] = 900;
  EXPECT_NE(error_of(beyond).context.at("expected").find("0 to 400 mm"), std::string::npos);
  // The second of a list is named as such.
  json list = spindle_json();
  list["effects"] = {"sensor_lag", "sensor_lag"};
  list["effect_parameters"] = {{"sensor_lag", {{{"lag_s", 60}}, {{"lag_s", -1}}}}};
  EXPECT_EQ(error_of(list).context.at("key"), "effect_parameters.sensor_lag[1].lag_s");
  // A source may cool, an offset and a growth have either sign, a film may be far above the usual.
  for (const json& unusual : {with("extra_heat_source", "power_W", -20), with("convection", "h_W_m2K", 5000),
                              with("convection", "h_W_m2K", 0), with("sensor_offset", "offset_K", -3),
                              with("structure_ambient", "um_per_K", -4)}) {
    EXPECT_TRUE(machine_from_json(unusual, "m.json")) << unusual["effect_parameters"];
  }
}

TEST(MachineReader, WritesWhatItReads) {
  Machine machine = test::spindle();
  machine.components[0].material.conductivity_W_mK = 41.5;
  machine.effects[0].numbers["h_W_m2K"] = 15.25;
  const auto again = machine_from_json(to_json(machine), "again.json");
  ASSERT_TRUE(again.has_value());
  EXPECT_DOUBLE_EQ(again->components[0].material.conductivity_W_mK, 41.5);
  EXPECT_DOUBLE_EQ(again->effect("convection")->number_or("h_W_m2K", 0), 15.25);
}

/// A rod grows along Z, or along X where that is all that is seen of it.
TEST(MachineReader, KnowsWhichWayAComponentGrows) {
  const auto across = [](const std::vector<std::string>& directions) {
    nlohmann::json document = test::spindle_json();
    document["displacements"] = nlohmann::json::array();
    for (const auto& direction : directions)
      document["displacements"].push_back(
          {{"channel", "d" + direction + "_um"}, {"direction", direction}, {"component", "spindle"}});
    const Machine machine = *machine_from_json(document, "machine.json");
    std::vector<bool> list;
    for (const auto& one : machine.displacements) list.push_back(is_across(machine, one));
    return list;
  };
  EXPECT_EQ(across({"X", "Y", "Z"}), (std::vector<bool>{true, true, false}));
  EXPECT_EQ(across({"X", "Y"}), (std::vector<bool>{true, true}));
  EXPECT_EQ(across({"X"}), (std::vector<bool>{false}));
  EXPECT_EQ(across({"Y"}), (std::vector<bool>{true}));
}

TEST(MachineReader, SensorsAloneMakeLumps) {
  const auto machine = machine_from_json(
      json::parse(R"({"format": "zerodrift-machine/1", "sensors": [{"channel": "a_C"}, {"channel": "b_C"}]})"),
      "s.json");
  ASSERT_TRUE(machine.has_value());
  EXPECT_EQ(machine->components.size(), 2u);
  EXPECT_TRUE(machine->components[1].lump);
}

}  // namespace zerodrift::physics
