#include "core/physics/placement.h"

#include <algorithm>
#include <cmath>

#include "core/physics/builder.h"
#include "core/physics/initial_state.h"
#include "core/physics/prediction.h"
#include "core/physics/simulate.h"
#include "core/physics/simulator.h"

namespace zerodrift::physics {
namespace {

struct Line {
  double slope = 0.0;
  double correlation = 0.0;
  double residual = 0.0;
};

/// Straight line of y over x where both are finite.
Line fit_line(const std::vector<double>& x, const std::vector<double>& y) {
  double sx = 0, sy = 0, n = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (!std::isfinite(x[k]) || !std::isfinite(y[k])) continue;
    sx += x[k];
    sy += y[k];
    n += 1.0;
  }
  if (n < 3.0) return {};
  double xx = 0, yy = 0, xy = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (!std::isfinite(x[k]) || !std::isfinite(y[k])) continue;
    const double dx = x[k] - sx / n;
    const double dy = y[k] - sy / n;
    xx += dx * dx;
    yy += dy * dy;
    xy += dx * dy;
  }
  Line line;
  if (xx <= 0.0 || yy <= 0.0) return line;
  line.slope = xy / xx;
  line.correlation = xy / std::sqrt(xx * yy);
  line.residual = std::sqrt(std::max(0.0, yy - xy * line.slope) / n);
  return line;
}

/// x(t - shift), linear between samples, NaN outside.
std::vector<double> shifted(const std::vector<double>& x, const std::vector<double>& time_s, double shift_s) {
  std::vector<double> out(x.size(), std::nan(""));
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double at = time_s[k] - shift_s;
    const auto next = std::upper_bound(time_s.begin(), time_s.end(), at);
    if (next == time_s.begin() || next == time_s.end()) continue;
    const auto i = next - time_s.begin();
    const double share = (at - time_s[i - 1]) / (time_s[i] - time_s[i - 1]);
    out[k] = x[i - 1] + share * (x[i] - x[i - 1]);
  }
  return out;
}

PlaceScore score(const std::vector<double>& temperature, const std::vector<double>& error,
                 const std::vector<double>& time_s, double position_mm) {
  PlaceScore s;
  s.position_mm = position_mm;
  const Line line = fit_line(temperature, error);
  s.correlation = line.correlation;
  s.residual_um = line.residual;
  s.um_per_K = line.slope;
  const double span_s = time_s.back() - time_s.front();
  double best = line.residual;
  for (const double unit : {0.02, 0.004}) {
    const double centre = s.lag_s;
    for (int i = -10; i <= 10; ++i) {
      const double lag_s = centre + i * unit * span_s;
      if (std::abs(lag_s) > 0.2 * span_s) continue;
      const Line at = fit_line(shifted(temperature, time_s, lag_s), error);
      if (at.residual > 0.0 && at.residual < best) {
        best = at.residual;
        s.lag_s = lag_s;
      }
    }
  }
  return s;
}

/// The smaller residual wins; when they are alike the smaller lag.
bool left_is_better(const PlaceScore& left, const PlaceScore& right) {
  const double scale = std::max(left.residual_um, right.residual_um);
  if (std::abs(left.residual_um - right.residual_um) < 0.02 * scale) {
    return std::abs(left.lag_s) <= std::abs(right.lag_s);
  }
  return left.residual_um < right.residual_um;
}

class Field {
 public:
  Field(const Trajectory& run, const Network::Place& place, std::size_t nodes)
      : m_run(run), m_place(place), m_nodes(nodes) {}

  /// Mean temperature between two positions; partly covered cells count by their share.
  std::vector<double> mean_over(double from_mm, double to_mm) const {
    const double cell_mm = 1e3 * m_place.cell_m;
    std::vector<double> mean(m_run.rows, 0.0);
    double sum = 0.0;
    for (int i = 0; i < m_place.count; ++i) {
      const double share = std::min(to_mm, (i + 1) * cell_mm) - std::max(from_mm, i * cell_mm);
      if (share <= 0.0) continue;
      sum += share;
      for (std::size_t k = 0; k < m_run.rows; ++k) mean[k] += share * m_run.field_C[k * m_nodes + m_place.first + i];
    }
    for (double& value : mean) value /= sum;
    return mean;
  }

 private:
  const Trajectory& m_run;
  Network::Place m_place;
  std::size_t m_nodes;
};

