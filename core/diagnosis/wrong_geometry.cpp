#include "core/diagnosis/wrong_geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/diagnosis/bodies.h"
#include "core/diagnosis/parallel.h"
#include "core/diagnosis/plausible.h"
#include "core/diagnosis/refine.h"

namespace zerodrift::diagnosis {
namespace {

using physics::Component;
using physics::Machine;
using What = WrongGeometry::What;

constexpr double long_end = 0.25;       // of the length: what is nearer the end than that hardly feels it
constexpr double worth_a_look = 25.0;   // in log evidence, before anything missing is sought beside it
constexpr double much = 0.3;            // of what imitations explain
constexpr double most_left_over = 3.0;  // excess
constexpr double least_shift = 0.015;   // of the length: what is less is a tape measure's error
constexpr double most_shift = 0.25;
constexpr double slight_factor = 1.4;  // of the diameter
constexpr FitOptions shape_fit{12, 0.05, true};

/// What may be wrong, and with which values: in mm, or as a factor of the diameter or of all its heat.
struct Mistake {
  std::optional<What> what;    // none: all heat, the rival of a diameter
  std::vector<double> values;  // rising
  double low = 0.0, high = 0.0;
  double clearly = 25.0;  // in log evidence: descriptions are mostly right
};

struct Shape {
  double value = 0.0;
  std::shared_ptr<Model> fit;
};

/// How far all sensors of a rod would rather sit from the fixed end, with everything else free: a step from the model.
struct Shift {
  double by_mm = 0.0;
  double gain = 0.0;  // in log evidence
};

/// The score of a shift, as of a candidate's amplitude (screening.cpp): two simulations tell whether it is worth a fit.
Shift shift_asked_by(const Model& model, const std::string& rod) {
  constexpr double step_mm = 1.0;
  const recording::Recording& seen = *model.data().recording;
  const double length_mm = model.machine().find(rod)->length_mm;
  const std::vector<double> values = model.values();
  // Nothing where the network has other unknowns for sensors that sit there.
  const auto residual_at = [&](double by_mm) -> std::optional<Eigen::VectorXd> {
    Machine machine = model.machine();
    for (physics::Sensor& sensor : machine.sensors) {
      if (sensor.component == rod) sensor.position_mm = std::clamp(sensor.position_mm + by_mm, 0.0, length_mm);
    }
    const physics::Network network = physics::build_network(machine, seen);
    if (network.parameters.size() != values.size()) return std::nullopt;
    Eigen::VectorXd residual;
    whiten(model.data(), physics::predict(network, physics::make_inputs(network, seen), values), &residual);
    return residual;
  };
  const auto before = residual_at(-step_mm), after = residual_at(step_mm);
  if (!before && !after) return {};
  const Eigen::VectorXd& here = model.residual();
  const Eigen::VectorXd column =
      (after.value_or(here) - before.value_or(here)) / (before && after ? 2.0 * step_mm : step_mm);
  const Eigen::VectorXd shared = model.jacobian().transpose() * column;
  const double own = column.squaredNorm() - shared.dot(model.hessian().llt().solve(shared));
  const double score = column.dot(model.residual());
  if (!(own > 0.0)) return {};
  return {-score / own, 0.5 * score * score / own};
}

bool less_likely(const Shape& a, const Shape& b) {
  return a.fit->log_evidence() < b.fit->log_evidence();
}

/// The farthest place of a rod on which the description has anything.
double last_known_mm(const Machine& machine, const Component& rod) {
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
    if (spec.word_or("component", rod.id) != rod.id) continue;
    for (const char* place : {"position_mm", "to_mm"}) take(spec.number_or(place, 0.0));
  }
  return last_mm;
}

/// First and last sensor.
std::pair<double, double> sensors_between(const Machine& machine, const std::string& rod) {
  double first_mm = 1e300, last_mm = -1e300;
  for (const auto& sensor : machine.sensors) {
    if (sensor.component != rod) continue;
    first_mm = std::min(first_mm, sensor.position_mm);
    last_mm = std::max(last_mm, sensor.position_mm);
  }
  return {first_mm, last_mm};
}

std::vector<Mistake> mistakes_of(const Machine& machine, const Component& rod, bool any) {
  std::vector<Mistake> list;
  const double last_mm = last_known_mm(machine, rod);
  const double bare_mm = rod.length_mm - last_mm;
  if (bare_mm > long_end * rod.length_mm && last_mm > 0.0) {
    Mistake length{What::length, {}, last_mm, rod.length_mm, 10.0};
    for (const double share : {0.02, 0.08, 0.2, 0.4, 0.65}) length.values.push_back(last_mm + share * bare_mm);
    list.push_back(std::move(length));
  }
  if (!any) return list;
  const auto [first_sensor_mm, last_sensor_mm] = sensors_between(machine, rod.id);
  if (last_sensor_mm <= first_sensor_mm) return list;
  list.push_back({What::other_end, {0.0}, 0.0, 0.0, 10.0});
  list.push_back({What::diameter, {0.5, 0.65, 1.5, 2.0}, 0.45, 2.2});
  return list;
}

Machine with_mistake(Machine machine, const std::string& rod, std::optional<What> what, double value) {
  Component& component =
      *std::find_if(machine.components.begin(), machine.components.end(), [&](const auto& c) { return c.id == rod; });
  if (!what) {
    for (physics::HeatSource& source : component.sources) source.scale *= value;
  }
  if (what == What::length) component.length_mm = value;
  if (what == What::diameter) {
    component.outer_diameter_mm *= value;
    component.bore_diameter_mm = std::min(component.bore_diameter_mm, 0.9 * component.outer_diameter_mm);
  }
  for (physics::Sensor& sensor : machine.sensors) {
    if (sensor.component != rod) continue;
    if (what == What::other_end) sensor.position_mm = component.length_mm - sensor.position_mm;
    if (what == What::datum) sensor.position_mm = std::clamp(sensor.position_mm + value, 0.0, component.length_mm);
  }
  return with_inner_bodies(std::move(machine));
}

/// What a wrong shape passes for.
bool is_imitation(const physics::EffectSpec& spec) {
  constexpr std::array imitations{"contact_resistance", "extra_heat_source", "standing_heat",    "structure_ambient",
                                  "sensor_gain",        "bearing_preload",   "bearing_viscosity"};
  return spec.candidate && std::count(imitations.begin(), imitations.end(), spec.id) != 0;
}

/// One mistake in one rod, and what stands there without it.
class Corrected {
 public:
  Corrected(const Machine& described, std::string rod, Mistake mistake, std::shared_ptr<const Dataset> data)
      : m_described(described), m_rod(std::move(rod)), m_mistake(std::move(mistake)), m_data(std::move(data)) {}

