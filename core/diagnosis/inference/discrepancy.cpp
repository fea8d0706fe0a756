#include "core/diagnosis/inference/discrepancy.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/physics/builder.h"
#include "core/physics/prediction.h"

namespace zerodrift::diagnosis::inference {
namespace {

using Series = std::vector<std::vector<double>>;  // [run][row]

double largest_of(const Series& series) {
  double largest = 0.0;
  for (const auto& run : series) {
    for (const double v : run) largest = std::max(largest, std::abs(v));
  }
  return largest;
}

double correlation(const Series& a, const Series& b) {
  double aa = 0.0, bb = 0.0, ab = 0.0;
  for (std::size_t r = 0; r < a.size(); ++r) {
    for (std::size_t k = 0; k < a[r].size(); ++k) {
      aa += a[r][k] * a[r][k];
      bb += b[r][k] * b[r][k];
      ab += a[r][k] * b[r][k];
    }
  }
  return aa > 0.0 && bb > 0.0 ? ab / std::sqrt(aa * bb) : 0.0;
}

struct Raw {
  std::string name;
  bool heat = false;
  std::string component;
  Series value;
};

class Collector {
 public:
  Collector(const std::vector<Run>& runs, double alike) : m_runs(runs), m_alike(alike) {}

  void add(Raw raw) {
    const double largest = largest_of(raw.value);
    if (!(largest > 1e-9)) return;
    for (auto& run : raw.value) {
      for (double& v : run) v /= largest;
    }
    const bool known = std::any_of(m_list.begin(), m_list.end(), [&](const Raw& have) {
      return have.component == raw.component && std::abs(correlation(have.value, raw.value)) > m_alike;
    });
    if (!known) m_list.push_back(std::move(raw));
  }
  Series zeros() const {
    Series out;
    for (const Run& run : m_runs) out.emplace_back(run.rows(), 0.0);
    return out;
  }
  const std::vector<Raw>& list() const { return m_list; }

