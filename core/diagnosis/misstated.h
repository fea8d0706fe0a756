#pragma once
// A described heat whose number is wrong looks like heat that nobody described, at the place of the described one.

#include <memory>
#include <optional>
#include <string>

#include "core/diagnosis/model.h"

namespace zerodrift::diagnosis {

struct Misstated {
  std::string source;   // its id in the description
  double factor = 1.0;  // what its heat must be, over what is described
};

/// `best` without the effects of that id, fitted.
std::shared_ptr<Model> fitted_without(const Model& best, const std::string& id);

/// What explains the recording as well as `best` without the effect that `without` lacks (both fitted): the described
/// heat that the fit without it moved farthest out of its tolerance, were it described so. None where that does not
/// explain it as well.
std::optional<Misstated> misstated_heat(const Model& best, const Model& without);

}  // namespace zerodrift::diagnosis
