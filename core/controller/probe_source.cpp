#include "core/controller/probe_source.h"

#include <cmath>
#include <limits>
#include <string>

namespace zerodrift::controller {
namespace {

constexpr double smallest_sigma_um =
    0.05;  // resolution of an eddy-current probe; repeated equal readings are not exact
constexpr std::array<std::size_t, 3> nose_probe = {0, 2, 4};  // X1, Y1, Z of X1 X2 Y1 Y2 Z

constexpr double patience_s = 10.0;  // host time, for an amplifier that is asked seldom
constexpr double pause_s = 0.005;

}  // namespace

/// The next reading after `at`, which becomes its time: one reading twice has no scatter. Nothing: no probe is read.
Result<std::optional<std::array<double, 5>>> ProbeErrorSource::newer_than(Seconds& at, const TaskContext& context) {
  const Seconds end = host_clock().steady() + Seconds(patience_s);
  for (;;) {
    ZD_TRY(const acquisition::MachineSample sample, m_machine.read());
    if (!sample.probes_um) return std::nullopt;
    if (sample.probes_at > at) {
      at = sample.probes_at;
      return sample.probes_um;
    }
    if (host_clock().steady() > end) {
      const std::string timeout_ms = std::to_string(static_cast<int>(1000.0 * patience_s));
      return fail(ErrorCode::machine_silent, {{"what", "displacement probes"}, {"timeout_ms", timeout_ms}});
    }
    if (!host_clock().wait_for(Seconds(pause_s), context.stop)) return fail(ErrorCode::cancelled);
  }
}

Result<ProbeErrorSource::Nose> ProbeErrorSource::read_nose(Seconds since, const TaskContext& context) {
  std::array<double, 3> sum{};
  std::array<double, 3> squares{};
  for (int i = 0; i < m_readings; ++i) {
    if (context.cancelled()) return fail(ErrorCode::cancelled);
    ZD_TRY(const auto probes_um, newer_than(since, context));
    if (!probes_um) return Nose{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double value = probes_um->at(nose_probe[axis]);
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
  ZD_TRY(const Nose nose, read_nose(stand.since, context));
  if (!nose.valid) {
    return fail(ErrorCode::machine_not_ready,
                {{"what", "measuring with probes"}, {"reason", "the nose is not at the probe nest"}});
  }
  ZD_CHECK(stand.still());
  m_zero_um = nose.mean_um;
  return {};
}

Result<acquisition::ErrorSample> ProbeErrorSource::measure(const acquisition::Stand& stand,
                                                           const TaskContext& context) {
  ZD_TRY(const Nose nose, read_nose(stand.since, context));
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
