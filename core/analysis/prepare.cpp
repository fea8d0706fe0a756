#include "core/analysis/prepare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/analysis/checked.h"
#include "core/analysis/cleaning.h"

namespace zerodrift::analysis {
namespace {

using recording::Channel;
using recording::ChannelKind;
using recording::Recording;

// Beyond these no machine tool can have been measured: sums of their squares would still be numbers, what is divided by
// them would not.
constexpr double largest_error_um = 1e6;
constexpr double largest_input = 1e9;  // rpm, mm/min, W

std::vector<std::string> wanted_sensors(const Recording& recording, const PrepareOptions& options) {
  if (!options.sensors.empty()) return options.sensors;
  std::vector<std::string> names;
  for (const auto& c : recording.channels) {
    if (c.kind() == ChannelKind::temperature || c.kind() == ChannelKind::ambient) names.push_back(c.name);
  }
  return names;
}

double typical_step_s(const std::vector<double>& time_s) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < time_s.size(); ++i) steps.push_back(time_s[i] - time_s[i - 1]);
  std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2), steps.end());
  return steps[steps.size() / 2];
}

/// The same series, up to an offset and a scale (one wire read twice, or the same reading in two units).
bool same_series(const std::vector<double>& a, const std::vector<double>& b) {
  using Map = Eigen::Map<const Eigen::ArrayXd>;
  const Map x(a.data(), static_cast<Eigen::Index>(a.size()));
  const Map y(b.data(), static_cast<Eigen::Index>(b.size()));
  const double xx = (x - x.mean()).square().sum();
  const double yy = (y - y.mean()).square().sum();
  const double xy = ((x - x.mean()) * (y - y.mean())).sum();
  return xx > 0.0 && yy > 0.0 && xy > 0.0 && xx * yy - xy * xy <= 1e-12 * xx * yy;
}

Status take_sensors(const Recording& recording, const PrepareOptions& options, Prepared& out) {
  std::vector<std::string> names = wanted_sensors(recording, options);
  const bool by_name = !options.sensors.empty();
  std::vector<std::vector<double>> series;
  for (const auto& name : names) {
    ZD_TRY(const Channel* channel, recording.require(name));
    series.push_back(channel->values);
  }
  const auto faults = check_temperatures(names, recording.time_s, series, out.findings);
  const double step_s = typical_step_s(recording.time_s);
  std::vector<std::vector<double>> kept;
  for (std::size_t c = 0; c < names.size(); ++c) {
    if (const auto& fault = faults[c]) {
      if (by_name) {
        return fail(fault->kind == FindingKind::constant_sensor ? ErrorCode::no_variation : ErrorCode::sensor_dead,
                    {{"what", names[c]}, {"sensor", names[c]}, {"detail", describe(*fault)}});
      }
      out.findings.push_back(*fault);
      continue;
    }
    const double gap_s = bridge_gaps(recording.time_s, series[c]);
    if (gap_s > std::max(10.0 * step_s, 300.0)) {
      out.findings.push_back(
          {FindingKind::gaps, FindingAction::repaired, names[c], fmt::format("longest {:.0f} s", gap_s)});
    }
    std::size_t twin = 0;
    while (twin < kept.size() && !same_series(kept[twin], series[c])) ++twin;
    if (twin < kept.size()) {
      out.findings.push_back({FindingKind::duplicate_sensor, by_name ? FindingAction::noted : FindingAction::dropped,
                              names[c], "of " + out.sensors[twin]});
      if (!by_name) continue;
    }
    kept.push_back(series[c]);
    out.sensors.push_back(names[c]);
  }
  out.temperature_C.resize(out.rows(), static_cast<Eigen::Index>(kept.size()));
  for (std::size_t c = 0; c < kept.size(); ++c) {
    out.temperature_C.col(static_cast<Eigen::Index>(c)) = Eigen::Map<const Eigen::VectorXd>(kept[c].data(), out.rows());
  }
  return {};
}