  /// The value that suits the recording best beside some effects. `like`: fitted to one not far off; null: each starts
  /// from the description, as what was fitted to the wrong shape is bent.
  Shape best_with(const std::vector<physics::EffectSpec>& effects, const Model* like) const {
    std::vector<Shape> shapes;
    for (const double value : m_mistake.values) shapes.push_back({value, {}});
    fit_all(shapes, effects, like);
    const auto best = std::max_element(shapes.begin(), shapes.end(), less_likely);
    if (m_mistake.what == What::datum) return settled(*best, effects);
    if (shapes.size() == 1) return *best;
    const double before = best == shapes.begin() ? m_mistake.low : std::prev(best)->value;
    const double after = std::next(best) == shapes.end() ? m_mistake.high : std::next(best)->value;
    std::vector<Shape> nearer;
    for (const double share : {0.33, 0.67}) {
      nearer.push_back({std::lerp(before, best->value, share), {}});
      nearer.push_back({std::lerp(best->value, after, share), {}});
    }
    // None that is hardly a mistake: what it would be good for is other than that.
    std::erase_if(nearer, [&](const Shape& one) { return is_slight(one.value); });
    fit_all(nearer, effects, like);
    nearer.push_back(*best);
    return *std::max_element(nearer.begin(), nearer.end(), less_likely);
  }

  const Mistake& mistake() const { return m_mistake; }

