#pragma once
// One search for effects in the making (selection.cpp), and what a description of lumps needs beside it (grow.cpp).

#include <algorithm>

#include "core/diagnosis/refine.h"
#include "core/diagnosis/selection.h"

namespace zerodrift::diagnosis {

class Selector {
 public:
  Selector(physics::RunFacts facts, const SelectionOptions& options, const TaskContext& context)
      : m_facts(std::move(facts)), m_options(options), m_context(context) {}

  Result<Selection> run(const physics::Machine& machine, std::shared_ptr<const Dataset> data);

  Result<Selection> grow(const physics::Machine& machine, std::shared_ptr<const Dataset>& data);

  Result<Selection> again(const Selection& selection, const std::shared_ptr<const Dataset>& data);

 private:
  Status search();
  void only_what_stands();

  static constexpr double clearly_deeper = 0.5;
  static constexpr double speaks_against = -2.0;

  static ModelPtr under(const Model& model, const std::shared_ptr<const Dataset>& data);

  /// Fitted with the discrepancy that suits it best: such models are compared by their total evidence, so that an
  /// effect has to do better than a latent process in every channel would.
  static ModelPtr with_own_discrepancy(const Model& model, const std::shared_ptr<const Dataset>& usual);

  /// Without the effects that are not needed under the discrepancies that suit them.
  ModelPtr only_needed(ModelPtr best, const std::shared_ptr<const Dataset>& usual) const;

  /// The same with a room that is felt at once; none where it is.
  static ModelPtr without_lag(const Model& model, std::size_t effect);

  /// An effect more where that is worth it under the discrepancies that suit both, else none. Under the default one the
  /// first effects of a crude description gain so much that what they leave is not asked about.
  ModelPtr with_one_more(const ModelPtr& best, const std::shared_ptr<const Dataset>& usual) const;

  /// Is the heat of a lump clearly less at some speed than at a lower one?
  static bool heat_falls(const Model& model, const std::string& component);

  /// Heat that may fall with speed, beside the effects or in the place of one: no law has it, but where it explains
  /// more than they do, they only stand in for it.
  double falling_heat(const Model& best, const std::shared_ptr<const Dataset>& usual) const;

  /// A displacement that settles by itself, or drifts, as the rival of what has a start of its own in each recording;
  /// and one that settles as the rival of none: where it explains as much as an effect, nothing shows that the effect
  /// is there (settling.cpp).
  void try_settling();
  /// Log evidence, with that of others where asked.
  double lead_over_moving_alone(std::size_t effect, const std::string& channel) const;
  bool settles_beside_nothing(const std::string& channel) const;

  /// Comparable between models under noises of their own.
  static bool by_total(const ModelPtr& a, const ModelPtr& b) {
    return a->log_evidence_total() > b->log_evidence_total();
  }
  static double total_gain(const Model& a, const Model& b) { return a.log_evidence_total() - b.log_evidence_total(); }

  /// Fitted with the ordinary discrepancy that suits it best: how much a model leaves belongs to it. A hidden effect
  /// makes the misfit without it look large; compared at the best misfit of both, it is not swallowed by that.
  ModelPtr with_ordinary(const ModelPtr& model) const;
  ModelPtr settled_ordinary(ModelPtr model) const;

  /// The best first effects of different families, each under its own misfit. Under the base's misfit, which has
  /// swallowed what it could of a weak effect, even the right one may look worthless.
  std::vector<ModelPtr> leaders_of(const std::vector<ModelPtr>& fits);

  /// The valley next to the description, where the model lies in another; none where it lies there or for lumps, whose
  /// descriptions are guesses.
  ModelPtr other_valley(const ModelPtr& model) const;

  ModelPtr in_the_deeper_valley(const ModelPtr& model);

  /// None must be as good as it can be before it is beaten: what the description becomes beside an effect may suit it
  /// better without the effect too.
  void base_from(const Model& best);

  /// An effect that this recording leaves in doubt may show in another of the machine: both must show together what one
  /// alone has to. Only what this one does not speak against is asked.
  void ask_others();
  bool ask_others_for_one();

  /// What other recordings add to one effect of an answer that they were asked about.
  double shown_elsewhere(const Model& best, const Model& without) const;

  /// What this recording can hardly tell apart the others may: families, and the forms of each effect. At one speed all
  /// laws are alike, and a source stands elsewhere beside one bearing that is wrong than beside both. Without others,
  /// or where none of that fits there, this one decides alone.
  void tell_apart();

  /// What comes near the best: of it, and beside the last effects of other families, each effect in its other forms;
  /// and, unless the others were asked already, those families.
  std::vector<ModelPtr> rivals_in_doubt(const Model& best, bool asked) const;

  /// Base and rivals under the final model's misfit, so that they can be told against it.
  void align();

  /// Another family in the place of one effect, where it is better; with `forms` also another form of the same.
  bool swap_one(bool forms = false);

  /// `pair`: two effects at once, tried beside one more than each of the beam has; or none.
  void add_one(const std::vector<ModelPtr>& beam, const ModelPtr& pair = nullptr);

  /// None, with two effects that hide each other: one by one neither is found, or the one in a form that makes up for
  /// the other. None where no two do.
  ModelPtr with_pair(const HiddenPair& pair) const;

  /// Are the two there, though none is by itself?
  bool found_together(const ModelPtr& two) const;

  /// Where a second joint beside the first is liked, the one joint may stand where the second was put: with that alone,
  /// where it is better than what there is, else none.
  ModelPtr one_of_its_joints(const Model& doubled) const;

  /// What an effect more has to gain where the others leave nothing slow.
  double least_gain(double so_far) const {
    return std::max(m_options.second_clean, std::min(m_options.clean_relative * so_far, m_options.second));
  }

  /// What an effect against none has to gain.
  double least_first(const Model& fit) const;

  bool accepted(const Model& fit, const Excess& before) const;

  /// Is each effect still needed beside the others? What is added in the place of one that was not is asked the same.
  void eliminate();

  bool remove_one();

  physics::RunFacts m_facts;
  SelectionOptions m_options;
  const TaskContext& m_context;
  std::shared_ptr<const Dataset> m_usual;  // with default widths
  ModelPtr m_other_valley;                 // of a first effect, worth a second one
  bool m_moved = false;                    // some model was better in another valley than where the base had led it
  Selection m_result;
};

}  // namespace zerodrift::diagnosis
