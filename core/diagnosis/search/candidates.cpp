#include "core/diagnosis/search/candidates.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/search/run_facts.h"

namespace zerodrift::diagnosis::search {
namespace {

using inference::HeldEffect;
using physics::EffectSpec;
using physics::EffectTraits;
using physics::Machine;

/// The same effect at the same place: a second one could not be told from the first.
bool same_place(const Machine& machine, const EffectSpec& have, const EffectSpec& want, const EffectTraits& traits) {
  for (const char* word : {"component", "channel", "neighbour", "source", "law"}) {
    const std::string a = have.word_or(word, ""), b = want.word_or(word, "");
    if (!a.empty() && !b.empty() && a != b) return false;
  }
  if (traits.apart_share > 0.0) {
    const physics::Component* part = machine.find(want.word_or("component", ""));
    const double length_mm = part == nullptr ? 1.0 : part->length_mm;
    return std::abs(have.number_or("position_mm", 0.0) - want.number_or("position_mm", 0.0)) <
           traits.apart_share * length_mm;
  }
  return true;
}

/// A lump whose sensor is a fluid that somebody else controls (a chiller) is no part of the machine: nothing that the
/// machine lacks explains its temperature.
bool of_a_fluid(const Machine& machine, const EffectSpec& spec) {
  const std::string component = spec.word_or("component", "");
  return !component.empty() && std::any_of(machine.sensors.begin(), machine.sensors.end(), [&](const auto& sensor) {
    return sensor.component == component &&
           std::any_of(machine.fluids.begin(), machine.fluids.end(),
                       [&](const auto& fluid) { return fluid.temperature_channel == sensor.channel; });
  });
}

bool measured(const EffectSpec& spec, const physics::RunFacts& facts) {
  const std::string channel = spec.word_or("channel", "");
  return channel.empty() || facts.jump_times_s.count(channel) != 0 ||
         std::find(facts.channels.begin(), facts.channels.end(), channel) != facts.channels.end();
}

}  // namespace

bool lacks_required(const Machine& machine, const EffectSpec& spec) {
  const EffectTraits& traits = physics::find_effect(spec.id)->traits;
  if (traits.requires_id.empty()) return false;
  const std::string component = spec.word_or("component", "");
  return std::none_of(machine.effects.begin(), machine.effects.end(), [&](const EffectSpec& have) {
    const std::string other = have.word_or("component", "");
    return have.id == traits.requires_id && (component.empty() || other.empty() || component == other);
  });
}

std::vector<Candidate> candidates_for(const inference::Hypothesis& hypothesis,
                                      const std::vector<physics::RunFacts>& facts, double effect_log_prior) {
  std::vector<Candidate> list;
  const physics::RunFacts all = merged(facts);
  for (const physics::Effect* effect : physics::all_effects()) {
    const int last = effect->traits.once ? static_cast<int>(facts.size()) : 0;
    const std::size_t first_of_kind = list.size();
    for (int run = effect->traits.once ? 0 : -1; run < last; ++run) {
      const physics::RunFacts& known = run < 0 ? all : facts[static_cast<std::size_t>(run)];
      const Machine machine = hypothesis.machine_in(run);
      for (EffectSpec& spec : effect->candidates(machine, known)) {
        const bool taken = std::any_of(machine.effects.begin(), machine.effects.end(), [&](const EffectSpec& have) {
          return have.id == spec.id && same_place(machine, have, spec, effect->traits);
        });
        // An event may happen several times, at other times.
        const bool again = effect->traits.once && taken;
        if ((taken && !again) || !measured(spec, known) || lacks_required(machine, spec) || of_a_fluid(machine, spec))
          continue;
        list.push_back({{std::move(spec), run}, effect_log_prior + effect->traits.log_rarity});
      }
      if (!effect->traits.once) break;
    }
    // What may be there in many forms finds one that fits by chance: its prior is spread over them.
    const double forms = static_cast<double>(list.size() - first_of_kind);
    for (std::size_t i = first_of_kind; i < list.size(); ++i)
      list[i].effect.spec.log_prior = list[i].log_prior -= std::log(forms);
  }
  return list;
}

}  // namespace zerodrift::diagnosis::search
