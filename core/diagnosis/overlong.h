#pragma once
// Is a rod described longer than it is? What lies beyond the last thing that is known of it takes up heat and grows
// with the room: cut off again, it looks like a joint that conducts nothing and a structure that follows the room the
// other way round.

#include <optional>
#include <string>

#include "core/diagnosis/selection.h"

namespace zerodrift::diagnosis {

struct Overlong {
  std::string component;
  double described_mm = 0.0;
  double fits_mm = 0.0;  // the length with which it explains the recording
  double bare_mm = 0.0;  // of the described length, at its free end, with nothing on it
};

/// "overlong:COMPONENT".
std::string note_of(const Overlong& found);

/// The rod that, cut off somewhere beyond all that is described on it, explains the recording clearly better than
/// `best` does, by itself or beside what is then found missing. Nothing where no rod has a long bare end. `data`: with
/// default widths.
std::optional<Overlong> overlong_rod(const Model& base, const Model& best, const std::shared_ptr<const Dataset>& data,
                                     const physics::RunFacts& facts, SelectionOptions limits,
                                     const TaskContext& context);

}  // namespace zerodrift::diagnosis
