// Every effect of the list: exact derivatives, an absent effect changes nothing, and a golden file.
// The golden files are snapshots (they prove "unchanged", to 1e-6 K or um: the scheme is deterministic); the physics
// behind them is proved by the closed series, by the balance and by the effects' own tests below.
// ZERODRIFT_WRITE_GOLDEN=1 writes them anew.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>

#include "core/base/json.h"
#include "core/physics/builder.h"
#include "core/physics/effects/effect.h"
#include "core/physics/prediction.h"
#include "tests/physics/machines.h"

namespace zerodrift::physics {
namespace {

struct Setting {
  Machine machine;
  recording::Recording run;
  EffectSpec spec;
};

Machine lumps() {
  return *machine_from_json(nlohmann::json::parse(R"({"format": "zerodrift-machine/1", "initial_temperature_C": 20,
    "components": [
      {"id": "a", "kind": "lump", "heat_capacity_J_K": 2000, "area_mm2": 90000, "length_mm": 300,
       "material": {"expansion_1_K": 1.1e-5}, "heat_sources": [{"id": "heater", "kind": "input", "channel": "heater_on", "watts_per_unit": 40}]},
      {"id": "b", "kind": "lump", "heat_capacity_J_K": 5000}],
    "sensors": [{"channel": "T1_C", "component": "a"}, {"channel": "T2_C", "component": "b"}, {"channel": "ambient_C", "component": "ambient"}],
    "displacements": [{"channel": "dZ_um", "direction": "Z", "component": "a"}]})"),
                            "lumps.json");
}

/// The test's machine, of a rod or of lumps, its run, and what is known of both.
Setting setting_on(bool rod, const Effect& effect, RunFacts& facts) {
  Setting s;
  s.machine = rod ? test::spindle() : lumps();
  if (rod && effect.id == "convection") s.machine.effects.clear();
  s.run = test::stepped_run(3.0, 60.0);
  s.run.channels.push_back({"heater_on", std::vector<double>(s.run.rows(), 0.0)});
  for (std::size_t k = 0; k < s.run.rows(); ++k)
    s.run.channels.back().values[k] = s.run.time_s[k] > 900 && s.run.time_s[k] < 6000;
  facts = RunFacts{};
  facts.duration_s = 3.0 * 3600.0;
  facts.full_speed_rpm = 8000;
  facts.has_speed = facts.has_coolant = facts.has_load = facts.room_logged = true;
  facts.typical_heat_W = 600;
  for (const auto& sensor : s.machine.sensors) facts.channels.push_back(sensor.channel);
  facts.jump_times_s["dZ_um"] = {3600.0};
  facts.unused_inputs["heater_on"] = 1.0;
  facts.stretches_s = {{1800.0, 3600.0}, {5400.0, 7200.0}};
  return s;
}

/// The forms an effect takes, by name: on which kind of machine, and which numbers and words it is described by. The
/// middle one of each form's candidates stands for it.
std::map<std::string, Setting> forms_of(const Effect& effect) {
  std::map<std::string, Setting> forms;
  for (const bool rod : {true, false}) {
    RunFacts facts;
    const Setting s = setting_on(rod, effect, facts);
    std::map<std::string, std::vector<EffectSpec>> specs;
    for (const EffectSpec& spec : effect.candidates(s.machine, facts)) {
      std::string form = rod ? "rod" : "lumps";
      for (const auto& [name, value] : spec.numbers) form += " " + name;
      for (const auto& [name, value] : spec.words) form += " " + name;
      specs[form].push_back(spec);
    }
    for (const auto& [form, list] : specs) {
      forms[form] = s;
      forms[form].spec = list[list.size() / 2];
    }
  }
  return forms;
}

std::vector<double> at_typical_size(const Network& network, int effect) {
  std::vector<double> values = network.start_values();
  values[network.hold_parameter] = 0.4;
  for (std::size_t p = 0; p < values.size(); ++p) {
    const Parameter& parameter = network.parameters[p];
    if (parameter.effect == effect && parameter.amplitude)
      values[p] = std::min(0.5 * parameter.sigma, 0.9 * parameter.high);
  }
  return values;
}

void expect_exact_derivatives(Setting s) {
  s.machine.effects.push_back(s.spec);
  const int effect = static_cast<int>(s.machine.effects.size()) - 1;
  const Network network = build_network(s.machine, s.run);
  const InputSet inputs = make_inputs(network, s.run);
  const std::vector<double> values = at_typical_size(network, effect);
  std::vector<int> all;
  for (std::size_t p = 0; p < values.size(); ++p) {
    if (network.parameters[p].sigma > 0.0) all.push_back(static_cast<int>(p));
  }
  const Prediction exact = predict(network, inputs, values, all);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Parameter& parameter = network.parameters[all[i]];
    // A joint between two faces makes the place piecewise smooth: a step small against a cell.
    const double width = parameter.logarithmic ? parameter.sigma * values[all[i]] : parameter.sigma;
    const double h = 2e-4 * width;
    std::vector<double> up = values, down = values;
    up[all[i]] += h;
    down[all[i]] -= h;
    const Prediction above = predict(network, inputs, up);
    const Prediction below = predict(network, inputs, down);
    for (std::size_t c = 0; c < exact.channels.size(); ++c) {
      double largest = 0.0;
      double worst = 0.0;
      for (std::size_t k = 0; k < exact.rows; ++k) {
        const double difference = width * (above.channels[c].values[k] - below.channels[c].values[k]) / (2.0 * h);
        largest = std::max(largest, std::abs(difference));
        worst = std::max(worst, std::abs(width * exact.channels[c].derivatives[k * exact.columns + i] - difference));
      }
      EXPECT_LT(worst, 1e-6 * (1.0 + largest)) << parameter.key << " on " << exact.channels[c].channel;
    }
  }
}

