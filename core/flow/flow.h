#pragma once
// The state of each step, derived from the job as a build system does it, and never stored: an artefact that was made
// from something else than what the job holds now is stale, and so is everything made from it. An input that was made
// anew with an equal result makes nothing stale.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/commissioning/job_kind.h"
#include "core/flow/step.h"

namespace zerodrift::flow {

enum class StepState {
  blocked,     // a needed artefact was never made
  ready,       // can be done, and was not yet
  current,     // done, from what the job holds now
  stale,       // done, but from something else
  not_needed,  // about a controller in a job from files only, or about errors where the run holds none
};
std::string_view name_of(StepState state);

enum class Cause {
  missing,   // blocked: the kind is not there
  changed,   // stale: made from another one than the latest
  added,     // stale: it came after this was made, and would be taken in
  upstream,  // the step that makes the kind is stale itself
};

struct Reason {
  Cause cause;
  std::string kind;
  std::string step;                    // that makes it
  commissioning::ArtefactId used = 0;  // 0: none
  commissioning::ArtefactId latest = 0;
};

struct StepStatus {
  const StepInfo* step = nullptr;
  StepState state = StepState::blocked;
  std::vector<Reason> reasons;  // why blocked or stale; of a ready step, what it would build on that is stale
  std::string reason;           // in short: the kind in the first of them
  commissioning::ArtefactId artefact = 0;  // its latest; 0: none
};

class Flow {
 public:
  /// Every step must stand after those that make what it needs or uses.
  explicit Flow(std::span<const StepInfo> steps = standard_steps());

  /// In the order of the steps; they point into this flow.
  Result<std::vector<StepStatus>> status(const commissioning::Job& job) const;
  /// The first step of the main line that is needed and not current; null when all are.
  static const StepStatus* next(const std::vector<StepStatus>& status);

  /// Runs a step and keeps what it made, with what the job held when it began as its inputs. step_blocked when
  /// something it needs is missing; nothing is kept when it fails or is cancelled.
  Result<commissioning::Artefact> perform(commissioning::Job& job, std::string_view step, const StepRun& run,
                                          const TaskContext& context) const;
  /// For a result that was not made from what the job holds now: a run from a file, a former table brought back, an
  /// older result judged anew. It needs nothing and names its inputs itself.
  Result<commissioning::Artefact> take_in(commissioning::Job& job, std::string_view step, const StepRun& run,
                                          const TaskContext& context) const;

 private:
  using LatestOf = std::map<std::string, std::optional<commissioning::Artefact>, std::less<>>;
  using StateOf = std::map<std::string, StepState, std::less<>>;
  StepStatus status_of(const StepInfo& step, const LatestOf& latest, const StateOf& made_by) const;
  /// What the steps have to be about in this job.
  struct Scope {
    bool controller = true;
    bool errors = true;
    bool covers(const StepInfo& step) const { return (controller || !step.controller) && (errors || !step.errors); }
  };
  static Result<Scope> scope_of(const commissioning::Job& job);
  /// Of what an unneeded step would make, nothing waits.
  bool spares(std::string_view kind, const Scope& scope) const;
  std::string maker_of(std::string_view kind) const;
  Result<const StepInfo*> find(std::string_view step) const;

  std::vector<StepInfo> m_steps;
};

/// One of the standard steps. An unknown one is blocked, and so is everything in a job that cannot be read.
StepStatus status_of(const commissioning::Job& job, std::string_view step);

}  // namespace zerodrift::flow
