#include "core/diagnosis/description/sensor_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "core/diagnosis/inference/parallel.h"
#include "core/physics/builder.h"

namespace zerodrift::diagnosis::description {
namespace {

using Eigen::Index;
using inference::Evidence;
using inference::Fit;
using inference::RowMatrix;
using inference::SeriesStatistics;
using physics::Component;
using physics::Machine;
using physics::Sensor;

struct Seat {
  std::string component;
  double position_mm = 0.0;
  bool operator<(const Seat& other) const {
    return std::tie(component, position_mm) < std::tie(other.component, other.position_mm);
  }
};

/// A series' statistics with its near field marginalised.
struct SeatStatistics {
  SeriesStatistics series;
  double log_determinant = 0.0;
};

/// Readings of a fit's simulation at any seat.
class Readings {
 public:
  explicit Readings(const Fit& fit) : m_fit(fit) {}

  std::size_t at(const Seat& seat) {
    const auto [found, fresh] = m_index.try_emplace(seat, m_seats.size());
    if (fresh) m_seats.push_back(seat);
    return found->second;
  }

  void simulate() {
    const inference::JointModel& model = m_fit.model();
    for (std::size_t r = 0; r < model.evidence().runs().size(); ++r) {
      const recording::Recording recording = set_right(model.evidence().runs()[r].recording, model.hypothesis().errors);
      const Machine machine = model.hypothesis().machine_in(static_cast<int>(r));
      m_near_fields.push_back(near_fields(machine, recording));
      physics::NetworkBuilder builder(machine, recording, {});
      builder.build();
      const std::size_t known = builder.network().observations.size();
      for (const Seat& seat : m_seats) {
        physics::Observation seen;
        seen.channel = seat.component;
        seen.probe = builder.probe(builder.probe_at(seat.component, seat.position_mm));
        builder.network().observations.push_back(std::move(seen));
      }
      take_in(physics::make_inputs(builder.network(), recording), builder.network(), known, r);
    }
  }

  /// Of a series whose sensor sits there; its own offset stays with it. The near field of the source that it then sits
  /// on is marginalised (the gains of the repeatable discrepancy do not act at the usual sizes).
  SeatStatistics statistics(std::size_t series, std::size_t seat) const {
    const inference::JointModel& model = m_fit.model();
    const std::string& channel = model.evidence().runs().front().series[series].channel;
    const auto n = static_cast<Index>(model.unknowns());
    std::vector<std::vector<double>> shown;
    std::vector<RowMatrix> columns;
    for (std::size_t r = 0; r < m_shown.size(); ++r) {
      shown.push_back(m_shown[r][seat]);
      RowMatrix wide(m_columns[r][seat].rows(), n + 1);
      wide << m_columns[r][seat], near_field(r, m_seats[seat], m_columns[r][seat].rows());
      const std::vector<double> values = model.values(r, m_fit.z());
      for (std::size_t u = 0; u < model.unknowns(); ++u) {
        const physics::Parameter& parameter = model.unknown(u).parameter;
        const int at = model.parameter_of(r, u);
        if (at < 0 || parameter.key != "offset_K" || parameter.channel != channel || parameter.effect >= 0) continue;
        wide.col(static_cast<Index>(u)).setConstant(parameter.sigma);
        for (double& value : shown.back()) value += values[static_cast<std::size_t>(at)];
      }
      columns.push_back(std::move(wide));
    }
    const SeriesStatistics all = statistics_of(model.evidence(), series, m_fit.sizes(), shown, columns);
    const double precision = 1.0 + all.jj(n, n);
    const Eigen::VectorXd across = all.jj.col(n).head(n);
    SeatStatistics out;
    out.series.jj = all.jj.topLeftCorner(n, n) - across * across.transpose() / precision;
    out.series.jr = all.jr.head(n) - across * (all.jr[n] / precision);
    out.series.rr = all.rr - all.jr[n] * all.jr[n] / precision;
    out.series.bj = all.bj.leftCols(n) - all.bj.col(n) * across.transpose() / precision;
    out.series.br = all.br - all.bj.col(n) * (all.jr[n] / precision);
    out.log_determinant = std::log(precision);
    return out;
  }

