#pragma once
// Is the description of this machine, and the recording of this description? Units that are off, a machine that was
// never driven and a sign the wrong way round are no missing physics.

#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/diagnosis/model.h"

namespace zerodrift::diagnosis {

/// An error naming the channel whose movement differs from the simulated one by more than any missing effect could.
Status check_scale(const physics::Machine& machine, const Dataset& data, const physics::Prediction& nominal);

/// An error where the times only make sense in minutes, hours or milliseconds, or the speeds in 1000 rpm or percent:
/// the machine as described is nothing like the recording, but is like it with other ones.
Status check_times(const physics::Machine& machine, const recording::Recording& recording);

struct LoadUnit {
  const char* symbol;  // "kW", "%", or "kW / %" where it may be either
  double most = 0.0;   // as logged
};
/// The unit in which the load would be one of this machine's motor, and hardly any in W; the fit goes on.
std::optional<LoadUnit> load_in_other_unit(const physics::Machine& machine, const recording::Recording& recording);

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
/// Does any source only have a shape?
bool has_unknown_heat(const physics::Machine& machine);

/// Does the measured displacement follow the described one with the sign turned?
bool is_mirrored(const MeasuredChannel& channel, const std::vector<double>& nominal);

}  // namespace zerodrift::diagnosis
