#include "core/analysis/predict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/analysis/prepare.h"

namespace zerodrift::analysis {
namespace {

using recording::Recording;

/// Largest median difference between a recording's first temperatures and the training's last ones to be the same run.
constexpr double continuation_tolerance_K = 0.5;
constexpr double longest_continuation_gap_s = 1800.0;
/// A recording whose clock starts anew is a continuation only if the temperatures say so more strictly.
constexpr double strict_tolerance_K = 0.2;

std::vector<double> sensor_starts(const Model& model, const Prepared& data) {
  return start_references(data, static_features(model.sensors));
}

double median_difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> d;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) d.push_back(std::abs(a[i] - b[i]));
  return median(std::move(d));
}

bool is_continuation(const Model& model, const Prepared& data, const std::vector<double>& start_C) {
  const double gap_s = data.time_s.front() - model.end.time_s;
  const double difference_K = median_difference(start_C, model.end_C);
  if (gap_s > 0.0 && gap_s <= longest_continuation_gap_s) return difference_K <= continuation_tolerance_K;
  return gap_s < 0.0 && data.time_s.front() != model.start_time_s && model.sensors.size() >= 3 &&
         difference_K <= strict_tolerance_K && difference_K < 0.5 * median_difference(start_C, model.start_C);
}

bool is_training_start(const Model& model, const Prepared& data, const std::vector<double>& start_C) {
  return std::abs(data.time_s.front() - model.start_time_s) < 1.0 &&
         median_difference(start_C, model.start_C) <= strict_tolerance_K;
}

/// References of the features when each run counts from its own start.
std::vector<double> references(const Model& model, const Prepared& data, Zero zero) {
  return zero == Zero::start ? start_references(data, model.features) : model.reference_C;
}

struct Frame {
  Zero zero = Zero::training;
  bool continued = false;
  double remember_from_s = 0.0;  // the slow noise of the training fades from here on
  bool remembers = false;
};

Frame frame_of(const Model& model, const Prepared& data, Zero asked) {
  const std::vector<double> start_C = sensor_starts(model, data);
  Frame frame;
  if (asked == Zero::start) {
    frame.zero = Zero::start;
    return frame;
  }
  frame.continued = is_continuation(model, data, start_C);
  if (frame.continued) {
    frame.remembers = true;
    frame.remember_from_s = std::max(model.end.time_s, 0.0);
    if (data.time_s.front() < model.end.time_s) frame.remember_from_s = data.time_s.front();
    return frame;
  }
  if (is_training_start(model, data, start_C)) {
    frame.remembers = data.time_s.back() > model.end.time_s;
    frame.remember_from_s = model.end.time_s;
    return frame;
  }
  frame.zero = asked == Zero::training ? Zero::training : Zero::start;
  return frame;
}

/// The features at the very start, with every rise exactly 0: free of the noise of the first reading.
Eigen::RowVectorXd start_of(const Model& model, const Eigen::MatrixXd& x) {
  Eigen::RowVectorXd start = x.row(0);
  for (std::size_t f = 0; f < model.features.size(); ++f) {
    if (model.features[f].temperature) start(static_cast<Eigen::Index>(f)) = 0.0;
  }
  return start;
}

void add_residual(const Recording& recording, PredictedError& predicted) {
  const recording::Channel* measured = recording.find(predicted.error);
  if (measured == nullptr || recording::present_count(*measured) == 0) return;
  const auto n = static_cast<Eigen::Index>(predicted.value_um.size());
  const Eigen::Map<const Eigen::VectorXd> truth(measured->values.data(), n);
  const Eigen::Map<const Eigen::VectorXd> value(predicted.value_um.data(), n);
  predicted.residual = residual_figures(truth, value);
  int inside = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (std::abs(truth(i) - value(i)) <= predicted.half_width_um[static_cast<std::size_t>(i)]) ++inside;
  }
  predicted.coverage = predicted.residual.count > 0 ? static_cast<double>(inside) / predicted.residual.count : 0.0;
}