 private:
  /// Of each source with a near field: what a sensor on it shows of one standard deviation.
  static std::map<std::string, std::vector<double>> near_fields(Machine machine,
                                                                const recording::Recording& recording) {
    std::map<std::string, std::string> source_of;  // of each sensor put on it
    for (Component& part : machine.components) {
      if (!part.inner || part.prescribed) continue;
      for (const auto& source : part.sources) {
        Sensor on{"@" + part.id + "/" + source.id, part.id, 0.5 * (source.from_mm + source.to_mm)};
        part.inner->near_field_K_W[on.channel] = 0.0;
        source_of[on.channel] = part.id + "/" + source.id;
        machine.sensors.push_back(std::move(on));
      }
    }
    const physics::Network network = physics::build_network(machine, recording);
    std::vector<int> parameters;
    for (std::size_t p = 0; p < network.parameters.size(); ++p) {
      const physics::Parameter& parameter = network.parameters[p];
      if (parameter.key == "near_field_K_W" && source_of.count(parameter.channel) != 0)
        parameters.push_back(static_cast<int>(p));
    }
    const physics::Prediction by =
        physics::predict(network, physics::make_inputs(network, recording), network.start_values(), parameters);
    std::map<std::string, std::vector<double>> fields;
    for (std::size_t c = 0; c < by.channels.size(); ++c) {
      for (std::size_t p = 0; p < parameters.size(); ++p) {
        const physics::Parameter& parameter = network.parameters[static_cast<std::size_t>(parameters[p])];
        if (parameter.channel != network.observations[c].channel) continue;
        std::vector<double>& field = fields[source_of[parameter.channel]];
        for (std::size_t k = 0; k < by.rows; ++k)
          field.push_back(parameter.sigma * by.channels[c].derivatives[k * parameters.size() + p]);
      }
    }
    return fields;
  }

  Eigen::VectorXd near_field(std::size_t run, const Seat& seat, Index rows) const {
    const Component& part = *m_fit.model().hypothesis().machine.find(seat.component);
    const physics::HeatSource* source = part.inner ? part.source_near(seat.position_mm) : nullptr;
    const auto found =
        source == nullptr ? m_near_fields[run].end() : m_near_fields[run].find(part.id + "/" + source->id);
    if (found == m_near_fields[run].end()) return Eigen::VectorXd::Zero(rows);
    return Eigen::Map<const Eigen::VectorXd>(found->second.data(), rows);
  }

  void take_in(const physics::InputSet& inputs, const physics::Network& network, std::size_t known, std::size_t r) {
    const inference::JointModel& model = m_fit.model();
    std::vector<int> parameters;
    std::vector<Index> unknowns;
    std::vector<double> slopes;
    const std::vector<double> values = model.values(r, m_fit.z());
    for (std::size_t u = 0; u < model.unknowns(); ++u) {
      const int parameter = model.parameter_of(r, u);
      if (parameter < 0) continue;
      parameters.push_back(parameter);
      unknowns.push_back(static_cast<Index>(u));
      slopes.push_back(model.unknown(u).parameter.slope_at(values[static_cast<std::size_t>(parameter)]));
    }
    const physics::Prediction by = predicted(network, inputs, values, parameters);
    m_shown.emplace_back();
    m_columns.emplace_back();
    for (std::size_t s = 0; s < m_seats.size(); ++s) {
      const auto& seen = by.channels[known + s];
      RowMatrix columns = RowMatrix::Zero(static_cast<Index>(by.rows), static_cast<Index>(model.unknowns()));
      for (std::size_t k = 0; k < by.rows; ++k) {
        for (std::size_t p = 0; p < parameters.size(); ++p) {
          columns(static_cast<Index>(k), unknowns[p]) = slopes[p] * seen.derivatives[k * parameters.size() + p];
        }
      }
      m_shown.back().push_back(seen.values);
      m_columns.back().push_back(std::move(columns));
    }
  }

  const Fit& m_fit;
  std::map<Seat, std::size_t> m_index;
  std::vector<Seat> m_seats;
  std::vector<std::vector<std::vector<double>>> m_shown;                  // [run][seat][row]
  std::vector<std::vector<RowMatrix>> m_columns;                          // [run][seat]
  std::vector<std::map<std::string, std::vector<double>>> m_near_fields;  // [run], by part/source
};

struct Unit {
  const char* symbol;
  double mm;
};
constexpr std::array other_units{Unit{"cm", 10.0}, Unit{"in", 25.4}, Unit{"m", 1000.0}};
constexpr int places_of_a_rod = 20;
constexpr double uniform = 0.4;  // standard deviation of as much prior density as a uniform one over 1: 1 / sqrt(2 pi)

class Trials {
 public:
  explicit Trials(const Fit& fit)
      : m_fit(fit), m_evidence(fit.model().evidence()), m_machine(fit.model().hypothesis().machine) {
    for (std::size_t c = 0; c < m_evidence.series(); ++c) {
      const Sensor* sensor = m_machine.sensor(m_evidence.runs().front().series[c].channel);
      if (sensor == nullptr || m_evidence.samples(c) == 0 || has_fault(sensor->channel)) continue;
      m_sensors.push_back({c, *sensor});
    }
  }

