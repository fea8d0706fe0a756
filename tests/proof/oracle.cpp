#include "tests/proof/oracle.h"

#include <algorithm>
#include <memory>

#include "core/diagnosis/screening.h"

namespace zerodrift::proof {
namespace {

using diagnosis::Model;
using ModelPtr = std::shared_ptr<Model>;

/// The best form of one effect added to a model.
ModelPtr with_effect(const ModelPtr& base, const std::string& id, const physics::RunFacts& facts) {
  auto screened = diagnosis::screen(*base, facts);
  std::erase_if(screened, [&](const auto& candidate) { return candidate.spec.id != id; });
  if (screened.size() > 6) screened.resize(6);
  ModelPtr best;
  for (const auto& candidate : screened) {
    const ModelPtr fit = diagnosis::extended(*base, candidate);
    fit->fit({20, 0.02, true});
    if (best == nullptr || fit->log_evidence() > best->log_evidence()) best = fit;
  }
  return best == nullptr ? base : best;
}

}  // namespace

OracleAnswer told_the_truth(const physics::Machine& machine, const Case& one) {
  const auto& recording = one.recordings.front();
  const physics::Network network = physics::build_network(machine, recording);
  auto data = std::make_shared<diagnosis::Dataset>(diagnosis::make_dataset(recording, network));
  diagnosis::set_timing_noise(*data, network, physics::make_inputs(network, recording));
  const physics::RunFacts facts = diagnosis::facts_of(machine, recording);
  const auto base = std::make_shared<Model>(machine, data);
  base->fit({20, 0.02, true});
  std::vector<std::string> ids;
  for (const auto& hidden : one.hidden) ids.push_back(hidden.id);
  ModelPtr best;
  for (int order = 0; order < 2; ++order) {
    ModelPtr model = base;
    for (const auto& id : ids) model = with_effect(model, id, facts);
    if (best == nullptr || model->log_evidence() > best->log_evidence()) best = model;
    std::reverse(ids.begin(), ids.end());
  }
  OracleAnswer answer;
  answer.evidence = best->log_evidence() - base->log_evidence();
  for (std::size_t i = machine.effects.size(); i < best->machine().effects.size(); ++i) {
    const auto less = diagnosis::reduced(*best, i);
    less->fit({20, 0.02, true});
    answer.beside[best->machine().effects[i].id] = best->log_evidence() - less->log_evidence();
  }
  return answer;
}

}  // namespace zerodrift::proof
