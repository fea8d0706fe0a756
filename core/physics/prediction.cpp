#include "core/physics/prediction.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace zerodrift::physics {
namespace {

struct LagStep {
  double keep, now, before;        // y1 = keep y0 + now u1 + before u0
  double d_keep, d_now, d_before;  // by tau
};

LagStep lag_step(double dt_s, double tau_s) {
  if (tau_s < 1e-9) return {0.0, 1.0, 0.0, 0.0, -1.0 / dt_s, 1.0 / dt_s};
  const double keep = std::exp(-dt_s / tau_s);
  const double q = tau_s / dt_s * (1.0 - keep);
  const double d_keep = keep * dt_s / (tau_s * tau_s);
  const double d_q = (1.0 - keep) / dt_s - keep / tau_s;
  return {keep, 1.0 - q, q - keep, d_keep, -d_q, d_q - d_keep};
}

/// Filters `columns` series side by side in place.
void lag_columns(UnfilledNumbers& x, std::size_t columns, const std::vector<double>& time_s, double tau_s) {
  if (tau_s < 1e-9 || columns == 0 || time_s.empty()) return;
  std::vector<double> before(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(columns));
  std::vector<double> y = before;
  for (std::size_t k = 1; k < time_s.size(); ++k) {
    const LagStep s = lag_step(time_s[k] - time_s[k - 1], tau_s);
    double* row = x.data() + k * columns;
    for (std::size_t c = 0; c < columns; ++c) {
      y[c] = s.keep * y[c] + s.now * row[c] + s.before * before[c];
      before[c] = row[c];
      row[c] = y[c];
    }
  }
}

class Observer {
 public:
  /// `parameters`: the columns that are wanted. `moving`: where among them each column of the trajectory belongs, the
  /// others move no temperature.
  Observer(const Network& network, const InputSet& inputs, const std::vector<double>& values,
           const std::vector<int>& parameters, const Trajectory& trajectory, const std::vector<std::size_t>& moving)
      : m_net(network),
        m_in(inputs),
        m_values(values),
        m_run(trajectory),
        m_columns(parameters.size()),
        m_moving(moving),
        m_column(network.parameters.size(), -1) {
    for (std::size_t c = 0; c < parameters.size(); ++c) m_column[parameters[c]] = static_cast<int>(c);
  }

  PredictedChannel channel(const Observation& seen) {
    PredictedChannel out;
    out.channel = seen.channel;
    out.temperature = seen.temperature;
    out.values.assign(m_run.rows, 0.0);
    out.derivatives.resize(m_run.rows * m_columns);
    if (seen.probe >= 0) {
      take_probe(seen, out);
    } else {
      std::fill(out.derivatives.begin(), out.derivatives.end(), 0.0);
    }
    for (const auto& step : seen.steps) add_step(step, out);
    if (seen.lag_s >= 0) apply_lag(m_values[seen.lag_s], column(seen.lag_s), out);
    if (seen.gain >= 0) apply_gain(seen, out);
    for (const auto& term : seen.structure) add_structure(term, out);
    if (seen.offset >= 0) {
      for (double& value : out.values) value += m_values[seen.offset];
      add_column(out, column(seen.offset), 1.0, std::vector<double>(m_run.rows, 1.0));
    }
    return out;
  }

 private:
  int column(int parameter) const { return parameter < 0 ? -1 : m_column[parameter]; }
  std::size_t rows() const { return m_run.rows; }

  void add_column(PredictedChannel& out, int at, double factor, const std::vector<double>& series) const {
    if (at < 0) return;
    for (std::size_t k = 0; k < rows(); ++k) out.derivatives[k * m_columns + at] += factor * series[k];
  }

  /// Adds a probe's derivatives, or what became of them ([row * the trajectory's columns + column]), to a row.
  void add_moving(PredictedChannel& out, double factor, const double* by, std::size_t k) const {
    const std::size_t count = m_moving.size();
    double* row = out.derivatives.data() + k * m_columns;
    for (std::size_t c = 0; c < count; ++c) row[m_moving[c]] += factor * by[k * count + c];
  }
  void add_moving(PredictedChannel& out, double factor, const double* by) const {
    for (std::size_t k = 0; k < rows(); ++k) add_moving(out, factor, by, k);
  }

  const double* by_probe(int probe) const {
    return m_run.derivatives.data() + m_run.derived[probe] * rows() * m_run.columns;
  }

