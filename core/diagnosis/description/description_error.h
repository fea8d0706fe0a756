#pragma once
// A mistake in the description or the wiring, as a hypothesis: what is wrong, and what is right in its place. It is set
// right in the machine - or, where the inputs' clock is off, in the recording - and fitted like any other hypothesis.

#include <string>
#include <vector>

#include "core/physics/machine.h"
#include "core/physics/parameter.h"
#include "core/recording/recording.h"

namespace zerodrift::diagnosis {

enum class ErrorKind {
  place,          // a sensor is elsewhere
  exchange,       // two sensors have changed places
  unit,           // places in another unit
  datum,          // the places of all sensors of a part from another edge
  other_end,      // or from the other end
  length,         // a part is longer or shorter, beyond the last thing on it
  diameter,       // thicker or thinner
  heat,           // all heat of a part
  number,         // another number: its tolerance is given up
  sign,           // a displacement counts the other way
  absent_effect,  // an effect that is described is not there
  clock           // what drives the machine was logged by another clock
};

struct DescriptionError {
  ErrorKind kind = ErrorKind::place;
  std::string of = {};       // channel (place, exchange, sign), component, effect
  std::string other = {};    // place: its component; exchange: channel; unit: symbol; number: key of the parameter
  std::string channel = {};  // number: of an expansion
  double value = 0.0;        // right: place, shift, length, diameter in mm; factor of heat, number, unit; clock: s late
  double before = 0.0;       // clock early: share of the time before the first row in which nothing ran
  double described = 0.0;    // in the unit of `value`
  double tolerance = 0.0;    // of a number as described, relative
  double spread = 0.0;       // standard deviation of what `value` may be; 0: it is one of a few
  double low = -1e300;       // of `value`
  double high = 1e300;
  double sigma = 0.0;            // of `value` after the fit
  double form_log_prior = 0.0;   // of the kind and of this form among its forms
  double value_log_prior = 0.0;  // of the value: posterior over prior width

  double log_prior() const { return form_log_prior + value_log_prior; }
};

/// What is said to be wrong, without figures: "misplaced:T2_C", "exchanged:T1_C:T3_C" ...
std::string name_of(const DescriptionError& error);
/// The machine with it set right. `described`: with all mistakes.
physics::Machine set_right(physics::Machine described, const DescriptionError& error);
physics::Machine set_right(physics::Machine described, const std::vector<DescriptionError>& errors);
/// The inputs at the times at which they acted.
recording::Recording set_right(const recording::Recording& logged, const std::vector<DescriptionError>& errors);
/// "quantity_heat" ... of the key of a described number; empty: it is none that a description states.
std::string quantity_of_number(const std::string& key);
/// Is its value sought by simulating with others?
bool is_sought(const DescriptionError& error);
/// The parameter of a network whose tolerance is given up.
bool is_about(const DescriptionError& error, const physics::Parameter& parameter);

}  // namespace zerodrift::diagnosis
