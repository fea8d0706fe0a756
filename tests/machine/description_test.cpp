#include "app/machine/description.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/machine/case_writer.h"
#include "core/base/json.h"

namespace zerodrift::machine {
namespace {

TEST(Description, TheShippedProfileIsTheOneTheToolWrites) {
  const auto shipped = read_json_file(std::string(ZERODRIFT_SOURCE_DIR) + "/resources/profiles/virtual-five-axis.json");
  ASSERT_TRUE(shipped);
  EXPECT_EQ(*shipped, connection_profile({}, {}));
}

TEST(Description, TheRigsProfileGivesEachSensorItsDevice) {
  Endpoints endpoints;
  endpoints.speedup = 240;
  RigEndpoints& rig = endpoints.rig.emplace();
  rig.serial_line = "/dev/pts/7";
  rig.agent_port = 5000;
  const auto profile = connection_profile(endpoints, {});
  EXPECT_EQ(profile["controller"]["register_map"], "virtual-rig-control");
  ASSERT_EQ(profile["devices"].size(), 4U);
  EXPECT_EQ(profile["devices"][1]["unit"], 2);
  EXPECT_EQ(profile["devices"][1]["device"], "/dev/pts/7");
  EXPECT_EQ(profile["devices"][1]["poll_period_s"], 0.02) << "no faster, however short a machine second is";
  EXPECT_EQ(profile["devices"][3]["url"], "http://127.0.0.1:5000/");
  EXPECT_EQ(profile["sensors"][8]["device"], "module-2");
  EXPECT_EQ(profile["sensors"][8]["signal"], "temperature_C[1]");
  EXPECT_EQ(profile["sensors"][19]["device"], "agent");
  EXPECT_EQ(profile["sensors"][19]["signal"], "T20");
  EXPECT_EQ(profile["ambient"]["signal"], "room");
  rig.broker_host = "127.0.0.1";
  rig.broker_port = 1883;
  rig.operator_port = 8070;
  const auto manual = connection_profile(endpoints, {});
  EXPECT_FALSE(manual.contains("controller"));
  EXPECT_EQ(manual["devices"].back()["kind"], "manual");
  EXPECT_EQ(manual["speed"]["signal"], "S1speed");
  EXPECT_EQ(manual["devices"][4]["port"], 1883);
  EXPECT_EQ(manual["sensors"][18]["signal"], "shop/T19#/temperature_C");
  EXPECT_EQ(manual["ambient"]["device"], "shop");
}

TEST(Description, KnowsNothingOfWhatIsHidden) {
  const auto plain = machine_description({});
  EXPECT_EQ(plain["effects"], nlohmann::json({"convection"}));
  for (const ConcealableEffect& effect : concealable_effects()) {
    const auto description = machine_description(*draw_effect(std::string(effect.id), 8));
    if (effect.id == "convection") {
      EXPECT_TRUE(description["effects"].empty());
      EXPECT_FALSE(description.contains("effect_parameters"));
    } else {
      EXPECT_EQ(description, plain) << effect.id;
    }
  }
}

/// The description must come near the truth when nothing is hidden: its own heat balance, integrated over a run.
TEST(Description, IsNearTheTruthWhenNothingIsHidden) {
  const auto description = machine_description({});
  const auto& spindle = description["components"][0];
  const auto run = record_case({}, 6);
  const double length_m = spindle["length_mm"].get<double>() / 1000;
  const double outer_m = spindle["outer_diameter_mm"].get<double>() / 1000;
  const double bore_m = spindle["bore_diameter_mm"].get<double>() / 1000;
  const auto& steel = spindle["material"];
  const double capacity_J_K = M_PI / 4 * (outer_m * outer_m - bore_m * bore_m) * length_m *
                              steel["density_kg_m3"].get<double>() * steel["heat_capacity_J_kgK"].get<double>();
  const double loss_W_K =
      M_PI * outer_m * length_m * description["effect_parameters"]["convection"]["h_W_m2K"].get<double>();
  const auto heat_W = [&](double rpm) {
    double sum = 0.0;
    for (const auto& source : spindle["heat_sources"]) {
      if (source["kind"] == "motor") {
        sum += source["rated_power_W"].get<double>() * (1 - source["efficiency"].get<double>()) * rpm /
               source["rated_speed_rpm"].get<double>();
      } else if (rpm > 0) {
        const double dm = source["mean_diameter_mm"];
        const double flow = source["oil_viscosity_mm2_s"].get<double>() * rpm;
        const double moment = 1e-7 * source["f0"].get<double>() * std::pow(flow, 2.0 / 3.0) * dm * dm * dm +
                              source["f1"].get<double>() * source["load_N"].get<double>() * dm;
        sum += 1.047e-4 * rpm * moment;
      }
    }
    return sum;
  };
  const auto& rpm = run.find("spindle_rpm")->values;
  const auto& room = run.find("ambient_C")->values;
  const auto& growth = run.find("dZ_um")->values;
  const double start_C = run.find("T3_C")->values[0];
  double mean_C = start_C;
  double largest_um = 0.0;
  double worst_um = 0.0;
  for (std::size_t i = 0; i + 1 < run.rows(); ++i) {
    const double seconds = run.time_s[i + 1] - run.time_s[i];
    mean_C += (heat_W(rpm[i]) - loss_W_K * (mean_C - room[i])) * seconds / capacity_J_K;
    const double expected_um = steel["expansion_1_K"].get<double>() * (mean_C - start_C) * length_m * 1e6;
    largest_um = std::max(largest_um, growth[i + 1]);
    worst_um = std::max(worst_um, std::abs(growth[i + 1] - expected_um));
  }
  EXPECT_GT(largest_um, 40.0);
  EXPECT_LT(worst_um, 0.2 * largest_um) << "beyond the scatter of a build";
}

}  // namespace
}  // namespace zerodrift::machine
