#pragma once
// The search over hypotheses: from the machine as described, effects are added one at a time (score test, fit, sizes of
// the discrepancy by evidence), and dropped again where the rest is more likely without. Everything that was fitted
// stays in the posterior; log posterior odds are the one currency.

#include <memory>
#include <vector>

#include "core/base/task_context.h"
#include "core/diagnosis/inference/fit.h"

namespace zerodrift::diagnosis::search {

/// One hypothesis that was fitted.
struct Explanation {
  std::shared_ptr<const inference::Fit> fit;
  double log_posterior = 0.0;  // ln evidence and priors, up to the same constant
};

struct Posterior {
  std::shared_ptr<const inference::Evidence> evidence;
  std::vector<Explanation> explanations;  // best first, within the margin; the machine as described is always there
  std::size_t described = 0;              // its index
  std::shared_ptr<const inference::Fit> described_straight;  // not fitted, with the discrepancy at its usual size
  int fitted = 0;                                            // hypotheses that were fitted in all
};

Result<Posterior> stepwise_search(std::shared_ptr<const inference::Evidence> evidence, const TaskContext& context);

}  // namespace zerodrift::diagnosis::search
