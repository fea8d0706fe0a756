#pragma once
// Candidates made models: the best-scored forms refitted and polished, and the same models started elsewhere.

#include <memory>
#include <span>
#include <vector>

#include "core/diagnosis/screening.h"

namespace zerodrift::diagnosis {

using ModelPtr = std::shared_ptr<Model>;

struct RefineOptions {
  int per_family = 2;
  double least_gain = 6.0;
  std::size_t most = 18;
};

const physics::EffectSpec& last_effect(const Model& model);
bool by_evidence(const ModelPtr& a, const ModelPtr& b);

/// `base` with each of the best-scored forms, fitted, best first.
std::vector<ModelPtr> refine(const ModelPtr& base, const std::vector<Candidate>& screened,
                             const RefineOptions& options);
/// The best forms in the place of one effect, fitted, best first; its own family only if `own_family`.
std::vector<ModelPtr> in_place_of(const Model& best, std::size_t effect, const physics::RunFacts& facts,
                                  bool own_family);

/// Could a model that is `behind` the front of a beam, in log evidence, get there with one more of what was screened
/// beside it? What ends the models before it in the beam is not counted: the two together were tried from there.
bool may_catch_up(const Model& model, double behind, std::span<const ModelPtr> before,
                  const std::vector<Candidate>& screened);

/// One effect in its other forms - another law, bearing or driver; at the same place - fitted from where the model
/// stands; without those that stay far behind it. Another effect's place found beside a wrong form, and the form chosen
/// before there was another effect, keep each other: a search that leaves out one of them does not get away from there.
std::vector<ModelPtr> in_other_forms(const Model& model, std::size_t effect, const physics::RunFacts& facts);

/// The machine's own unknowns stand about where the description puts them.
bool near_its_description(const Model& model);
/// The same effects, with the machine's own unknowns started anew at the description. A description fitted without the
/// effect has bent itself round it - the length follows the wrong body, heat enters the other one - and from there the
/// fit with the effect does not find back: it is another valley. The last effect is tried where it stands and where it
/// scores best beside the description. None where all lead to the same valley.
ModelPtr restarted(const Model& fit, const physics::RunFacts& facts);
/// The same effects, with the machine's own unknowns started as another model found them.
ModelPtr in_the_valley_of(const Model& fit, const Model& other);
/// Each place of a candidate tried again from both sides: where it stands between two sensors, or beside a bearing, has
/// more than one valley. The best of them, or the model itself.
ModelPtr with_places_tried(const ModelPtr& model);

/// The same hypothesis fitted under other noise.
ModelPtr refitted_under(const Model& model, const std::shared_ptr<const Dataset>& data);
/// As described: without hypotheses.
physics::Machine without_candidates(physics::Machine machine);

}  // namespace zerodrift::diagnosis