  std::vector<PossibleError> made() {
    add_places();
    add_exchanges();
    for (const Component& part : m_machine.components) {
      if (!part.lump && !part.prescribed) add_of_all_sensors(part);
    }
    if (m_trials.empty()) return {};
    spread_priors();
    evaluate();
    return best_of_each();
  }

 private:
  struct SensorOf {
    std::size_t series;
    Sensor sensor;
  };
  struct Trial {
    PossibleError what;
    std::vector<std::pair<std::size_t, std::size_t>> seats;  // series, seat
  };

  /// A reading that is wrong in itself would not move with its sensor.
  bool has_fault(const std::string& channel) const {
    const auto& effects = m_fit.model().hypothesis().effects;
    return std::any_of(effects.begin(), effects.end(),
                       [&](const auto& one) { return one.spec.word_or("channel", "") == channel; });
  }

  void add(DescriptionError error, const std::vector<std::pair<const SensorOf*, Seat>>& seats) {
    Trial trial{{std::move(error), 0.0}, {}};
    for (const auto& [sensor, seat] : seats) trial.seats.emplace_back(sensor->series, m_readings.at(seat));
    m_trials.push_back(std::move(trial));
  }

  void add_places() {
    constexpr double near = 0.5 / places_of_a_rod;  // of the length: refined from there
    for (const SensorOf& one : m_sensors) {
      const auto place = [&](const Component& part, double at_mm, double spread_mm) {
        DescriptionError error{ErrorKind::place, one.sensor.channel, part.id};
        error.described = one.sensor.position_mm;
        error.value = at_mm;
        error.low = 0.0;
        error.high = part.length_mm;
        error.spread = spread_mm;
        // Before it is refined: as well known as the grid is fine.
        if (spread_mm > 0.0) error.value_log_prior = -std::log(static_cast<double>(places_of_a_rod));
        add(std::move(error), {{&one, {part.id, at_mm}}});
      };
      for (const Component& part : m_machine.components) {
        if (part.prescribed) continue;
        const bool here = part.id == one.sensor.component;
        if (part.lump) {
          if (!here) place(part, 0.0, 0.0);
          continue;
        }
        for (int i = 0; i < places_of_a_rod; ++i) {
          const double at_mm = (i + 0.5) / places_of_a_rod * part.length_mm;
          if (here && std::abs(at_mm - one.sensor.position_mm) < near * part.length_mm) continue;
          place(part, at_mm, uniform * part.length_mm);
        }
        for (const Unit& unit : other_units) {
          const double at_mm = one.sensor.position_mm * unit.mm;
          if (here && at_mm > one.sensor.position_mm && at_mm <= part.length_mm) place(part, at_mm, 0.0);
        }
      }
    }
  }

  void add_exchanges() {
    for (auto one = m_sensors.begin(); one != m_sensors.end(); ++one) {
      for (auto two = std::next(one); two != m_sensors.end(); ++two) {
        if (one->sensor.component == two->sensor.component && one->sensor.position_mm == two->sensor.position_mm)
          continue;
        DescriptionError error{ErrorKind::exchange, one->sensor.channel, two->sensor.channel};
        error.described = one->sensor.position_mm;
        error.value = two->sensor.position_mm;
        add(std::move(error), {{&*one, {two->sensor.component, two->sensor.position_mm}},
                               {&*two, {one->sensor.component, one->sensor.position_mm}}});
      }
    }
  }