class Effects : public testing::TestWithParam<const Effect*> {};

std::string name_of_effect(const testing::TestParamInfo<const Effect*>& info) {
  return std::string(info.param->id);
}

}  // namespace

TEST_P(Effects, DerivativesAgreeWithCentralDifferences) {
  const auto forms = forms_of(*GetParam());
  EXPECT_FALSE(forms.empty());
  for (const auto& [form, setting] : forms) {
    SCOPED_TRACE(form);
    expect_exact_derivatives(setting);
  }
}

TEST_P(Effects, AbsentChangesNothing) {
  for (auto& [form, s] : forms_of(*GetParam())) {
    SCOPED_TRACE(form);
    Machine machine = s.machine;
    const Network bare = build_network(machine, s.run);
    const Prediction without = predict(bare, make_inputs(bare, s.run), bare.start_values());
    machine.effects.push_back(s.spec);
    const Network network = build_network(machine, s.run);
    const Prediction with = predict(network, make_inputs(network, s.run), network.start_values());
    for (std::size_t c = 0; c < with.channels.size(); ++c) {
      for (std::size_t k = 0; k < with.rows; ++k) {
        ASSERT_NEAR(with.channels[c].values[k], without.channels[c].values[k], 1e-7)
            << with.channels[c].channel << " " << k;
      }
    }
  }
}

TEST_P(Effects, GoldenFile) {
  nlohmann::json now;
  for (auto& [form, s] : forms_of(*GetParam())) {
    Machine machine = s.machine;
    machine.effects.push_back(s.spec);
    const Network network = build_network(machine, s.run);
    const Prediction p = predict(network, make_inputs(network, s.run),
                                 at_typical_size(network, static_cast<int>(machine.effects.size()) - 1));
    for (const auto& channel : p.channels) {
      for (std::size_t k = 20; k < p.rows; k += 40) now[form][channel.channel].push_back(channel.values[k]);
    }
  }
  const std::string file =
      std::string(ZERODRIFT_SOURCE_DIR) + "/tests/golden/physics/" + std::string(GetParam()->id) + ".json";
  if (std::getenv("ZERODRIFT_WRITE_GOLDEN") != nullptr) {
    ASSERT_TRUE(write_json_file(file, now).has_value());
    return;
  }
  const auto golden = read_json_file(file);
  ASSERT_TRUE(golden.has_value()) << "no golden file for " << GetParam()->id;
  ASSERT_EQ(golden->size(), now.size()) << "a form without golden figures";
  for (const auto& [form, channels] : golden->items()) {
    ASSERT_TRUE(now.contains(form)) << form;
    for (const auto& [channel, values] : channels.items()) {
      for (std::size_t k = 0; k < values.size(); ++k)
        EXPECT_NEAR(now[form][channel][k], values[k].get<double>(), 1e-6) << form << ": " << channel;
    }
  }
}

