#pragma once
// What was wrong with a recording and what was done about it: each fault is named, with the channel, and either
// repaired, dropped with the channel, or refused. Nothing that is not a number leaves this room.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace zerodrift::analysis {

enum class FindingKind {
  dead_sensor,        // no or hardly any samples
  sensor_died,        // samples end, or freeze, before the run ends
  constant_sensor,    // never moves
  duplicate_sensor,   // the same series as another one
  dropout,            // one value for a while that is not the sensor's own
  spikes,             // isolated samples far from their neighbours
  gaps,               // samples missing for long
  fahrenheit,         // values that may be in degrees Fahrenheit; never converted
  kelvin,             // values that may be in kelvin; never converted
  implausible,        // outside anything a machine tool can have
  error_dead,         // an error channel without samples
  error_never_moves,  // an error channel that stays put
  weak_excitation,    // the run hardly warmed the machine
  ill_conditioned,    // the sensors say nearly the same
  few_rows,           // hardly more measurements than parameters
  extrapolation,      // states that the training never saw
  not_in_every_run,   // one of several recordings lacks it
  doubtful_times,     // warmer in less time than a machine can
  not_guaranteed,     // a figure that this recording is too short to guarantee
};

enum class FindingAction {
  noted,
  repaired,
  dropped,
};

struct Finding {
  FindingKind kind = FindingKind::gaps;
  FindingAction action = FindingAction::noted;
  std::string channel;
  std::string detail;  // figures in words, for example "12 samples", "from 5400 s"
};

/// Stable identifier, for example "sensor_died".
std::string_view name_of(FindingKind kind);
/// "noted", "repaired", "dropped".
std::string_view name_of(FindingAction action);
/// One English line for logs and the command line.
std::string describe(const Finding& finding);
nlohmann::json to_json(const std::vector<Finding>& findings);

}  // namespace zerodrift::analysis
