#pragma once
// Which effects, if any: refit of the best-scored forms, evidence, one or several effects, elimination, adequacy.

#include <algorithm>
#include <map>
#include <memory>
#include <vector>

#include "core/diagnosis/screening.h"

namespace zerodrift::diagnosis {

/// Thresholds on the log evidence (natural logarithm), found on concealed cases; see the proof.
struct SelectionOptions {
  double first = 8.0;             // an effect against none
  double second_screen = 14;      // score gain that makes a second effect worth a refit
  double second_clean = 7.5;      // a second effect where the first leaves nothing slow
  double clean_relative = 0.001;  // of the evidence so far: a strong effect's law is never quite right; up to `second`
  double second = 25;             // a second effect where it does
  double second_relative = 0.002;
  double together = 10.0;  // an effect that two recordings have to show together; of 1200 sound machines one reached 5
  double tiny = 15.0;      // an effect so small that every machine has as much of it; by itself of 400 none reached 5
  int most_effects = 3;
  bool own_misfit = true;        // models are compared at the ordinary misfit that suits each best
  bool excess_must_fall = true;  // a second effect must also remove much of what is slow in some channel
  /// Other recordings of the machine, with default widths: asked where the fitted one leaves an effect in doubt.
  std::vector<std::shared_ptr<const Dataset>> others;
};

/// For what is missing beside a wrong place or shape of the description: little, and in this recording alone.
inline SelectionOptions beside_a_mistake(SelectionOptions options) {
  constexpr int most = 2;
  options.others.clear();
  options.most_effects = std::min(options.most_effects, most);
  return options;
}

/// Excess of slow variation from which on something is missing: right descriptions leave less.
inline constexpr double least_evident = 2.3;

struct Excess {
  std::vector<double> per_channel;
  double largest = 0.0;
  double warmest = 0.0;  // the largest of a temperature
  double mean = 0.0;
};

/// `residual`: whitened under `data`'s noise assumptions.
Excess excess_of(const Dataset& data, const Eigen::VectorXd& residual);
Excess excess_of(const Model& model);

struct Selection {
  std::shared_ptr<Model> base;  // refitted without any effect
  std::shared_ptr<Model> best;
  std::vector<std::shared_ptr<Model>> without;              // the best without each of effects(), fitted
  std::vector<double> shown;                                // log evidence of each, with that of others where asked
  std::vector<Candidate> screened;                          // around the base
  std::vector<std::vector<std::shared_ptr<Model>>> levels;  // refits with one effect more, best first
  double falling_heat = 0.0;  // log evidence by which heat that falls with speed beats the best; 0: it does not
  std::string settling;  // the displacement that settles by itself, where that explains it as well as the best does
  std::map<std::string, double> lead_over_moving_alone;  // log evidence of what follows the room, by displacement
  std::size_t described = 0;                             // effects that the description had
  std::vector<std::size_t> effects() const;              // indices in best->machine().effects
};

Result<Selection> select_effects(const physics::Machine& machine, std::shared_ptr<const Dataset> data,
                                 const physics::RunFacts& facts, const SelectionOptions& options,
                                 const TaskContext& context);

/// For a description so crude (a lump a sensor) that its discrepancy must be learned with its effects: every effect is
/// judged again with the discrepancy that suits the model best with and without it. `data` with default widths;
/// afterwards with the best model's own.
Result<Selection> grow_effects(const physics::Machine& machine, std::shared_ptr<const Dataset>& data,
                               const physics::RunFacts& facts, const SelectionOptions& options,
                               const TaskContext& context);

/// The same effects under other noise: refitted, and dropped where that noise no longer asks for them.
Result<Selection> reconsider(const Selection& selection, const std::shared_ptr<const Dataset>& data,
                             const physics::RunFacts& facts, const SelectionOptions& options,
                             const TaskContext& context);

}  // namespace zerodrift::diagnosis
