#include "core/controller/device_readings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <limits>
#include <map>

namespace zerodrift::controller {
namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double longest_pause_s = 30.0;  // between two tries of a device that does not answer
constexpr double first_patience_s = 1.0;  // beyond its time-out

std::string line_of(const DeviceProfile& device) {
  const bool serial = device.kind == DeviceKind::modbus && device.modbus.kind == LinkKind::rtu;
  return serial ? "serial " + device.modbus.device : "device " + device.id;
}

}  // namespace

struct DeviceReadings::Entry {
  DeviceProfile profile;
  std::vector<std::string> signals;
  std::unique_ptr<Device> device;
  Seconds due{0.0};
  double pause_s = 0.0;  // after a fault; grows

  mutable std::mutex mutex;  // for what follows
  std::condition_variable asked;
  std::vector<Reading> readings;
  Seconds answered{0.0};
  DeviceState state;
  double age_sum_s = 0.0;
  long ages = 0;
};

struct DeviceReadings::Line {
  std::vector<Entry*> entries;
  std::jthread thread;
};

Result<std::shared_ptr<DeviceReadings>> DeviceReadings::open(const Profile& profile) {
  std::map<std::string, std::vector<std::string>> wanted;  // device -> signals
  const auto want = [&](const SignalSource& source) {
    if (!source.device.empty()) wanted[source.device].push_back(source.signal);
  };
  auto out = std::shared_ptr<DeviceReadings>(new DeviceReadings);
  for (const SensorProfile& sensor : profile.sensors) {
    out->m_temperatures.push_back(sensor.source);
    want(sensor.source);
  }
  out->m_sources = profile.sources;
  const SignalSources& sources = profile.sources;
  for (const auto& one : {sources.ambient, sources.speed, sources.load, sources.coolant, sources.compensation_state}) {
    if (one) want(*one);
  }
  for (const auto& [axis, source] : sources.positions) want(source);
  for (const SignalSource& probe : sources.probes) want(probe);
  if (wanted.empty()) return std::shared_ptr<DeviceReadings>();

  std::map<std::string, Line*> lines;
  for (const DeviceProfile& device : profile.devices) {
    const auto names = wanted.find(device.id);
    if (names == wanted.end()) continue;
    auto entry = std::make_unique<Entry>();
    entry->profile = device;
    entry->signals = names->second;
    entry->state.id = device.id;
    entry->readings.assign(names->second.size(), Reading{nan_value, Seconds(0.0)});
    ZD_TRY(entry->device, open_device(device, entry->signals));
    Line*& line = lines[line_of(device)];
    if (line == nullptr) line = out->m_lines.emplace_back(std::make_unique<Line>()).get();
    line->entries.push_back(entry.get());
    out->m_entries.push_back(std::move(entry));
  }
  for (const auto& line : out->m_lines) {
    line->thread = std::jthread([work = line.get()](const std::stop_token& stop) { ask_in_turn(*work, stop); });
  }
  return out;
}

DeviceReadings::~DeviceReadings() {
  for (const auto& line : m_lines) line->thread.request_stop();
  m_lines.clear();
}

/// The one that has waited longest is next, so that none is passed over on a busy line.
void DeviceReadings::ask_in_turn(Line& line, const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    Entry& next = **std::min_element(line.entries.begin(), line.entries.end(),
                                     [](const Entry* a, const Entry* b) { return a->due < b->due; });
    if (!host_clock().wait_until(next.due, stop)) return;
    ask(next);
  }
}

void DeviceReadings::ask(Entry& entry) {
  const Seconds begun = host_clock().steady();
  const auto answer = entry.device->read();
  const Seconds ended = host_clock().steady();
  const double period_s = entry.profile.poll_period_s;
  entry.pause_s = answer ? 0.0 : std::clamp(2.0 * entry.pause_s, period_s, std::max(period_s, longest_pause_s));
  // A device that is asked more often than it can answer is not asked to make up for it.
  entry.due = answer ? std::max(begun + Seconds(period_s), ended) : ended + Seconds(entry.pause_s);

  const std::lock_guard lock(entry.mutex);
  entry.state.remarks = entry.device->remarks();
  if (answer) {
    entry.readings = *answer;
    entry.answered = ended;
    entry.state.round_trip_s = (ended - begun).count();
    ++entry.state.rounds;
    entry.state.fault.reset();
  } else {
    ++entry.state.faults;
    entry.state.fault = answer.error();
    if (const auto what = entry.state.fault->context.find("what"); what != entry.state.fault->context.end()) {
      what->second = entry.profile.id + ": " + what->second;
    }
  }
  entry.asked.notify_all();
}

