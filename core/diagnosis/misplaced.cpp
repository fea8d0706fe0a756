#include "core/diagnosis/misplaced.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "core/diagnosis/parallel.h"
#include "core/diagnosis/refine.h"
#include "core/diagnosis/selection.h"

namespace zerodrift::diagnosis {
namespace {

constexpr std::string_view joint_id = "contact_resistance";
constexpr int places_per_rod = 16;
constexpr double far = 0.1;            // of the length: what is nearer is a tape measure's error
constexpr double all_explained = 1.0;  // right models leave 0.3 to 1
constexpr double far_behind = 200.0;   // in log evidence, after a step or a few: no further ones would make that good
constexpr FitOptions fit_options{8, 0.1, true};
constexpr FitOptions as_it_stands{0, 0.1, true};
constexpr FitOptions glance{1, 0.1, true};
constexpr FitOptions few_steps{3, 1.0, true};

struct Unit {
  const char* symbol;
  double mm;
};
constexpr std::array other_units{Unit{"cm", 10.0}, Unit{"in", 25.4}, Unit{"m", 1000.0}};

enum class Mistake {
  another_place,
  a_little_aside,  // by a few per cent of the length: more usual
  typical          // an exchange, or described numbers in another unit: nothing is free to suit the data
};

struct Trial {
  Misplaced what;
  Mistake kind = Mistake::another_place;
  std::shared_ptr<Model> fit;
};

physics::Sensor& sensor_of(physics::Machine& machine, const std::string& channel) {
  return *std::find_if(machine.sensors.begin(), machine.sensors.end(),
                       [&](const auto& sensor) { return sensor.channel == channel; });
}

/// Sensors on rods, those that the model misses most first.
std::vector<physics::Sensor> missed_most(const Model& model) {
  struct Suspect {
    physics::Sensor sensor;
    double excess = 0.0;
  };
  const Excess excess = excess_of(model);
  std::vector<Suspect> list;
  for (std::size_t c = 0; c < model.data().channels.size(); ++c) {
    const MeasuredChannel& channel = model.data().channels[c];
    const physics::Sensor* sensor = model.machine().sensor(channel.name);
    if (channel.samples == 0 || sensor == nullptr) continue;
    const physics::Component* rod = model.machine().find(sensor->component);
    if (rod == nullptr || rod->lump) continue;
    list.push_back({*sensor, excess.per_channel[c]});
  }
  std::sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.excess > b.excess; });
  std::vector<physics::Sensor> sensors;
  for (const Suspect& one : list) sensors.push_back(one.sensor);
  return sensors;
}

/// Those that the base or what explains it best misses most, and those that are said to be at fault.
std::vector<physics::Sensor> suspects(const Model& base, const Model& best, const Model& sound) {
  constexpr std::size_t most_of_each = 2;
  std::vector<physics::Sensor> list;
  const auto take = [&](const physics::Sensor& sensor) {
    if (std::none_of(list.begin(), list.end(), [&](const auto& one) { return one.channel == sensor.channel; })) {
      list.push_back(sensor);
    }
  };
  for (const Model* model : {&base, &sound}) {
    std::vector<physics::Sensor> missed = missed_most(*model);
    missed.resize(std::min(most_of_each, missed.size()));
    std::for_each(missed.begin(), missed.end(), take);
  }
  for (const auto& spec : best.machine().effects) {
    if (!spec.candidate || !spec.id.starts_with("sensor_")) continue;
    const physics::Sensor* at_fault = best.machine().sensor(spec.word_or("channel", ""));
    const physics::Component* rod = at_fault == nullptr ? nullptr : best.machine().find(at_fault->component);
    if (rod != nullptr && !rod->lump) take(*at_fault);
  }
  return list;
}

void add_places(std::vector<Trial>& trials, const Model& base, const physics::Sensor& sensor) {
  const double length_mm = base.machine().find(sensor.component)->length_mm;
  const double here_mm = sensor.position_mm;
  for (int i = 0; i < places_per_rod; ++i) {
    const double at_mm = (i + 0.5) / places_per_rod * length_mm;
    if (std::abs(at_mm - here_mm) > far * length_mm)
      trials.push_back({{sensor.channel, here_mm, at_mm, {}, {}}, Mistake::another_place, {}});
  }
  for (const Unit& unit : other_units) {
    const double at_mm = here_mm * unit.mm;
    if (at_mm > length_mm || at_mm - here_mm <= far * length_mm) continue;
    trials.push_back({{sensor.channel, here_mm, at_mm, {}, {}}, Mistake::typical, {}});
  }
}