 private:
  /// A shift where the fit asks for no other.
  Shape settled(Shape shape, const std::vector<physics::EffectSpec>& effects) const {
    constexpr int most_steps = 3;
    const double enough_mm = 0.003 * m_described.find(m_rod)->length_mm;
    for (int step = 0; step < most_steps; ++step) {
      const double at_mm =
          std::clamp(shape.value + shift_asked_by(*shape.fit, m_rod).by_mm, m_mistake.low, m_mistake.high);
      if (std::abs(at_mm - shape.value) < enough_mm) break;
      std::vector<Shape> next = {{at_mm, {}}};
      fit_all(next, effects, shape.fit.get());
      if (!less_likely(shape, next.front())) break;
      shape = std::move(next.front());
    }
    return shape;
  }
  bool is_slight(double value) const {
    return m_mistake.what == What::diameter && std::abs(std::log(value)) < std::log(slight_factor);
  }
  void fit_all(std::vector<Shape>& shapes, const std::vector<physics::EffectSpec>& effects, const Model* like) const {
    in_parallel(shapes.size(), [&](std::size_t i) {
      Machine machine = with_mistake(m_described, m_rod, m_mistake.what, shapes[i].value);
      machine.effects = effects;
      shapes[i].fit = std::make_shared<Model>(std::move(machine), m_data);
      if (like != nullptr) shapes[i].fit->start_from(*like, false);
      shapes[i].fit->fit(shape_fit);
    });
  }

  const Machine& m_described;
  std::string m_rod;
  Mistake m_mistake;
  std::shared_ptr<const Dataset> m_data;
};

std::size_t candidates_of(const Model& model) {
  const auto& effects = model.machine().effects;
  return static_cast<std::size_t>(
      std::count_if(effects.begin(), effects.end(), [](const auto& spec) { return spec.candidate; }));
}

/// What a shape has to do better than.
struct Rivals {
  bool stands = true;
  ModelPtr named;         // with what is named
  ModelPtr no_imitation;  // without what of that a wrong shape passes for
  ModelPtr none;

  bool lose_to(const Shape& shape, const Mistake& mistake) const {
    const bool simpler = mistake.what == What::length || !stands || candidates_of(*shape.fit) < candidates_of(*named);
    // Beside as much that is missing only a shift is told: right answers ask for less than 6.
    const bool beside = mistake.what == What::datum && shape.fit->log_evidence() > named->log_evidence() + worth_a_look;
    return (simpler || beside) && shape.fit->log_evidence() > named->log_evidence() + mistake.clearly &&
           excess_of(*shape.fit).largest <= most_left_over && far_from_description(*shape.fit).empty();
  }
  /// Does it do much of what the imitations do?
  bool come_near(const Shape& shape, const Model& plain) const {
    const double of_imitations = named->log_evidence() - plain.log_evidence();
    return shape.fit->log_evidence() > plain.log_evidence() + std::max(worth_a_look, much * of_imitations);
  }
};

/// From the shifts that ask for a look: beside what is named, in its place, or in that of what may imitate one.
std::optional<Mistake> shifted(const GeometryAsked& asked, const Component& rod, const Rivals* rivals) {
  constexpr double asked_for = 8.0;   // in log evidence
  constexpr double comparable = 0.6;  // of what is named: a step from the model does not tell all
  const auto [first_sensor_mm, last_sensor_mm] = sensors_between(asked.described, rod.id);
  if (last_sensor_mm <= first_sensor_mm) return std::nullopt;
  Mistake datum{What::datum, {}, -first_sensor_mm, rod.length_mm - last_sensor_mm, 10.0};
  const auto take = [&](const Model& model, double least_gain) {
    const Shift shift = shift_asked_by(model, rod.id);
    const double share = std::abs(shift.by_mm) / rod.length_mm;
    if (shift.gain < least_gain || share < least_shift || share > most_shift) return;
    datum.values.push_back(std::clamp(shift.by_mm, datum.low, datum.high));
  };
  const auto take_instead = [&](const Model& without, const Model& named) {
    take(without, std::max(asked_for, comparable * (named.log_evidence() - without.log_evidence())));
  };
  take_instead(asked.base, asked.best);
  if (rivals != nullptr && rivals->no_imitation != rivals->none) take_instead(*rivals->no_imitation, *rivals->named);
  if (asked.best.unknowns() != asked.base.unknowns()) take(asked.best, asked_for);
  if (datum.values.empty()) return std::nullopt;
  return datum;
}

/// The shape without the mistake that beats the rivals: as it is, beside what is no imitation, or with what is then
/// found missing.
std::optional<Shape> winner(const Corrected& corrected, const Rivals& rivals, const physics::RunFacts& facts,
                            const SelectionOptions& limits, const TaskContext& context) {
  std::vector<ModelPtr> plain = {rivals.no_imitation};
  if (rivals.none != rivals.no_imitation) plain.push_back(rivals.none);
  const bool any_imitation = candidates_of(*rivals.no_imitation) < candidates_of(*rivals.named);
  if (corrected.mistake().what == What::datum && any_imitation) plain.push_back(rivals.named);
  ModelPtr next;
  for (const ModelPtr& without : plain) {
    const Shape shape = corrected.best_with(without->machine().effects, nullptr);
    if (rivals.lose_to(shape, corrected.mistake())) return shape;
    if (next == nullptr && rivals.come_near(shape, *without)) next = shape.fit;
  }
  if (next == nullptr) return std::nullopt;
  const auto selected =
      select_effects(without_candidates(next->machine()), next->shared_data(), facts, limits, context);
  if (!selected || selected->effects().empty()) return std::nullopt;
  const Shape shape = corrected.best_with(selected->best->machine().effects, selected->best.get());
  return rivals.lose_to(shape, corrected.mistake()) ? std::optional(shape) : std::nullopt;
}

/// A thinner rod is one with more heat, but for its film: which of them is wrong is told only where that decides.
bool may_be_heat(const Machine& described, const std::string& rod, const Shape& thinner,
                 const std::shared_ptr<const Dataset>& data) {
  constexpr double decides = 3.0;
  const Corrected heat(described, rod, {std::nullopt, {0.25, 0.4, 0.63, 1.6, 2.5, 4.0}, 0.15, 6.0}, data);
  const Shape rival = heat.best_with(thinner.fit->machine().effects, nullptr);
  return rival.fit->log_evidence() > thinner.fit->log_evidence() - decides;
}

Rivals rivals_of(const GeometryAsked& asked) {
  Rivals rivals{asked.stands, refitted_under(asked.best, asked.data), nullptr, refitted_under(asked.base, asked.data)};
  Machine machine = asked.best.machine();
  std::erase_if(machine.effects, is_imitation);
  rivals.no_imitation = rivals.none;
  if (machine.effects.size() == rivals.none->machine().effects.size()) return rivals;
  rivals.no_imitation = std::make_shared<Model>(std::move(machine), asked.data);
  rivals.no_imitation->start_from(*rivals.none, false);
  rivals.no_imitation->fit(shape_fit);
  return rivals;
}

}  // namespace