void DeviceReadings::wait_for_first() {
  for (const auto& entry : m_entries) {
    std::unique_lock lock(entry->mutex);
    const Seconds patience(first_patience_s + entry->profile.timeout_ms / 1000.0);
    entry->asked.wait_for(lock, patience, [&] { return entry->state.rounds + entry->state.faults > 0; });
  }
}

/// NaN where there is none, or none that still counts.
Reading DeviceReadings::latest(const SignalSource& source) const {
  for (const auto& entry : m_entries) {
    if (entry->profile.id != source.device) continue;
    const auto at = std::find(entry->signals.begin(), entry->signals.end(), source.signal);
    const std::lock_guard lock(entry->mutex);
    Reading reading = entry->readings[static_cast<std::size_t>(at - entry->signals.begin())];
    const double age_s = (host_clock().steady() - reading.at).count();
    if (age_s > entry->profile.stale_after_s) reading.value = nan_value;
    if (std::isfinite(reading.value)) {
      ++entry->ages;
      entry->age_sum_s += age_s;
      entry->state.largest_age_s = std::max(entry->state.largest_age_s, age_s);
    }
    return reading;
  }
  return {nan_value, Seconds(0.0)};
}

void DeviceReadings::put_into(acquisition::MachineSample& sample) const {
  const auto put = [&](const std::optional<SignalSource>& source, double& value) {
    if (source) value = latest(*source).value;
  };
  put(m_sources.ambient, sample.ambient_C);
  put(m_sources.speed, sample.spindle_rpm);
  put(m_sources.load, sample.spindle_load_W);
  for (const auto& [axis, source] : m_sources.positions) {
    const double position_mm = latest(source).value;
    sample.axes.erase(axis);
    if (std::isfinite(position_mm)) sample.axes[axis] = position_mm;
  }
  // A switch that cannot be read stays as the control says it.
  const auto put_flag = [&](const std::optional<SignalSource>& source, bool& flag) {
    double value = nan_value;
    put(source, value);
    if (std::isfinite(value)) flag = value != 0.0;
  };
  put_flag(m_sources.coolant, sample.coolant_on);
  put_flag(m_sources.compensation_state, sample.compensation_on);
  sample.temperature_C.resize(m_temperatures.size(), nan_value);
  sample.temperature_at.resize(m_temperatures.size(), host_clock().steady());
  for (std::size_t i = 0; i < m_temperatures.size(); ++i) {
    if (m_temperatures[i].device.empty()) continue;
    const Reading reading = latest(m_temperatures[i]);
    sample.temperature_C[i] = reading.value;
    sample.temperature_at[i] = reading.at;
  }
  if (!m_sources.probes.empty()) {
    sample.probes_um.emplace();
    sample.probes_at = Seconds(std::numeric_limits<double>::max());
    sample.probes_um->fill(nan_value);
    for (std::size_t i = 0; i < sample.probes_um->size(); ++i) {
      if (m_sources.probes[i].device.empty()) continue;  // a nest need not have all five
      const Reading reading = latest(m_sources.probes[i]);
      (*sample.probes_um)[i] = reading.value;
      sample.probes_at = std::min(sample.probes_at, reading.at);
    }
  }
  for (const auto& entry : m_entries) {
    const std::lock_guard lock(entry->mutex);
    const bool gone = (host_clock().steady() - entry->answered).count() > entry->profile.stale_after_s;
    if (entry->state.fault && gone) sample.device_faults[entry->profile.id] = *entry->state.fault;
  }
}

std::vector<DeviceState> DeviceReadings::states() const {
  std::vector<DeviceState> out;
  for (const auto& entry : m_entries) {
    const std::lock_guard lock(entry->mutex);
    DeviceState state = entry->state;
    if (state.rounds > 0) state.age_s = (host_clock().steady() - entry->answered).count();
    if (entry->ages > 0) state.mean_age_s = entry->age_sum_s / static_cast<double>(entry->ages);
    out.push_back(std::move(state));
  }
  return out;
}

std::vector<std::string> DeviceReadings::remarks() const {
  std::vector<std::string> out;
  for (const DeviceState& state : states()) {
    if (state.faults > 0) {
      out.push_back(
          fmt::format("{}: {} of {} rounds were not answered", state.id, state.faults, state.rounds + state.faults));
    }
    for (const std::string& remark : state.remarks) out.push_back(state.id + ": " + remark);
  }
  return out;
}

}  // namespace zerodrift::controller
