#include "core/diagnosis/misplaced.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/diagnosis/parallel.h"
#include "core/diagnosis/places_tried.h"
#include "core/diagnosis/refine.h"
#include "core/diagnosis/selection.h"

namespace zerodrift::diagnosis {
namespace {

constexpr double all_explained = 1.0;  // right models leave 0.3 to 1
constexpr double far_behind = 200.0;   // in log evidence, after a step or a few: no further ones would make that good
constexpr FitOptions fit_options{8, 0.1, true};
constexpr FitOptions as_it_stands{0, 0.1, true};
constexpr FitOptions glance{1, 0.1, true};
constexpr FitOptions few_steps{3, 1.0, true};

std::shared_ptr<Model> refitted(physics::Machine machine, const Model& like, const std::shared_ptr<const Dataset>& data,
                                const FitOptions& options = fit_options) {
  auto model = std::make_shared<Model>(std::move(machine), data);
  model->start_from(like, false);
  model->fit(options);
  return model;
}

/// The trial's places with the effects of `like`.
void fit(Trial& trial, const Model& like, const std::shared_ptr<const Dataset>& data,
         const FitOptions& options = fit_options) {
  trial.fit = refitted(placed(like.machine(), trial.what), like, data, options);
}

/// Two exchanged in the machine as it is described. What was fitted to the wrong places is bent so far that a step from
/// there says nothing.
void fit_exchange(Trial& trial, const physics::Machine& described, const std::shared_ptr<const Dataset>& data) {
  trial.fit = std::make_shared<Model>(placed(described, trial.what), data);
  trial.fit->fit(few_steps);
}

/// Descriptions are mostly right about places: the log evidence that a wrong one has to show. A few per cent are seen
/// as often as the joints and the faults of sensors that they pass for, of which each has 60 and more over any place.
double clearly(const Trial& trial) {
  switch (trial.kind) {
    case Mistake::a_little_aside:
      return 3.0;
    case Mistake::typical:
      return 10.0;
    case Mistake::another_place:
      break;
  }
  return 25.0;
}

/// Where the best says that this sensor itself is at fault it has seen that something is wrong with it: its place need
/// only be the likelier fault.
double clearly(const Trial& trial, const Model& best) {
  constexpr double as_a_fault = 10.0;
  const auto& effects = best.machine().effects;
  const bool at_fault = std::any_of(effects.begin(), effects.end(), [&](const physics::EffectSpec& spec) {
    return spec.candidate && spec.id.starts_with("sensor_") && spec.word_or("channel", "") == trial.what.channel;
  });
  return at_fault ? std::min(as_a_fault, clearly(trial)) : clearly(trial);
}

bool is_typical(const Trial& trial) {
  return trial.kind == Mistake::typical;
}

bool likelier(const Trial& a, const Trial& b) {
  return a.fit->log_evidence() - clearly(a) > b.fit->log_evidence() - clearly(b);
}

/// Nothing is left that a place could not explain: what moves elsewhere would bend the temperatures to suit itself.
bool leaves_little(const Model& fit) {
  constexpr double least_that_counts = 3.0;
  return excess_of(fit).largest <= least_that_counts;
}

/// Which trial beats the description, and by how much it must.
class Contest {
 public:
  Contest(const Model& base, const Model& best, std::shared_ptr<const Dataset> data) : m_data(std::move(data)) {
    in_parallel(3, [&](std::size_t i) {
      if (i == 0) m_base = refitted(base.machine(), base, m_data);
      if (i == 1) m_described = refitted(best.machine(), best, m_data);
      // The machine may lack something besides, but what a wrong place looks like is often named as a sensor's fault.
      if (i == 2) m_sound = refitted(without_sensor_faults(best.machine()), best, m_data);
    });
  }

