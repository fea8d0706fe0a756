#include "app/proof/score.h"

#include <gtest/gtest.h>

namespace zerodrift::proof {
namespace {

using nlohmann::json;

json diagnosis_of(const std::string& verdict, const std::vector<std::pair<std::string, double>>& effects) {
  json d = {{"verdict", verdict},
            {"effects", json::array()},
            {"mismatch", {{"channels", {"T1_C"}}}},
            {"seconds", 1.0},
            {"rmse", json::object()}};
  for (const auto& [id, confidence] : effects) {
    d["effects"].push_back(
        {{"id", id}, {"confidence", confidence}, {"position_mm", 110.0}, {"parameters", json::object()}});
  }
  return d;
}

OpenedAnswer hiding(const std::vector<std::string>& ids) {
  OpenedAnswer truth;
  for (const auto& id : ids) truth.effects.push_back({id, 100.0, "", ""});
  truth.worst_channel = "T1_C";
  return truth;
}

std::string value_of(const Score& score, const std::string& id) {
  for (const auto& figure : score.figures()) {
    if (figure.id == id) return figure.value;
  }
  return "";
}

}  // namespace

TEST(Score, JudgesEachKindOfAnswer) {
  Score score;
  const auto outcome = [&](const OpenedAnswer& truth, const json& d) { return score.add(truth, d).outcome; };
  EXPECT_EQ(outcome(hiding({}), diagnosis_of("consistent", {})), Outcome::right);
  EXPECT_EQ(outcome(hiding({}), diagnosis_of("unexplained", {})), Outcome::false_alarm);
  EXPECT_EQ(outcome(hiding({}), diagnosis_of("missing_effect", {{"coolant", 0.9}})), Outcome::false_alarm);
  EXPECT_EQ(outcome(hiding({"coolant"}), diagnosis_of("missing_effect", {{"coolant", 0.9}})), Outcome::right);
  EXPECT_EQ(outcome(hiding({"coolant"}), diagnosis_of("missing_effect", {{"coolant", 0.9}, {"radiation", 0.5}})),
            Outcome::first_right);
  EXPECT_EQ(outcome(hiding({"coolant"}), diagnosis_of("missing_effect", {{"radiation", 0.9}})), Outcome::wrong_name);
  EXPECT_EQ(outcome(hiding({"coolant"}), diagnosis_of("consistent", {})), Outcome::missed);
  // An unexplained verdict may list what came closest: it is still no name.
  EXPECT_EQ(outcome(hiding({"coolant"}), diagnosis_of("unexplained", {{"coolant", 0.4}})), Outcome::given_up);
  EXPECT_EQ(
      outcome(hiding({"coolant", "radiation"}), diagnosis_of("missing_effect", {{"radiation", 0.9}, {"coolant", 0.9}})),
      Outcome::right);
  const auto twice = diagnosis_of("missing_effect", {{"contact_resistance", 0.9}, {"contact_resistance", 0.9}});
  EXPECT_EQ(outcome(hiding({"contact_resistance"}), twice), Outcome::first_right);
  OpenedAnswer odd = hiding({"unlisted:creep"});
  odd.unlisted = true;
  EXPECT_EQ(outcome(odd, diagnosis_of("unexplained", {})), Outcome::right);
  EXPECT_EQ(outcome(odd, diagnosis_of("missing_effect", {{"coolant", 0.9}})), Outcome::wrong_name);
  EXPECT_EQ(outcome(odd, diagnosis_of("consistent", {})), Outcome::missed);
  EXPECT_EQ(score.add_failure(hiding({"coolant"}), "refused").outcome, Outcome::failed);
  // Four of the 14 answers are whole; two more have the first name right.
  EXPECT_EQ(value_of(score, "all_right"), "4/14 = 28.6");
  EXPECT_EQ(value_of(score, "first_right"), "6/14 = 42.9");
  EXPECT_EQ(value_of(score, "false_alarms"), "2/3 = 66.7");
  EXPECT_EQ(value_of(score, "missed"), "1/8 = 12.5");
  EXPECT_EQ(value_of(score, "pairs"), "1/1 = 100.0");
  EXPECT_EQ(value_of(score, "unlisted"), "1/3 = 33.3");
  EXPECT_EQ(value_of(score, "location_worst_mm"), "10.0");
  EXPECT_EQ(value_of(score, "location_stated"), "0/7 = 0.0");
}

/// A place that is known too badly for a point is told as a stretch, and judged as one.
TEST(Score, PointsAndStretchesAreJudgedApart) {
  Score score;
  score.add(hiding({"extra_heat_source"}), diagnosis_of("missing_effect", {{"extra_heat_source", 0.9}}));
  json wide = diagnosis_of("missing_effect", {{"extra_heat_source", 0.9}});
  wide["effects"][0]["position_mm"] = 130.0;
  wide["effects"][0]["between_mm"] = {90.0, 160.0};
  score.add(hiding({"extra_heat_source"}), wide);
  wide["effects"][0]["between_mm"] = {110.0, 160.0};
  score.add(hiding({"extra_heat_source"}), wide);
  EXPECT_EQ(value_of(score, "location_worst_mm"), "30.0");
  EXPECT_EQ(value_of(score, "location_point_worst_mm"), "10.0");
  EXPECT_EQ(value_of(score, "location_stretch"), "1/2 = 50.0");
}

TEST(Score, CalibrationErrorIsTheMeanDistanceOfStatedAndTrue) {
  Score score;
  for (int i = 0; i < 10; ++i) {  // 0.9 stated, 7 of 10 right; 0.3 stated, all wrong
    score.add(hiding({"coolant"}), diagnosis_of("missing_effect", {{i < 7 ? "coolant" : "radiation", 0.9}}));
    score.add(hiding({"coolant"}), diagnosis_of("missing_effect", {{"radiation", 0.3}}));
  }
  EXPECT_NEAR(score.expected_calibration_error(), 0.5 * 0.2 + 0.5 * 0.3, 1e-12);
  const auto bins = score.reliability();
  EXPECT_EQ(bins[4].cases, 10);
  EXPECT_NEAR(bins[4].right, 0.7, 1e-12);
}

TEST(Score, ASourceThatIsAlwaysOnHasTwoNames) {
  Score score;
  auto constant = diagnosis_of("missing_effect", {{"extra_heat_source", 0.9}});
  constant["effects"][0]["parameters"]["law"] = "constant";
  EXPECT_EQ(score.add(hiding({"standing_heat"}), constant).outcome, Outcome::right);
  constant["effects"][0]["parameters"]["law"] = "n";
  EXPECT_EQ(score.add(hiding({"standing_heat"}), constant).outcome, Outcome::wrong_name);
}

/// A reader of the misses must see which of them the recording could have shown, and what the answer said of it.
TEST(Score, SaysWhetherTheRecordingCouldShowWhatWasNotNamed) {
  OpenedAnswer hard = hiding({"coolant", "radiation"});
  hard.told = 2.0;
  hard.effects[1].sizes = {{"emissivity", 0.7}};
  json d = diagnosis_of("missing_effect", {{"coolant", 0.9}});
  d["could_have_detected"] = {{"radiation", {{"key", "emissivity"}, {"value", 1.1}}}};
  Score score;
  const Judgement one = score.add(hard, d);
  ASSERT_EQ(one.not_named.size(), 1u);
  EXPECT_EQ(one.not_named[0].id, "radiation");
  EXPECT_TRUE(one.not_named[0].was_told());
  EXPECT_FALSE(one.decidable());

  OpenedAnswer easy = hiding({"coolant", "sensor_lag"});
  easy.told = 40.0;
  d["could_have_detected"]["sensor_lag"] = {{"key", "lag_s"}, {"value", 20.0}};
  const Judgement other = score.add(easy, d);
  ASSERT_EQ(other.not_named.size(), 1u);
  EXPECT_FALSE(other.not_named[0].compared());  // nobody said how large it was
  EXPECT_TRUE(other.decidable());

  EXPECT_EQ(value_of(score, "pairs"), "0/2 = 0.0");
  EXPECT_EQ(value_of(score, "pairs_decidable"), "0/1 = 0.0");
  EXPECT_EQ(score.undecidable().undecidable, 1);
  EXPECT_EQ(score.undecidable().said_so, 1);
}

}  // namespace zerodrift::proof