TEST_P(Effects, SaysWhatItIs) {
  const Effect& effect = *GetParam();
  EXPECT_FALSE(effect.equation.empty());
  EXPECT_FALSE(effect.source.empty());
  EXPECT_FALSE(effect.fingerprint.empty());
  EXPECT_FALSE(effect.parameters.empty());
}

INSTANTIATE_TEST_SUITE_P(List, Effects, testing::ValuesIn(all_effects()), name_of_effect);

EffectSpec joint_at(double position_mm, double half_width_mm) {
  return {"contact_resistance",
          true,
          {{"resistance_m2K_W", 0.0}, {"position_mm", position_mm}, {"half_width_mm", half_width_mm}},
          {{"component", "spindle"}}};
}

/// The effect's own form stands between the sensors.
TEST(Effect, JointBesideASensorHasExactDerivatives) {
  for (const double half_width_mm : {3.0, 12.0}) {
    for (const double position_mm : {101.0, 108.5, 113.5, 196.0, 202.7}) {  // sensors at 110 and 200
      SCOPED_TRACE(position_mm);
      RunFacts facts;
      Setting s = setting_on(true, *find_effect("contact_resistance"), facts);
      s.spec = joint_at(position_mm, half_width_mm);
      s.spec.numbers["position_mm_prior_sigma"] = 5.0;
      expect_exact_derivatives(s);
    }
  }
}

/// What a joint changes at each sensor, on so many cells.
std::vector<std::vector<double>> change_by_joint(double position_mm, double half_width_mm, int cells) {
  const recording::Recording run = test::stepped_run(3.0, 60.0);
  Machine machine = test::spindle();
  const auto simulated = [&] {
    const Network network = build_network(machine, run, {cells});
    return predict(network, make_inputs(network, run), network.start_values());
  };
  const Prediction without = simulated();
  machine.effects.push_back(joint_at(position_mm, half_width_mm));
  machine.effects.back().candidate = false;
  machine.effects.back().numbers["resistance_m2K_W"] = 2e-3;
  const Prediction with = simulated();
  std::vector<std::vector<double>> change;
  for (std::size_t c = 0; c < with.channels.size(); ++c) {
    if (!with.channels[c].temperature) continue;
    change.emplace_back();
    for (std::size_t k = 0; k < with.rows; ++k)
      change.back().push_back(with.channels[c].values[k] - without.channels[c].values[k]);
  }
  return change;
}

/// A sensor beside a joint reads its own side of it, wherever the cells' borders are.
TEST(Effect, JointBesideASensorNeedsNoFineGrid) {
  const auto rms = [](const std::vector<double>& of) {
    double squares = 0.0;
    for (const double value : of) squares += value * value;
    return std::sqrt(squares / static_cast<double>(of.size()));
  };
  for (const double half_width_mm : {0.0, 4.0, 12.0}) {
    for (const double position_mm : {103.0, 107.0, 112.0, 118.0, 192.0, 199.0, 204.0, 270.0, 287.0}) {
      auto usual = change_by_joint(position_mm, half_width_mm, 40);
      const auto fine = change_by_joint(position_mm, half_width_mm, 800);
      double largest = 0.0;
      double off = 0.0;
      for (std::size_t c = 0; c < fine.size(); ++c) {
        largest = std::max(largest, rms(fine[c]));
        for (std::size_t k = 0; k < fine[c].size(); ++k) usual[c][k] -= fine[c][k];
        off = std::max(off, rms(usual[c]));
      }
      EXPECT_LT(off, 0.06 * largest) << "joint at " << position_mm << " mm, half as broad as " << half_width_mm;
    }
  }
}

TEST(Effect, RadiationIsTheFourthPowerLaw) {
  Machine machine = test::spindle();
  machine.effects = {{"radiation", false, {{"emissivity", 0.9}}, {}}};
  const recording::Recording run = test::stepped_run(1.0);
  const Network network = build_network(machine, run);
  for (const auto& term : network.terms) {
    if (term.label != "spindle/radiation") continue;
    const double emissivity = 0.9;
    LawPoint at;
    at.values = &emissivity;
    at.driver_C = 80.0;
    at.environment_C = 20.0;
    const double flux = term.law(at).value * (80.0 - 20.0);
    EXPECT_NEAR(flux, 0.9 * 5.670374419e-8 * (std::pow(353.15, 4) - std::pow(293.15, 4)), 1e-9);
    return;
  }
  FAIL() << "no radiation term";
}

}  // namespace zerodrift::physics
