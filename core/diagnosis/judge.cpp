// The verdict: does what was found explain the recording, does the other recording bear it out, and is the machine the
// one described?
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/diagnosis/contradiction.h"
#include "core/diagnosis/diagnoser.h"
#include "core/diagnosis/locate.h"
#include "core/diagnosis/plausible.h"
#include "core/diagnosis/refined.h"

namespace zerodrift::diagnosis {

/// Excess of a prediction under other noise assumptions.
static Excess excess_under(const physics::Prediction& prediction, const Dataset& data) {
  Eigen::VectorXd residual;
  whiten(data, prediction, &residual);
  return excess_of(data, residual);
}

/// What a fitted model leaves, in noise widths of the channel where it is largest.
double Diagnoser::leftover(const physics::Prediction& prediction) const {
  double largest = 0.0;
  for (std::size_t c = 0; c < m_default_data->channels.size(); ++c) {
    const MeasuredChannel& channel = m_default_data->channels[c];
    double sum = 0.0;
    for (std::size_t k = 0; k < m_default_data->rows(); ++k) {
      const double e = channel.present[k] ? channel.values[k] - prediction.channels[c].values[k] : 0.0;
      sum += e * e;
    }
    const double white2 = channel.white * channel.white;
    const double slow2 = channel.samples == 0 ? 0.0 : std::max(0.0, sum / channel.samples - white2);
    largest = std::max(largest, std::sqrt(slow2 / std::max(1e-30, white2 + channel.drift * channel.drift)));
  }
  return largest;
}

void Diagnoser::tell_tried() {
  struct Tried {
    std::string form;
    std::string id;
    double size = 0.0;
  };
  const Model& best = *m_selection.best;
  std::vector<Tried> list;
  for (const std::size_t index : m_selection.effects()) {
    const physics::EffectSpec& spec = best.machine().effects[index];
    Tried tried{spec.id, spec.id};
    for (const auto& [key, word] : spec.words) tried.form += fmt::format(" {}={}", key, word);
    for (std::size_t i = best.unknowns(); i-- > 0;) {
      const physics::Parameter& unknown = best.unknown(i);
      if (unknown.effect != static_cast<int>(index)) continue;
      if (unknown.amplitude) tried.size = best.value(i);
      const double off = std::abs(best.z()[static_cast<Eigen::Index>(i)]);
      if (unknown.per_recording) m_out.unusual_start = std::max(m_out.unusual_start, off);
    }
    list.push_back(std::move(tried));
  }
  std::sort(list.begin(), list.end(), [](const Tried& a, const Tried& b) { return a.form < b.form; });
  for (Tried& tried : list) {
    m_out.tried.push_back(std::move(tried.id));
    m_out.forms.push_back(std::move(tried.form));
    m_out.sizes.push_back(tried.size);
  }
}

void Diagnoser::judge() {
  const physics::Prediction of_base = m_selection.base->prediction();
  const physics::Prediction of_best = m_selection.best->prediction();
  const Excess before = excess_under(of_base, *m_default_data);
  const Excess after = excess_under(of_best, *m_default_data);
  bool asked = false;  // for more discrepancy than a right model shows
  for (const auto& channel : likely_discrepancy(*m_default_data, of_best)) {
    m_out.drift_factor = std::max(m_out.drift_factor, m_wide ? channel.factor : 1.0);
    asked = asked || channel.asks_for_more();
  }
  m_out.excess_before = before.largest;
  m_out.excess_after = after.largest;
  m_warmth_left = after.warmest;
  tell_tried();
  const bool found = !m_selection.effects().empty();
  if (!found) {
    m_out.verdict = after.largest > least_evident ? Verdict::unexplained : Verdict::consistent;
    if (m_out.verdict == Verdict::consistent && !m_lumps_only && m_selection.settling.empty()) {
      m_moved_elsewhere = moved_elsewhere(*m_selection.base, m_limits.others);
    }
    if (!m_moved_elsewhere.empty() || !m_selection.settling.empty()) m_out.verdict = Verdict::unexplained;
    m_used = m_selection.base;
  } else {
    // A listed effect whose law differs a little leaves a few hundredths of the mismatch; what is not listed is
    // imitated less well. The proof has the distribution of both.
    m_out.refuted = refuted();
    const std::vector<std::size_t> named = m_selection.effects();
    const bool stands = std::any_of(named.begin(), named.end(),
                                    [&](std::size_t index) { return stands_still(*m_selection.best, index); });
    const bool wrong =
        m_out.refuted || m_selection.falling_heat > 0.0 || !m_selection.settling.empty() || stands || heat_is_left();
    // What stands for many parts as one lump each is a guess, and leaves what it leaves.
    const double left = leftover(of_best);
    const bool by_far = !m_lumps_only && left > most_left_widths;
    const bool poor = wrong || by_far || (asked && left > most_left * leftover(of_base));
    m_out.verdict = poor ? Verdict::unexplained : Verdict::missing_effect;
    // A wrong effect can worsen the prediction of another run: it is used only if it really helps.
    const bool helps = !wrong && after.mean < 0.7 * before.mean;
    m_used = poor && !helps ? m_selection.base : m_selection.best;
  }
  m_far = far_from_description(*m_used);
}

/// Is something described that is not so: a length, a place, two cables?
void Diagnoser::check_set_up() {
  // A sensor at another place leaves temperatures off, not a displacement alone.
  const bool anywhere = m_warmth_left > least_evident || names_a_sensor() || !m_far.empty();
  PlaceSearch places(*m_selection.base, *m_selection.best, m_default_data, anywhere ? Reach::anywhere : Reach::aside,
                     m_facts, m_limits, m_context);
  m_misplaced = places.at_once();
  if (m_misplaced) return;
  if (!m_lumps_only && (anywhere || !m_selection.effects().empty())) {
    const bool stands = m_out.verdict != Verdict::unexplained && m_far.empty();
    m_wrong_geometry = wrong_geometry({m_machine, *m_selection.base, *m_selection.best, stands, m_default_data},
                                      m_facts, m_limits, m_context);
  }
  if (m_wrong_geometry) return;
  m_misplaced = places.beside_more();
}

void Diagnoser::decide() {
  judge();
  if (leave_out_what_is_not_there()) judge();
  const bool checked = of_use();
  if (checked) check_set_up();
  if (!wrong_set_up() && correct_description()) {
    judge();
    if (!checked && of_use()) check_set_up();
  }
  const auto beyond_belief = [this] {
    return is_beyond_belief(m_far) || (m_corrected && is_beyond_belief({*m_corrected}));
  };
  const bool unbelievable =
      m_selection.effects().empty() ? m_out.verdict == Verdict::consistent && beyond_belief() : is_beyond_belief(m_far);
  // With nothing missing beside it the description has too much: no agreement either.
  const bool too_much = m_not_there && m_out.verdict == Verdict::consistent;
  m_out.wrong_set_up = wrong_set_up();
  if (wrong_set_up() || unbelievable || too_much) {
    m_out.verdict = Verdict::unexplained;
    m_out.doubtful = true;
    m_used = m_selection.base;
  }
  if (wrong_set_up()) m_far.clear();  // the numbers moved to suit the wrong place
  if (m_used == m_selection.base) {
    for (auto& other : m_out.held_out) other.explained = other.refitted;
  }
  if (m_corrected) m_far.insert(m_far.begin(), *m_corrected);
  m_out.refined = refined_machine(*m_used);
  state_room(m_out.refined, *m_used);
  if (!m_from_each_start || m_used == m_selection.base) return;
  m_out.refined.reference_temperature_C.reset();
  m_out.notes.emplace_back("counts_from_each_start");
}

bool Diagnoser::names_a_sensor() const {
  const std::vector<std::size_t> named = m_selection.effects();
  return std::any_of(named.begin(), named.end(), [&](std::size_t index) {
    return m_selection.best->machine().effects[index].id.starts_with("sensor_");
  });
}

/// What is named leaves nothing of a heat that comes and goes at one place: whatever wanders is imitated by something
/// listed, but not wholly. An open door and bearings that run in also have to explain more than such a heat does, for
/// it looks like something that happened once.
bool Diagnoser::heat_is_left() const {
  constexpr double least_that_counts = 3.0;  // twenty to one; 167 right answers left 1.7 at most, travelling heats 5 up
  constexpr double hardly_any = 0.001;       // of what is explained: a law differs a little
  if (m_lumps_only) return false;
  const std::vector<std::size_t> named = m_selection.effects();
  const Model& best = *m_selection.best;
  for (std::size_t i = 0; i < named.size(); ++i) {
    const std::string& id = best.machine().effects[named[i]].id;
    if (id != "draught" && id != "bearing_run_in") continue;
    if (evidence_of_wandering_heat(*m_selection.without[i]) > m_selection.shown[i]) return true;
  }
  const auto most = std::max_element(m_selection.shown.begin(), m_selection.shown.end());
  return evidence_of_wandering_heat(best) > std::max(least_that_counts, hardly_any * *most);
}

}  // namespace zerodrift::diagnosis
