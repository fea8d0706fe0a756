// Mistakes in the description and in the wiring: each is recognised for what it is, machines without any name none, and
// an effect is not taken for one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>

#include "core/diagnosis/description/corrected_value.h"
#include "core/diagnosis/description/machine_errors.h"
#include "core/diagnosis/diagnosis.h"
#include "core/physics/simulate.h"
#include "tests/diagnosis/answered.h"

namespace zerodrift::diagnosis {
namespace {

using physics::Machine;

/// A steel bar in a film, heated over two stretches of it, with five sensors and a gauge at its free end.
Machine bar() {
  const auto machine = physics::machine_from_json(nlohmann::json::parse(R"({"format": "zerodrift-machine/1",
    "initial_temperature_C": 20,
    "components": [{"id": "bar", "length_mm": 400, "outer_diameter_mm": 30, "bore_diameter_mm": 0,
      "material": {"conductivity_W_mK": 45, "density_kg_m3": 7850, "heat_capacity_J_kgK": 460, "expansion_1_K": 1.15e-5},
      "heat_sources": [{"id": "rear", "kind": "input", "channel": "rear_on", "from_mm": 20, "to_mm": 40,
                        "watts_per_unit": 12},
                       {"id": "front", "kind": "input", "channel": "front_on", "from_mm": 220, "to_mm": 250,
                        "watts_per_unit": 8}]}],
    "effects": ["convection"], "effect_parameters": {"convection": {"h_W_m2K": 14}},
    "sensors": [{"channel": "T1_C", "component": "bar", "position_mm": 10},
                {"channel": "T2_C", "component": "bar", "position_mm": 80},
                {"channel": "T3_C", "component": "bar", "position_mm": 150},
                {"channel": "T4_C", "component": "bar", "position_mm": 235},
                {"channel": "T5_C", "component": "bar", "position_mm": 270},
                {"channel": "ambient_C", "component": "ambient"}],
    "displacements": [{"channel": "dZ_um", "direction": "Z", "component": "bar"}]})"),
                                                  "bar.json");
  EXPECT_TRUE(machine.has_value());
  return *machine;
}

/// Three hours in which the heaters come and go; what `truth` shows of it, with noise.
recording::Recording shown_by(const Machine& truth, unsigned seed) {
  recording::Recording run;
  run.name = "run.csv";
  run.channels = {{"rear_on", {}}, {"front_on", {}}, {"ambient_C", {}}};
  for (double t = 0.0; t <= 3.0 * 3600.0; t += 40.0) {
    run.time_s.push_back(t);
    run.channels[0].values.push_back((t > 300.0 && t < 3600.0) || t > 8000.0 ? 1.0 : 0.0);
    run.channels[1].values.push_back(t > 2400.0 && t < 7000.0 ? 1.0 : 0.0);
    run.channels[2].values.push_back(20.0 + 0.3 * std::sin(t / 2500.0));
  }
  const auto shown = physics::simulate(truth, run);
  EXPECT_TRUE(shown.has_value());
  std::mt19937 random(seed);
  for (const std::string& name : shown->predicted) {
    std::normal_distribution<double> noise(0.0, name == "dZ_um" ? 0.2 : 0.04);
    run.channels.push_back(*shown->prediction.find(name));
    for (double& v : run.channels.back().values) v += noise(random);
  }
  return run;
}

physics::Sensor& sensor_of(Machine& machine, const std::string& channel) {
  return *std::find_if(machine.sensors.begin(), machine.sensors.end(),
                       [&](const auto& one) { return one.channel == channel; });
}

Diagnosis told(const Machine& described, const recording::Recording& run) {
  auto answer = diagnose(described, {run}, {false});
  EXPECT_TRUE(answer.has_value());
  return answer ? std::move(*answer) : Diagnosis{};
}

std::string fact(const Diagnosis& d, const std::string& sentence, const std::string& key) {
  for (const Sentence& one : d.sentences) {
    if (one.id == sentence) return one.facts.at(key);
  }
  ADD_FAILURE() << "no sentence " << sentence;
  return "0";
}

bool names_a_mistake(const Diagnosis& d) {
  for (const char* note : {"misplaced", "exchanged", "places_in", "datum", "other_end", "overlong", "diameter",
                           "far_from_description", "sign_turned", "described_not_there", "clock_"}) {
    if (notes(d, note)) return true;
  }
  return false;
}

void expect_set_up(const Diagnosis& d, const std::string& note) {
  EXPECT_TRUE(notes(d, note)) << note;
  EXPECT_EQ(d.verdict, Verdict::unexplained) << note;
  EXPECT_TRUE(d.wrong_set_up) << note;
  EXPECT_TRUE(d.effects.empty()) << note;
}

}  // namespace

TEST(Description, NothingIsSaidOfARightOne) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const Diagnosis d = told(bar(), shown_by(bar(), seed));
    EXPECT_EQ(d.verdict, Verdict::consistent) << seed;
    EXPECT_FALSE(names_a_mistake(d)) << seed;
  }
}

