#include "core/controller/modbus_machine.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <deque>
#include <limits>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/acquisition/machine_fault.h"
#include "core/base/json.h"
#include "core/base/resources.h"
#include "core/compensation/interlock.h"
#include "core/controller/controller_claim.h"
#include "core/controller/device_readings.h"

namespace zerodrift::controller {
namespace {

using acquisition::MachineIdentity;
using acquisition::MachineSample;

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double move_timeout_machine_s = 120.0;
constexpr double ramp_timeout_machine_s = 300.0;

// Capability bits of the identity block.
constexpr int can_host_offset = 1 << 0;
constexpr int can_table = 1 << 1;
constexpr int has_probes = 1 << 3;

// State bits.
constexpr int state_cycle = 1 << 0;
constexpr int state_moving = 1 << 1;
constexpr int state_referenced = 1 << 2;
constexpr int state_alarm = 1 << 3;

void pause_ms(int milliseconds) {
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}

std::chrono::steady_clock::time_point after(double host_s) {
  return std::chrono::steady_clock::now() +
         std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(host_s));
}

double first_of(const RegisterValues& values, const std::string& name, double fallback) {
  const auto at = values.find(name);
  return at == values.end() || at->second.empty() ? fallback : at->second.front();
}

int bits_of(const RegisterValues& values, const std::string& name, int fallback) {
  const double value = first_of(values, name, fallback);
  return std::isfinite(value) ? static_cast<int>(value) : fallback;
}

Error not_fitting(const std::string& what, const std::string& found, const std::string& expected) {
  return Error{ErrorCode::machine_unsupported, {{"what", what}, {"found", found}, {"expected", expected}}};
}

/// What a sample is made of; a map need not have all of it.
const std::vector<std::string> sample_names = {
    "clock_s",        "state",         "compensation_state", "coolant_state",  "position_X_mm",
    "position_Y_mm",  "position_Z_mm", "position_A_deg",     "position_C_deg", "spindle_rpm",
    "spindle_load_W", "feed_X_mm_min", "feed_Y_mm_min",      "feed_Z_mm_min",  "applied_um",
    "ambient_C",      "temperature_C", "probes_valid",       "probe_um"};

std::vector<std::string> present(const RegisterMap& map, const std::vector<std::string>& names) {
  std::vector<std::string> out;
  for (const auto& name : names) {
    if (map.find(name) != nullptr) out.push_back(name);
  }
  return out;
}

bool refuses(const Error& error, const char* exception) {
  return error.code == ErrorCode::machine_exception && error.context.at("exception") == exception;
}
bool refuses_address(const Error& error) {
  return refuses(error, "2");
}
bool refuses_count(const Error& error) {
  return refuses(error, "3");
}

}  // namespace

Result<RegisterMap> map_of(const Profile& profile, std::vector<std::string>* warnings) {
  const std::string& name = profile.controller.register_map;
  if (profile.controller.own_map) return register_map_from_json(*profile.controller.own_map, name, warnings);
  if (!profile.of_job) return load_register_map(name, std::filesystem::path(profile.file).parent_path(), warnings);
  ZD_TRY(const auto path, find_resource("register_maps/" + name + ".json"));
  ZD_TRY(const nlohmann::json document, read_json_file(path));
  return register_map_from_json(document, path.string(), warnings);
}

Result<std::unique_ptr<ModbusMachine>> ModbusMachine::open(const Profile& profile, access::Permit permit) {
  if (profile.manual) {
    return fail(ErrorCode::machine_unsupported,
                {{"what", "the link to the control"}, {"found", "a manual control"}, {"expected", "Modbus"}});
  }
  ZD_TRY(RegisterMap map, map_of(profile));
  auto machine = std::make_unique<ModbusMachine>(profile, std::move(map), permit);
  if (permit.may_write()) {
    ZD_TRY(machine->m_claim, ControllerClaim::take(machine->m_link.settings()));
  }
  ZD_TRY(machine->m_devices, DeviceReadings::open(profile));
  return machine;
}

ModbusMachine::~ModbusMachine() = default;

ModbusMachine::ModbusMachine(Profile profile, RegisterMap map, access::Permit permit)
    : m_profile(std::move(profile)), m_map(std::move(map)), m_permit(permit), m_link([this] {
        ControllerSettings settings = m_profile.controller;
        if (m_map.unit) settings.unit = *m_map.unit;
        return settings;
      }()) {}