/// Any two of a rod that are not next to each other's places: of two exchanged cables a fit may miss others most.
void add_exchanges(std::vector<Trial>& trials, const Model& base, const std::vector<physics::Sensor>& all) {
  for (auto one = all.begin(); one != all.end(); ++one) {
    const double length_mm = base.machine().find(one->component)->length_mm;
    for (auto other = std::next(one); other != all.end(); ++other) {
      if (other->component != one->component) continue;
      if (std::abs(other->position_mm - one->position_mm) < far * length_mm) continue;
      trials.push_back(
          {{one->channel, one->position_mm, other->position_mm, other->channel, {}}, Mistake::typical, {}});
    }
  }
}

void add_a_little_aside(std::vector<Trial>& trials, const Model& best, const physics::Sensor& sensor) {
  const double length_mm = best.machine().find(sensor.component)->length_mm;
  for (const double aside : {-0.09, -0.06, -0.03, 0.03, 0.06, 0.09}) {
    const double at_mm = sensor.position_mm + aside * length_mm;
    if (at_mm < 0.0 || at_mm > length_mm) continue;
    trials.push_back({{sensor.channel, sensor.position_mm, at_mm, {}, {}}, Mistake::a_little_aside, {}});
  }
}

/// The sensors next to the joints that are named, a little to either side of their places: one that sits elsewhere
/// reads too much or too little in proportion to what flows past it, as beside a joint.
std::vector<Trial> aside_of_joints(const Model& best, const std::vector<physics::Sensor>& all) {
  std::vector<Trial> trials;
  for (const auto& joint : best.machine().effects) {
    if (!joint.candidate || joint.id != joint_id) continue;
    const std::string rod = joint.word_or("component", "");
    const double joint_mm = joint.number_or("position_mm", 0.0);
    for (const double side : {-1.0, 1.0}) {
      const physics::Sensor* next = nullptr;
      for (const physics::Sensor& one : all) {
        const double away_mm = side * (one.position_mm - joint_mm);
        if (one.component != rod || away_mm < 0.0) continue;
        if (next == nullptr || away_mm < side * (next->position_mm - joint_mm)) next = &one;
      }
      if (next != nullptr) add_a_little_aside(trials, best, *next);
    }
  }
  return trials;
}

/// The sensors that are said to answer late or by another gain, likewise: so does one that sits farther from the heat.
std::vector<Trial> aside_of_faults(const Model& best, const std::vector<physics::Sensor>& all) {
  std::vector<Trial> trials;
  for (const auto& fault : best.machine().effects) {
    if (!fault.candidate || (fault.id != "sensor_lag" && fault.id != "sensor_gain")) continue;
    for (const physics::Sensor& one : all) {
      if (one.channel == fault.word_or("channel", "")) add_a_little_aside(trials, best, one);
    }
  }
  return trials;
}

/// All places of a rod in another unit, told by the sensor that is farthest from the fixed end.
void add_units(std::vector<Trial>& trials, const Model& base, const std::vector<physics::Sensor>& all) {
  constexpr double most_of_length = 0.15;  // a rod whose sensors are all at its one end is no usual one
  for (const physics::Sensor& sensor : all) {
    const bool farthest = std::none_of(all.begin(), all.end(), [&](const physics::Sensor& other) {
      return other.component == sensor.component && other.position_mm > sensor.position_mm;
    });
    const double length_mm = base.machine().find(sensor.component)->length_mm;
    if (!farthest || sensor.position_mm > most_of_length * length_mm) continue;
    for (const Unit& unit : other_units) {
      const double at_mm = sensor.position_mm * unit.mm;
      if (at_mm <= length_mm)
        trials.push_back({{sensor.channel, sensor.position_mm, at_mm, {}, unit.symbol}, Mistake::typical, {}});
    }
  }
}

std::shared_ptr<Model> refitted(physics::Machine machine, const Model& like, const std::shared_ptr<const Dataset>& data,
                                const FitOptions& options = fit_options) {
  auto model = std::make_shared<Model>(std::move(machine), data);
  model->start_from(like, false);
  model->fit(options);
  return model;
}

bool is_exchange(const Trial& trial) {
  return !trial.what.exchanged_with.empty();
}

/// The trial's places with the effects of `like`.
void fit(Trial& trial, const Model& like, const std::shared_ptr<const Dataset>& data,
         const FitOptions& options = fit_options) {
  physics::Machine machine = like.machine();
  if (!trial.what.all_in.empty()) {
    const std::string component = sensor_of(machine, trial.what.channel).component;
    for (physics::Sensor& sensor : machine.sensors) {
      if (sensor.component == component) sensor.position_mm *= trial.what.at_mm / trial.what.described_mm;
    }
  }
  sensor_of(machine, trial.what.channel).position_mm = trial.what.at_mm;
  if (!trial.what.exchanged_with.empty()) {
    sensor_of(machine, trial.what.exchanged_with).position_mm = trial.what.described_mm;
  }
  trial.fit = refitted(std::move(machine), like, data, options);
}

