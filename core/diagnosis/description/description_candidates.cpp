#include "core/diagnosis/description/description_candidates.h"

#include <algorithm>
#include <iterator>
#include <map>

#include "core/diagnosis/description/machine_errors.h"

namespace zerodrift::diagnosis::description {

std::vector<PossibleError> description_candidates(const inference::Fit& straight, const inference::Fit& usual,
                                                  const inference::Fit& settled, std::size_t most) {
  const DiagnosisSettings& settings = usual.model().evidence().settings();
  std::vector<PossibleError> all = sensor_errors(usual);
  for (auto more : {machine_errors(straight), number_errors(settled)})
    std::move(more.begin(), more.end(), std::back_inserter(all));
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.log_odds > b.log_odds; });
  std::vector<PossibleError> list;
  std::map<ErrorKind, std::size_t> of_kind;
  for (PossibleError& one : all) {
    if (list.size() == most || one.log_odds < -settings.decisive) break;
    if (of_kind[one.error.kind]++ < settings.forms_of_a_kind) list.push_back(std::move(one));
  }
  return list;
}

}  // namespace zerodrift::diagnosis::description
