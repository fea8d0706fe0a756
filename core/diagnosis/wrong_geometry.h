#pragma once
// Is a rod described in another shape than it has? Too long, its bare end takes up heat and grows with the room: cut
// off again, it looks like a joint that conducts nothing and a structure that follows the room the other way round.
// Places told from the other end or from another edge look like heat where nobody described any, a radius for a
// diameter like four motors.

#include <optional>
#include <string>

#include "core/diagnosis/selection.h"

namespace zerodrift::diagnosis {

struct WrongGeometry {
  enum class What {
    length,     // longer than it is, beyond the last thing that is known of it
    other_end,  // its sensors' places from one end, its heat sources' from the other
    datum,      // its sensors' places from another edge
    diameter
  };
  What what = What::length;
  std::string component;
  double described_mm = 0.0;  // length or diameter
  double fits_mm = 0.0;  // with which it explains the recording; datum: by how much they sit farther from the fixed end
  double bare_mm = 0.0;  // length: at its free end, with nothing on it
};

/// "overlong:COMPONENT", "other_end:COMPONENT", "datum:COMPONENT" or "diameter:COMPONENT".
std::string note_of(const WrongGeometry& found);

struct GeometryAsked {
  const physics::Machine& described;  // without the insides that the diagnosis adds to it
  const Model& base;                  // fitted without effects
  const Model& best;
  bool stands = true;                   // what `best` names explains the recording
  std::shared_ptr<const Dataset> data;  // with default widths
};

/// The mistake in a rod's geometry without which the recording is clearly likelier than with what `best` names, beside
/// less that is missing.
std::optional<WrongGeometry> wrong_geometry(const GeometryAsked& asked, const physics::RunFacts& facts,
                                            SelectionOptions limits, const TaskContext& context);

}  // namespace zerodrift::diagnosis
