#pragma once
// An effect is a piece of physics that a simulation may include or leave out. Each stands in one file with its
// equation, its source, the plausible range of its parameters and its fingerprint in words; list.cpp is the list of
// them all.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/physics/machine.h"

namespace zerodrift::physics {

class NetworkBuilder;
struct RunFacts;

/// How one parameter of an effect is known beforehand. Amplitudes are half-normal from 0 when only physical signs are
/// allowed (low = 0), else normal.
struct EffectParameter {
  std::string_view key;
  double sigma = 1.0;
  double low = 0.0;
  double high = 1e300;
  bool amplitude = false;
  double mean = 0.0;  // not for amplitudes; 0: the candidate's own start
  bool logarithmic = false;
};

/// What acts in stretches of time that nothing logs, and is looked for in what is left of a recording.
enum class Event { none, heat, film, reading };

/// What a search for missing effects has to know of an effect, beside its equation.
struct EffectTraits {
  /// Natural logarithm of how much rarer it is, beforehand, than the common ones (engineering judgement: what service
  /// reports name often is common; twenty to one what a machine has now and then).
  double log_rarity = 0.0;
  bool once = false;                  // an event of one recording - a slip, an open door - that the next need not show
  std::string_view requires_id = {};  // an effect without which it cannot be there
  bool alone = false;                 // replaces a part of the network: two forms cannot stand in one simulation
  double apart_share = 0.0;  // of a part's length, within which a second of the kind only mends the first's shape
  /// The derivative at 0 says little of the effect's usual size (a lag's stands for the moments of switching alone):
  /// the score takes the chord to this share of the recording's duration.
  double chord_share_of_run = 0.0;
  Event event = Event::none;
  bool room_reads_wrong = false;  // the films believe a room that is not there: it brings no heat
};

/// A form of an effect with a name of its own: described by this number.
struct NamedForm {
  std::string_view number;
  std::string_view id;
  std::string_view name;
};

struct Effect {
  std::string_view id;
  std::string_view name;  // in words, as a part of a sentence: "convection to the room"
  std::string_view equation;
  std::string_view source;
  std::string_view fingerprint;
  std::string_view confused_with;
  std::vector<EffectParameter> parameters;
  std::vector<std::string_view> required_numbers;  // a description that lists the effect gives one of them at least
  /// Puts the effect into the network.
  void (*add)(NetworkBuilder& builder, const EffectSpec& spec, int index);
  /// The forms in which the effect could be missing from this machine in this run; parameters at their start values.
  std::vector<EffectSpec> (*candidates)(const Machine& machine, const RunFacts& facts);
  std::string_view acts_with = {};  // the recording's channel that it follows, where it acts in no other time
  EffectTraits traits = {};
  std::vector<NamedForm> named_forms = {};

  const EffectParameter& parameter(std::string_view key) const;
};

/// What the recording can excite, for making candidates.
struct RunFacts {
  double duration_s = 0.0;
  double full_speed_rpm = 0.0;
  bool has_speed = false;    // the speed is there and not always 0
  bool has_coolant = false;  // coolant_on is there and not always 0
  bool has_load = false;
  bool room_logged = false;
  double typical_heat_W = 0.0;      // all known sources at full inputs
  double temperature_rise_K = 0.0;  // largest in the recording
  double displacement_range_um = 0.0;
  std::map<std::string, std::vector<double>> jump_times_s;  // displacement channel -> where it jumps most
  std::vector<std::string> channels;                        // of the machine that the recording has
  std::map<std::string, double> unused_inputs;  // logged inputs that the description has no use for -> full value
  /// In which something that nobody logged may have acted, s; proposed from what the recording leaves.
  std::vector<std::pair<double, double>> stretches_s;
};

const std::vector<const Effect*>& all_effects();
const Effect* find_effect(std::string_view id);
/// The effect that acts in stretches of time as heat, as film, as a reading.
const Effect& effect_of_event(Event event);
/// "convection, speed_convection, ..."
std::string effect_ids();

}  // namespace zerodrift::physics
