#include "core/diagnosis/dataset.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/physics/skyline.h"

namespace zerodrift::diagnosis {
namespace {

double range_of(const MeasuredChannel& channel) {
  std::vector<double> sorted;
  for (std::size_t k = 0; k < channel.values.size(); ++k) {
    if (channel.present[k]) sorted.push_back(channel.values[k]);
  }
  if (sorted.size() < 3) return 0.0;
  std::sort(sorted.begin(), sorted.end());
  return sorted[sorted.size() * 98 / 100] - sorted[sorted.size() * 2 / 100];
}

double white_noise(const std::vector<double>& values, bool temperature) {
  return physics::noise_width(values, temperature ? 0.01 : 0.05);
}

MeasuredChannel make_channel(const recording::Channel* source, const physics::Observation& seen, std::size_t rows) {
  MeasuredChannel channel;
  channel.name = seen.channel;
  channel.temperature = seen.temperature;
  channel.values.assign(rows, 0.0);
  channel.present.assign(rows, false);
  channel.timing.assign(rows, 0.0);
  if (source == nullptr) return channel;
  channel.white = white_noise(source->values, seen.temperature);
  const std::vector<bool> spike = spikes_of(source->values, seen.temperature);
  for (std::size_t k = 0; k < rows; ++k) {
    if (!std::isfinite(source->values[k]) || spike[k]) continue;
    channel.values[k] = source->values[k];
    channel.present[k] = true;
    ++channel.samples;
  }
  channel.drift = std::hypot(ordinary_drift(seen.temperature, range_of(channel)), seen.accuracy);
  return channel;
}

/// A dozen samples tell a noise width badly, and a channel that stands still tells none: sensors of a kind are alike.
void share_noise(std::vector<MeasuredChannel>& channels, bool temperature) {
  constexpr double worth_samples = 10.0;  // of what the others show
  std::vector<double> variances;
  for (const auto& channel : channels) {
    if (channel.samples > 0 && channel.temperature == temperature) variances.push_back(channel.white * channel.white);
  }
  if (variances.empty()) return;
  const auto middle = variances.begin() + static_cast<std::ptrdiff_t>(variances.size() / 2);
  std::nth_element(variances.begin(), middle, variances.end());
  for (auto& channel : channels) {
    if (channel.samples == 0 || channel.temperature != temperature) continue;
    const double own = channel.samples * channel.white * channel.white;
    channel.white = std::sqrt((own + worth_samples * *middle) / (channel.samples + worth_samples));
  }
}

void set_gains(MeasuredChannel& channel, const std::vector<double>& time_s) {
  channel.gains.resize(time_s.size());
  const double drift2 = channel.drift * channel.drift;
  const double white2 = channel.white * channel.white;
  double variance = drift2;
  double log_determinant = 0.0;
  for (std::size_t k = 0; k < time_s.size(); ++k) {
    Gain& g = channel.gains[k];
    g = Gain{};
    if (k > 0) {
      g.fade = std::exp(-(time_s[k] - time_s[k - 1]) / channel.drift_time_s);
      variance = g.fade * g.fade * variance + (1.0 - g.fade * g.fade) * drift2 + channel.timing[k];
    }
    g.present = channel.present[k];
    if (!g.present) continue;
    const double total = variance + white2;
    log_determinant += std::log(total);
    g.inverse = 1.0 / std::sqrt(total);
    g.update = variance / total;
    variance *= 1.0 - g.update;
  }
  channel.log_determinant = log_determinant;
}

}  // namespace

int Dataset::samples() const {
  int count = 0;
  for (const auto& channel : channels) count += channel.samples;
  return count;
}

void Dataset::prepare() {
  for (auto& channel : channels) {
    if (channel.samples > 0) set_gains(channel, time_s);
  }
}

std::vector<bool> spikes_of(const std::vector<double>& values, bool temperature) {
  return physics::spikes(values, white_noise(values, temperature));
}

double ordinary_drift(bool temperature, double range) {
  return std::hypot(temperature ? 0.02 : 0.2, 0.0015 * range);
}

Dataset make_dataset(const recording::Recording& recording, const physics::Network& network) {
  Dataset data;
  data.recording = &recording;
  data.time_s = recording.time_s;
  for (const auto& seen : network.observations) {
    data.channels.push_back(make_channel(recording.find(seen.channel), seen, data.rows()));
  }
  share_noise(data.channels, true);
  data.prepare();
  return data;
}

Dataset with_drift(Dataset data, double factor) {
  for (auto& channel : data.channels) channel.drift *= factor;
  data.prepare();
  return data;
}

namespace {

/// Log likelihood of one channel's difference to a prediction, without the constant.
double log_likelihood(const MeasuredChannel& channel, const std::vector<double>& predicted) {
  double mean = 0.0;
  double sum = 0.0;
  for (std::size_t k = 0; k < predicted.size(); ++k) {
    const Gain& g = channel.gains[k];
    mean *= g.fade;
    if (!g.present) continue;
    const double innovation = channel.values[k] - predicted[k] - mean;
    sum += innovation * innovation * g.inverse * g.inverse;
    mean += g.update * innovation;
  }
  return -0.5 * sum - 0.5 * channel.log_determinant;
}

}  // namespace

std::vector<Discrepancy> likely_discrepancy(const Dataset& data, const physics::Prediction& prediction) {
  std::vector<Discrepancy> list(data.channels.size());
  for (std::size_t c = 0; c < list.size(); ++c) {
    if (data.channels[c].samples == 0) continue;
    MeasuredChannel trial = data.channels[c];
    const std::vector<double>& predicted = prediction.channels[c].values;
    const double usual = log_likelihood(trial, predicted);
    list[c] = {1.0, 1500.0, usual, 0.0};
    for (const double time_s : {1500.0, 6000.0}) {
      for (const double factor : {1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0, 24.0, 32.0}) {
        if (factor == 1.0 && time_s == 1500.0) continue;
        trial.drift = factor * data.channels[c].drift;
        trial.drift_time_s = time_s;
        set_gains(trial, data.time_s);
        const double gain = log_likelihood(trial, predicted) - usual;
        if (gain > list[c].gain) list[c] = {factor, time_s, usual + gain, gain};
      }
    }
  }
  return list;
}

std::vector<Discrepancy> ordinary_discrepancy(const Dataset& data, const physics::Prediction& prediction) {
  static constexpr double factors[] = {0.25, 0.35, 0.5, 0.7, 1.0, 1.4};
  constexpr std::size_t count = std::size(factors);
  constexpr double spread = 0.35;  // ln, of a channel about the others of its kind
  std::vector<std::array<double, count>> likelihood(data.channels.size());
  for (std::size_t c = 0; c < data.channels.size(); ++c) {
    if (data.channels[c].samples == 0) continue;
    MeasuredChannel trial = data.channels[c];
    for (std::size_t f = 0; f < count; ++f) {
      trial.drift = factors[f] * data.channels[c].drift;
      set_gains(trial, data.time_s);
      likelihood[c][f] = log_likelihood(trial, prediction.channels[c].values);
    }
  }
  // A channel's own best factor beside a common one; for a displacement the common one stands in the middle.
  const auto best_beside = [&](std::size_t c, double common) {
    std::size_t best = 0;
    double largest = -1e300;
    for (std::size_t f = 0; f < count; ++f) {
      const double off = std::log(factors[f] / common) / (data.channels[c].temperature ? spread : 2.0 * spread);
      const double value = likelihood[c][f] - 0.5 * off * off;
      if (value > largest) largest = value, best = f;
    }
    return std::pair{largest, best};
  };
  double common = 0.7;
  double largest = -1e300;
  for (const double factor : factors) {
    double sum = 0.0;
    for (std::size_t c = 0; c < data.channels.size(); ++c) {
      if (data.channels[c].samples > 0 && data.channels[c].temperature) sum += best_beside(c, factor).first;
    }
    if (sum > largest) largest = sum, common = factor;
  }
  std::vector<Discrepancy> list(data.channels.size());
  for (std::size_t c = 0; c < list.size(); ++c) {
    if (data.channels[c].samples == 0) continue;
    const std::size_t best = best_beside(c, data.channels[c].temperature ? common : 0.7).second;
    list[c].factor = factors[best];
    list[c].time_s = data.channels[c].drift_time_s;
    list[c].log_likelihood = likelihood[c][best];
  }
  return list;
}

Dataset with_discrepancy(Dataset data, const std::vector<Discrepancy>& channels) {
  for (std::size_t c = 0; c < channels.size(); ++c) {
    data.channels[c].drift *= channels[c].factor;
    data.channels[c].drift_time_s = channels[c].time_s;
  }
  data.prepare();
  return data;
}

void set_timing_noise(Dataset& data, const physics::Network& network, const physics::InputSet& inputs) {
  const auto hold = static_cast<std::size_t>(network.hold_parameter);
  std::vector<double> values = network.start_values();
  values[hold] = 0.0;
  const physics::Prediction late = predict(network, inputs, values);
  values[hold] = 1.0;
  const physics::Prediction early = predict(network, inputs, values);
  for (std::size_t c = 0; c < data.channels.size(); ++c) {
    MeasuredChannel& channel = data.channels[c];
    double before = 0.0;
    for (std::size_t k = 0; k < data.rows(); ++k) {
      // New is what the slow drift does not carry over from the sample before, whether it rises or falls.
      const double fade = k == 0 ? 0.0 : std::exp(-(data.time_s[k] - data.time_s[k - 1]) / channel.drift_time_s);
      const double moved = early.channels[c].values[k] - late.channels[c].values[k];
      const double change = network.parameters[hold].sigma * (moved - fade * before);
      channel.timing[k] = change * change;
      before = moved;
    }
  }
  data.prepare();
}

double whiten(const Dataset& data, const physics::Prediction& prediction, Eigen::VectorXd* residual) {
  residual->setZero(static_cast<Eigen::Index>(data.stacked()));
  double log_determinant = 0.0;
  for (std::size_t c = 0; c < data.channels.size(); ++c) {
    const MeasuredChannel& channel = data.channels[c];
    if (channel.samples == 0) continue;
    log_determinant += channel.log_determinant;
    double mean = 0.0;
    for (std::size_t k = 0; k < data.rows(); ++k) {
      const Gain& g = channel.gains[k];
      mean *= g.fade;
      if (!g.present) continue;
      const double innovation = channel.values[k] - prediction.channels[c].values[k] - mean;
      (*residual)[static_cast<Eigen::Index>(c * data.rows() + k)] = innovation * g.inverse;
      mean += g.update * innovation;
    }
  }
  return log_determinant;
}

/// One row of a channel's filter, all columns side by side.
ZERODRIFT_WIDE static void whiten_row(const Gain& gain, std::size_t columns, const double* __restrict by,
                                      const double* __restrict slopes, double* __restrict mean,
                                      double* __restrict out) {
  for (std::size_t p = 0; p < columns; ++p) {
    const double expected = mean[p] * gain.fade;
    const double innovation = by[p] - expected;
    out[p] = innovation * gain.inverse * slopes[p];
    mean[p] = expected + gain.update * innovation;
  }
}

void whiten_columns(const Dataset& data, const physics::Prediction& prediction, const std::vector<double>& slopes,
                    RowMatrix& jacobian, const std::vector<int>& target_columns) {
  const std::size_t count = prediction.columns;
  if (count == 0) return;
  const bool in_order = std::adjacent_find(target_columns.begin(), target_columns.end(),
                                           [](int a, int b) { return b != a + 1; }) == target_columns.end();
  std::vector<double> mean(count), row(count);
  for (std::size_t c = 0; c < data.channels.size(); ++c) {
    const MeasuredChannel& channel = data.channels[c];
    std::fill(mean.begin(), mean.end(), 0.0);
    for (std::size_t k = 0; k < data.rows(); ++k) {
      double* out = jacobian.row(static_cast<Eigen::Index>(c * data.rows() + k)).data();
      const bool measured = channel.samples > 0;
      if (!measured || !channel.gains[k].present) {
        for (std::size_t p = 0; measured && p < count; ++p) mean[p] *= channel.gains[k].fade;
        for (const int target : target_columns) out[target] = 0.0;
        continue;
      }
      const double* by = prediction.channels[c].derivatives.data() + k * count;
      double* to = in_order ? out + target_columns.front() : row.data();
      whiten_row(channel.gains[k], count, by, slopes.data(), mean.data(), to);
      for (std::size_t p = 0; !in_order && p < count; ++p) out[target_columns[p]] = row[p];
    }
  }
}

}  // namespace zerodrift::diagnosis