void take_inputs(const Recording& recording, Prepared& out) {
  std::vector<std::vector<double>> kept;
  for (const auto& channel : recording.channels) {
    if (!recording::is_input(channel.kind()) || recording::present_count(channel) == 0) continue;
    const auto largest = std::max_element(channel.values.begin(), channel.values.end(), [](double a, double b) {
      return (std::isfinite(a) ? std::abs(a) : 0.0) < (std::isfinite(b) ? std::abs(b) : 0.0);
    });
    if (std::isfinite(*largest) && std::abs(*largest) > largest_input) {
      out.findings.push_back(
          {FindingKind::implausible, FindingAction::dropped, channel.name, fmt::format("{:.4g}", *largest)});
      continue;
    }
    kept.push_back(channel.values);
    hold_gaps(kept.back());
    out.inputs.push_back(channel.name);
  }
  out.input.resize(out.rows(), static_cast<Eigen::Index>(kept.size()));
  for (std::size_t c = 0; c < kept.size(); ++c) {
    out.input.col(static_cast<Eigen::Index>(c)) = Eigen::Map<const Eigen::VectorXd>(kept[c].data(), out.rows());
  }
}

Status take_errors(const Recording& recording, const PrepareOptions& options, Prepared& out) {
  const bool by_name = !options.errors.empty();
  const std::vector<std::string> names = by_name ? options.errors : recording.names(ChannelKind::error);
  std::vector<std::vector<double>> kept;
  for (const auto& name : names) {
    ZD_TRY(const Channel* channel, recording.require(name));
    std::vector<double> values = channel->values;
    for (Finding& finding : told(remove_dropouts(values), name, recording.time_s)) {
      out.findings.push_back(std::move(finding));
    }
    const int wild = remove_wild_errors(values);
    if (wild > 0) {
      out.findings.push_back(
          {FindingKind::spikes, FindingAction::repaired, name, fmt::format("{} measurements left out", wild)});
    }
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    int count = 0;
    for (double& v : values) {
      if (!std::isfinite(v)) {
        v = missing_sample;
        continue;
      }
      low = std::min(low, v);
      high = std::max(high, v);
      ++count;
    }
    if (count < 4) {
      if (by_name) {
        return fail(ErrorCode::not_enough_data,
                    {{"what", name}, {"found", fmt::format("{} measurements", count)}, {"needed", "at least 4"}});
      }
      out.findings.push_back(
          {FindingKind::error_dead, FindingAction::dropped, name, fmt::format("{} measurements", count)});
      continue;
    }
    if (std::max(-low, high) > largest_error_um) {
      const std::string range = fmt::format("{:.4g} to {:.4g} um", low, high);
      if (by_name) {
        return fail(ErrorCode::data_does_not_fit,
                    {{"what", name}, {"found", range}, {"expected", "errors of a machine, below a metre"}});
      }
      out.findings.push_back({FindingKind::implausible, FindingAction::dropped, name, range});
      continue;
    }
    if (high - low < 1e-9) {
      if (by_name) return fail(ErrorCode::no_variation, {{"what", name}});
      out.findings.push_back({FindingKind::error_never_moves, FindingAction::dropped, name, {}});
      continue;
    }
    kept.push_back(std::move(values));
    out.errors.push_back(name);
  }
  out.error_um.resize(out.rows(), static_cast<Eigen::Index>(kept.size()));
  for (std::size_t c = 0; c < kept.size(); ++c) {
    out.error_um.col(static_cast<Eigen::Index>(c)) = Eigen::Map<const Eigen::VectorXd>(kept[c].data(), out.rows());
  }
  return {};
}

/// A table without any temperature or error column was never one of a run, or its columns bear other names.
Status check_kinds(const Recording& recording, const PrepareOptions& options) {
  const auto none = [&](const std::string& found, const std::string& expected) {
    return fail(ErrorCode::data_does_not_fit,
                {{"what", "the recording " + recording.name}, {"found", found}, {"expected", expected}});
  };
  if (options.sensors.empty() && recording.names(ChannelKind::temperature).empty() &&
      recording.names(ChannelKind::ambient).empty()) {
    return none("no temperature column", "columns named like T1_C");
  }
  if (options.need_errors && options.errors.empty() && recording.names(ChannelKind::error).empty()) {
    return none("no error column", "columns named like dZ_um");
  }
  return {};
}

}  // namespace

int Prepared::sensor(const std::string& channel) const {
  const auto at = std::find(sensors.begin(), sensors.end(), channel);
  return at == sensors.end() ? -1 : static_cast<int>(at - sensors.begin());
}

int Prepared::input_index(const std::string& channel) const {
  const auto at = std::find(inputs.begin(), inputs.end(), channel);
  return at == inputs.end() ? -1 : static_cast<int>(at - inputs.begin());
}