  bool wins(const Trial& trial) const { return is_likelier(trial) && leaves_little(*trial.fit); }
  std::vector<Trial> tried_alone(std::vector<Trial> trials) const {
    std::vector<Trial> exchanges;
    std::copy_if(trials.begin(), trials.end(), std::back_inserter(exchanges), is_exchange);
    std::erase_if(trials, is_exchange);
    trials = tried_beside(*m_base, std::move(trials));
    const auto behind = [&](const Trial& one, double least) {
      return one.fit->log_evidence() < m_base->log_evidence() + least;
    };
    in_parallel(exchanges.size(), [&](std::size_t i) { fit_exchange(exchanges[i], m_base->machine(), m_data); });
    std::erase_if(exchanges, [&](const Trial& one) { return behind(one, -far_behind); });
    in_parallel(exchanges.size(), [&](std::size_t i) { exchanges[i].fit->fit(fit_options); });
    std::erase_if(exchanges, [&](const Trial& one) { return behind(one, clearly(one)); });
    std::move(exchanges.begin(), exchanges.end(), std::back_inserter(trials));
    std::sort(trials.begin(), trials.end(), likelier);
    return trials;
  }
  std::vector<Trial> tried_beside(const Model& like, std::vector<Trial> trials) const {
    // A glance first: what a step promises, and then what it gains, tells most places from any that could win.
    const double least = like.log_evidence() - far_behind;
    in_parallel(trials.size(), [&](std::size_t i) {
      fit(trials[i], like, m_data, as_it_stands);
      Model& there = *trials[i].fit;
      if (there.log_evidence() + there.promised() >= least) there.fit(glance);
    });
    std::erase_if(trials, [&](const Trial& one) { return one.fit->log_evidence() < least; });
    in_parallel(trials.size(), [&](std::size_t i) { trials[i].fit->fit(fit_options); });
    std::erase_if(trials,
                  [&](const Trial& one) { return one.fit->log_evidence() < like.log_evidence() + clearly(one); });
    std::sort(trials.begin(), trials.end(), likelier);
    return trials;
  }
  /// Between the places that were tried, on while it gets better, then finer: a fit from a place far off bends what is
  /// described.
  void narrow(Trial& found) const {
    if (found.kind == Mistake::typical) return;
    constexpr double finest = 0.005;  // of the length: what a tape measure tells
    constexpr int most_rounds = 12;
    const double length_mm = rod_of(found).length_mm;
    double step_mm = (found.kind == Mistake::a_little_aside ? 0.01 : 0.3 / tried_per_rod) * length_mm;
    for (int round = 0; round < most_rounds && step_mm > finest * length_mm; ++round) {
      std::vector<Trial> nearer;
      for (const double steps : {-2.0, -1.0, 1.0, 2.0}) {
        nearer.push_back(found);
        nearer.back().what.at_mm = std::clamp(found.what.at_mm + steps * step_mm, 0.0, length_mm);
      }
      const double from_mm = found.what.at_mm;
      const Model like = *found.fit;
      in_parallel(nearer.size(), [&](std::size_t i) { fit(nearer[i], like, m_data); });
      for (Trial& one : nearer) {
        if (likelier(one, found)) found = std::move(one);
      }
      if (!is_likelier(found)) return;
      if (std::abs(found.what.at_mm - from_mm) < 1.5 * step_mm) step_mm /= 3.0;
    }
  }
  const Model& sound() const { return *m_sound; }
  const std::shared_ptr<const Dataset>& data() const { return m_data; }

 private:
  bool is_likelier(const Trial& trial) const {
    return trial.fit->log_evidence() > m_described->log_evidence() + clearly(trial, *m_described);
  }

  std::shared_ptr<const Dataset> m_data;
  std::shared_ptr<Model> m_base, m_described, m_sound;
};

/// The best of each list in turn, each place once, from the list where it explains more.
std::vector<Trial> leaders(const std::vector<Trial>& one, const std::vector<Trial>& other) {
  constexpr std::size_t most = 3;
  std::vector<Trial> list;
  for (std::size_t i = 0; i < std::max(one.size(), other.size()); ++i) {
    for (const auto* trials : {&one, &other}) {
      if (i >= trials->size()) continue;
      const Trial& next = (*trials)[i];
      const auto had =
          std::find_if(list.begin(), list.end(), [&](const Trial& earlier) { return same_place(next, earlier); });
      if (had == list.end()) {
        if (list.size() < most) list.push_back(next);
      } else if (likelier(next, *had)) {
        *had = next;
      }
    }
  }
  return list;
}

}  // namespace

std::string note_of(const Misplaced& found) {
  if (!found.all_in.empty()) return "places_in:" + found.all_in;
  return found.exchanged_with.empty() ? "misplaced:" + found.channel
                                      : "exchanged:" + found.channel + ":" + found.exchanged_with;
}

class PlaceSearch::Search {
 public:
  Search(const Model& base, const Model& best, const std::shared_ptr<const Dataset>& data,
         const physics::RunFacts& facts, const SelectionOptions& limits, const TaskContext& context)
      : m_base(base),
        m_best(best),
        m_contest(base, best, data),
        m_facts(facts),
        m_limits(beside_a_mistake(limits)),
        m_context(context) {}

