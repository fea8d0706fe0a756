#pragma once
// How strong a hidden effect is: rms of one channel, in widths of that sensor's noise. Generators ask their own
// simulators alone; neither core/physics nor core/diagnosis has a part in it.

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string_view>

namespace zerodrift::proof {

inline constexpr double least_strength = 2.5;

/// How strong a generator's hidden effects are. `raw`: their change of a noise-free recording, everything else equal,
/// reaches the least strength. `shown`: and when the machine's ordinary numbers have been re-fitted without them, half
/// a noise width remains. `left`: all of the least strength remains.
enum class StrengthRule { raw, shown, left };
inline constexpr double least_left(StrengthRule rule) {
  return rule == StrengthRule::raw ? 0.0 : rule == StrengthRule::shown ? 0.5 : least_strength;
}
std::string_view name_of(StrengthRule rule);
std::optional<StrengthRule> strength_rule_from(std::string_view name);

/// Noise-free readings (a row a sample, a column a channel, in widths of that channel's noise) of a machine without the
/// effect whose ordinary numbers are off by `z`, in tolerances. Called from several threads at once.
using Rival = std::function<Eigen::MatrixXd(const Eigen::VectorXd& z)>;

/// d readings / dz at z = 0 by one-sided differences, a thread each: a column a number, the channels one below the
/// other.
Eigen::MatrixXd sensitivities_of(const Rival& rival, int count, const Eigen::MatrixXd& at_zero);

/// What is left of `seen` after the rival, with `at_zero` for z = 0, has been fitted to it: least squares over all
/// channels together, the tolerances as priors. `slopes` start the fit, which corrects them by every run it makes.
Eigen::MatrixXd left_after_refit(const Eigen::MatrixXd& seen, const Rival& rival, const Eigen::MatrixXd& at_zero,
                                 Eigen::MatrixXd slopes);

/// The largest rms of a column.
double largest_rms(const Eigen::MatrixXd& change);

}  // namespace zerodrift::proof
