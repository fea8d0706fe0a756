#include "core/analysis/features.h"

#include <algorithm>
#include <cmath>

namespace zerodrift::analysis {
namespace {

constexpr double hour_s = 3600.0;

/// One step of the low-pass; the input is taken as a straight line between the two samples.
double step(double filtered, double before, double now, double dt_s, double time_constant_s) {
  const double keep = std::exp(-dt_s / time_constant_s);
  return keep * filtered + (1.0 - keep) * 0.5 * (before + now);
}

Result<Eigen::VectorXd> driving_values(const Prepared& data, const FeatureSpec& spec, double reference_C) {
  if (spec.temperature) {
    const int column = data.sensor(spec.channel);
    if (column < 0) {
      std::string available;
      for (const auto& name : data.sensors) available += (available.empty() ? "" : ", ") + name;
      return fail(ErrorCode::channel_missing, {{"channel", spec.channel}, {"available", available}});
    }
    return Eigen::VectorXd(data.temperature_C.col(column).array() - reference_C);
  }
  const int column = data.input_index(spec.channel);
  if (column < 0) {
    std::string available;
    for (const auto& name : data.inputs) available += (available.empty() ? "" : ", ") + name;
    return fail(ErrorCode::channel_missing, {{"channel", spec.channel}, {"available", available}});
  }
  return Eigen::VectorXd((data.input.col(column).array() / spec.unit).pow(spec.power));
}

}  // namespace

std::vector<FeatureSpec> static_features(const std::vector<std::string>& sensors) {
  std::vector<FeatureSpec> specs;
  for (const auto& sensor : sensors) specs.push_back({sensor, 0.0, 1, 1.0, true});
  return specs;
}

std::vector<FeatureSpec> dynamic_features(const std::vector<std::string>& sensors, const Prepared& data) {
  std::vector<FeatureSpec> specs;
  for (std::size_t c = 0; c < data.inputs.size(); ++c) {
    const auto& name = data.inputs[c];
    const auto column = data.input.col(static_cast<Eigen::Index>(c));
    const double largest = column.cwiseAbs().maxCoeff();
    if (column.maxCoeff() - column.minCoeff() <= 1e-9 * std::max(largest, 1.0)) continue;
    const auto kind = recording::kind_of(name);
    if (kind == recording::ChannelKind::speed) {
      for (const int power : {1, 2}) {
        for (const double hours : {0.05, 0.15, 0.4, 1.0, 2.5, 6.0}) {
          specs.push_back({name, hours * hour_s, power, 1000.0, false});
        }
      }
    } else if (kind == recording::ChannelKind::coolant || kind == recording::ChannelKind::feed) {
      for (const double hours : {0.15, 1.0, 6.0}) specs.push_back({name, hours * hour_s, 1, largest, false});
    }
  }
  for (const auto& sensor : sensors) {
    for (const double hours : {0.0, 0.4, 1.5, 5.0}) specs.push_back({sensor, hours * hour_s, 1, 1.0, true});
  }
  return specs;
}

namespace {

/// Every input that moves through each time constant; speeds with their square.
std::vector<FeatureSpec> filtered_inputs(const Prepared& data, const std::vector<double>& hours) {
  std::vector<FeatureSpec> specs;
  for (std::size_t c = 0; c < data.inputs.size(); ++c) {
    const auto kind = recording::kind_of(data.inputs[c]);
    const bool speed = kind == recording::ChannelKind::speed;
    if (!speed && kind != recording::ChannelKind::coolant && kind != recording::ChannelKind::feed) continue;
    const auto column = data.input.col(static_cast<Eigen::Index>(c));
    const double largest = column.cwiseAbs().maxCoeff();
    if (column.maxCoeff() - column.minCoeff() <= 1e-9 * std::max(largest, 1.0)) continue;
    for (const double h : hours) {
      for (int power = 1; power <= (speed ? 2 : 1); ++power) {
        specs.push_back({data.inputs[c], h * hour_s, power, speed ? 1000.0 : largest, false});
      }
    }
  }
  return specs;
}

}  // namespace

std::vector<FeatureSpec> arx_features(const std::vector<std::string>& sensors, const Prepared& data) {
  const std::vector<double> hours{0.1, 0.25, 0.6, 1.5, 4.0};
  std::vector<FeatureSpec> specs = filtered_inputs(data, hours);
  for (const auto& sensor : sensors) {
    for (const double h : hours) specs.push_back({sensor, h * hour_s, 1, 1.0, true});
  }
  return specs;
}

std::vector<FeatureSpec> greybox_features(const std::string& room, const Prepared& data) {
  const std::vector<double> hours{0.05, 0.15, 0.4, 1.0, 2.5, 6.0};
  std::vector<FeatureSpec> specs = filtered_inputs(data, hours);
  for (const double h : hours) specs.push_back({room, h * hour_s, 1, 1.0, true});
  return specs;
}

bool has_simulation(const Prepared& data) {
  return std::any_of(data.inputs.begin(), data.inputs.end(),
                     [](const std::string& name) { return name.starts_with(simulated_prefix); });
}

std::vector<FeatureSpec> physics_features(const std::vector<std::string>& sensors, const Prepared& data) {
  std::vector<FeatureSpec> specs;
  for (const auto& name : data.inputs) {
    if (!name.starts_with(simulated_prefix)) continue;
    for (const double hours : {0.0, 0.4, 1.5}) specs.push_back({name, hours * hour_s, 1, 1.0, false});
  }
  const std::vector<FeatureSpec> temperatures = static_features(sensors);
  specs.insert(specs.end(), temperatures.begin(), temperatures.end());
  return specs;
}

std::vector<std::vector<int>> pole_groups(const std::vector<FeatureSpec>& specs, bool pairs) {
  std::vector<double> poles_s;
  for (const auto& spec : specs) {
    if (std::find(poles_s.begin(), poles_s.end(), spec.time_constant_s) == poles_s.end()) {
      poles_s.push_back(spec.time_constant_s);
    }
  }
  std::vector<std::vector<int>> groups;
  for (std::size_t a = 0; a < poles_s.size(); ++a) {
    for (std::size_t b = pairs ? a + 1 : a; b < (pairs ? poles_s.size() : a + 1); ++b) {
      auto& group = groups.emplace_back();
      for (std::size_t f = 0; f < specs.size(); ++f) {
        const double tau_s = specs[f].time_constant_s;
        if (tau_s == poles_s[a] || tau_s == poles_s[b]) group.push_back(static_cast<int>(f));
      }
    }
  }
  return groups;
}

Result<Eigen::MatrixXd> features(const Prepared& data, const std::vector<FeatureSpec>& specs,
                                 const std::vector<double>& reference_C, const FilterState* from, FilterState* end) {
  Eigen::MatrixXd out(data.rows(), static_cast<Eigen::Index>(specs.size()));
  if (end != nullptr) *end = {data.time_s.back(), {}, {}};
  for (std::size_t f = 0; f < specs.size(); ++f) {
    ZD_TRY(const Eigen::VectorXd u, driving_values(data, specs[f], reference_C[f]));
    const auto column = static_cast<Eigen::Index>(f);
    const double tau_s = specs[f].time_constant_s;
    double y = u(0);
    if (tau_s > 0.0 && from != nullptr) {
      y = step(from->filtered[f], from->driving[f], u(0), data.time_s[0] - from->time_s, tau_s);
    }
    out(0, column) = y;
    double last_dt_s = -1.0;
    double keep = 0.0;
    for (Eigen::Index i = 1; i < out.rows(); ++i) {
      if (tau_s <= 0.0) {
        y = u(i);
      } else {
        const double dt_s = data.time_s[static_cast<std::size_t>(i)] - data.time_s[static_cast<std::size_t>(i) - 1];
        if (dt_s != last_dt_s) keep = std::exp(-dt_s / tau_s);
        last_dt_s = dt_s;
        y = keep * y + (1.0 - keep) * 0.5 * (u(i - 1) + u(i));
      }
      out(i, column) = y;
    }
    if (end != nullptr) {
      end->filtered.push_back(y);
      end->driving.push_back(u(u.size() - 1));
    }
  }
  return out;
}

std::vector<double> start_references(const Prepared& data, const std::vector<FeatureSpec>& specs) {
  int rows = 1;
  while (rows < data.rows() && data.time_s[rows] - data.time_s[0] <= 300.0) ++rows;
  Prepared start;
  start.time_s.assign(data.time_s.begin(), data.time_s.begin() + rows);
  const Eigen::MatrixXd smoothed = smooth(start.time_s, data.temperature_C.topRows(rows), 300.0);
  std::vector<double> out;
  for (const auto& spec : specs) {
    const int column = spec.temperature ? data.sensor(spec.channel) : -1;
    out.push_back(column < 0 ? 0.0 : smoothed(0, column));
  }
  return out;
}

Eigen::VectorXd low_pass(const std::vector<double>& time_s, const Eigen::VectorXd& values, double time_constant_s) {
  Eigen::VectorXd out = values;
  if (time_constant_s <= 0.0) return out;
  for (Eigen::Index i = 1; i < values.size(); ++i) {
    const double dt_s = time_s[static_cast<std::size_t>(i)] - time_s[static_cast<std::size_t>(i) - 1];
    out(i) = step(out(i - 1), values(i - 1), values(i), dt_s, time_constant_s);
  }
  return out;
}

}  // namespace zerodrift::analysis