  void take_probe(const Observation& seen, PredictedChannel& out) const {
    const std::size_t probes = m_net.probes.size();
    const double scale = seen.scale >= 0 ? m_values[seen.scale] : 1.0;
    const double reference = seen.temperature ? 0.0 : seen.reference;
    const bool mixed = seen.inner_probe >= 0;
    const double share = mixed ? m_values[seen.inner_share] : 0.0;
    std::vector<double> raw(rows()), inner(mixed ? rows() : 0);
    for (std::size_t k = 0; k < rows(); ++k) {
      raw[k] = m_run.probes[k * probes + seen.probe] - reference;
      if (mixed) {
        inner[k] = m_run.probes[k * probes + seen.inner_probe] - reference - raw[k];
        raw[k] += share * inner[k];
      }
      out.values[k] = scale * raw[k];
    }
    // Row by row, so that it is filled with zeros where it is at once written.
    const double* by = by_probe(seen.probe);
    for (std::size_t k = 0; k < rows(); ++k) {
      std::fill_n(out.derivatives.data() + k * m_columns, m_columns, 0.0);
      add_moving(out, scale * (1.0 - share), by, k);
    }
    if (mixed) {
      add_moving(out, scale * share, by_probe(seen.inner_probe));
      add_column(out, column(seen.inner_share), scale, inner);
    }
    if (seen.scale >= 0) add_column(out, column(seen.scale), 1.0, raw);
  }

  void add_step(const StepTerm& step, PredictedChannel& out) const {
    std::array<double, max_law_parameters> own{};
    for (std::size_t i = 0; i < step.parameters.size(); ++i) own[i] = m_values[step.parameters[i]];
    LawPoint at;
    at.values = own.data();
    const Strength strength = step.law(at);
    const std::size_t probes = m_net.probes.size();
    std::vector<double> difference(rows());
    for (std::size_t k = 0; k < rows(); ++k) {
      difference[k] = m_run.probes[k * probes + step.probe];
      out.values[k] += strength.value * difference[k];
    }
    if (strength.value != 0.0) add_moving(out, strength.value, by_probe(step.probe));
    for (std::size_t i = 0; i < step.parameters.size(); ++i) {
      add_column(out, column(step.parameters[i]), strength.by_parameter[i], difference);
    }
  }

  void apply_lag(double tau_s, int at, PredictedChannel& out) const {
    std::vector<double> by_tau;
    out.values = lagged(out.values, m_in.time_s, tau_s, at >= 0 ? &by_tau : nullptr);
    lag_columns(out.derivatives, m_columns, m_in.time_s, tau_s);
    if (at >= 0) add_column(out, at, 1.0, by_tau);
  }

  void apply_gain(const Observation& seen, PredictedChannel& out) const {
    const double gain = 1.0 + m_values[seen.gain];
    std::vector<double> rise(rows());
    for (std::size_t k = 0; k < rows(); ++k) {
      rise[k] = out.values[k] - seen.reference;
      out.values[k] = seen.reference + gain * rise[k];
    }
    for (double& d : out.derivatives) d *= gain;
    add_column(out, column(seen.gain), 1.0, rise);
  }

  void add_structure(const StructureTerm& term, PredictedChannel& out) const {
    std::vector<double> driver(rows());
    if (term.probe >= 0) {
      const std::size_t probes = m_net.probes.size();
      for (std::size_t k = 0; k < rows(); ++k) driver[k] = m_run.probes[k * probes + term.probe] - term.probe_reference;
    } else {
      for (std::size_t k = 0; k < rows(); ++k) driver[k] = m_in.signals[k][term.signal];
    }
    const double gain = term.factor * m_values[term.gain];
    const double tau_s = term.lag >= 0 ? m_values[term.lag] : 0.0;
    std::vector<double> by_tau;
    std::vector<double> shape = lagged(driver, m_in.time_s, tau_s, &by_tau);
    std::vector<double> fading;
    if (term.initial >= 0 && tau_s > 1e-9) {
      const double initial = m_values[term.initial];
      for (std::size_t k = 0; k < rows(); ++k) {
        const double age = (m_in.time_s[k] - m_in.time_s[0]) / tau_s;
        fading.push_back(std::exp(-age));
        shape[k] += initial * fading[k];
        by_tau[k] += initial * fading[k] * age / tau_s;
      }
    }
    std::vector<double> by_second;
    std::vector<double> shape_by_tau = by_tau;
    const bool difference = term.second_lag >= 0;
    const double second_s = difference ? m_values[term.second_lag] : 0.0;
    if (difference) {
      const std::vector<double> slow = lagged(shape, m_in.time_s, second_s, &by_second);
      const std::vector<double> slow_by_tau = lagged(by_tau, m_in.time_s, second_s);
      for (std::size_t k = 0; k < rows(); ++k) {
        shape[k] -= slow[k];
        shape_by_tau[k] -= slow_by_tau[k];
      }
    }
    for (std::size_t k = 0; k < rows(); ++k) out.values[k] += gain * shape[k];
    add_column(out, column(term.gain), term.factor, shape);
    if (term.lag >= 0) add_column(out, column(term.lag), gain, shape_by_tau);
    if (!fading.empty()) add_column(out, column(term.initial), gain, fading);
    if (difference) add_column(out, column(term.second_lag), -gain, by_second);
    if (term.probe < 0 || gain == 0.0) return;
    const double* from = by_probe(term.probe);
    UnfilledNumbers by(from, from + rows() * m_run.columns);
    lag_columns(by, m_run.columns, m_in.time_s, tau_s);
    if (difference) {
      UnfilledNumbers slow_by = by;
      lag_columns(slow_by, m_run.columns, m_in.time_s, second_s);
      for (std::size_t i = 0; i < by.size(); ++i) by[i] -= slow_by[i];
    }
    add_moving(out, gain, by.data());
  }

