#include "core/controller/profile_signals.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/controller/profile_devices.h"

namespace zerodrift::controller {
namespace {

using nlohmann::json;

// As many readings as page Machine takes to call a sensor stuck.
constexpr int readings_to_vary = 20;
constexpr std::array<const char*, 5> axes = {"X", "Y", "Z", "A", "C"};

struct Quantity {
  const char* key;
  SignalUse use;
  const char* of_control;
};
constexpr std::array<Quantity, 5> quantities = {
    Quantity{"ambient", SignalUse::ambient, "ambient_C"},
    Quantity{"speed", SignalUse::speed, "spindle_rpm"},
    Quantity{"load", SignalUse::load, "spindle_load_W"},
    Quantity{"coolant", SignalUse::coolant, "coolant_state"},
    Quantity{"compensation_state", SignalUse::compensation_state, "compensation_state"},
};

std::string word(const json& object, const char* key) {
  const auto at = object.is_object() ? object.find(key) : object.end();
  return at != object.end() && at->is_string() ? at->get<std::string>() : std::string();
}

const json& part(const json& object, const char* key) {
  static const json nothing;
  const auto at = object.is_object() ? object.find(key) : object.end();
  return at == object.end() ? nothing : *at;
}

SignalSource source_at(const json& entry) {
  return {word(entry, "device"), word(entry, "signal")};
}

}  // namespace

std::vector<SignalRow> signal_rows(const json& document) {
  std::vector<SignalRow> rows;
  const json& sensors = part(document, "sensors");
  for (std::size_t i = 0; sensors.is_array() && i < sensors.size(); ++i) {
    rows.push_back(
        {fmt::format("sensors[{}]", i), SignalUse::sensor, word(sensors[i], "channel"), source_at(sensors[i])});
  }
  for (const Quantity& quantity : quantities) {
    rows.push_back({quantity.key, quantity.use, quantity.key, source_at(part(document, quantity.key))});
  }
  const json& positions = part(document, "positions");
  for (const char* axis : axes) {
    rows.push_back({fmt::format("positions.{}", axis), SignalUse::position, axis, source_at(part(positions, axis))});
  }
  const json& probes = part(document, "probes");
  const SignalSource array = source_at(probes);
  for (std::size_t i = 0; i < probe_names.size(); ++i) {
    SignalSource source = source_at(part(probes, probe_names[i]));
    if (!array.device.empty()) source = {array.device, fmt::format("{}[{}]", array.signal, i + 1)};
    rows.push_back({fmt::format("probes.{}", probe_names[i]), SignalUse::probe, probe_names[i], source});
  }
  return rows;
}

std::string control_signal(const SignalRow& row) {
  switch (row.use) {
    case SignalUse::sensor: {
      const std::size_t number = std::stoul(row.place.substr(row.place.find('[') + 1)) + 1;
      return fmt::format("temperature_C[{}]", number);
    }
    case SignalUse::position:
      return fmt::format("position_{}_{}", row.name, row.name == "A" || row.name == "C" ? "deg" : "mm");
    case SignalUse::probe:
      for (std::size_t i = 0; i < probe_names.size(); ++i) {
        if (row.name == probe_names[i]) return fmt::format("probe_um[{}]", i + 1);
      }
      return {};
    default:
      for (const Quantity& quantity : quantities) {
        if (quantity.use == row.use) return quantity.of_control;
      }
      return {};
  }
}

SignalRange range_of(SignalUse use) {
  switch (use) {
    case SignalUse::sensor:  // parts of a machine tool; an open PT100 reads 850 or -200 C
      return {"C", -20.0, 150.0, true};
    case SignalUse::ambient:
      return {"C", -20.0, 60.0, true};
    case SignalUse::speed:
      return {"1/min", -200000.0, 200000.0, false};
    case SignalUse::load:
      return {"W", -1e6, 1e6, false};
    case SignalUse::coolant:
    case SignalUse::compensation_state:
      return {"", -1e9, 1e9, false};
    case SignalUse::position:
      return {"mm", -1e5, 1e5, false};
    case SignalUse::probe:  // the longest inductive and eddy-current probes
      return {"um", -10000.0, 10000.0, true};
  }
  return {};
}

void SignalWatch::add(double value) {
  m_asked = true;
  if (std::isfinite(m_last) && std::isfinite(value) && value != m_last) m_changed = true;
  m_last = value;
  if (!std::isfinite(value)) return;
  if (!std::isfinite(m_first)) m_first = value;
  ++m_values;
}

Plausibility SignalWatch::judgement() const {
  if (!m_asked) return Plausibility::unknown;
  if (!std::isfinite(m_last)) return Plausibility::missing;
  if (m_last < m_range.low || m_last > m_range.high) return Plausibility::out_of_range;
  if (m_range.varies && !m_changed && m_values >= readings_to_vary) return Plausibility::unchanged;
  return Plausibility::ok;
}

}  // namespace zerodrift::controller