  void add_of_all_sensors(const Component& part) {
    std::vector<const SensorOf*> there;
    for (const SensorOf& one : m_sensors) {
      if (one.sensor.component == part.id) there.push_back(&one);
    }
    if (there.size() < 2) return;
    const auto [first, last] = std::minmax_element(there.begin(), there.end(), [](const auto* a, const auto* b) {
      return a->sensor.position_mm < b->sensor.position_mm;
    });
    const double first_mm = (*first)->sensor.position_mm, last_mm = (*last)->sensor.position_mm;
    const auto all = [&](DescriptionError error) {
      const Machine right = set_right(m_machine, error);
      std::vector<std::pair<const SensorOf*, Seat>> seats;
      for (const SensorOf* one : there)
        seats.push_back({one, {part.id, right.sensor(one->sensor.channel)->position_mm}});
      add(std::move(error), seats);
    };
    for (const Unit& unit : other_units) {
      if (last_mm * unit.mm > part.length_mm || last_mm <= 0.0) continue;
      DescriptionError error{ErrorKind::unit, part.id, unit.symbol};
      error.value = unit.mm;
      all(std::move(error));
    }
    if (last_mm <= first_mm) return;
    all({ErrorKind::other_end, part.id});
    for (const double share : {-0.2, -0.1, -0.05, -0.02, 0.02, 0.05, 0.1, 0.2}) {
      DescriptionError error{ErrorKind::datum, part.id};
      error.low = -last_mm;
      error.high = part.length_mm - first_mm;
      error.value = share * part.length_mm;
      if (error.value < error.low || error.value > error.high) continue;
      error.spread = uniform * 0.5 * part.length_mm;
      error.value_log_prior = -std::log(8.0);
      all(std::move(error));
    }
  }

  /// The kind's prior is spread over its forms: sensors and parts, pairs, units.
  void spread_priors() {
    std::map<ErrorKind, std::map<std::string, int>> forms;
    const auto form_of = [](const DescriptionError& error) {
      return error.kind == ErrorKind::place && error.spread == 0.0 ? name_of(error) + std::to_string(error.value)
                                                                   : name_of(error) + error.other;
    };
    for (const Trial& one : m_trials) ++forms[one.what.error.kind][form_of(one.what.error)];
    for (Trial& one : m_trials) {
      one.what.error.form_log_prior =
          m_evidence.settings().error_log_prior - std::log(static_cast<double>(forms[one.what.error.kind].size()));
    }
  }

  void evaluate() {
    m_readings.simulate();
    std::map<std::pair<std::size_t, std::size_t>, SeatStatistics> there;
    std::vector<std::pair<std::size_t, std::size_t>> wanted;
    for (const Trial& one : m_trials) {
      for (const auto& seat : one.seats) {
        if (there.try_emplace(seat).second) wanted.push_back(seat);
      }
    }
    in_parallel(wanted.size(),
                [&](std::size_t i) { there.at(wanted[i]) = m_readings.statistics(wanted[i].first, wanted[i].second); });
    std::vector<const SeriesStatistics*> described(m_evidence.series(), nullptr);
    for (std::size_t c = 0; c < described.size(); ++c) {
      if (m_evidence.samples(c) > 0) described[c] = &m_fit.statistics(c, m_fit.sizes());
    }
    const auto log_evidence = [&](const std::vector<const SeriesStatistics*>& statistics) {
      return log_evidence_of(quadratic_of(m_evidence, m_fit.sizes(), m_fit.z(), statistics), m_fit.z(),
                             m_fit.model().low(), m_fit.model().high());
    };
    const double before = log_evidence(described);
    in_parallel(m_trials.size(), [&](std::size_t i) {
      std::vector<const SeriesStatistics*> moved = described;
      double near_fields = 0.0;
      for (const auto& seat : m_trials[i].seats) {
        moved[seat.first] = &there.at(seat).series;
        near_fields -= 0.5 * there.at(seat).log_determinant;
      }
      m_trials[i].what.log_odds = log_evidence(moved) + near_fields - before + m_trials[i].what.error.log_prior();
    });
  }

  std::vector<PossibleError> best_of_each() const {
    std::map<std::string, const PossibleError*> best;
    for (const Trial& one : m_trials) {
      const PossibleError*& kept = best[name_of(one.what.error)];
      if (kept == nullptr || kept->log_odds < one.what.log_odds) kept = &one.what;
    }
    std::vector<PossibleError> list;
    for (const auto& [name, kept] : best) list.push_back(*kept);
    return list;
  }

  const Fit& m_fit;
  const Evidence& m_evidence;
  const Machine& m_machine;
  std::vector<SensorOf> m_sensors;
  Readings m_readings{m_fit};
  std::vector<Trial> m_trials;
};

}  // namespace

std::vector<PossibleError> sensor_errors(const Fit& fit) {
  return Trials(fit).made();
}

}  // namespace zerodrift::diagnosis::description
