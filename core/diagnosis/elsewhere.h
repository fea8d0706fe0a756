#pragma once
// What other recordings of the machine say of an effect that the fitted one leaves in doubt.

#include "core/diagnosis/refine.h"
#include "core/diagnosis/selection.h"

namespace zerodrift::diagnosis {

using OtherRecordings = std::vector<std::shared_ptr<const Dataset>>;  // with default widths

/// Something that happened in one recording says nothing about another.
bool happened_once(const Model& model);
/// Whether the last effect is large enough to be what is missing. Every machine has a little of some: its nose, too,
/// loses more when it turns, and oil that thins by a thousandth a kelvin is what its sheet says. Two recordings
/// together may well show so little.
bool worth_naming(const Model& model);
/// Whether an effect is a chiller that does not come and go: a heat, whatever else.
bool stands_still(const Model& model, std::size_t effect);
/// Whether the last effect is no more than a sound part may have: the gain of a sensor within 1 %, the proportional
/// part of IEC 60751's class C, its widest; a bearing's load within two widths of what its heat is known to - load, f0
/// and f1 are catalogue figures, and the two terms of the friction moment are not known better against each other than
/// their sum; or is a chiller that stands still.
bool within_tolerance(const Model& model);

/// Sets for each model the log evidence that the other recordings, in turn, have beside `without`: of each recording
/// under what the fit to those before it knows of the machine. Leaves out models that do not fit there - a recording of
/// another machine judges nobody.
void ask_elsewhere(std::vector<ModelPtr>& models, const Model& without, const OtherRecordings& others);
/// Whether the others bear a model out: with what it has shown of the machine they fit, and they are likelier than
/// beside `without`. What a recording leaves uncertain stays uncertain here; a prediction with its likeliest numbers
/// may miss by it. `most_left`: what is slow in the worst channel of a model that still fits (excess_of).
bool borne_out(const Model& fit, const Model& without, const OtherRecordings& others, double most_left = least_evident);
/// Does another recording fit the machine, with all that the fitted one leaves uncertain of it free?
bool fits_elsewhere(const Model& fit, const std::shared_ptr<const Dataset>& other);
/// The displacement that needs more than the ordinary misfit in another recording, with what the fitted one has shown
/// of the machine, where no temperature does; empty where there is none. An expansion or an offset of the description
/// may hide in one run what moves the nose, but not in two.
std::string moved_elsewhere(const Model& fit, const OtherRecordings& others);
/// Of the fitted recording, and of the others where they were asked.
double evidence_of(const Model& model);
/// The model in each of the others, with what the fitted one and those before have shown of the machine.
struct SeenByAll {
  std::vector<ModelPtr> fits;  // none where it does not fit one of them
  Sensors sensors = Sensors::anew;
};
/// A sensor has the same offset in all recordings unless it was mounted anew: what the evidence says. What two
/// recordings say of a place is not independent where one offset is in both.
SeenByAll seen_by_all(const Model& fit, const OtherRecordings& others);

}  // namespace zerodrift::diagnosis