double ModbusMachine::host_seconds(double machine_seconds) const {
  return std::max(machine_seconds / m_profile.time_factor, 5.0);
}

Result<std::vector<std::uint16_t>> ModbusMachine::read_span(const ReadSpan& span, const std::string& what) {
  std::vector<std::uint16_t> words;
  while (static_cast<int>(words.size()) < span.count) {
    const int done = static_cast<int>(words.size());
    const int count = std::min(m_map.max_read, span.count - done);
    const auto part = m_link.read(span.space, span.address + done, count, what);
    if (!part && refuses_count(part.error()) && count > 1) {
      // A device that answers for fewer registers a request; even, so that no value of two words is read in halves.
      m_map.max_read = std::max(1, count / 4 * 2);
      continue;
    }
    if (!part) return fail(part.error());
    words.insert(words.end(), part->begin(), part->end());
  }
  return words;
}

Result<RegisterValues> ModbusMachine::read_values(const std::vector<std::string>& names) {
  std::vector<const Register*> entries;
  for (const auto& name : names) {
    ZD_CHECK(m_map.require(name).map([](const Register&) {}));
    entries.push_back(m_map.find(name));
  }
  RegisterMap strict;
  strict.max_read = m_map.max_read;
  RegisterValues values;
  for (const ReadSpan& span : plan_reads(m_single_reads ? strict : m_map, entries)) {
    const std::string what = names.size() == 1 ? names.front() : fmt::format("registers from {}", span.address);
    const int most = m_map.max_read;
    auto words = read_span(span, what);
    if (m_map.max_read < most) return read_values(names);  // planned anew: no value is read in two halves
    // Asked again: one refusal may be of a request that was spoilt on its way, a gap is refused each time.
    if (!words && refuses_address(words.error())) words = read_span(span, what);
    if (!words) {
      if (!refuses_address(words.error()) || m_single_reads || names.size() == 1) return fail(words.error());
      m_single_reads = true;  // a device that answers only for the registers it names
      return read_values(names);
    }
    for (const Register* entry : entries) {
      const int from = entry->address - span.address;
      if (entry->space != span.space || from < 0 || from + entry->words() > span.count) continue;
      const auto part =
          std::span(*words).subspan(static_cast<std::size_t>(from), static_cast<std::size_t>(entry->words()));
      auto& list = values[entry->name];
      list.clear();
      for (int i = 0; i < entry->count; ++i) list.push_back(decode(*entry, part, i));
    }
  }
  return values;
}

Result<double> ModbusMachine::read_value(const std::string& name) {
  ZD_TRY(const RegisterValues values, read_values({name}));
  return values.at(name).front();
}

Status ModbusMachine::write_values(const std::string& name, const std::vector<double>& values, Retry retry) {
  ZD_CHECK(m_permit.check("Writing " + name));
  ZD_TRY(const Register entry, m_map.require(name));
  if (static_cast<int>(values.size()) > entry.count) {
    return fail(
        not_fitting("the number of values of " + name, std::to_string(entry.count), std::to_string(values.size())));
  }
  std::vector<std::uint16_t> words;
  for (const double value : values) {
    ZD_TRY(const auto part, encode(entry, value));
    words.insert(words.end(), part.begin(), part.end());
  }
  return m_link.write(entry.address, words, name, retry);
}

Result<std::vector<std::uint16_t>> ModbusMachine::read_words(const std::string& name, int count) {
  ZD_TRY(const Register entry, m_map.require(name));
  if (count > entry.words()) {
    return fail(ErrorCode::limit_exceeded, {{"what", "number of registers of " + name},
                                            {"found", std::to_string(count)},
                                            {"limit", std::to_string(entry.words())}});
  }
  return read_span({entry.space, entry.address, count}, name);
}

Status ModbusMachine::write_words(const std::string& name, int offset, std::span<const std::uint16_t> words) {
  ZD_CHECK(m_permit.check("Writing " + name));
  ZD_TRY(const Register entry, m_map.require(name));
  const auto chunk = static_cast<std::size_t>(std::min(m_profile.controller.chunk_registers, m_map.max_write));
  for (std::size_t done = 0; done < words.size(); done += chunk) {
    const auto part = words.subspan(done, std::min(chunk, words.size() - done));
    ZD_CHECK(m_link.write(entry.address + offset + static_cast<int>(done), part, name));
  }
  return {};
}

