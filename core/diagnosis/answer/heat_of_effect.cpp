#include "core/diagnosis/answer/heat_of_effect.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/physics/heat.h"
#include "core/physics/prediction.h"

namespace zerodrift::diagnosis::answer {
namespace {

constexpr double acts_from = 0.1;  // of its largest
constexpr double least_W = 0.05;   // less is the arithmetic's
constexpr double sure_sigmas = 2.0;
constexpr double step_sigmas = 0.05;

}  // namespace

std::optional<EffectHeat> heat_of_effect(const inference::Fit& fit, std::size_t effect) {
  const inference::JointModel& model = fit.model();
  const inference::HeldEffect& held = model.hypothesis().effects[effect];
  // A room sensor that reads wrong brings no heat, though the films believe it.
  if (physics::find_effect(held.spec.id)->traits.room_reads_wrong) return std::nullopt;
  const std::size_t run = held.run < 0 ? 0 : static_cast<std::size_t>(held.run);
  const physics::Network& network = model.network(run);
  const physics::InputSet& inputs = model.inputs(run);
  const std::vector<double> fitted = model.values(run, fit.z());
  const std::vector<double> field_C = physics::run_network(network, inputs, fitted, {}, {31.0, true, false}).field_C;
  std::vector<std::size_t> amplitudes;
  for (std::size_t i = 0; i < network.parameters.size(); ++i) {
    const physics::Parameter& parameter = network.parameters[i];
    if (parameter.amplitude &&
        model.hypothesis().effect_of(static_cast<int>(run), parameter.effect) == static_cast<int>(effect))
      amplitudes.push_back(i);
  }
  const auto brought_W = [&](std::vector<double> values) {
    std::vector<double> heat_W = physics::heat_from_outside_W(network, inputs, values, field_C);
    for (const std::size_t i : amplitudes) values[i] = 0.0;
    const std::vector<double> without_W = physics::heat_from_outside_W(network, inputs, values, field_C);
    std::transform(heat_W.begin(), heat_W.end(), without_W.begin(), heat_W.begin(), std::minus<>());
    return heat_W;
  };
  const std::vector<double> heat_W = brought_W(fitted);
  double largest_W = 0.0;
  for (const double one : heat_W) largest_W = std::max(largest_W, std::abs(one));
  if (!(largest_W > least_W)) return std::nullopt;
  const std::vector<double>& time_s = inputs.time_s;
  const auto mean_of = [&](const std::vector<double>& all_W) {
    double sum_J = 0.0, acts_s = 0.0;
    for (std::size_t k = 0; k < all_W.size(); ++k) {
      if (std::abs(heat_W[k]) < acts_from * largest_W) continue;
      sum_J += all_W[k] * (time_s[k + 1] - time_s[k]);
      acts_s += time_s[k + 1] - time_s[k];
    }
    return sum_J / acts_s;
  };
  EffectHeat heat;
  heat.mean_W = mean_of(heat_W);
  Eigen::VectorXd slope(fit.z().size());
  for (Eigen::Index i = 0; i < slope.size(); ++i) {
    Eigen::VectorXd z = fit.z();
    z[i] += step_sigmas;
    slope[i] = model.parameter_of(run, static_cast<std::size_t>(i)) < 0
                   ? 0.0
                   : (mean_of(brought_W(model.values(run, z))) - heat.mean_W) / step_sigmas;
  }
  heat.sigma_W = std::sqrt(std::max(0.0, slope.dot(fit.quadratic().curvature.llt().solve(slope))));
  if (!std::isfinite(heat.sigma_W) || std::abs(heat.mean_W) < sure_sigmas * heat.sigma_W) return std::nullopt;
  return heat;
}

}  // namespace zerodrift::diagnosis::answer
