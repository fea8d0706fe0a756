#include "core/acquisition/run_row.h"

#include <limits>

namespace zerodrift::acquisition {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();
constexpr const char* axes[] = {"X", "Y", "Z"};

}  // namespace

RowLayout::RowLayout(const MachineIdentity& identity, const MachineSample& first, bool with_compensation)
    : m_sensors(identity.sensors.size()), m_with_compensation(with_compensation) {
  m_channels.emplace_back("spindle_rpm");
  for (const auto& [axis, feed] : first.feed_mm_min) {
    m_feed_axes.push_back(axis);
    m_channels.push_back("feed_" + axis + "_mm_min");
  }
  m_channels.insert(m_channels.end(), {"coolant_on", "spindle_load_W", "ambient_C"});
  for (const SensorInfo& sensor : identity.sensors) m_channels.push_back(sensor.channel);
  for (const char* axis : axes) m_channels.push_back(std::string("d") + axis + "_um");
  for (const char* axis : axes) m_channels.push_back(std::string("sigma_") + axis + "_nm");
  if (!with_compensation) return;
  m_channels.emplace_back("compensation_on");
  for (const char* axis : axes) m_channels.push_back(std::string("applied_") + axis + "_nm");
}

std::vector<double> RowLayout::row(const MachineSample& sample, const ErrorSample* error) const {
  std::vector<double> values;
  values.reserve(m_channels.size());
  values.push_back(sample.spindle_rpm);
  for (const std::string& axis : m_feed_axes) {
    const auto at = sample.feed_mm_min.find(axis);
    values.push_back(at == sample.feed_mm_min.end() ? missing : at->second);
  }
  values.insert(values.end(), {sample.coolant_on ? 1.0 : 0.0, sample.spindle_load_W, sample.ambient_C});
  for (std::size_t i = 0; i < m_sensors; ++i) {
    values.push_back(i < sample.temperature_C.size() ? sample.temperature_C[i] : missing);
  }
  for (std::size_t i = 0; i < 3; ++i) values.push_back(error == nullptr ? missing : error->error_um[i]);
  for (std::size_t i = 0; i < 3; ++i) values.push_back(error == nullptr ? missing : 1000.0 * error->sigma_um[i]);
  if (m_with_compensation) {
    values.push_back(sample.compensation_on ? 1.0 : 0.0);
    for (const double applied : sample.applied_um) values.push_back(1000.0 * applied);
  }
  return values;
}

MachineSample between(const MachineSample& before, const MachineSample& after, double part) {
  const auto at = [part](double a, double b) { return a + part * (b - a); };
  MachineSample middle = after;
  middle.machine_time_s = at(before.machine_time_s, after.machine_time_s);
  middle.ambient_C = at(before.ambient_C, after.ambient_C);
  for (std::size_t i = 0; i < std::min(before.temperature_C.size(), after.temperature_C.size()); ++i) {
    middle.temperature_C[i] = at(before.temperature_C[i], after.temperature_C[i]);
  }
  for (std::size_t i = 0; i < 3; ++i) middle.applied_um[i] = at(before.applied_um[i], after.applied_um[i]);
  return middle;
}

}  // namespace zerodrift::acquisition