Result<Prepared> prepare(const Recording& recording, const PrepareOptions& options) {
  if (recording.rows() < 4) {
    return fail(ErrorCode::not_enough_data, {{"what", "the recording " + recording.name},
                                             {"found", fmt::format("{} rows", recording.rows())},
                                             {"needed", "at least 4"}});
  }
  ZD_CHECK(check_kinds(recording, options));
  Prepared out;
  out.name = recording.name;
  out.time_s = recording.time_s;
  ZD_CHECK(take_sensors(recording, options, out));
  take_inputs(recording, out);
  if (options.need_errors) ZD_CHECK(take_errors(recording, options, out));
  if (out.sensors.empty()) {
    return fail(ErrorCode::no_variation, {{"what", "every temperature of the recording " + recording.name}});
  }
  if (options.need_errors && out.errors.empty()) {
    return fail(ErrorCode::no_variation, {{"what", "every error of the recording " + recording.name}});
  }
  return out;
}

double block_length_s(const Prepared& data) {
  return std::min(600.0, (data.time_s.back() - data.time_s.front()) / 144.0);
}

double smoothing_half_window_s(const Prepared& data) {
  return std::min(150.0, (data.time_s.back() - data.time_s.front()) / 50.0);
}

Eigen::MatrixXd smooth(const std::vector<double>& time_s, const Eigen::MatrixXd& values, double half_window_s) {
  const int n = static_cast<int>(time_s.size());
  Eigen::MatrixXd out(values.rows(), values.cols());
  int first = 0;
  int last = -1;
  for (int i = 0; i < n; ++i) {
    // Symmetric: a window cut at one end would turn the line into a look ahead or back only.
    const double reach_s = std::min(half_window_s, std::max(time_s[i] - time_s[0], 0.5 * half_window_s));
    while (time_s[first] < time_s[i] - reach_s) ++first;
    while (first > 0 && time_s[first - 1] >= time_s[i] - reach_s) --first;
    while (last + 1 < n && time_s[last + 1] <= time_s[i] + reach_s) ++last;
    while (time_s[last] > time_s[i] + reach_s) --last;
    const int count = last - first + 1;
    const Eigen::Map<const Eigen::VectorXd> t(time_s.data() + first, count);
    const auto window = values.middleRows(first, count);
    const double t_mean = t.mean();
    const Eigen::VectorXd dt = t.array() - t_mean;
    const double spread = dt.squaredNorm();
    out.row(i) = window.colwise().mean();
    if (count >= 3 && spread > 0.0) out.row(i) += (time_s[i] - t_mean) / spread * (dt.transpose() * window);
  }
  return out;
}

Samples sample(const Prepared& data, bool only_measured) {
  const double block_s = block_length_s(data);
  const Eigen::MatrixXd smoothed = smooth(data.time_s, data.temperature_C, smoothing_half_window_s(data));
  Samples out;
  std::vector<Eigen::VectorXd> temperature;
  std::vector<Eigen::VectorXd> error;
  const auto errors = data.error_um.cols();
  int row = 0;
  while (row < data.rows()) {
    const double end_s = data.time_s[row] + block_s;
    Eigen::VectorXd t_sum = Eigen::VectorXd::Zero(data.temperature_C.cols());
    Eigen::VectorXd e_sum = Eigen::VectorXd::Zero(errors);
    Eigen::VectorXd e_count = Eigen::VectorXd::Zero(errors);
    double time_sum = 0.0;
    std::vector<int> rows;
    do {
      bool measured = !only_measured;
      for (Eigen::Index e = 0; e < errors; ++e) {
        const double v = data.error_um(row, e);
        if (!std::isfinite(v)) continue;
        measured = true;
        e_sum(e) += v;
        e_count(e) += 1.0;
      }
      if (measured) {
        t_sum += smoothed.row(row).transpose();
        time_sum += data.time_s[row];
        rows.push_back(row);
      }
      ++row;
    } while (row < data.rows() && data.time_s[row] < end_s);
    if (rows.empty()) continue;
    const auto count = static_cast<double>(rows.size());
    out.time_s.push_back(time_sum / count);
    temperature.push_back(t_sum / count);
    error.push_back((e_count.array() > 0.0).select(e_sum.array() / e_count.array().max(1.0), missing_sample));
    out.rows.push_back(std::move(rows));
  }
  const auto n = static_cast<Eigen::Index>(out.time_s.size());
  out.temperature_C.resize(n, data.temperature_C.cols());
  out.error_um.resize(n, errors);
  for (Eigen::Index i = 0; i < n; ++i) {
    out.temperature_C.row(i) = temperature[static_cast<std::size_t>(i)].transpose();
    out.error_um.row(i) = error[static_cast<std::size_t>(i)].transpose();
  }
  return out;
}

}  // namespace zerodrift::analysis
