#include "core/diagnosis/overlong.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/diagnosis/parallel.h"
#include "core/diagnosis/refine.h"

namespace zerodrift::diagnosis {
namespace {

constexpr double long_end = 0.25;          // of the length: what is nearer the end than that hardly feels it
constexpr double clearly_likelier = 10.0;  // in log evidence: descriptions are mostly right
constexpr double worth_a_look = 25.0;      // before anything missing is sought beside it
constexpr double most_left_over = 3.0;     // excess
constexpr FitOptions cut_fit{12, 0.05, true};

struct Cut {
  double length_mm = 0.0;
  std::shared_ptr<Model> fit;
};

/// The farthest place of a rod on which the description has anything.
double last_known_mm(const physics::Machine& machine, const physics::Component& rod) {
  double last_mm = 0.0;
  const auto take = [&](double at_mm) { last_mm = std::max(last_mm, at_mm); };
  for (const auto& source : rod.sources) take(source.to_mm);
  for (const auto& sensor : machine.sensors) {
    if (sensor.component == rod.id) take(sensor.position_mm);
  }
  for (const auto& coupling : machine.couplings) {
    for (const auto* end : {&coupling.first, &coupling.second}) {
      if (end->component == rod.id) take(end->position_mm);
    }
  }
  for (const auto& spec : machine.effects) {
    if (spec.candidate || spec.word_or("component", rod.id) != rod.id) continue;
    for (const char* place : {"position_mm", "to_mm"}) take(spec.number_or(place, 0.0));
  }
  return last_mm;
}

physics::Machine cut_to(physics::Machine machine, const std::string& rod, double length_mm) {
  for (physics::Component& component : machine.components) {
    if (component.id == rod) component.length_mm = length_mm;
  }
  return machine;
}

/// Without what a bare end too long passes for.
physics::Machine without_imitations(physics::Machine machine) {
  constexpr std::array imitations{"contact_resistance", "extra_heat_source", "standing_heat", "structure_ambient"};
  std::erase_if(machine.effects, [&](const auto& spec) {
    return spec.candidate && std::count(imitations.begin(), imitations.end(), spec.id) != 0;
  });
  return machine;
}

bool less_likely(const Cut& a, const Cut& b) {
  return a.fit->log_evidence() < b.fit->log_evidence();
}

/// A rod whose length is in doubt, and what stands on it.
class Cuts {
 public:
  Cuts(const physics::Component& rod, double last_mm, std::shared_ptr<const Dataset> data)
      : m_rod(rod.id), m_length_mm(rod.length_mm), m_last_mm(last_mm), m_data(std::move(data)) {}

  /// The length that suits the recording best. `like`: fitted to a length not far off; null: each starts from the
  /// description, as what was fitted to the wrong length is bent.
  Cut best_of(const physics::Machine& machine, const Model* like) const {
    std::vector<Cut> cuts;
    for (const double share : {0.02, 0.08, 0.2, 0.4, 0.65}) {
      cuts.push_back({m_last_mm + share * (m_length_mm - m_last_mm), {}});
    }
    fit_all(cuts, machine, like);
    const auto best = std::max_element(cuts.begin(), cuts.end(), less_likely);
    const double before_mm = best == cuts.begin() ? m_last_mm : std::prev(best)->length_mm;
    const double after_mm = std::next(best) == cuts.end() ? m_length_mm : std::next(best)->length_mm;
    std::vector<Cut> nearer;
    for (const double share : {0.33, 0.67}) {
      nearer.push_back({std::lerp(before_mm, best->length_mm, share), {}});
      nearer.push_back({std::lerp(best->length_mm, after_mm, share), {}});
    }
    fit_all(nearer, machine, like);
    nearer.push_back(*best);
    return *std::max_element(nearer.begin(), nearer.end(), less_likely);
  }

 private:
  void fit_all(std::vector<Cut>& cuts, const physics::Machine& machine, const Model* like) const {
    in_parallel(cuts.size(), [&](std::size_t i) {
      cuts[i].fit = std::make_shared<Model>(cut_to(machine, m_rod, cuts[i].length_mm), m_data);
      if (like != nullptr) cuts[i].fit->start_from(*like, false);
      cuts[i].fit->fit(cut_fit);
    });
  }

  std::string m_rod;
  double m_length_mm, m_last_mm;
  std::shared_ptr<const Dataset> m_data;
};

}  // namespace

std::string note_of(const Overlong& found) {
  return "overlong:" + found.component;
}

std::optional<Overlong> overlong_rod(const Model& base, const Model& best, const std::shared_ptr<const Dataset>& data,
                                     const physics::RunFacts& facts, SelectionOptions limits,
                                     const TaskContext& context) {
  limits.others.clear();
  for (const physics::Component& rod : base.machine().components) {
    if (rod.lump || rod.prescribed) continue;
    const double last_mm = last_known_mm(base.machine(), rod);
    const double bare_mm = rod.length_mm - last_mm;
    if (bare_mm < long_end * rod.length_mm || last_mm <= 0.0) continue;
    const Cuts cuts(rod, last_mm, data);
    Cut found = cuts.best_of(base.machine(), nullptr);
    Cut beside = cuts.best_of(without_imitations(best.machine()), nullptr);
    if (less_likely(found, beside)) std::swap(found, beside);
    if (found.fit->log_evidence() < refitted_under(base, data)->log_evidence() + worth_a_look) continue;
    const double needed = refitted_under(best, data)->log_evidence() + clearly_likelier;
    const auto wins = [&](const Cut& cut) {
      return cut.fit->log_evidence() > needed && excess_of(*cut.fit).largest <= most_left_over;
    };
    const auto told = [&](const Cut& cut) { return Overlong{rod.id, rod.length_mm, cut.length_mm, bare_mm}; };
    if (wins(found)) return told(found);
    const auto selected = select_effects(without_candidates(found.fit->machine()), data, facts, limits, context);
    if (!selected || selected->effects().empty()) continue;
    beside = cuts.best_of(selected->best->machine(), selected->best.get());
    if (wins(beside)) return told(beside);
  }
  return std::nullopt;
}

}  // namespace zerodrift::diagnosis