/// The rod whose length the displacement measures; the first rod when it names none.
Result<const Component*> rod_of(const Machine& machine, const std::string& error) {
  for (const auto& displacement : machine.displacements) {
    const Component* component = machine.find(displacement.component);
    if (displacement.channel == error && component != nullptr && !component->lump) return component;
  }
  for (const auto& component : machine.components) {
    if (!component.lump) return &component;
  }
  return fail(ErrorCode::data_does_not_fit,
              {{"what", machine.file},
               {"found", "no rod"},
               {"expected", "a component with length and diameter to place a sensor on"}});
}

}  // namespace

Result<Placement> place_sensor(const Machine& machine, const recording::Recording& inputs,
                               const PlacementOptions& options, const TaskContext& context) {
  ZD_TRY(auto warnings, check_recording(machine, inputs));
  ZD_TRY(const Component* rod, rod_of(machine, options.error));
  const Network network = build_network(machine, inputs);
  const InputSet set = make_inputs(network, inputs);
  SimulateOptions keep;
  keep.keep_field = true;
  const std::vector<double> values = network.start_values();
  const Trajectory run = run_network(network, set, values, {}, keep);
  context.progress(0.5, "simulating");
  if (context.cancelled()) return fail(ErrorCode::cancelled);

  Placement placement;
  placement.component = rod->id;
  placement.error = options.error;
  placement.length_mm = rod->length_mm;
  placement.notes = network.notes;
  if (nothing_drives(set) && !starts_warm(machine, inputs)) placement.notes.emplace_back("no_excitation");
  std::vector<double> error;
  const recording::Channel* seen = inputs.find(options.error);
  if (seen != nullptr && recording::present_count(*seen) > 10) {
    error = seen->values;
    placement.measured = true;
  } else {
    for (const auto& channel : observe(network, set, values, run).channels) {
      if (channel.channel == options.error) error = channel.values;
    }
  }
  if (error.empty()) {
    return fail(ErrorCode::channel_missing,
                {{"channel", options.error}, {"available", "the displacements of " + machine.file}});
  }
  const Field field(run, *network.place(rod->id), network.nodes());
  const double step_mm = rod->length_mm / 40.0;
  for (int i = 0; i < 40; ++i) {
    placement.along.push_back(
        score(field.mean_over(i * step_mm, (i + 1) * step_mm), error, inputs.time_s, (i + 0.5) * step_mm));
  }
  constexpr double rounding_um = 1e-6;
  const auto [lowest, highest] = std::minmax_element(error.begin(), error.end());
  if (*highest - *lowest < rounding_um) {
    return fail(ErrorCode::no_variation, {{"what", options.error + " against the simulated temperatures"}});
  }
  double from_mm = 0.0;
  double to_mm = rod->length_mm;
  const double smallest_mm =
      options.smallest_region_mm > 0.0 ? options.smallest_region_mm : std::min(12.5, rod->length_mm / 8.0);
  while (to_mm - from_mm > smallest_mm * 1.0001) {
    const double middle_mm = 0.5 * (from_mm + to_mm);
    BisectionStep bisection;
    bisection.from_mm = from_mm;
    bisection.to_mm = to_mm;
    bisection.left = score(field.mean_over(from_mm, middle_mm), error, inputs.time_s, 0.5 * (from_mm + middle_mm));
    bisection.right = score(field.mean_over(middle_mm, to_mm), error, inputs.time_s, 0.5 * (middle_mm + to_mm));
    bisection.took_left = left_is_better(bisection.left, bisection.right);
    (bisection.took_left ? to_mm : from_mm) = middle_mm;
    placement.steps.push_back(bisection);
  }
  placement.from_mm = from_mm;
  placement.to_mm = to_mm;
  placement.best = score(field.mean_over(from_mm, to_mm), error, inputs.time_s, 0.5 * (from_mm + to_mm));
  for (const auto& sensor : machine.sensors) {
    if (sensor.component != rod->id) continue;
    const recording::Channel* measured = inputs.find(sensor.channel);
    const double half_mm = 0.5 * step_mm;
    const auto simulated = field.mean_over(std::max(0.0, sensor.position_mm - half_mm),
                                           std::min(rod->length_mm, sensor.position_mm + half_mm));
    const bool use_measured = measured != nullptr && recording::present_count(*measured) > 10;
    placement.sensors.push_back(
        score(use_measured ? measured->values : simulated, error, inputs.time_s, sensor.position_mm));
    placement.sensor_channels.push_back(sensor.channel);
  }
  context.progress(1.0, "placing");
  return placement;
}

}  // namespace zerodrift::physics
