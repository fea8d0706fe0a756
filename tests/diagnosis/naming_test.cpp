// Which effects of a posterior are named: as many as are missing for certain, and each the likeliest.
#include <gtest/gtest.h>

#include <set>

#include "core/diagnosis/answer/assess.h"
#include "core/diagnosis/search/candidates.h"
#include "core/diagnosis/search/intervals.h"
#include "core/diagnosis/search/run_facts.h"
#include "tests/diagnosis/heated_rod.h"

namespace zerodrift::diagnosis {
namespace {

using inference::Evidence;
using inference::Fit;
using inference::HeldEffect;
using inference::Hypothesis;
using inference::JointModel;

const char* const twelve = R"({"convection": {"h_W_m2K": 12}})";

/// The machine as described, and explanations with a gain error of each of these sensors; log odds beside each.
struct Weights {
  double described = 0.0;
  std::vector<std::pair<std::vector<std::string>, double>> gains;
  double gain_error = 0.1;  // of these sensors in truth
};

class Naming : public testing::Test {
 protected:
  Diagnosis answer_of(const Weights& weights) {
    const physics::Machine machine = rod(R"(["convection"])", twelve);
    physics::Machine truth = machine;
    std::set<std::string> wrong;
    for (const auto& [channels, log_odds] : weights.gains) wrong.insert(channels.begin(), channels.end());
    for (const std::string& channel : wrong)
      truth.effects.push_back({"sensor_gain", true, {{"gain_error", weights.gain_error}}, {{"channel", channel}}});
    CheckedRuns runs;
    runs.recordings = {measured(truth, inputs(2.0, {{600.0, 3600.0}}), 5)};
    const auto evidence = std::make_shared<const Evidence>(machine, runs.recordings, DiagnosisSettings{});
    search::Posterior posterior;
    posterior.evidence = evidence;
    const auto fitted = [&](std::vector<HeldEffect> effects) {
      auto fit =
          std::make_shared<Fit>(std::make_shared<JointModel>(Hypothesis{machine, std::move(effects), 0.0}, evidence),
                                evidence->usual_sizes());
      fit->fit({12, true});
      return fit;
    };
    const auto described = fitted({});
    posterior.explanations.push_back({described, weights.described});
    posterior.described_straight = described;
    for (const auto& [channels, log_odds] : weights.gains) {
      std::vector<HeldEffect> effects;
      for (const std::string& channel : channels)
        effects.push_back({{"sensor_gain", true, {{"gain_error", 0.0}}, {{"channel", channel}}}, -1});
      posterior.explanations.push_back({fitted(std::move(effects)), log_odds});
    }
    std::stable_sort(posterior.explanations.begin(), posterior.explanations.end(),
                     [](const auto& a, const auto& b) { return a.log_posterior > b.log_posterior; });
    for (std::size_t i = 0; i < posterior.explanations.size(); ++i) {
      if (posterior.explanations[i].fit == described) posterior.described = i;
    }
    return answer::assess(posterior, machine, runs, {false});
  }