void add_extrapolation(const Model& model, const Prepared& data, const std::vector<double>& reference_C,
                       Prediction& out) {
  double worst = 0.0;
  int outside = 0;
  Eigen::VectorXd rise(static_cast<Eigen::Index>(model.sensors.size()));
  std::vector<double> values(model.domain.channels.size());
  for (int i = 0; i < data.rows(); ++i) {
    for (std::size_t c = 0; c < values.size(); ++c) {
      const int sensor = data.sensor(model.domain.channels[c]);
      values[c] =
          sensor >= 0 ? data.temperature_C(i, sensor) : data.input(i, data.input_index(model.domain.channels[c]));
      if (c < model.sensors.size()) rise(static_cast<Eigen::Index>(c)) = values[c] - reference_C[c];
    }
    std::string channel;
    out.extrapolation.push_back(extrapolation_of(model.domain, rise, values, &channel));
    if (out.extrapolation.back() > 1.0) ++outside;
    if (out.extrapolation.back() > worst) {
      worst = out.extrapolation.back();
      out.extrapolation_channel = channel;
    }
  }
  out.extrapolation_share = static_cast<double>(outside) / data.rows();
  if (outside > 0) {
    out.findings.push_back({FindingKind::extrapolation, FindingAction::noted, out.extrapolation_channel,
                            fmt::format("{:.0f} % of the time, up to {:.2f} of the trained range",
                                        100.0 * out.extrapolation_share, worst)});
  }
}

Result<Prepared> prepare_for(const Model& model, const Recording& recording) {
  PrepareOptions options;
  options.sensors = model.sensors;
  options.need_errors = false;
  ZD_TRY(Prepared data, prepare(recording, options));
  for (const auto& spec : model.features) {
    if (!spec.temperature && data.input_index(spec.channel) < 0) ZD_CHECK(recording.require(spec.channel));
  }
  return data;
}

}  // namespace

double extrapolation_of(const Domain& domain, const Eigen::VectorXd& rise_K, const std::vector<double>& values,
                        std::string* channel) {
  const Eigen::VectorXd away = rise_K - domain.mean;
  double worst = std::sqrt(std::max(away.dot(domain.inverse * away), 0.0) / domain.limit);
  std::string where = "sensors together";
  for (std::size_t c = 0; c < values.size(); ++c) {
    // Sensors may leave their range by a little noise; a speed counts as soon as it is higher.
    const double slack = static_cast<Eigen::Index>(c) < rise_K.size() ? 0.5 : 0.0;
    const double range = std::max(domain.high[c] - domain.low[c], 1e-9);
    const double excess = std::max(values[c] - domain.high[c], domain.low[c] - values[c]) - slack;
    if (excess > 1e-6 * range && 1.0 + excess / range > worst) {
      worst = 1.0 + excess / range;
      where = domain.channels[c];
    }
  }
  if (channel != nullptr) *channel = where;
  return worst;
}

recording::Recording Prediction::to_recording() const {
  Recording out;
  out.name = "prediction";
  out.time_s = time_s;
  for (const auto& e : errors) {
    recording::Channel low{e.error + "_low", {}};
    recording::Channel high{e.error + "_high", {}};
    for (std::size_t i = 0; i < e.value_um.size(); ++i) {
      low.values.push_back(e.value_um[i] - e.half_width_um[i]);
      high.values.push_back(e.value_um[i] + e.half_width_um[i]);
    }
    out.channels.push_back({e.error, e.value_um});
    out.channels.push_back(std::move(low));
    out.channels.push_back(std::move(high));
  }
  out.channels.push_back({"extrapolation", extrapolation});
  return out;
}