  void try_anywhere() {
    const std::vector<Trial> trials = places_anywhere(m_base, m_best, m_contest.sound());
    const std::vector<Trial> alone = m_contest.tried_alone(trials);
    m_leading = leaders(alone, m_contest.tried_beside(m_contest.sound(), trials));
    if (m_leading.empty()) return;
    std::sort(m_leading.begin(), m_leading.end(), likelier);
    m_found = m_leading.front();
    m_contest.narrow(*m_found);
  }

  std::optional<Misplaced> at_once() {
    if (!m_found) return std::nullopt;
    if (m_contest.wins(*m_found)) {
      return is_typical(*m_found) || explains_all(*m_found) ? std::optional(m_found->what) : std::nullopt;
    }
    look_besides();
    return m_contest.wins(*m_found) && explains_all(*m_found) ? std::optional(m_found->what) : std::nullopt;
  }

  std::optional<Misplaced> anywhere() {
    if (!m_found) return std::nullopt;
    look_besides();
    return m_contest.wins(*m_found) ? std::optional(m_found->what) : std::nullopt;
  }

  std::optional<Misplaced> aside() const {
    for (const auto& [trials, without] : aside_of_what_is_named(m_base, m_best)) {
      const std::vector<Trial> tried = m_contest.tried_beside(*refitted(without, m_best, m_contest.data()), trials);
      if (tried.empty()) continue;
      Trial found = tried.front();
      m_contest.narrow(found);
      if (m_contest.wins(found)) return found.what;
    }
    return std::nullopt;
  }

 private:
  static bool explains_all(const Trial& one) { return excess_of(*one.fit).largest <= all_explained; }

  /// What else is missing was sought with the sensor where it is not: once more, with each where it may be.
  void look_besides() {
    // Where nothing is left all else that is missing stands in the best, beside which the places were tried.
    if (m_looked || m_contest.wins(*m_found) || excess_of(m_best).largest <= all_explained) return;
    m_looked = true;
    for (Trial& one : m_leading) {
      const auto selected =
          select_effects(without_candidates(one.fit->machine()), m_contest.data(), m_facts, m_limits, m_context);
      if (!selected) return;
      one.fit = refitted(selected->best->machine(), *selected->best, m_contest.data());
      if (likelier(one, *m_found)) m_found = one;
    }
    m_contest.narrow(*m_found);
  }

  const Model& m_base;
  const Model& m_best;
  Contest m_contest;
  const physics::RunFacts& m_facts;
  SelectionOptions m_limits;
  const TaskContext& m_context;
  std::vector<Trial> m_leading;  // of the places anywhere
  std::optional<Trial> m_found;
  bool m_looked = false;
};

PlaceSearch::PlaceSearch(const Model& base, const Model& best, const std::shared_ptr<const Dataset>& data, Reach reach,
                         const physics::RunFacts& facts, const SelectionOptions& limits, const TaskContext& context) {
  if (reach == Reach::aside && aside_of_what_is_named(base, best).empty()) return;
  m_search = std::make_unique<Search>(base, best, data, facts, limits, context);
  if (reach == Reach::anywhere) m_search->try_anywhere();
}

PlaceSearch::~PlaceSearch() = default;

std::optional<Misplaced> PlaceSearch::at_once() {
  return m_search ? m_search->at_once() : std::nullopt;
}

std::optional<Misplaced> PlaceSearch::beside_more() {
  if (!m_search) return std::nullopt;
  if (auto found = m_search->anywhere()) return found;
  return m_search->aside();
}

}  // namespace zerodrift::diagnosis