  const Network& m_net;
  const InputSet& m_in;
  const std::vector<double>& m_values;
  const Trajectory& m_run;
  std::size_t m_columns;
  const std::vector<std::size_t>& m_moving;
  std::vector<int> m_column;
};

}  // namespace

std::vector<double> lagged(const std::vector<double>& series, const std::vector<double>& time_s, double tau_s,
                           std::vector<double>* by_tau) {
  std::vector<double> y = series;
  if (by_tau != nullptr) by_tau->assign(series.size(), 0.0);
  for (std::size_t k = 1; k < series.size(); ++k) {
    const LagStep s = lag_step(time_s[k] - time_s[k - 1], tau_s);
    y[k] = s.keep * y[k - 1] + s.now * series[k] + s.before * series[k - 1];
    if (by_tau != nullptr) {
      (*by_tau)[k] = s.keep * (*by_tau)[k - 1] + s.d_keep * y[k - 1] + s.d_now * series[k] + s.d_before * series[k - 1];
    }
  }
  return y;
}

static Prediction observe(const Network& network, const InputSet& inputs, const std::vector<double>& values,
                          const std::vector<int>& parameters, const Trajectory& trajectory,
                          const std::vector<std::size_t>& moving) {
  Prediction prediction;
  prediction.rows = trajectory.rows;
  prediction.columns = parameters.size();
  Observer observer(network, inputs, values, parameters, trajectory, moving);
  for (const auto& seen : network.observations) prediction.channels.push_back(observer.channel(seen));
  return prediction;
}

Prediction observe(const Network& network, const InputSet& inputs, const std::vector<double>& values,
                   const Trajectory& trajectory) {
  return observe(network, inputs, values, {}, trajectory, {});
}

/// Parameters that move node temperatures; offsets, lags, gains and structure terms act on the readings alone.
static std::vector<bool> thermal_parameters(const Network& network) {
  std::vector<bool> thermal(network.parameters.size(), false);
  const auto mark = [&](int parameter) {
    if (parameter >= 0) thermal[static_cast<std::size_t>(parameter)] = true;
  };
  mark(network.hold_parameter);
  for (const auto& term : network.terms) {
    for (const int parameter : term.parameters) mark(parameter);
    mark(term.place_parameter);
  }
  for (const auto& part : network.initial_parts) mark(part.parameter);
  for (const int parameter : network.capacity_parameter) mark(parameter);
  for (const auto& environment : network.environments) {
    for (const auto& part : environment.parts) mark(part.parameter);
  }
  return thermal;
}

/// What only drives a structure that does not move is not differentiated: of the many forms that a screening looks
/// through, each with a driver of its own, that is all.
static std::vector<bool> drivers_of_nothing(const Network& network, const std::vector<double>& values) {
  std::vector<bool> unread(network.probes.size(), true);
  const auto read = [&](int probe) {
    if (probe >= 0) unread[static_cast<std::size_t>(probe)] = false;
  };
  for (const auto& seen : network.observations) {
    read(seen.probe);
    read(seen.inner_probe);
    for (const auto& step : seen.steps) read(step.probe);
    for (const auto& term : seen.structure) {
      if (values[term.gain] != 0.0) read(term.probe);
    }
  }
  return unread;
}

Prediction predict(const Network& network, const InputSet& inputs, const std::vector<double>& values,
                   const std::vector<int>& parameters, SimulateOptions options) {
  const std::vector<bool> thermal = thermal_parameters(network);
  std::vector<int> moving;
  std::vector<std::size_t> target;
  for (std::size_t c = 0; c < parameters.size(); ++c) {
    if (!thermal[static_cast<std::size_t>(parameters[c])]) continue;
    moving.push_back(parameters[c]);
    target.push_back(c);
  }
  options.values_only = drivers_of_nothing(network, values);
  const Trajectory run = run_network(network, inputs, values, moving, options);
  return observe(network, inputs, values, parameters, run, target);
}

}  // namespace zerodrift::physics