Result<MachineIdentity> ModbusMachine::identify() {
  MachineIdentity identity;
  identity.name = m_profile.name;
  ZD_TRY(const RegisterValues values, read_values(present(m_map, {"magic", "map_version", "capabilities",
                                                                  "table_capacity", "serial", "sensor_count"})));
  if (m_map.magic) {
    const int magic = bits_of(values, "magic", -1);
    if (magic != *m_map.magic) {
      return fail(not_fitting("the identity register", fmt::format("0x{:04X}", static_cast<unsigned>(magic)),
                              fmt::format("0x{:04X}", static_cast<unsigned>(*m_map.magic))));
    }
  }
  const double serial = first_of(values, "serial", 0.0);
  identity.serial = std::isfinite(serial) ? static_cast<std::uint32_t>(serial) : 0;
  identity.map_version = bits_of(values, "map_version", 0);
  if (m_map.magic && identity.map_version != 1) {
    return fail(not_fitting("the version of the register map", std::to_string(identity.map_version), "1"));
  }
  // A map without a capability register says by its entries what the controller can do.
  const bool listed = m_map.find("capabilities") != nullptr;
  const int bits = bits_of(values, "capabilities", 0);
  const auto able = [&](int bit, const char* entry) {
    return listed ? (bits & bit) != 0 : m_map.find(entry) != nullptr;
  };
  const Register* offset = m_map.find("host_offset_um");
  identity.accepts_host_offset = able(can_host_offset, "host_offset_um") && offset != nullptr && offset->count == 3;
  identity.accepts_table = able(can_table, "table_commit") && m_map.find("table_commit") != nullptr;
  identity.has_probes = able(has_probes, "probe_um") && m_map.find("probe_um") != nullptr;
  const Register* staging = m_map.find("table_staging");
  identity.table_capacity_registers = bits_of(values, "table_capacity", staging == nullptr ? 0 : staging->words());
  if (staging != nullptr) {
    identity.table_capacity_registers = std::min(identity.table_capacity_registers, staging->words());
  }
  const Register* temperatures = m_map.find("temperature_C");
  const int available = bits_of(values, "sensor_count", temperatures == nullptr ? 0 : temperatures->count);
  for (int number = static_cast<int>(m_profile.sensors.size()); number > available; --number) {
    if (!m_profile.sensors[static_cast<std::size_t>(number - 1)].source.device.empty()) continue;
    return fail(not_fitting("the number of temperature sensors", std::to_string(available),
                            fmt::format("the {} of the profile", number)));
  }
  if (!m_profile.sources.probes.empty()) identity.has_probes = true;
  if (m_devices) m_devices->wait_for_first();
  for (const auto& sensor : m_profile.sensors) {
    identity.sensors.push_back({sensor.channel, sensor.label, sensor.place, sensor.accuracy_C});
  }
  return identity;
}

Result<MachineSample> ModbusMachine::read() {
  ZD_TRY(const RegisterValues values, read_values(present(m_map, sample_names)));
  MachineSample sample;
  sample.machine_time_s = first_of(values, "clock_s", nan_value);
  for (const char* axis : {"X", "Y", "Z", "A", "C"}) {
    const std::string name(axis);
    const double position = first_of(values, "position_" + name + (name < "D" ? "_deg" : "_mm"), nan_value);
    if (std::isfinite(position)) sample.axes[name] = position;
    const double feed = first_of(values, "feed_" + name + "_mm_min", nan_value);
    if (std::isfinite(feed)) sample.feed_mm_min[name] = feed;
  }
  sample.spindle_rpm = first_of(values, "spindle_rpm", nan_value);
  sample.spindle_load_W = first_of(values, "spindle_load_W", nan_value);
  sample.coolant_on = bits_of(values, "coolant_state", 0) != 0;
  sample.compensation_on = bits_of(values, "compensation_state", 0) != 0;
  const int state = bits_of(values, "state", state_referenced);
  sample.moving = (state & state_moving) != 0;
  sample.cycling = (state & state_cycle) != 0;
  sample.referenced = (state & state_referenced) != 0;
  sample.alarm = (state & state_alarm) != 0;
  sample.ambient_C = first_of(values, "ambient_C", nan_value);
  sample.temperature_C.assign(m_profile.sensors.size(), nan_value);
  if (const auto at = values.find("temperature_C"); at != values.end()) {
    const std::size_t count = std::min(at->second.size(), sample.temperature_C.size());
    std::copy_n(at->second.begin(), count, sample.temperature_C.begin());
  }
  if (const auto at = values.find("applied_um"); at != values.end()) {
    std::copy_n(at->second.begin(), std::min<std::size_t>(3, at->second.size()), sample.applied_um.begin());
  }
  if (const auto at = values.find("probe_um"); at != values.end() && bits_of(values, "probes_valid", 1) != 0) {
    sample.probes_um.emplace();
    std::copy_n(at->second.begin(), std::min<std::size_t>(5, at->second.size()), sample.probes_um->begin());
  }
  sample.probes_at = host_clock().steady();
  if (m_devices) m_devices->put_into(sample);
  return sample;
}

