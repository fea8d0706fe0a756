// From the posterior to the answer: detection limits, held-out recordings, notes and their words.
#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/answer/detectable.h"
#include "core/diagnosis/answer/explain.h"
#include "core/diagnosis/answer/fitted_description.h"
#include "tests/diagnosis/answered.h"
#include "tests/diagnosis/heated_rod.h"

namespace zerodrift::diagnosis {
namespace {

using inference::Evidence;
using inference::Fit;
using inference::Hypothesis;
using inference::JointModel;

physics::Machine in_still_air() {
  return rod(R"(["convection"])", R"({"convection": {"h_W_m2K": 12}})");
}

}  // namespace

/// Five standard deviations of the amplitude that a fit with the effect has, its prior taken out.
TEST(DetectionLimits, AreFiveStandardDeviationsOfAFit) {
  const physics::Machine machine = in_still_air();
  const auto evidence = std::make_shared<const Evidence>(
      machine, std::vector{measured(machine, inputs(2.0, on_and_off), 41)}, DiagnosisSettings{});
  auto described = std::make_shared<Fit>(std::make_shared<JointModel>(Hypothesis{machine, {}, 0.0}, evidence),
                                         evidence->usual_sizes());
  described->fit({20, true});
  search::Posterior posterior;
  posterior.evidence = evidence;
  posterior.explanations = {{described, 0.0}};
  const auto limits = answer::detection_limits(posterior);
  const auto found =
      std::find_if(limits.begin(), limits.end(), [](const Detectable& one) { return one.id == "sensor_gain"; });
  ASSERT_NE(found, limits.end());
  EXPECT_EQ(found->key, "gain_error");
  double least = 1e300;
  for (const char* channel : {"T1_C", "T2_C", "T3_C"}) {
    const inference::HeldEffect effect{{"sensor_gain", true, {{"gain_error", 0.0}}, {{"channel", channel}}}, -1};
    Fit with(std::make_shared<JointModel>(Hypothesis{machine, {effect}, 0.0}, evidence), evidence->usual_sizes());
    with.fit({20, true});
    for (const int u : with.model().effect_unknowns()) {
      const auto i = static_cast<std::size_t>(u);
      const double prior = with.model().unknown(i).parameter.sigma;
      least = std::min(least, 5.0 / std::sqrt(1.0 / std::pow(with.sigma(i), 2) - 1.0 / (prior * prior)));
    }
  }
  EXPECT_NEAR(found->value / least, 1.0, 0.1);
}

/// The second recording is predicted from the first alone.
TEST(HeldOut, IsPredictedByWhatWasFittedToTheOthers) {
  const physics::Machine described = rod("[]", "{}");
  const recording::Recording first = measured(in_still_air(), inputs(2.0, on_and_off), 43);
  recording::Recording second = measured(in_still_air(), inputs(2.0, {{1200.0, 3000.0}, {4200.0, 6600.0}}), 44);
  second.name = "r2.csv";
  const auto answer = diagnose(described, {first, second}, {false});
  ASSERT_TRUE(answer.has_value());
  ASSERT_EQ(ids_of(*answer), std::vector<std::string>{"convection"});
  ASSERT_EQ(answer->held_out.size(), 1u);
  EXPECT_EQ(answer->held_out[0].recording, "r2.csv");

  const auto alone = std::make_shared<const Evidence>(described, std::vector{first}, DiagnosisSettings{});
  const inference::HeldEffect convection{{"convection", true, {{"h_W_m2K", 0.0}}, {}}, -1};
  Fit fit(std::make_shared<JointModel>(Hypothesis{described, {convection}, 0.0}, alone), alone->usual_sizes());
  fit.settle();
  const auto predicted = physics::simulate(answer::fitted_description(fit, -1), second);
  ASSERT_TRUE(predicted.has_value());
  for (const auto& one : physics::compare(predicted->prediction, second)) {
    EXPECT_NEAR(answer->held_out[0].explained.at(one.channel), one.rms, 0.05) << one.channel;
    EXPECT_GT(answer->held_out[0].refitted.at(one.channel), 10.0 * one.rms) << one.channel;
  }
}

TEST(Notes, EachHasANameOfItsOwnAndStandsInTheAnswerAsCodeAndFacts) {
  std::vector<std::string_view> names;
  for (int code = 0; code <= static_cast<int>(NoteCode::far_from_description); ++code)
    names.push_back(name_of(static_cast<NoteCode>(code)));
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::unique(names.begin(), names.end()), names.end());
  Diagnosis answer;
  answer.notes.push_back({NoteCode::exchanged, {{"channel", "T1_C"}, {"other", "T2_C"}}});
  EXPECT_EQ(to_json(answer)["notes"],
            nlohmann::json::parse(R"([{"code": "exchanged", "channel": "T1_C", "other": "T2_C"}])"));
}

TEST(Notes, ANumberFarOffIsSaidWithItsPartAndItsFactor) {
  const Note note = far_from_description("heat", "front_bearing", 2.53, 6.2);
  EXPECT_EQ(sentence_of(note).english,
            "To fit, the heat of front bearing had to become 2.5 times what is described, 6 times its tolerance: check "
            "units, sizes and powers.");
  EXPECT_EQ(sentence_of(far_from_description("conductance", "motor-head", 0.25, 9.0)).id, "far_joint");
  EXPECT_EQ(sentence_of({NoteCode::warm_start, {{"component", "rod"}, {"above", "-4.2"}}})
                .english.find("The recording starts with rod 4.2 K below its room"),
            0u);
  EXPECT_TRUE(sentence_of({NoteCode::warm_start, {{"component", "rod"}}}).id.empty());
}

}  // namespace zerodrift::diagnosis
