#include "app/machine/faults.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace zerodrift::machine {
namespace {

using Kind = controller::ReplyFault::Kind;

struct ReplyEntry {
  std::string_view name;
  Kind kind;
  int delay_ms;
  unsigned every;  // sporadic: one request in so many; rarer where each costs the host a timeout
};
constexpr std::array reply_entries{
    ReplyEntry{"busy", Kind::busy, 0, 10},
    ReplyEntry{"late", Kind::late, 1500, 50},
    ReplyEntry{"wrong-transaction", Kind::wrong_transaction, 0, 25},
    ReplyEntry{"truncated", Kind::truncated, 0, 50},
    ReplyEntry{"drop", Kind::drop, 0, 25},
    ReplyEntry{"bytewise", Kind::bytewise, 1, 10},
};
constexpr std::array<std::string_view, 5> other_names{"stuck-sensor", "dead-sensor", "camera-freeze", "camera-occluded",
                                                      "mark-occluded"};
constexpr double spell_period_s = 1800.0;
constexpr double spell_start_s = 1500.0;

const ReplyEntry* reply_entry(const std::string& name) {
  const auto* at = std::find_if(reply_entries.begin(), reply_entries.end(),
                                [&](const ReplyEntry& entry) { return entry.name == name; });
  return at == reply_entries.end() ? nullptr : at;
}

std::string fault_names() {
  std::string names;
  for (const ReplyEntry& entry : reply_entries) names += std::string(entry.name) + ", ";
  for (const std::string_view name : other_names) names += std::string(name) + ", ";
  return names + "each also with :always";
}

}  // namespace

Result<Fault> parse_fault(const std::string& text) {
  Fault fault;
  const auto colon = text.find(':');
  fault.name = text.substr(0, colon);
  const std::string suffix = colon == std::string::npos ? "" : text.substr(colon + 1);
  const bool known = reply_entry(fault.name) != nullptr ||
                     std::find(other_names.begin(), other_names.end(), fault.name) != other_names.end();
  if (!known || (colon != std::string::npos && suffix != "always")) {
    return fail(ErrorCode::bad_argument, {{"what", "--fault"}, {"found", text}, {"expected", fault_names()}});
  }
  fault.always = suffix == "always";
  return fault;
}

controller::ReplyFault ReplyFaults::next() {
  const unsigned request = ++m_requests;
  for (const Fault& fault : m_faults) {
    const ReplyEntry* entry = reply_entry(fault.name);
    if (entry == nullptr || (!fault.always && request % entry->every != 0)) continue;
    return {entry->kind, std::chrono::milliseconds(entry->delay_ms)};
  }
  return {};
}

SensorFault sensor_fault(const std::vector<Fault>& faults) {
  for (const Fault& fault : faults) {
    if (fault.name == "stuck-sensor") return {SensorFault::Kind::stuck, fault.always, 1};
    if (fault.name == "dead-sensor") return {SensorFault::Kind::dead, fault.always, 3};
  }
  return {};
}

CameraFault camera_fault(const std::vector<Fault>& faults, double machine_time_s, std::optional<double> first_turn_s) {
  for (const Fault& fault : faults) {
    CameraFault camera;
    if (fault.name == "camera-freeze") camera.kind = CameraFault::Kind::freeze;
    if (fault.name == "camera-occluded") camera.kind = CameraFault::Kind::occluded;
    if (fault.name == "mark-occluded") camera.kind = CameraFault::Kind::mark_occluded;
    const bool chip = camera.kind == CameraFault::Kind::occluded || camera.kind == CameraFault::Kind::mark_occluded;
    // A chip that lay there while the template was taken would be a part of the target and hide nothing.
    if (camera.kind == CameraFault::Kind::none || (chip && !first_turn_s)) continue;
    const double since_s = chip ? *first_turn_s : 0.0;
    if (fault.always) {
      if (chip) camera.from_machine_s = since_s + spell_start_s;
      return camera;
    }
    const double period_begin = since_s + std::floor((machine_time_s - since_s) / spell_period_s) * spell_period_s;
    camera.from_machine_s = period_begin + spell_start_s;
    camera.until_machine_s = period_begin + spell_period_s;
    return camera;
  }
  return {};
}

}  // namespace zerodrift::machine