Status ModbusMachine::command(double spindle_rpm, bool coolant_on, bool path_cycle) {
  ZD_CHECK(write_values("command_spindle_rpm", {spindle_rpm}));
  ZD_CHECK(write_values("command_coolant", {coolant_on ? 1.0 : 0.0}));
  return write_values("command_cycle", {path_cycle ? 1.0 : 0.0});
}

Status ModbusMachine::wait_until_zero(const std::string& name, double host_s, const std::string& what) {
  const auto end = after(host_s);
  for (;;) {
    ZD_TRY(const double value, read_value(name));
    if (value == 0.0) return {};
    if (std::chrono::steady_clock::now() > end) {
      return fail(ErrorCode::machine_not_ready,
                  {{"what", what}, {"reason", fmt::format("not done within {:.0f} s", host_s)}});
    }
    pause_ms(10);
  }
}

Status ModbusMachine::move_to(const std::map<std::string, double>& target_mm) {
  ZD_TRY(const RegisterValues now,
         read_values(present(m_map, {"position_X_mm", "position_Y_mm", "position_Z_mm", "state"})));
  if ((bits_of(now, "state", state_referenced) & state_alarm) != 0) {
    return fail(ErrorCode::machine_not_ready, {{"what", "a move"}, {"reason", "an alarm is on"}});
  }
  std::vector<double> target;
  for (const char* axis : {"X", "Y", "Z"}) {
    const auto at = target_mm.find(axis);
    target.push_back(at != target_mm.end() ? at->second : first_of(now, fmt::format("position_{}_mm", axis), 0.0));
  }
  ZD_CHECK(write_values("target_mm", target));
  ZD_CHECK(write_values("move", {1.0}));
  return wait_until_zero("move", host_seconds(move_timeout_machine_s), "a move");
}

Result<bool> ModbusMachine::compensation_on() {
  ZD_TRY(const double state, read_value("compensation_state"));
  return state != 0.0;
}

Status ModbusMachine::switch_compensation(bool on) {
  const auto end = after(host_seconds(10.0));
  auto command_again = std::chrono::steady_clock::now();
  for (;;) {
    if (std::chrono::steady_clock::now() >= command_again) {
      // After an answer that is missing or unclear, the switch itself is asked before it is commanded again.
      const Status sent = write_values("command_compensation", {on ? 1.0 : 0.0}, Retry::no);
      if (!sent && !acquisition::may_pass(sent.error())) return sent;
      // Once a second: a command that came over spoilt is not waited for in vain.
      command_again = after(sent ? 1.0 : 0.1);
    }
    const auto is_on = compensation_on();
    if (!is_on && !acquisition::may_pass(is_on.error())) return fail(is_on.error());
    if (is_on && *is_on == on) return {};
    if (std::chrono::steady_clock::now() > end) {
      if (!is_on) return fail(is_on.error());
      return fail(ErrorCode::machine_not_ready,
                  {{"what", on ? "compensation on" : "compensation off"}, {"reason", "the switch does not follow"}});
    }
    pause_ms(10);
  }
}

std::vector<std::string> ModbusMachine::remarks() const {
  std::vector<std::string> all;
  for (const auto& [name, count] : health().faults) {
    all.push_back(fmt::format("link: {} {} times, overcome", name, count));
  }
  all.insert(all.end(), health().remarks.begin(), health().remarks.end());
  const auto of_devices = m_devices ? m_devices->remarks() : std::vector<std::string>();
  all.insert(all.end(), of_devices.begin(), of_devices.end());
  return all;
}

Status ModbusMachine::beat() {
  if (m_map.find("host_heartbeat") == nullptr) return {};
  return write_values("host_heartbeat", {static_cast<double>(++m_beat)});
}