std::string note_of(const WrongGeometry& found) {
  constexpr std::array names{"overlong:", "other_end:", "datum:", "diameter:"};
  return names[static_cast<std::size_t>(found.what)] + found.component;
}

std::optional<WrongGeometry> wrong_geometry(const GeometryAsked& asked, const physics::RunFacts& facts,
                                            SelectionOptions limits, const TaskContext& context) {
  limits = beside_a_mistake(std::move(limits));
  Machine described = asked.described;
  described.reference_temperature_C = asked.base.machine().reference_temperature_C;
  const auto& effects = asked.best.machine().effects;
  const bool imitated = std::any_of(effects.begin(), effects.end(), is_imitation);
  // One effect that explains everything is no sign of a wrong shape.
  const bool any = !asked.stands || (imitated && candidates_of(asked.best) > 1);
  std::optional<Rivals> rivals;
  for (const Component& rod : described.components) {
    if (rod.lump || rod.prescribed) continue;
    std::vector<Mistake> mistakes = mistakes_of(described, rod, any);
    if (any && !rivals) rivals = rivals_of(asked);
    if (auto datum = shifted(asked, rod, rivals ? &*rivals : nullptr)) mistakes.push_back(std::move(*datum));
    for (Mistake& mistake : mistakes) {
      if (!rivals) rivals = rivals_of(asked);
      const Corrected corrected(described, rod.id, std::move(mistake), asked.data);
      const std::optional<Shape> found = winner(corrected, *rivals, facts, limits, context);
      if (!found) continue;
      const What what = *corrected.mistake().what;
      if (what == What::diameter && may_be_heat(described, rod.id, *found, asked.data)) continue;
      WrongGeometry told{what, rod.id, rod.length_mm, found->value, 0.0};
      if (told.what == What::length) told.bare_mm = rod.length_mm - corrected.mistake().low;
      if (told.what == What::diameter) {
        told.described_mm = rod.outer_diameter_mm;
        told.fits_mm = found->value * rod.outer_diameter_mm;
      }
      return told;
    }
  }
  return std::nullopt;
}

}  // namespace zerodrift::diagnosis