/// Two exchanged in the machine as it is described. What was fitted to the wrong places is bent so far that a step from
/// there says nothing.
void fit_exchange(Trial& trial, const physics::Machine& described, const std::shared_ptr<const Dataset>& data) {
  physics::Machine machine = described;
  sensor_of(machine, trial.what.channel).position_mm = trial.what.at_mm;
  sensor_of(machine, trial.what.exchanged_with).position_mm = trial.what.described_mm;
  trial.fit = std::make_shared<Model>(std::move(machine), data);
  trial.fit->fit(few_steps);
}

physics::Machine without_sensor_faults(physics::Machine machine) {
  std::erase_if(machine.effects, [](const auto& spec) { return spec.candidate && spec.id.starts_with("sensor_"); });
  return machine;
}

physics::Machine without_joints(physics::Machine machine) {
  std::erase_if(machine.effects, [](const auto& spec) { return spec.candidate && spec.id == joint_id; });
  return machine;
}

const physics::Component& rod_of(const Trial& trial) {
  const physics::Machine& machine = trial.fit->machine();
  return *machine.find(machine.sensor(trial.what.channel)->component);
}

/// The same sensor at much the same place.
bool same_place(const Trial& a, const Trial& b) {
  const auto& [channel, described_mm, at_mm, exchanged_with, all_in] = a.what;
  if (!all_in.empty() || !b.what.all_in.empty()) return all_in == b.what.all_in;
  const bool swapped = channel == b.what.exchanged_with && exchanged_with == b.what.channel;
  if (!exchanged_with.empty() || !b.what.exchanged_with.empty()) {
    return swapped || (channel == b.what.channel && exchanged_with == b.what.exchanged_with);
  }
  constexpr double near = 0.15;  // of the length
  return channel == b.what.channel && std::abs(at_mm - b.what.at_mm) < near * rod_of(a).length_mm;
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

  bool wins(const Trial& trial) const {
    return trial.fit->log_evidence() > m_described->log_evidence() + clearly(trial) && leaves_little(*trial.fit);
  }
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
  /// Between the places that were tried.
  void narrow(Trial& found) const {
    if (found.kind == Mistake::typical) return;
    const double length_mm = rod_of(found).length_mm;
    std::vector<Trial> nearer;
    const double step_mm = (found.kind == Mistake::a_little_aside ? 0.01 : 0.3 / places_per_rod) * length_mm;
    for (const double steps : {-2.0, -1.0, 1.0, 2.0}) {
      nearer.push_back(found);
      nearer.back().what.at_mm = std::clamp(found.what.at_mm + steps * step_mm, 0.0, length_mm);
    }
    const Model like = *found.fit;
    in_parallel(nearer.size(), [&](std::size_t i) { fit(nearer[i], like, m_data); });
    for (Trial& one : nearer) {
      if (likelier(one, found)) found = std::move(one);
    }
  }
  const Model& sound() const { return *m_sound; }
  const std::shared_ptr<const Dataset>& data() const { return m_data; }

 private:
  std::shared_ptr<const Dataset> m_data;
  std::shared_ptr<Model> m_base, m_described, m_sound;
};

/// The best of each list in turn, each place once.
std::vector<Trial> leaders(const std::vector<Trial>& one, const std::vector<Trial>& other) {
  constexpr std::size_t most = 3;
  std::vector<Trial> list;
  for (std::size_t i = 0; i < std::max(one.size(), other.size()); ++i) {
    for (const auto* trials : {&one, &other}) {
      if (list.size() == most || i >= trials->size()) continue;
      const Trial& next = (*trials)[i];
      if (std::none_of(list.begin(), list.end(), [&](const Trial& had) { return same_place(next, had); })) {
        list.push_back(next);
      }
    }
  }
  return list;
}

/// Places beside those described, and the machine without what they pass for.
struct Suspicion {
  std::vector<Trial> trials;
  physics::Machine without;
};

std::vector<Suspicion> aside_of_what_is_named(const Model& base, const Model& best) {
  const std::vector<physics::Sensor> all = missed_most(base);
  std::vector<Suspicion> list;
  list.push_back({aside_of_joints(best, all), without_joints(best.machine())});
  list.push_back({aside_of_faults(best, all), without_sensor_faults(best.machine())});
  std::erase_if(list, [](const Suspicion& one) { return one.trials.empty(); });
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
    std::vector<Trial> trials;
    for (const physics::Sensor& sensor : suspects(m_base, m_best, m_contest.sound())) {
      add_places(trials, m_base, sensor);
    }
    const std::vector<physics::Sensor> all = missed_most(m_base);
    add_exchanges(trials, m_base, all);
    add_units(trials, m_base, all);
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
