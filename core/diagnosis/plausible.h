#pragma once
// Is the description one of this machine? A number far from what a fit makes of it, and a sign the wrong way round, are
// no missing physics.

#include <string>
#include <vector>

#include "core/diagnosis/model.h"

namespace zerodrift::diagnosis {

/// What a fit has made of a number of the description.
struct FarParameter {
  std::string quantity;     // id in the catalogue of sentences: "quantity_heat" ...
  std::string of;           // component or source
  double factor = 1.0;      // fitted over described
  double widths = 0.0;      // of its tolerance
  std::size_t unknown = 0;  // of the model that was asked
};
/// Numbers of the description that a fit has moved out of all tolerance (more than four widths), farthest first.
std::vector<FarParameter> far_from_description(const Model& model);
/// Moved by so much that a unit or a size must be wrong, and what is named beside it stands for that.
bool is_doubtful(const std::vector<FarParameter>& far);

/// So far that nobody could have meant the description: it is of another machine, material or unit.
bool is_beyond_belief(const std::vector<FarParameter>& far);

/// Does the measured displacement follow the described one with the sign turned?
bool is_mirrored(const MeasuredChannel& channel, const std::vector<double>& nominal);

}  // namespace zerodrift::diagnosis
