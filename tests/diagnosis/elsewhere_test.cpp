// What the machine's other recordings say beside the first.
#include "core/diagnosis/elsewhere.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/diagnosis/bodies.h"
#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/refined.h"
#include "core/diagnosis/selection.h"
#include "core/physics/machine.h"
#include "tests/diagnosis/simulated.h"
#include "tests/proof/case_generator.h"

namespace zerodrift::diagnosis {
namespace {

std::shared_ptr<const Dataset> dataset_of(const physics::Machine& machine, const recording::Recording& recording) {
  const physics::Network network = physics::build_network(machine, recording);
  auto data = std::make_shared<Dataset>(make_dataset(recording, network));
  set_timing_noise(*data, network, physics::make_inputs(network, recording));
  return data;
}

double evidence_of_both(const physics::Machine& machine, const std::shared_ptr<const Dataset>& first,
                        const std::shared_ptr<const Dataset>& then) {
  Model one(machine, first);
  one.fit({40, 0.01, true});
  Model other(machine, then);
  other.learn_from(one);
  other.fit({40, 0.01, true});
  return one.log_evidence_total() + other.log_evidence_total();
}

}  // namespace

/// Load, f0 and f1 are catalogue figures, and oil and load are not known better against each other than in their sum.
TEST(Elsewhere, ABearingsLoadWithinItsTolerancesIsNoEffect) {
  const proof::Case one = proof::make_case(42, "none");
  physics::Machine machine = *physics::machine_from_json(one.machine, one.name);
  machine.tolerances.heat_source_power = 0.1;
  const auto data = dataset_of(machine, one.recordings[0]);
  const auto within = [&](const char* key, double value) {
    physics::Machine with = machine;
    with.effects.push_back({"bearing_preload", true, {{key, 0.0}}, {}});
    Model model(with, data);
    for (std::size_t i = 0; i < model.unknowns(); ++i) {
      if (model.unknown(i).key == key) model.set_z(i, model.unknown(i).z_of(value));
    }
    return within_tolerance(model);
  };
  EXPECT_TRUE(within("constant_share", 0.09));
  EXPECT_TRUE(within("constant_share", -0.09));
  EXPECT_TRUE(within("speed_share", 0.06));
  EXPECT_FALSE(within("constant_share", 0.4));
  EXPECT_FALSE(within("constant_share", -0.3));
  EXPECT_FALSE(within("growth_1_K", 0.02));
}

/// p(a) p(b | a) = p(b) p(a | b).
TEST(Elsewhere, TheEvidenceOfTwoRecordingsDoesNotDependOnTheirOrder) {
  const proof::Case one = proof::make_case(42, "none");
  const auto machine = physics::machine_from_json(one.machine, one.name);
  const physics::Machine bodies = with_inner_bodies(*machine);
  const auto a = dataset_of(bodies, one.recordings[0]);
  const auto b = dataset_of(bodies, one.recordings[1]);
  Model alone(bodies, b);
  alone.fit({40, 0.01, true});
  Model beside_nothing(bodies, a);
  beside_nothing.fit({40, 0.01, true});
  const double together = evidence_of_both(bodies, a, b);
  EXPECT_NEAR(together, evidence_of_both(bodies, b, a), 1.0);
  // One machine explains both: what the first has shown saves the second much of the description's vagueness.
  EXPECT_GT(together, beside_nothing.log_evidence_total() + alone.log_evidence_total() + 10.0);
}

TEST(Elsewhere, WhatWasLearnedIsKnownAtLeastAsWellThere) {
  const proof::Case one = proof::make_case(42, "none");
  const auto machine = physics::machine_from_json(one.machine, one.name);
  const physics::Machine bodies = with_inner_bodies(*machine);
  Model first(bodies, dataset_of(bodies, one.recordings[0]));
  first.fit({});
  Model second(bodies, dataset_of(bodies, one.recordings[1]));
  second.learn_from(first);
  second.fit({});
  int shared = 0;
  for (std::size_t i = 0; i < second.unknowns(); ++i) {
    const physics::Parameter& want = second.unknown(i);
    if (want.per_recording || want.logarithmic) continue;
    for (std::size_t k = 0; k < first.unknowns(); ++k) {
      const physics::Parameter& have = first.unknown(k);
      if (have.key != want.key || have.component != want.component || have.channel != want.channel) continue;
      EXPECT_LE(second.sigma(i), 1.001 * first.sigma(k)) << want.key;
      ++shared;
    }
  }
  EXPECT_GT(shared, 2);
}

/// How well each offset is known, K.
std::map<std::string, double> offset_sigmas_of(const Model& model) {
  std::map<std::string, double> list;
  for (std::size_t i = 0; i < model.unknowns(); ++i) {
    if (model.unknown(i).of_sensor) list[model.unknown(i).channel] = model.sigma(i);
  }
  return list;
}

TEST(Elsewhere, ASensorKeepsItsOffsetButForALittle) {
  const proof::Case one = proof::make_case(42, "none");
  const auto machine = physics::machine_from_json(one.machine, one.name);
  const physics::Machine bodies = with_inner_bodies(*machine);
  Model first(bodies, dataset_of(bodies, one.recordings[0]));
  first.fit({});
  Model same(bodies, dataset_of(bodies, one.recordings[1]));
  same.learn_from(first, Sensors::the_same);
  same.fit({});
  const auto known_K = offset_sigmas_of(first);
  const auto kept_K = offset_sigmas_of(same);
  ASSERT_GT(known_K.size(), 4u);
  for (const auto& [channel, sigma_K] : known_K) {
    const double may_move_K = 0.25 * 0.5 * machine->sensor(channel)->accuracy_C;
    EXPECT_LT(kept_K.at(channel), std::hypot(sigma_K, may_move_K)) << channel;
  }
}

TEST(Elsewhere, TheEvidenceTellsWhetherASensorWasMountedAnew) {
  const proof::Case one = proof::make_case(42, "none");
  const auto machine = physics::machine_from_json(one.machine, one.name);
  const physics::Machine bodies = with_inner_bodies(*machine);
  Model first(bodies, dataset_of(bodies, one.recordings[0]));
  first.fit({});
  const SeenByAll kept = seen_by_all(first, {dataset_of(bodies, one.recordings[1])});
  EXPECT_EQ(kept.fits.size(), 1u);
  EXPECT_EQ(kept.sensors, Sensors::the_same);
  recording::Recording moved = one.recordings[1];
  for (auto& channel : moved.channels) {
    const double by_K = channel.name == "T2_C" ? 0.15 : channel.name == "T4_C" ? -0.15 : 0.0;
    for (double& value : channel.values) value += by_K;
  }
  const SeenByAll mounted = seen_by_all(first, {dataset_of(bodies, moved)});
  EXPECT_EQ(mounted.fits.size(), 1u);
  EXPECT_EQ(mounted.sensors, Sensors::anew);
}

/// Its offsets and temperatures fit no better with any effect of the first machine.
TEST(Elsewhere, ARecordingOfAnotherMachineJudgesNobody) {
  const proof::Case one = proof::make_case(42, "none");
  const proof::Case other = proof::make_case(1234, "convection");
  const auto machine = physics::machine_from_json(one.machine, one.name);
  const physics::Machine bodies = with_inner_bodies(*machine);
  auto first = std::make_shared<Model>(bodies, dataset_of(bodies, one.recordings[0]));
  first->fit({});
  std::vector<ModelPtr> asked = {first};
  ask_elsewhere(asked, *first, {dataset_of(bodies, one.recordings[1])});
  EXPECT_EQ(asked.size(), 1u);
  EXPECT_NEAR(first->elsewhere, 0.0, 1e-6);
  ask_elsewhere(asked, *first, {dataset_of(bodies, other.recordings[0])});
  EXPECT_TRUE(asked.empty());
}

/// The effect that is there, one that is not, and the recording of another machine.
TEST(Elsewhere, OnlyWhatIsThereIsBorneOut) {
  const proof::Case one = proof::make_case(118, "coolant");
  const proof::Case other = proof::make_case(42, "none");
  const auto machine = physics::machine_from_json(one.machine, one.name);
  const physics::Machine bodies = with_inner_bodies(*machine);
  const auto seen = dataset_of(bodies, one.recordings[0]);
  Model none(bodies, seen);
  none.fit({20, 0.05, true});
  const auto with = [&](const Model& base, const char* id) {
    std::vector<Candidate> forms = screen(base, facts_of(bodies, one.recordings[0]));
    std::erase_if(forms, [&](const Candidate& form) { return form.spec.id != id; });
    const ModelPtr fit = extended(base, forms.front());
    fit->fit({20, 0.05, true});
    return fit;
  };
  const ModelPtr there = with(none, "coolant");
  const OtherRecordings others = {dataset_of(bodies, one.recordings[1])};
  EXPECT_TRUE(borne_out(*there, none, others));
  EXPECT_FALSE(borne_out(*with(*there, "bearing_viscosity"), *there, others));
  EXPECT_FALSE(borne_out(*there, none, {dataset_of(bodies, other.recordings[0])}));
  EXPECT_FALSE(borne_out(*there, none, {}));
}

/// A slack of the nest that an expansion 8 % larger hides in one run: 0.27 um are left of it there.
TEST(Elsewhere, WhatOneRunHidesInTheExpansionTheOtherShows) {
  const proof::Case one = proof::make_case(1830277358);
  ASSERT_EQ(one.hidden.front().id, "unlisted:slack");
  const auto machine = physics::machine_from_json(one.machine, one.name);
  const physics::Machine bodies = with_inner_bodies(*machine);
  Model alone(bodies, dataset_of(bodies, one.recordings[0]));
  alone.fit({20, 0.05, true});
  EXPECT_LT(excess_of(alone).largest, least_evident);
  EXPECT_EQ(moved_elsewhere(alone, {dataset_of(bodies, one.recordings[1])}), "dZ_um");
  const auto both = diagnosed_and_simulated(*machine, one.recordings, {false});
  ASSERT_TRUE(both);
  EXPECT_EQ(both->verdict, Verdict::unexplained);
  ASSERT_FALSE(both->mismatch.channels.empty());
  EXPECT_EQ(both->mismatch.channels.front(), "dZ_um");
}

/// Ten minutes are twenty samples: cleaned by themselves one spike would pass for noise and be taken for an offset.
TEST(Elsewhere, ASpikeInTheFirstMinutesDoesNotShiftWhatIsPredicted) {
  const proof::Case one = proof::make_case(42, "none");
  const auto machine = physics::machine_from_json(one.machine, one.name);
  recording::Recording spoilt = one.recordings[1];
  const auto channel = std::find_if(spoilt.channels.begin(), spoilt.channels.end(),
                                    [](const auto& each) { return each.name == "T2_C"; });
  ASSERT_NE(channel, spoilt.channels.end());
  const physics::Prediction sound = predict_other(*machine, spoilt, 0.4);
  channel->values[7] += 8.0;
  const physics::Prediction spiked = predict_other(*machine, spoilt, 0.4);
  for (std::size_t c = 0; c < sound.channels.size(); ++c) {
    EXPECT_NEAR(spiked.channels[c].values.back(), sound.channels[c].values.back(), 0.02) << sound.channels[c].channel;
  }
}

}  // namespace zerodrift::diagnosis
