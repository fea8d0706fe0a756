// What is named where a number of the description is wrong: sought again with that number corrected, or doubted.
#include <fmt/format.h>

#include <algorithm>

#include "core/diagnosis/confidence.h"
#include "core/diagnosis/diagnoser.h"
#include "core/diagnosis/explain.h"
#include "core/diagnosis/misstated.h"
#include "core/diagnosis/refine.h"

namespace zerodrift::diagnosis {

/// Of the same hypothesis under the ordinary noise.
static double evidence_on(const std::shared_ptr<const Dataset>& data, const Model& model) {
  if (model.shared_data() == data) return model.log_evidence();
  return refitted_under(model, data)->log_evidence();
}

/// What a wrong number of the description has bent is sought again with that number as the fit would have it; kept
/// where the recording then asks for nothing far from the description, and is clearly likelier so.
bool Diagnoser::correct_description() {
  constexpr double clearly = 10.0;  // descriptions are mostly right
  const Model& best = *m_selection.best;
  const std::vector<std::size_t> named = m_selection.effects();
  if (named.empty() || m_lumps_only) return false;
  std::optional<Misstated> number;
  if (is_doubtful(m_far)) {
    number = as_if_described(best);
  } else {
    for (std::size_t i = 0; i < named.size() && !number; ++i) {
      number = misstated_instead(best, *without_kind(i));
      if (number && number->fit->log_evidence() < best.log_evidence() + clearly) number.reset();
    }
  }
  if (!number) return false;
  Result<Selection> again =
      select_effects(without_candidates(number->fit->machine()), m_default_data, m_facts, m_limits, m_context);
  if (!again || excess_of(*again->best).largest > least_evident || !far_from_description(*again->best).empty() ||
      evidence_on(m_default_data, *again->best) < evidence_on(m_default_data, best) + clearly) {
    return false;
  }
  m_selection = std::move(*again);
  m_data = m_default_data;
  m_wide = false;
  m_corrected = number->number;
  m_of_others.reset();
  m_out.held_out.clear();
  m_out.tried.clear();
  m_out.forms.clear();
  m_out.sizes.clear();
  held_out();
  return true;
}

/// The best without one of the effects it has, and without those of the same kind: two may share what one number lacks.
std::shared_ptr<Model> Diagnoser::without_kind(std::size_t i) const {
  const Model& best = *m_selection.best;
  const std::vector<std::size_t> named = m_selection.effects();
  const auto id_of = [&](std::size_t index) { return best.machine().effects[index].id; };
  const std::string id = id_of(named[i]);
  const auto alike = std::count_if(named.begin(), named.end(), [&](std::size_t index) { return id_of(index) == id; });
  return alike > 1 ? fitted_without(best, id) : m_selection.without[i];
}

/// A number of the description that is wrong may look like this effect.
void Diagnoser::doubt_description(FoundEffect& found, const Model& without) {
  const std::optional<Misstated> instead = misstated_instead(*m_selection.best, without);
  if (!instead) return;
  const FarParameter& number = instead->number;
  found.confidence = std::min(found.confidence, doubt::or_a_number);
  const std::string note = fmt::format("misstated:{}:{}:{:.3g}", number.quantity.substr(9), number.of, number.factor);
  if (std::count(m_out.notes.begin(), m_out.notes.end(), note) != 0) return;
  m_out.notes.push_back(note);
  m_misstated.push_back(explain_misstated(found.id, number));
}

}  // namespace zerodrift::diagnosis
