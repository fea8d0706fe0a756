#pragma once
// A number of the description that is wrong bends the fit and looks like physics: half the power of a motor like heat
// that nobody described, a third of a conductivity like joints that conduct badly. Told apart by describing it as the
// fit would have it.

#include <memory>
#include <optional>
#include <string>

#include "core/diagnosis/plausible.h"

namespace zerodrift::diagnosis {

struct Misstated {
  FarParameter number;         // with the factor by which the description has to change
  std::shared_ptr<Model> fit;  // of the description so changed, fitted
};

/// The machine of `model`, fitted, with the number that its fit moved farthest out of its tolerance described so that
/// it need not. None where none moved so far, or it is none of a source or a material.
std::optional<Misstated> as_if_described(const Model& model);

/// `best` without the effects of that id, fitted.
std::shared_ptr<Model> fitted_without(const Model& best, const std::string& id);

/// The same, of `without`, the best without some effects, where it explains the recording nearly as well as the best
/// or better.
std::optional<Misstated> misstated_instead(const Model& best, const Model& without);

}  // namespace zerodrift::diagnosis
