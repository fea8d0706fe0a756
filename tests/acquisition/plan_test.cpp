#include "core/acquisition/plan.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

namespace zerodrift::acquisition {
namespace {

using nlohmann::json;

Result<Plan> plan_from(const char* text, std::vector<std::string>* warnings = nullptr) {
  return plan_from_json(json::parse(text), "plan.json", warnings);
}

TEST(Plan, ReadsTheContractsForm) {
  std::vector<std::string> warnings;
  const auto plan = plan_from(R"({"name": "run", "sample_period_s": 5, "measure_period_s": 1800,
    "measure_position_mm": {"X": 1, "Y": 2, "Z": -3}, "colour": "red",
    "steps": [{"duration_s": 3600, "spindle_rpm": 3000, "coolant_on": true, "path": "cycle"},
              {"duration_s": 600, "spindle_rpm": 0, "path": "still"}]})",
                              &warnings);
  ASSERT_TRUE(plan) << describe(plan.error());
  EXPECT_EQ(plan->name, "run");
  EXPECT_EQ(plan->sample_period_s, 5.0);
  EXPECT_EQ(plan->measure_position_mm.at("Z"), -3.0);
  EXPECT_EQ(plan->duration_s(), 4200.0);
  EXPECT_TRUE(plan->steps[0].path_cycle);
  EXPECT_FALSE(plan->steps[1].coolant_on);
  EXPECT_EQ(plan->index_at(3599.9), 0u);
  EXPECT_EQ(plan->index_at(3600.0), 1u);
  EXPECT_EQ(plan->step_at(99999.0).spindle_rpm, 0.0);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("colour"), std::string::npos);
}

TEST(Plan, SaysWhatIsWrong) {
  const auto key_of = [](const char* text) {
    const auto plan = plan_from(text);
    return plan ? "accepted" : plan.error().context.at("key");
  };
  EXPECT_EQ(key_of(R"({})"), "steps");
  EXPECT_EQ(key_of(R"({"steps": []})"), "steps");
  EXPECT_EQ(key_of(R"({"steps": [{"spindle_rpm": 1}]})"), "steps[0].duration_s");
  EXPECT_EQ(key_of(R"({"steps": [{"duration_s": 0, "spindle_rpm": 1}]})"), "steps[0].duration_s");
  EXPECT_EQ(key_of(R"({"steps": [{"duration_s": 1, "spindle_rpm": -1}]})"), "steps[0].spindle_rpm");
  EXPECT_EQ(key_of(R"({"steps": [{"duration_s": 1, "spindle_rpm": 1, "path": "fast"}]})"), "steps[0].path");
  EXPECT_EQ(key_of(R"({"sample_period_s": 0, "steps": [{"duration_s": 1, "spindle_rpm": 1}]})"), "sample_period_s");
  EXPECT_EQ(
      key_of(R"({"sample_period_s": 60, "measure_period_s": 10, "steps": [{"duration_s": 1, "spindle_rpm": 1}]})"),
      "measure_period_s");
  EXPECT_EQ(key_of(R"({"measure_position_mm": {"B": 1}, "steps": [{"duration_s": 1, "spindle_rpm": 1}]})"),
            "measure_position_mm.B");
}

TEST(Plan, PresetsReadBackTheSame) {
  std::set<std::string> names;
  for (const Plan& preset : preset_plans()) {
    EXPECT_TRUE(names.insert(preset.name).second) << preset.name;
    std::vector<std::string> warnings;
    const auto back = plan_from_json(to_json(preset), preset.name, &warnings);
    ASSERT_TRUE(back) << describe(back.error());
    EXPECT_TRUE(warnings.empty());
    EXPECT_EQ(to_json(*back), to_json(preset));
  }
  EXPECT_GE(names.size(), 5u);
}

TEST(Plan, TakesTheMeasuringPositionThatItLeavesOpenFromTheProfile) {
  Plan plan;
  plan.measure_position_mm = {{"Z", 5.0}};
  const auto whole = with_measuring_position(plan, {{"X", 1.0}, {"Y", 2.0}, {"Z", 3.0}, {"A", 90.0}});
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->measure_position_mm, (std::map<std::string, double>{{"X", 1.0}, {"Y", 2.0}, {"Z", 5.0}}));
}

TEST(Plan, IsRefusedWhereNeitherItNorTheProfileHasAMeasuringPosition) {
  for (const Plan& preset : preset_plans()) {
    const auto plan = with_measuring_position(preset, {});
    ASSERT_FALSE(plan) << preset.name << " must not send a machine to a position that nobody gave";
    EXPECT_EQ(plan.error().code, ErrorCode::no_measuring_position);
  }
}

TEST(Plan, NamesTheFile) {
  const auto plan = read_plan("/nowhere/plan.json");
  ASSERT_FALSE(plan);
  EXPECT_EQ(plan.error().code, ErrorCode::file_not_found);
}

}  // namespace
}  // namespace zerodrift::acquisition