TEST(Description, ASensorElsewhereIsTold) {
  for (const double at_mm : {330.0, 100.0}) {
    Machine described = bar();
    sensor_of(described, "T2_C").position_mm = at_mm;
    const Diagnosis d = told(described, shown_by(bar(), 4));
    expect_set_up(d, "misplaced:T2_C");
    EXPECT_NEAR(std::stod(fact(d, "misplaced", "at")), 80.0, 8.0);
    EXPECT_NEAR(d.refined.sensor("T2_C")->position_mm, 80.0, 8.0);
    EXPECT_TRUE(says(d, "verdict_unexplained_misplaced"));
  }
}

TEST(Description, TwoExchangedCablesAreTold) {
  Machine described = bar();
  std::swap(sensor_of(described, "T2_C").position_mm, sensor_of(described, "T5_C").position_mm);
  expect_set_up(told(described, shown_by(bar(), 5)), "exchanged:T2_C:T5_C");
}

TEST(Description, PlacesInAnotherUnitAreTold) {
  for (const auto& [symbol, mm] : {std::pair{"cm", 10.0}, std::pair{"in", 25.4}, std::pair{"m", 1000.0}}) {
    Machine described = bar();
    for (auto& sensor : described.sensors) sensor.position_mm /= mm;
    expect_set_up(told(described, shown_by(bar(), 6)), std::string("places_in:") + symbol);
  }
}

TEST(Description, PlacesFromAnotherEdgeOrFromTheOtherEndAreTold) {
  Machine other_end = bar(), datum = bar();
  for (auto& sensor : other_end.sensors) {
    if (sensor.component == "bar") sensor.position_mm = 400.0 - sensor.position_mm;
  }
  for (auto& sensor : datum.sensors) {
    if (sensor.component == "bar") sensor.position_mm += 25.0;
  }
  expect_set_up(told(other_end, shown_by(bar(), 7)), "other_end:bar");
  const Diagnosis d = told(datum, shown_by(bar(), 7));
  expect_set_up(d, "datum:bar");
  EXPECT_NEAR(std::stod(fact(d, "datum_nearer", "fits")), 25.0, 4.0);
}

TEST(Description, ALengthFarOffIsTold) {
  Machine described = bar();
  described.components[0].length_mm = 640.0;
  const Diagnosis d = told(described, shown_by(bar(), 8));
  expect_set_up(d, "overlong:bar");
  EXPECT_NEAR(std::stod(fact(d, "overlong", "fits")), 400.0, 20.0);
}

TEST(Description, ADiameterFarOffIsTold) {
  Machine described = bar();
  described.components[0].outer_diameter_mm = 60.0;
  const Diagnosis d = told(described, shown_by(bar(), 9));
  expect_set_up(d, "diameter:bar");
  EXPECT_NEAR(std::stod(fact(d, "diameter", "fits")), 30.0, 4.0);
}

TEST(Description, ANumberFarOffIsTold) {
  struct Wrong {
    const char* note;
    double factor;
    std::function<void(Machine&)> change;
  };
  const std::vector<Wrong> list = {
      {"far_from_description:heat:front", 10.0, [](Machine& m) { m.components[0].sources[1].watts_per_unit *= 0.1; }},
      {"far_from_description:conductivity:bar", 0.33,
       [](Machine& m) { m.components[0].material.conductivity_W_mK *= 3.0; }},
      {"far_from_description:expansion:bar", 2.0, [](Machine& m) { m.components[0].material.expansion_1_K *= 0.5; }}};
  for (const Wrong& wrong : list) {
    Machine described = bar();
    wrong.change(described);
    const Diagnosis d = told(described, shown_by(bar(), 10));
    EXPECT_TRUE(notes(d, wrong.note)) << wrong.note;
    EXPECT_EQ(d.verdict, Verdict::unexplained) << wrong.note;
    EXPECT_TRUE(d.effects.empty()) << wrong.note;
    EXPECT_NEAR(std::log(std::stod(fact(d, "far_from_description", "factor")) / wrong.factor), 0.0, 0.15);
  }
}

TEST(Description, ADisplacementThatCountsTheOtherWayIsTold) {
  Machine described = bar();
  described.displacements[0].sign = -1.0;
  const Diagnosis d = told(described, shown_by(bar(), 11));
  EXPECT_TRUE(notes(d, "sign_turned:dZ_um"));
  EXPECT_EQ(d.verdict, Verdict::unexplained);
}

TEST(Description, ADescribedEffectThatIsNotThereIsTold) {
  Machine described = bar();
  described.effects.push_back({"radiation", false, {{"emissivity", 0.9}}, {}});
  described.effects.push_back({"standing_heat", false, {{"power_W", 6.0}}, {{"component", "bar"}}});
  Machine truth = described;
  truth.effects.pop_back();
  const Diagnosis d = told(described, shown_by(truth, 12));
  EXPECT_TRUE(notes(d, "described_not_there:standing_heat"));
  EXPECT_FALSE(notes(d, "described_not_there:radiation"));
  EXPECT_EQ(d.verdict, Verdict::unexplained);
  EXPECT_TRUE(says(d, "verdict_unexplained_too_much"));
}

