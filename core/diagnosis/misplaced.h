#pragma once
// Does a sensor read what another place of its component would? A place in metres, or two cables exchanged, looks like
// missing physics that no law has.

#include <optional>
#include <string>

#include "core/diagnosis/selection.h"

namespace zerodrift::diagnosis {

struct Misplaced {
  std::string channel;
  double described_mm = 0.0;
  double at_mm = 0.0;          // where it reads as if it sat
  std::string exchanged_with;  // the channel with which it changes places; empty: it alone
  std::string all_in;  // the unit that suits the places of all sensors of its component: "cm", "in", "m"; or empty
};

/// "misplaced:CHANNEL", "exchanged:CHANNEL:CHANNEL" or "places_in:UNIT".
std::string note_of(const Misplaced& found);

/// The sensor whose place, changed, explains the recording far better than `best` does, beside what `best` names of
/// the machine or what is found missing with the sensor there; nothing where no place does, or where much is
/// left even so. `data`: with default widths.
std::optional<Misplaced> misplaced_sensor(const Model& base, const Model& best,
                                          const std::shared_ptr<const Dataset>& data, const physics::RunFacts& facts,
                                          SelectionOptions limits, const TaskContext& context);

/// The same some per cent of the length to either side of where they are described: the sensors next to a joint that
/// `best` names, and those that it names as late or of another gain.
std::optional<Misplaced> a_little_misplaced(const Model& base, const Model& best,
                                            const std::shared_ptr<const Dataset>& data);

}  // namespace zerodrift::diagnosis
