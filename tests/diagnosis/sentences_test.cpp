#include "core/diagnosis/answer/sentences.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/diagnosis/answer/explain.h"
#include "core/physics/effects/effect.h"

namespace zerodrift::diagnosis {

TEST(Sentences, AreMadeFromIdsAndFactsInAnyLanguage) {
  const Sentence sentence{"verdict_missing_effect", {{"effects", "coolant,sensor_lag"}}, ""};
  EXPECT_EQ(said(sentence), "The simulation left out cooling by the coolant and a sensor that answers late.");
  const Translate dutch = [](const std::string& text) -> std::string {
    if (text == "The simulation left out {+effects}.") return "Vergeten: {+effects}.";
    if (text == " and ") return " en ";
    return text == "cooling by the coolant" ? "koeling" : "een trage sensor";
  };
  EXPECT_EQ(said(sentence, dutch), "Vergeten: koeling en een trage sensor.");
  EXPECT_EQ(said(sentence_from_json(to_json(sentence)), dutch), "Vergeten: koeling en een trage sensor.");
  EXPECT_EQ(said({"no_such_sentence", {}, ""}), "");
}

TEST(Sentences, EveryEffectOfTheLibraryHasAName) {
  for (const auto* effect : physics::all_effects()) {
    const std::string id(effect->id);
    std::string blanks = id;
    std::replace(blanks.begin(), blanks.end(), '_', ' ');
    if (id == "convection") continue;
    EXPECT_NE(plain_name(id), blanks) << id;
  }
}

TEST(Sentences, AnEffectIsToldWithUnitsAndUncertainty) {
  FoundEffect effect;
  effect.id = "coolant";
  effect.parameters = {{"h_W_m2K", 78.62}, {"temperature_C", 20.36}, {"from_mm", 296.0}, {"to_mm", 379.0}};
  effect.sigma = {{"h_W_m2K", 4.1}, {"temperature_C", 0.22}};
  const Sentence s = explain_effect(effect, 3600.0, {"T1_C", 3.1, 0.124, 0.05});
  EXPECT_EQ(s.english.find("While the coolant runs, T1_C is 3.1 K (rms) off the best simulation without it. Adding "
                           "cooling by the coolant between 296 and 379 mm (h = 78.6 ± 4.1 W/m²K, T = 20.36 ± 0.22 °C) "
                           "removes 96 % of that."),
            0u)
      << s.english;
  EXPECT_EQ(s.english.find('{'), std::string::npos);
}

TEST(Sentences, AFigureThatGrowsWithTheSpeedSaysAtWhich) {
  FoundEffect effect;
  effect.id = "extra_heat_source";
  effect.component = "spindle";
  effect.position_mm = 300.0;
  effect.words = {{"law", "n"}};
  effect.parameters = {{"power_W", 26.0}};
  effect.sigma = {{"power_W", 2.0}};
  effect.at_rpm = speeds_of_figures(effect.parameters, effect.words, 8000.0);
  const Sentence s = explain_effect(effect, 3600.0, {"T1_C", 0.5, 0.1, 0.05});
  EXPECT_NE(s.english.find("(P(8000 rpm) = 26.0 ± 2.0 W)"), std::string::npos) << s.english;
  EXPECT_EQ(s.english.find("In step with the spindle speed"), 0U) << s.english;
  effect.words = {{"law", "constant"}};
  EXPECT_TRUE(speeds_of_figures(effect.parameters, effect.words, 8000.0).empty());
}

TEST(Sentences, ANeighbourIsToldByItsName) {
  FoundEffect effect;
  effect.id = "neighbour_heat";
  effect.component = "spindle";
  effect.words = {{"component", "spindle"}, {"neighbour", "gearbox"}};
  effect.parameters = {{"conductance_W_K", 1.33}};
  effect.sigma = {{"conductance_W_K", 0.12}};
  const Sentence s = explain_effect(effect, 3600.0, {"T1_C", 0.5, 0.1, 0.05});
  EXPECT_NE(s.english.find("(gearbox, G = 1.33 ± 0.12 W/K)"), std::string::npos) << s.english;
}

TEST(Sentences, WhatIsMostlyNoiseIsNotSaidToBeLeft) {
  FoundEffect effect;
  effect.id = "convection";
  effect.parameters = {{"h_W_m2K", 12.0}};
  const Sentence s = explain_effect(effect, 3600.0, {"T2_C", 0.062, 0.051, 0.05});
  EXPECT_NE(s.english.find("brings T2_C from 0.062 to 0.051 K (rms), of which 0.05 K is its noise"), std::string::npos)
      << s.english;
}

TEST(Sentences, WhatDoesNotComeNearerIsNotSaidToBeRemoved) {
  FoundEffect effect;
  effect.id = "convection";
  effect.parameters = {{"h_W_m2K", 12.0}};
  effect.log_evidence_gain = 34.0;
  const Sentence s = explain_effect(effect, 3600.0, {"t2_C", 0.069, 0.082, 0.05});
  EXPECT_EQ(s.id, "effect_found_course");
  EXPECT_NE(s.english.find("log evidence 34"), std::string::npos) << s.english;
  EXPECT_EQ(s.english.find('{'), std::string::npos) << s.english;
}

TEST(Sentences, HeatThatIsTooMuchIsToldAsSuch) {
  Diagnosis answer;
  answer.verdict = Verdict::unexplained;
  answer.mismatch.channels = {"T1_C"};
  answer.mismatch.missing_heat_W = -60.0;
  EXPECT_NE(explain_verdict(answer).english.find("about 60 W too much heat is simulated"), std::string::npos);
  answer.mismatch.missing_heat_W = 60.0;
  EXPECT_EQ(explain_verdict(answer).english.find("too much"), std::string::npos);
  answer.mismatch.missing_heat_W = 0.2;
  answer.channels.resize(1);
  answer.channels[0].channel = "T1_C";
  answer.channels[0].temperature = true;
  answer.channels[0].rms_refitted = 0.31;
  EXPECT_NE(explain_verdict(answer).english.find("T1_C is off the best simulation by 0.31 K (rms)"), std::string::npos);
}

TEST(Sentences, ASlipIsSaidToLookLikeAGaugeSetToZero) {
  FoundEffect slip;
  slip.id = "bracket_slip";
  slip.channel = "dZ_um";
  slip.parameters = {{"step_um", -64.0}, {"time_s", 9300.0}};
  EXPECT_NE(
      explain_effect(slip, 18000.0, {"dZ_um", 20.0, 0.2, 0.05}).english.find("A gauge that was set to zero again"),
      std::string::npos);
}

TEST(Sentences, WhatHappenedOnceIsToldWithItsMoment) {
  FoundEffect slip;
  slip.id = "bracket_slip";
  slip.parameters = {{"step_um", 9.0}, {"time_s", 9300.0}};
  EXPECT_EQ(regime_of_effect(slip, 18000.0), "from 155 min on");
  FoundEffect door;
  door.id = "draught";
  door.parameters = {{"h_W_m2K", 21.0}, {"from_s", 9600.0}, {"to_s", 12000.0}};
  door.sigma = {{"to_s", 60.0}};
  EXPECT_EQ(regime_of_effect(door, 18000.0), "from 160 to 200 min");
  EXPECT_EQ(regime_of_effect(door, 12000.0), "from 160 min on");
  door.intervals_s = {{2057.0, 2218.0}};
  EXPECT_EQ(regime_of_effect(door, 12000.0), "from 34.3 to 37.0 min");
  door.intervals_s.push_back({9000.0, 9600.0});
  EXPECT_EQ(regime_of_effect(door, 12000.0), "2 times between 34 and 160 min");
  door.intervals_s.clear();
  door.sigma.clear();  // it was still open when the recording ended
  EXPECT_EQ(explain_effect(door, 12000.0, {"T1_C", 1.0, 0.1, 0.05}).english.find(", to ="), std::string::npos);
}

}  // namespace zerodrift::diagnosis