TEST(Description, InputsOfAnotherClockAreTold) {
  for (const int rows : {5, -5}) {
    recording::Recording run = shown_by(bar(), 13);
    const int last = static_cast<int>(run.rows()) - 1;
    for (const char* name : {"rear_on", "front_on"}) {
      auto& values = run.find(name)->values;
      const std::vector<double> then = values;
      for (int k = 0; k <= last; ++k)
        values[static_cast<std::size_t>(k)] = then[static_cast<std::size_t>(std::clamp(k - rows, 0, last))];
    }
    const Diagnosis d = told(bar(), run);
    EXPECT_EQ(d.verdict, Verdict::consistent) << rows;
    EXPECT_TRUE(d.effects.empty()) << rows;
    EXPECT_NEAR(std::stod(fact(d, rows > 0 ? "clock_late" : "clock_early", "seconds")), 200.0, 45.0);
  }
}

TEST(Description, AnEffectIsNoMistake) {
  const std::vector<physics::EffectSpec> effects = {
      {"sensor_offset", false, {{"offset_K", 1.5}}, {{"channel", "T3_C"}}},
      {"sensor_lag", false, {{"lag_s", 240.0}}, {{"channel", "T4_C"}}},
      {"extra_heat_source",
       false,
       {{"power_W", 5.0}, {"position_mm", 350.0}},
       {{"component", "bar"}, {"law", "constant"}}},
      {"draught", false, {{"h_W_m2K", 25.0}}, {{"component", "bar"}}, {{4000.0, 6000.0}}}};
  for (const physics::EffectSpec& effect : effects) {
    Machine truth = bar();
    truth.effects.push_back(effect);
    const Diagnosis d = told(bar(), shown_by(truth, 14));
    EXPECT_FALSE(names_a_mistake(d)) << effect.id;
    EXPECT_TRUE(std::any_of(d.effects.begin(), d.effects.end(), [&](const FoundEffect& found) {
      return found.id == effect.id;
    })) << effect.id;
  }
}

/// What the description lacks is found beside the mistake, and the number does not take its place.
TEST(Description, AnEffectBesideAWrongNumberIsFoundWithIt) {
  Machine described = bar();
  described.components[0].sources[0].watts_per_unit *= 3.0;
  Machine truth = bar();
  truth.effects.push_back({"sensor_offset", false, {{"offset_K", 1.5}}, {{"channel", "T3_C"}}});
  const Diagnosis d = told(described, shown_by(truth, 15));
  EXPECT_TRUE(notes(d, "far_from_description:heat:rear"));
  ASSERT_EQ(d.effects.size(), 1u);
  EXPECT_EQ(d.effects[0].id, "sensor_offset");
  EXPECT_EQ(d.verdict, Verdict::missing_effect);
}

/// The linear step over all seats promises most where the sensor is, and the value is refined to it.
TEST(Description, APlaceIsProposedAndRefined) {
  Machine described = bar();
  sensor_of(described, "T3_C").position_mm = 300.0;
  const auto evidence = std::make_shared<const inference::Evidence>(
      described, std::vector<recording::Recording>{shown_by(bar(), 16)}, DiagnosisSettings{});
  inference::Fit fit(std::make_shared<inference::JointModel>(inference::Hypothesis{described, {}, 0.0}, evidence),
                     evidence->usual_sizes());
  fit.reset_description();
  const auto list = description::sensor_errors(fit);
  const auto best =
      std::max_element(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.log_odds < b.log_odds; });
  ASSERT_NE(best, list.end());
  EXPECT_EQ(name_of(best->error), "misplaced:T3_C");
  EXPECT_NEAR(best->error.value, 150.0, 20.0);
  const auto child = description::fitted_with(fit, best->error);
  const DescriptionError& found = child->model().hypothesis().errors.back();
  EXPECT_NEAR(found.value, 150.0, 4.0 * found.sigma);
  EXPECT_LT(found.sigma, 4.0);
  EXPECT_NEAR(found.value_log_prior, std::log(found.sigma / found.spread), 1e-9);
  EXPECT_NEAR(child->model().hypothesis().log_prior, found.log_prior(), 1e-9);
}

/// Giving up a tolerance: what the closed form promises is what a fit gains.
TEST(Description, ANumbersToleranceIsGivenUpInClosedForm) {
  Machine described = bar();
  described.components[0].material.heat_capacity_J_kgK *= 1.25;
  const auto evidence = std::make_shared<const inference::Evidence>(
      described, std::vector<recording::Recording>{shown_by(bar(), 17)}, DiagnosisSettings{});
  inference::Fit fit(std::make_shared<inference::JointModel>(inference::Hypothesis{described, {}, 0.0}, evidence),
                     evidence->usual_sizes());
  fit.fit({20, true});
  for (const auto& one : description::number_errors(fit)) {
    if (one.error.other != "heat_capacity_J_kgK") continue;
    inference::Fit wide(std::make_shared<inference::JointModel>(
                            description::with_error(described, fit.model().hypothesis(), one.error), evidence),
                        fit.sizes());
    wide.fit({20, true});
    EXPECT_NEAR(wide.log_posterior() - fit.log_posterior(), one.log_odds, 2.0);
  }
}

}  // namespace zerodrift::diagnosis