  static std::vector<std::string> named(const Diagnosis& answer) {
    std::vector<std::string> list;
    for (const FoundEffect& one : answer.effects) list.push_back(one.channel);
    std::sort(list.begin(), list.end());
    return list;
  }
  static bool is_rival(const Diagnosis& answer, const std::string& channel) {
    return std::any_of(answer.ambiguous_with.begin(), answer.ambiguous_with.end(),
                       [&](const Rival& one) { return one.channel == channel; });
  }
};

}  // namespace

TEST_F(Naming, NeedsTwentyToOneAgainstTheDescription) {
  constexpr double within_limits = 0.005;
  const Diagnosis likely = answer_of({0.0, {{{"T1_C"}, 2.0}}, within_limits});
  EXPECT_EQ(named(likely), std::vector<std::string>{});
  EXPECT_EQ(likely.verdict, Verdict::consistent);
  EXPECT_TRUE(is_rival(likely, "T1_C"));
  EXPECT_EQ(likely.refined.effects.size(), 1u) << "what is not named is not in the refined machine";
  const Diagnosis certain = answer_of({0.0, {{{"T1_C"}, 4.0}}, within_limits});
  EXPECT_EQ(named(certain), std::vector<std::string>{"T1_C"});
  EXPECT_EQ(certain.verdict, Verdict::missing_effect);
  EXPECT_EQ(certain.refined.effects.size(), 2u);
}

/// What leaves more of a channel than good descriptions do is no alternative.
TEST_F(Naming, NeedsLessAgainstADescriptionThatLeavesTooMuch) {
  EXPECT_EQ(named(answer_of({0.0, {{{"T1_C"}, 2.0}}})), std::vector<std::string>{"T1_C"});
}

TEST_F(Naming, TellsOneOfTwoWhereTheSecondIsNotCertain) {
  const Diagnosis one = answer_of({-20.0, {{{"T1_C"}, 0.0}, {{"T1_C", "T2_C"}, 1.0}}});
  EXPECT_EQ(named(one), std::vector<std::string>{"T1_C"});
  EXPECT_TRUE(is_rival(one, "T2_C"));
  const Diagnosis both = answer_of({-20.0, {{{"T1_C"}, 0.0}, {{"T1_C", "T2_C"}, 5.0}}});
  EXPECT_EQ(named(both), (std::vector<std::string>{"T1_C", "T2_C"}));
}

TEST_F(Naming, NamesNoneWhereSeveralAreAsLikely) {
  const Diagnosis answer = answer_of({-20.0, {{{"T1_C"}, 0.0}, {{"T2_C"}, -0.1}, {{"T3_C"}, -0.2}}});
  EXPECT_EQ(named(answer), std::vector<std::string>{});
  EXPECT_EQ(answer.verdict, Verdict::unexplained);
}

/// An open door is more film for a while: where the machine has none, that is missing first.
TEST(Intervals, NoDraughtIsProposedWhereNoFilmIsDescribed) {
  const auto draughts = [](const physics::Machine& described) {
    const physics::Machine truth = rod(R"(["convection"])", twelve);
    const recording::Recording run = measured(truth, inputs(2.0, {{600.0, 3600.0}}), 6);
    const auto evidence = std::make_shared<const Evidence>(described, std::vector{run}, DiagnosisSettings{});
    Fit fit(std::make_shared<JointModel>(Hypothesis{described, {}, 0.0}, evidence), evidence->usual_sizes());
    fit.fit({2, true});
    const auto found = search::interval_candidates(fit, {search::run_facts(described, run)});
    return std::count_if(found.begin(), found.end(),
                         [](const search::Candidate& one) { return one.effect.spec.id == "draught"; });
  };
  EXPECT_EQ(draughts(rod("[]", "{}")), 0);
  EXPECT_GT(draughts(rod(R"(["convection"])", R"({"convection": {"h_W_m2K": 3}})")), 0);
}

TEST(Candidates, AFilmMayGrowWithSpeedOverOnePartAlone) {
  const auto machine = physics::machine_from_json(nlohmann::json::parse(R"({"format": "zerodrift-machine/1",
    "initial_temperature_C": 20, "effects": ["convection"], "effect_parameters": {"convection": {"h_W_m2K": 12}},
    "components": [{"id": "motor", "kind": "lump", "heat_capacity_J_K": 2000, "area_mm2": 90000},
                   {"id": "frame", "kind": "lump", "heat_capacity_J_K": 9000, "area_mm2": 400000}],
    "sensors": [{"channel": "T1_C", "component": "motor"}, {"channel": "T2_C", "component": "frame"}],
    "displacements": []})"),
                                                  "two.json");
  ASSERT_TRUE(machine.has_value());
  physics::RunFacts facts;
  facts.duration_s = 7200.0;
  facts.has_speed = true;
  facts.channels = {"T1_C", "T2_C"};
  std::vector<std::string> parts;
  for (const search::Candidate& one : search::candidates_for({*machine, {}, 0.0}, {facts}, -3.5)) {
    if (one.effect.spec.id == "speed_convection") parts.push_back(one.effect.spec.word_or("component", "all"));
  }
  EXPECT_EQ(parts, (std::vector<std::string>{"motor", "frame", "all"}));
}

}  // namespace zerodrift::diagnosis
