// What is named where a number of the description is wrong: sought again with that number corrected, or doubted.
#include <fmt/format.h>

#include <algorithm>

#include "core/diagnosis/confidence.h"
#include "core/diagnosis/diagnoser.h"
#include "core/diagnosis/explain.h"
#include "core/diagnosis/misstated.h"
#include "core/diagnosis/refine.h"

namespace zerodrift::diagnosis {

using physics::Machine;

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
  m_corrected = number->number;
  answer_anew(std::move(*again));
  return true;
}

/// What was found for a description that was changed first.
void Diagnoser::answer_anew(Selection again) {
  m_selection = std::move(again);
  m_data = m_default_data;
  m_wide = false;
  m_of_others.reset();
  m_out.held_out.clear();
  m_out.tried.clear();
  m_out.forms.clear();
  m_out.sizes.clear();
  held_out();
}

/// An effect that is described and that the machine does not have looks like whatever undoes it. Sought again without
/// it: where it is there, that finds at most the same again, as a hypothesis.
bool Diagnoser::leave_out_what_is_not_there() {
  if (m_out.verdict == Verdict::consistent || m_lumps_only) return false;
  const std::size_t named = m_selection.effects().size();
  constexpr double not_needed = 5.0;   // beside nothing else
  constexpr double hopeless = 2000.0;  // after three steps
  const double as_described = evidence_on(m_default_data, *m_selection.base);
  std::optional<Selection> likeliest;
  double most = evidence_on(m_default_data, *m_selection.best);
  for (std::size_t i = 0; i < m_bodies.effects.size(); ++i) {
    Machine without = m_bodies;
    without.effects.erase(without.effects.begin() + static_cast<std::ptrdiff_t>(i));
    Model base(without, m_default_data);
    base.start_from(*m_selection.base, false);
    base.fit({3, 0.05, true});
    if (base.log_evidence() < as_described - hopeless) continue;
    base.fit({15, 0.05, true});
    if (base.log_evidence() < as_described + not_needed) continue;
    Result<Selection> again = select_effects(without, m_default_data, m_facts, m_limits, m_context);
    if (!again || excess_of(*again->best).largest > least_evident) continue;
    // Descriptions are mostly right, but so are those in which less is missing.
    const double clearly = again->effects().size() < named ? 0.0 : 10.0;
    const double evidence = evidence_on(m_default_data, *again->best) - clearly;
    if (evidence <= most) continue;
    most = evidence;
    m_not_there = m_bodies.effects[i];
    likeliest = std::move(*again);
  }
  if (!likeliest) return false;
  m_out.notes.push_back("described_not_there:" + m_not_there->id);
  answer_anew(std::move(*likeliest));
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
