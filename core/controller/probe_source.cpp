#include "core/controller/probe_source.h"

#include <cmath>
#include <limits>

namespace zerodrift::controller {
namespace {

constexpr double smallest_sigma_um =
    0.05;  // resolution of an eddy-current probe; repeated equal readings are not exact
constexpr std::array<std::size_t, 3> nose_probe = {0, 2, 4};  // X1, Y1, Z of X1 X2 Y1 Y2 Z

}  // namespace

Result<ProbeErrorSource::Nose> ProbeErrorSource::read_nose(const TaskContext& context) {
  std::array<double, 3> sum{};
  std::array<double, 3> squares{};
  for (int i = 0; i < m_readings; ++i) {
    if (context.cancelled()) return fail(ErrorCode::cancelled);
    ZD_TRY(const RegisterValues values, m_machine.read_values({"probes_valid", "probe_um"}));
    if (values.at("probes_valid").front() != 1.0) return Nose{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double value = values.at("probe_um").at(nose_probe[axis]);
      sum[axis] += value;
      squares[axis] += value * value;
    }
  }
  Nose nose;
  nose.valid = true;
  const double n = m_readings;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    nose.mean_um[axis] = sum[axis] / n;
    const double variance = n > 1 ? std::max(0.0, (squares[axis] - sum[axis] * sum[axis] / n) / (n - 1)) : 0.0;
    nose.sigma_um[axis] = std::max(smallest_sigma_um, std::sqrt(variance / n));
  }
  return nose;
}

Status ProbeErrorSource::take_zero(const acquisition::Stand& stand, const TaskContext& context) {
  ZD_TRY(const Nose nose, read_nose(context));
  if (!nose.valid) {
    return fail(ErrorCode::machine_not_ready,
                {{"what", "measuring with probes"}, {"reason", "the nose is not at the probe nest"}});
  }
  ZD_CHECK(stand.still());
  m_zero_um = nose.mean_um;
  return {};
}

Result<acquisition::ErrorSample> ProbeErrorSource::measure(const acquisition::Stand& /*stand*/,
                                                           const TaskContext& context) {
  ZD_TRY(const Nose nose, read_nose(context));
  acquisition::ErrorSample sample{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double missing = std::numeric_limits<double>::quiet_NaN();
    const double error_um = nose.mean_um[axis] - m_zero_um[axis];
    sample.error_um[axis] = nose.valid && std::isfinite(error_um) ? error_um : missing;
    sample.sigma_um[axis] = nose.valid ? nose.sigma_um[axis] : missing;
  }
  if (!nose.valid) sample.problems.emplace_back("the nose is not at the probe nest");
  return sample;
}

}  // namespace zerodrift::controller
