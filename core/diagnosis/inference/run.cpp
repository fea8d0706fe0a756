#include "core/diagnosis/inference/run.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/physics/prediction.h"
#include "core/physics/skyline.h"

namespace zerodrift::diagnosis::inference {
namespace {

double range_of(const MeasuredSeries& series) {
  std::vector<double> sorted;
  for (std::size_t k = 0; k < series.values.size(); ++k) {
    if (series.present[k]) sorted.push_back(series.values[k]);
  }
  if (sorted.size() < 3) return 0.0;
  std::sort(sorted.begin(), sorted.end());
  return sorted[sorted.size() * 98 / 100] - sorted[sorted.size() * 2 / 100];
}

MeasuredSeries make_series(const recording::Channel* source, const physics::Observation& seen, std::size_t rows,
                           const DiagnosisSettings& settings) {
  MeasuredSeries series;
  series.channel = seen.channel;
  series.temperature = seen.temperature;
  series.values.assign(rows, 0.0);
  series.present.assign(rows, false);
  series.timing.assign(rows, 0.0);
  if (source == nullptr) return series;
  series.white =
      physics::noise_width(source->values, seen.temperature ? settings.least_noise_K : settings.least_noise_um);
  const std::vector<bool> spike = physics::spikes(source->values, series.white);
  for (std::size_t k = 0; k < rows; ++k) {
    if (!std::isfinite(source->values[k]) || spike[k]) continue;
    series.values[k] = source->values[k];
    series.present[k] = true;
    ++series.samples;
  }
  series.range = range_of(series);
  series.slow = std::hypot(seen.temperature ? settings.slow_K : settings.slow_um, settings.slow_share * series.range,
                           seen.accuracy);
  return series;
}

/// A dozen samples tell a noise width badly, and a channel that does not move tells none: sensors of a kind are alike.
void share_noise(std::vector<MeasuredSeries>& series) {
  constexpr double worth_samples = 10.0;  // of what the others show
  std::vector<double> variances;
  for (const auto& one : series) {
    if (one.samples > 0 && one.temperature) variances.push_back(one.white * one.white);
  }
  if (variances.empty()) return;
  const auto middle = variances.begin() + static_cast<std::ptrdiff_t>(variances.size() / 2);
  std::nth_element(variances.begin(), middle, variances.end());
  for (auto& one : series) {
    if (one.samples == 0 || !one.temperature) continue;
    one.white =
        std::sqrt((one.samples * one.white * one.white + worth_samples * *middle) / (one.samples + worth_samples));
  }
}

/// An input switched somewhere between two samples: how far that moves the nominal prediction, beyond what the slow
/// discrepancy carries on from the sample before.
void set_timing_noise(Run& run, const physics::Network& network, double correlation_time_s) {
  const auto hold = static_cast<std::size_t>(network.hold_parameter);
  const physics::InputSet inputs = physics::make_inputs(network, run.recording);
  std::vector<double> values = network.start_values();
  values[hold] = 0.0;
  const physics::Prediction late = physics::predict(network, inputs, values);
  values[hold] = 1.0;
  const physics::Prediction early = physics::predict(network, inputs, values);
  const std::vector<double>& time_s = run.recording.time_s;
  for (std::size_t c = 0; c < run.series.size(); ++c) {
    double before = 0.0;
    for (std::size_t k = 0; k < run.rows(); ++k) {
      const double fade = k == 0 ? 0.0 : std::exp(-(time_s[k] - time_s[k - 1]) / correlation_time_s);
      const double moved = early.channels[c].values[k] - late.channels[c].values[k];
      const double change = network.parameters[hold].sigma * (moved - fade * before);
      run.series[c].timing[k] = change * change;
      before = moved;
    }
  }
}

}  // namespace

Run make_run(recording::Recording recording, const physics::Network& nominal, const DiagnosisSettings& settings) {
  Run run;
  run.recording = std::move(recording);
  for (const auto& seen : nominal.observations) {
    run.series.push_back(make_series(run.recording.find(seen.channel), seen, run.rows(), settings));
  }
  share_noise(run.series);
  set_timing_noise(run, nominal, settings.slow_times_s.front());
  return run;
}

/// State: the discrepancy and its rate. Over dt the transition is exp(-l dt) [[1 + l dt, dt], [-l^2 dt, 1 - l dt]] with
/// l = sqrt(3) / correlation time (Hartikainen & Sarkka 2010, Gaussian process regression by Kalman filter, eq. 12
/// ff.).
Whitener::Whitener(const MeasuredSeries& series, const std::vector<double>& time_s, double size,
                   double correlation_time_s)
    : m_steps(time_s.size()) {
  const double rate = std::sqrt(3.0) / correlation_time_s;
  const double slow2 = size * size * series.slow * series.slow;
  const double rate2 = rate * rate * slow2;
  const double white2 = series.white * series.white;
  double p00 = slow2, p01 = 0.0, p11 = rate2;
  for (std::size_t k = 0; k < time_s.size(); ++k) {
    Step& step = m_steps[k];
    if (k > 0) {
      const double dt = time_s[k] - time_s[k - 1];
      const double fade = std::exp(-rate * dt);
      step.f00 = fade * (1.0 + rate * dt);
      step.f01 = fade * dt;
      step.f10 = -fade * rate * rate * dt;
      step.f11 = fade * (1.0 - rate * dt);
      const auto [a, b, c, d] = std::array{step.f00, step.f01, step.f10, step.f11};
      const double q00 = slow2 - (a * a * slow2 + b * b * rate2);
      const double q01 = -(a * c * slow2 + b * d * rate2);
      const double q11 = rate2 - (c * c * slow2 + d * d * rate2);
      const double n00 = a * a * p00 + 2.0 * a * b * p01 + b * b * p11 + q00 + series.timing[k];
      const double n01 = a * c * p00 + (a * d + b * c) * p01 + b * d * p11 + q01;
      const double n11 = c * c * p00 + 2.0 * c * d * p01 + d * d * p11 + q11;
      p00 = n00, p01 = n01, p11 = n11;
    }
    step.present = series.present[k];
    if (!step.present) continue;
    const double total = p00 + white2;
    m_log_determinant += std::log(total);
    step.inverse = 1.0 / std::sqrt(total);
    step.gain0 = p00 / total;
    step.gain1 = p01 / total;
    p11 -= step.gain1 * p01;
    p01 -= step.gain0 * p01;
    p00 -= step.gain0 * p00;
  }
}

void Whitener::apply(const double* value, double* out) const {
  double level = 0.0, slope = 0.0;
  for (std::size_t k = 0; k < m_steps.size(); ++k) {
    const Step& step = m_steps[k];
    const double expected = step.f00 * level + step.f01 * slope;
    slope = step.f10 * level + step.f11 * slope;
    level = expected;
    out[k] = 0.0;
    if (!step.present) continue;
    const double innovation = value[k] - level;
    out[k] = innovation * step.inverse;
    level += step.gain0 * innovation;
    slope += step.gain1 * innovation;
  }
}

/// One sample of the filter, all columns side by side.
ZERODRIFT_WIDE static void whiten_row(const double* __restrict transition, double gain0, double gain1, double inverse,
                                      std::size_t columns, const double* __restrict value, double* __restrict level,
                                      double* __restrict slope, double* __restrict out) {
  for (std::size_t p = 0; p < columns; ++p) {
    const double expected = transition[0] * level[p] + transition[1] * slope[p];
    const double rate = transition[2] * level[p] + transition[3] * slope[p];
    const double innovation = value[p] - expected;
    out[p] = innovation * inverse;
    level[p] = expected + gain0 * innovation;
    slope[p] = rate + gain1 * innovation;
  }
}

void Whitener::apply(const Eigen::Ref<const RowMatrix>& value, Eigen::Ref<RowMatrix> out) const {
  const auto columns = static_cast<std::size_t>(value.cols());
  std::vector<double> level(columns, 0.0), slope(columns, 0.0);
  for (std::size_t k = 0; k < m_steps.size(); ++k) {
    const Step& step = m_steps[k];
    const auto row = static_cast<Eigen::Index>(k);
    const double transition[4] = {step.f00, step.f01, step.f10, step.f11};
    // What was not measured has no innovation: a gain and a weight of 0.
    const double gain0 = step.present ? step.gain0 : 0.0, gain1 = step.present ? step.gain1 : 0.0;
    whiten_row(transition, gain0, gain1, step.present ? step.inverse : 0.0, columns, value.row(row).data(),
               level.data(), slope.data(), out.row(row).data());
  }
}

}  // namespace zerodrift::diagnosis::inference