 private:
  const std::vector<Run>& m_runs;
  double m_alike;
  std::vector<Raw> m_list;
};

/// Watts of each source by its nominal law; of one whose power is unknown, its shape.
void add_sources(Collector& to, const physics::Machine& machine, const std::vector<Run>& runs) {
  std::vector<physics::Network> networks;
  std::vector<physics::InputSet> inputs;
  for (const Run& run : runs) {
    networks.push_back(physics::build_network(machine, run.recording));
    inputs.push_back(physics::make_inputs(networks.back(), run.recording));
  }
  if (networks.empty()) return;
  for (std::size_t t = 0; t < networks.front().terms.size(); ++t) {
    const physics::Term& first = networks.front().terms[t];
    if (first.kind != physics::TermKind::source || first.label.ends_with("/inside")) continue;
    for (std::size_t p = 0; p < first.parameters.size(); ++p) {
      Raw raw{first.label, true, {}, to.zeros()};
      bool there = true;
      for (std::size_t r = 0; r < runs.size() && there; ++r) {
        const auto& terms = networks[r].terms;
        const auto term = std::find_if(terms.begin(), terms.end(), [&](const auto& one) {
          return one.label == first.label && one.kind == physics::TermKind::source;
        });
        there = term != terms.end() && p < term->parameters.size();
        if (!there) break;
        std::vector<double> values;
        for (const int parameter : term->parameters)
          values.push_back(networks[r].parameters[static_cast<std::size_t>(parameter)].start);
        for (std::size_t k = 0; k < inputs[r].rows(); ++k) {
          physics::LawPoint at;
          at.held = inputs[r].held[k].data();
          at.values = values.data();
          at.driver_C = networks[r].initial_C.empty() ? 20.0 : networks[r].initial_C.front();
          at.time_s = inputs[r].time_s[k];
          raw.value[r][k] = term->law(at).by_parameter[p];
        }
      }
      if (there) to.add(std::move(raw));
    }
  }
}

/// Every other logged input that changes: a fan, a door, a valve may matter even where the description has no use for
/// it.
void add_inputs(Collector& to, const std::vector<Run>& runs) {
  for (const auto& channel : runs.front().recording.channels) {
    if (!recording::is_input(channel.kind()) || channel.name == "spindle_rpm") continue;
    Raw raw{channel.name, true, {}, to.zeros()};
    bool there = true;
    for (std::size_t r = 0; r < runs.size(); ++r) {
      const auto* found = runs[r].recording.find(channel.name);
      there = there && found != nullptr && recording::present_count(*found) > 2;
      if (!there) break;
      raw.value[r] = physics::mended(found->values, runs[r].recording.time_s);
    }
    if (!there) continue;
    const auto [low, high] = std::minmax_element(raw.value.front().begin(), raw.value.front().end());
    if (*high - *low > 1e-9) to.add(std::move(raw));
  }
}

/// A measured temperature's way from its start.
std::optional<Series> risen(const std::vector<Run>& runs, const std::string& channel) {
  Series out;
  for (const Run& run : runs) {
    const auto* found = run.recording.find(channel);
    if (found == nullptr || recording::present_count(*found) < 3) return std::nullopt;
    out.push_back(physics::mended(found->values, run.recording.time_s));
    const double start = out.back().front();
    for (double& v : out.back()) v -= start;
  }
  return out;
}

/// The room, fluids, measured boundaries; and of each part of a machine of several the mean of what the others measure.
void add_temperatures(Collector& to, const physics::Machine& machine, const std::vector<Run>& runs) {
  constexpr double moves_K = 0.3;  // less is noise of the reading
  for (const std::string& channel : physics::measured_boundaries(machine)) {
    if (channel.empty()) continue;
    if (auto series = risen(runs, channel); series && largest_of(*series) > moves_K)
      to.add({channel, false, {}, std::move(*series)});
  }
  if (machine.components.size() < 2) return;
  for (const auto& part : machine.components) {
    if (part.prescribed) continue;
    Series sum = to.zeros();
    int count = 0;
    for (const auto& sensor : machine.sensors) {
      if (sensor.component == part.id || machine.find(sensor.component) == nullptr) continue;
      const auto series = risen(runs, sensor.channel);
      if (!series) continue;
      for (std::size_t r = 0; r < sum.size(); ++r) {
        for (std::size_t k = 0; k < sum[r].size(); ++k) sum[r][k] += (*series)[r][k];
      }
      ++count;
    }
    if (count > 0) to.add({"neighbours:" + part.id, false, part.id, std::move(sum)});
  }
}

struct Seat {
  std::string component;
  double along = 0.0;  // share of the part's length
};

Seat seat_of(const physics::Machine& machine, const std::string& channel) {
  const physics::Sensor* sensor = machine.sensor(channel);
  if (sensor == nullptr) return {};
  const physics::Component* part = machine.find(sensor->component);
  const double length_mm = part == nullptr || part->lump ? 0.0 : part->length_mm;
  return {sensor->component, length_mm > 0.0 ? sensor->position_mm / length_mm : 0.0};
}

/// How alike the gains of two sensors to one driver are.
double likeness(const Seat& a, const Seat& b, bool same, const DiagnosisSettings& s) {
  double shared = s.common_share;
  if (a.component == b.component) {
    const double off = (a.along - b.along) / s.near_length;
    shared += s.part_share + s.near_share * std::exp(-0.5 * off * off);
  }
  return same ? 1.0 : shared;
}

/// First-order lag of what was 0 before the recording began.
std::vector<double> lagged_from_rest(const std::vector<double>& series, const std::vector<double>& time_s,
                                     double lag_s) {
  std::vector<double> out = physics::lagged(series, time_s, lag_s);
  for (std::size_t k = 0; k < out.size(); ++k)
    out[k] -= series.front() * std::exp(-(time_s[k] - time_s.front()) / lag_s);
  return out;
}

}  // namespace

std::vector<Driver> make_drivers(const physics::Machine& machine, const std::vector<Run>& runs,
                                 const DiagnosisSettings& settings) {
  Collector collector(runs, settings.alike);
  add_sources(collector, machine, runs);
  add_inputs(collector, runs);
  add_temperatures(collector, machine, runs);
  std::vector<Driver> drivers;
  for (const Raw& raw : collector.list()) {
    for (const double lag_s : settings.lags_s) {
      Driver driver{raw.name, lag_s, raw.component, raw.heat, {}};
      for (std::size_t r = 0; r < runs.size(); ++r) {
        driver.value.push_back(lagged_from_rest(raw.value[r], runs[r].recording.time_s, lag_s));
      }
      const double largest = largest_of(driver.value);
      if (!(largest > 1e-6)) continue;
      for (auto& run : driver.value) {
        for (double& v : run) v /= largest;
      }
      drivers.push_back(std::move(driver));
    }
  }
  return drivers;
}

std::vector<GainGroup> make_gains(const physics::Machine& machine, const std::vector<Run>& runs,
                                  const std::vector<Driver>& drivers, const DiagnosisSettings& settings) {
  std::vector<GainGroup> groups(2);
  for (std::size_t g = 0; g < 2; ++g) {
    GainGroup& group = groups[g];
    group.temperature = g == 0;
    for (std::size_t c = 0; c < runs.front().series.size(); ++c) {
      const MeasuredSeries& first = runs.front().series[c];
      if (first.temperature != group.temperature) continue;
      double range = 0.0;
      for (const Run& run : runs) range = std::max(range, run.series[c].range);
      if (range <= 0.0) continue;
      const Seat seat = seat_of(machine, first.channel);
      std::vector<std::size_t> mine;
      for (std::size_t d = 0; d < drivers.size(); ++d) {
        const bool acts = drivers[d].component.empty() || drivers[d].component == seat.component;
        if (acts && (group.temperature || drivers[d].heat)) mine.push_back(d);
      }
      if (mine.empty()) continue;
      std::vector<RowMatrix> of_runs;
      for (std::size_t r = 0; r < runs.size(); ++r) {
        RowMatrix basis(static_cast<Eigen::Index>(runs[r].rows()), static_cast<Eigen::Index>(mine.size()));
        for (std::size_t d = 0; d < mine.size(); ++d) {
          for (std::size_t k = 0; k < runs[r].rows(); ++k) {
            basis(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(d)) =
                settings.repeatable_share * range * drivers[mine[d]].value[r][k];
          }
        }
        of_runs.push_back(std::move(basis));
      }
      group.series.push_back(c);
      group.first.push_back(group.count);
      group.count += static_cast<Eigen::Index>(mine.size());
      group.basis.push_back(std::move(of_runs));
      group.driver.push_back(std::move(mine));
    }
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(group.count, group.count);
    for (std::size_t a = 0; a < group.series.size(); ++a) {
      for (std::size_t b = 0; b < group.series.size() && group.temperature; ++b) {
        const Seat one = seat_of(machine, runs.front().series[group.series[a]].channel);
        const Seat two = seat_of(machine, runs.front().series[group.series[b]].channel);
        for (std::size_t i = 0; i < group.driver[a].size(); ++i) {
          for (std::size_t j = 0; j < group.driver[b].size(); ++j) {
            if (group.driver[a][i] != group.driver[b][j]) continue;
            covariance(group.first[a] + static_cast<Eigen::Index>(i), group.first[b] + static_cast<Eigen::Index>(j)) =
                likeness(one, two, a == b, settings);
          }
        }
      }
    }
    const Eigen::LLT<Eigen::MatrixXd> factors(covariance);
    group.prior_precision = factors.solve(Eigen::MatrixXd::Identity(group.count, group.count));
    group.prior_log_determinant =
        group.count == 0 ? 0.0 : 2.0 * factors.matrixL().toDenseMatrix().diagonal().array().log().sum();
  }
  return groups;
}

}  // namespace zerodrift::diagnosis::inference