Result<Prediction> predict(const Model& model, const Recording& recording, Zero zero) {
  // A simulation starts with its recording: it cannot go on from the training's end.
  if (model.method == Method::physics) zero = Zero::start;
  ZD_TRY(const Prepared data, prepare_for(model, recording));
  const Frame frame = frame_of(model, data, zero);
  const std::vector<double> reference_C = references(model, data, frame.zero);
  FilterState from = model.end;
  if (frame.continued && data.time_s.front() <= from.time_s) from.time_s = data.time_s.front() - 1.0;
  ZD_TRY(const Eigen::MatrixXd x, features(data, model.features, reference_C, frame.continued ? &from : nullptr));
  Prediction out;
  out.time_s = data.time_s;
  out.zero = frame.zero;
  out.continued = frame.continued;
  out.findings = data.findings;
  const bool own_start = frame.zero == Zero::start;
  add_extrapolation(model, data, own_start ? sensor_starts(model, data) : model.start_C, out);
  const Eigen::RowVectorXd start = start_of(model, x);
  for (const auto& e : model.errors) {
    Eigen::VectorXd value = e.regression.predict(x);
    if (own_start) value.array() -= e.regression.predict(start)(0);
    if (frame.remembers && e.regression.noise.memory_s > 0.0) {
      for (Eigen::Index i = 0; i < value.size(); ++i) {
        const double after_s = data.time_s[static_cast<std::size_t>(i)] - frame.remember_from_s;
        if (after_s >= 0.0) value(i) += e.remembered_um * std::exp(-after_s / e.regression.noise.memory_s);
      }
    }
    const Eigen::VectorXd half_width = model.half_width_um(e, x, own_start ? &start : nullptr);
    PredictedError predicted;
    predicted.error = e.error;
    predicted.value_um.assign(value.begin(), value.end());
    predicted.half_width_um.assign(half_width.begin(), half_width.end());
    for (std::size_t i = 0; i < out.extrapolation.size(); ++i) {
      predicted.half_width_um[i] *= std::max(1.0, out.extrapolation[i]);
    }
    add_residual(recording, predicted);
    out.errors.push_back(std::move(predicted));
  }
  return out;
}

LivePredictor::LivePredictor(Model model)
    : m_model(std::move(model)), m_filtered(m_model.features.size()), m_driving(m_model.features.size()) {}

Result<double> LivePredictor::value_of(const std::string& channel, double time_s,
                                       const std::map<std::string, double>& channels) {
  constexpr double longest_hold_s = 30.0;
  const auto at = channels.find(channel);
  if (at != channels.end() && std::isfinite(at->second)) {
    m_last[channel] = {time_s, at->second};
    return at->second;
  }
  const auto last = m_last.find(channel);
  if (last == m_last.end() || time_s - last->second.first > longest_hold_s) {
    return fail(ErrorCode::sensor_dead, {{"sensor", channel}});
  }
  return last->second.second;
}

Result<LivePredictor::Sample> LivePredictor::update(double time_s, const std::map<std::string, double>& channels) {
  Eigen::RowVectorXd x(static_cast<Eigen::Index>(m_model.features.size()));
  for (std::size_t f = 0; f < m_model.features.size(); ++f) {
    const FeatureSpec& spec = m_model.features[f];
    ZD_TRY(const double raw, value_of(spec.channel, time_s, channels));
    const double u = spec.temperature ? raw - m_model.reference_C[f] : std::pow(raw / spec.unit, spec.power);
    if (!m_started || spec.time_constant_s <= 0.0) {
      m_filtered[f] = u;
    } else {
      const double keep = std::exp(-std::max(time_s - m_time_s, 0.0) / spec.time_constant_s);
      m_filtered[f] = keep * m_filtered[f] + (1.0 - keep) * 0.5 * (m_driving[f] + u);
    }
    m_driving[f] = u;
    x(static_cast<Eigen::Index>(f)) = m_filtered[f];
  }
  Eigen::VectorXd rise(static_cast<Eigen::Index>(m_model.sensors.size()));
  std::vector<double> values(m_model.domain.channels.size());
  for (std::size_t c = 0; c < values.size(); ++c) {
    ZD_TRY(values[c], value_of(m_model.domain.channels[c], time_s, channels));
    if (c < m_model.sensors.size()) rise(static_cast<Eigen::Index>(c)) = values[c] - m_model.start_C[c];
  }
  m_time_s = time_s;
  m_started = true;
  Sample out;
  out.extrapolation = extrapolation_of(m_model.domain, rise, values, &out.extrapolation_channel);
  const Eigen::RowVectorXd start = start_of(m_model, x);
  for (const auto& e : m_model.errors) {
    out.errors.push_back({e.error, e.regression.predict(x)(0),
                          std::max(1.0, out.extrapolation) * m_model.half_width_um(e, x, &start)(0)});
  }
  return out;
}

}  // namespace zerodrift::analysis