Result<double> ModbusMachine::wait_for_ramp(bool on, const std::stop_token& stop) {
  const double slew_s = 2.0 * m_profile.max_um / m_profile.max_um_per_s;
  const auto end = after(host_seconds(std::max(ramp_timeout_machine_s, slew_s)));
  if (m_map.find("table_ramp_percent") != nullptr) {
    for (;;) {
      ZD_TRY(const double percent, read_value("table_ramp_percent"));
      if (on ? percent >= 100.0 : percent <= 0.0) break;
      if (std::chrono::steady_clock::now() > end) return percent;
      if (stop.stop_requested()) return fail(ErrorCode::cancelled);
      pause_ms(20);
    }
  }
  ZD_CHECK(wait_until_applied(end, stop));
  return on ? 100.0 : 0.0;
}

/// The ramp is over before the machine is there: what it applies runs after it at the rate it is limited to. At rest it
/// still follows the noise of its sensors, so a quarter of that rate tells the two apart over a third of a micrometre.
Status ModbusMachine::wait_until_applied(std::chrono::steady_clock::time_point end, const std::stop_token& stop) {
  if (m_map.find("applied_um") == nullptr) return {};
  const double slow_um_s = std::min(0.5, 0.25 * m_profile.max_um_per_s);
  const double machine_s = std::max(1.0, 0.3 / slow_um_s);
  const std::chrono::duration<double> apart(std::max(0.05, machine_s / m_profile.time_factor));
  struct Seen {
    std::chrono::steady_clock::time_point at;
    std::vector<double> applied_um;
  };
  std::deque<Seen> seen;
  while (seen.empty() || seen.back().at < end) {
    if (stop.stop_requested()) return fail(ErrorCode::cancelled);
    const auto now = std::chrono::steady_clock::now();
    ZD_TRY(const RegisterValues values, read_values({"applied_um"}));
    seen.push_back({now, values.at("applied_um")});
    while (seen.size() > 1 && now - seen[1].at >= apart) seen.pop_front();
    const Seen& before = seen.front();
    const double passed_s = std::chrono::duration<double>(now - before.at).count() * m_profile.time_factor;
    double largest_um = 0.0;
    for (std::size_t i = 0; i < before.applied_um.size(); ++i) {
      largest_um = std::max(largest_um, std::abs(seen.back().applied_um[i] - before.applied_um[i]));
    }
    if (now - before.at >= apart && largest_um < slow_um_s * passed_s) return {};
    pause_ms(std::max(10, static_cast<int>(200.0 * apart.count())));
  }
  return {};
}

Status ModbusMachine::set_watchdog(double host_s) {
  if (m_map.find("host_watchdog_s") == nullptr) return {};
  // It counts machine seconds; on a quick machine it must still outlast a few turns of the host.
  const double seconds = std::clamp(std::ceil(host_s * m_profile.time_factor), 10.0, 60000.0);
  ZD_CHECK(write_values("host_watchdog_s", {seconds}));
  m_watchdog_set = true;
  return {};
}

Status ModbusMachine::write_host_offset(const std::array<double, 3>& compensation_um) {
  ZD_TRY(const bool on, compensation_on());
  ZD_CHECK(compensation::allow_offset_write(on));
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::isfinite(compensation_um[i]) && std::abs(compensation_um[i]) <= m_profile.max_um) continue;
    return fail(ErrorCode::limit_exceeded, {{"what", fmt::format("the offset of axis {}", "XYZ"[i])},
                                            {"found", fmt::format("{:.2f} um", compensation_um[i])},
                                            {"limit", fmt::format("{:.0f} um", m_profile.max_um)}});
  }
  if (!m_watchdog_set) ZD_CHECK(set_watchdog(default_watchdog_s));
  ZD_CHECK(beat());
  return write_values("host_offset_um", {compensation_um.begin(), compensation_um.end()});
}

Result<std::array<double, 3>> ModbusMachine::held_offset_um() {
  ZD_TRY(const RegisterValues values, read_values({"host_offset_um"}));
  const auto& held = values.at("host_offset_um");
  return std::array<double, 3>{held.at(0), held.at(1), held.at(2)};
}

Status ModbusMachine::clear_host_offset() {
  return write_values("host_offset_um", {0.0, 0.0, 0.0});
}

}  // namespace zerodrift::controller
