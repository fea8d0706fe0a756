#include "app/machine/rig/agent_documents.h"

#include <fmt/format.h>

#include <array>
#include <pugixml.hpp>
#include <sstream>
#include <string_view>

#include "app/machine/machine.h"
#include "core/base/time_text.h"

namespace zerodrift::machine {
namespace {

constexpr double raw_step_C = 1.0 / 16.0;  // of Machine::raw_temperature
constexpr std::string_view unavailable = "UNAVAILABLE";
constexpr const char* device_name = "VirtualFiveAxis";

struct AgentComponent {
  const char* element;
  const char* id;
  const char* name;
};
// In the order of the items below.
constexpr std::array agent_components{AgentComponent{"Device", "machine", device_name},
                                      AgentComponent{"Linear", "x", "X"},
                                      AgentComponent{"Linear", "y", "Y"},
                                      AgentComponent{"Linear", "z", "Z"},
                                      AgentComponent{"Rotary", "s1", "S1"},
                                      AgentComponent{"Sensor", "temperatures", "temperatures"}};

struct AgentItem {
  std::size_t component;  // of agent_components
  const char* id;
  const char* element;  // in a stream
  const char* type;     // in the device's description
  const char* sub_type;
  const char* units;
  std::string (*value)(const Machine& machine);

  bool is_event() const { return units == nullptr; }
};

template <int axis>
std::string position(const Machine& machine) {
  return fmt::format("{:.4f}", machine.motion().position_mm()[axis]);
}

template <int sensor>
std::string temperature(const Machine& machine) {
  const std::int16_t raw = machine.raw_temperature(sensor);
  return raw == dead_reading ? std::string(unavailable) : fmt::format("{:.2f}", raw * raw_step_C);
}

std::string available(const Machine& /*machine*/) {
  return "AVAILABLE";
}

std::string speed(const Machine& machine) {
  return fmt::format("{:.1f}", machine.speed_rpm());
}

std::string load(const Machine& machine) {
  return fmt::format("{:.1f}", machine.spindle_load_W());
}

constexpr std::array agent_items{
    AgentItem{0, "avail", "Availability", "AVAILABILITY", nullptr, nullptr, available},
    AgentItem{1, "Xact", "Position", "POSITION", "ACTUAL", "MILLIMETER", position<0>},
    AgentItem{2, "Yact", "Position", "POSITION", "ACTUAL", "MILLIMETER", position<1>},
    AgentItem{3, "Zact", "Position", "POSITION", "ACTUAL", "MILLIMETER", position<2>},
    AgentItem{4, "S1speed", "RotaryVelocity", "ROTARY_VELOCITY", "ACTUAL", "REVOLUTION/MINUTE", speed},
    AgentItem{4, "S1load", "Wattage", "WATTAGE", nullptr, "WATT", load},
    AgentItem{5, "T17", "Temperature", "TEMPERATURE", nullptr, "CELSIUS", temperature<17>},
    AgentItem{5, "T18", "Temperature", "TEMPERATURE", nullptr, "CELSIUS", temperature<18>},
    AgentItem{5, "T19", "Temperature", "TEMPERATURE", nullptr, "CELSIUS", temperature<19>},
    AgentItem{5, "T20", "Temperature", "TEMPERATURE", nullptr, "CELSIUS", temperature<20>},
    AgentItem{5, "room", "Temperature", "TEMPERATURE", nullptr, "CELSIUS", temperature<0>}};

std::string text_of(const pugi::xml_document& document) {
  std::ostringstream out;
  document.save(out, " ", pugi::format_default, pugi::encoding_utf8);
  return out.str();
}

/// The root of a document of this kind ("MTConnectStreams"), with its header.
pugi::xml_node add_root(pugi::xml_document& document, const std::string& kind, std::uint64_t instance, UtcTime now) {
  pugi::xml_node declaration = document.prepend_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  declaration.append_attribute("encoding") = "UTF-8";
  pugi::xml_node root = document.append_child(kind.c_str());
  const std::string name_space = fmt::format("urn:mtconnect.org:{}:1.5", kind);
  root.append_attribute("xmlns") = name_space.c_str();
  pugi::xml_node header = root.append_child("Header");
  header.append_attribute("creationTime") = to_text(now).c_str();
  header.append_attribute("sender") = "zerodrift-machine";
  header.append_attribute("instanceId") = std::to_string(instance).c_str();
  header.append_attribute("version") = "1.5.0.0";
  header.append_attribute("bufferSize") = std::to_string(AgentDocuments::buffer_size).c_str();
  return root;
}

void add_data_items(pugi::xml_node component, std::size_t number) {
  pugi::xml_node list = component.append_child("DataItems");
  for (const AgentItem& item : agent_items) {
    if (item.component != number) continue;
    pugi::xml_node node = list.append_child("DataItem");
    node.append_attribute("category") = item.is_event() ? "EVENT" : "SAMPLE";
    node.append_attribute("id") = item.id;
    node.append_attribute("name") = item.id;
    node.append_attribute("type") = item.type;
    if (item.sub_type != nullptr) node.append_attribute("subType") = item.sub_type;
    if (item.units != nullptr) node.append_attribute("units") = item.units;
  }
}

pugi::xml_node add_component(pugi::xml_node parent, std::size_t number) {
  const AgentComponent& component = agent_components[number];
  pugi::xml_node node = parent.append_child(component.element);
  node.append_attribute("id") = component.id;
  node.append_attribute("name") = component.name;
  return node;
}

}  // namespace

AgentDocuments::AgentDocuments(std::string device_uuid, std::uint64_t instance)
    : m_device_uuid(std::move(device_uuid)), m_instance(instance), m_last(agent_items.size()) {}

void AgentDocuments::observe(const Machine& machine, UtcTime now) {
  for (std::size_t i = 0; i < agent_items.size(); ++i) {
    std::string value = agent_items[i].value(machine);
    if (m_last[i].sequence != 0 && m_last[i].value == value) continue;
    m_last[i] = {m_next++, i, std::move(value), now};
    m_buffer.push_back(m_last[i]);
    if (m_buffer.size() > buffer_size) m_buffer.pop_front();
  }
}

std::uint64_t AgentDocuments::first_sequence() const {
  return m_buffer.empty() ? m_next : m_buffer.front().sequence;
}

std::string AgentDocuments::probe(UtcTime now) const {
  pugi::xml_document document;
  pugi::xml_node device =
      add_component(add_root(document, "MTConnectDevices", m_instance, now).append_child("Devices"), 0);
  device.append_attribute("uuid") = m_device_uuid.c_str();
  add_data_items(device, 0);
  pugi::xml_node components = device.append_child("Components");
  pugi::xml_node axes = components.append_child("Axes");
  axes.append_attribute("id") = "axes";
  pugi::xml_node axis_list = axes.append_child("Components");
  for (std::size_t i = 1; i < agent_components.size(); ++i) {
    const bool axis = i + 1 < agent_components.size();
    add_data_items(add_component(axis ? axis_list : components, i), i);
  }
  return text_of(document);
}

std::string AgentDocuments::current(UtcTime now) const {
  std::vector<const Observation*> last;
  for (const Observation& one : m_last) {
    if (one.sequence != 0) last.push_back(&one);
  }
  return streams(last, m_next, now);
}

tl::expected<std::string, AgentError> AgentDocuments::sample(std::uint64_t from, std::uint64_t count,
                                                             UtcTime now) const {
  if (count < 1 || count > buffer_size) {
    return tl::unexpected(
        AgentError{"OUT_OF_RANGE", fmt::format("'count' must be from 1 to {}, not {}", buffer_size, count)});
  }
  if (from < first_sequence() || from > m_next) {
    return tl::unexpected(AgentError{
        "OUT_OF_RANGE", fmt::format("'from' must be from {} to {}, not {}", first_sequence(), m_next, from)});
  }
  std::vector<const Observation*> some;
  const std::size_t begin = from - first_sequence();
  for (std::size_t i = begin; i < m_buffer.size() && some.size() < count; ++i) some.push_back(&m_buffer[i]);
  return streams(some, from + some.size(), now);
}

std::string AgentDocuments::streams(const std::vector<const Observation*>& observations, std::uint64_t next,
                                    UtcTime now) const {
  pugi::xml_document document;
  pugi::xml_node root = add_root(document, "MTConnectStreams", m_instance, now);
  pugi::xml_node header = root.child("Header");
  header.append_attribute("nextSequence") = std::to_string(next).c_str();
  header.append_attribute("firstSequence") = std::to_string(first_sequence()).c_str();
  header.append_attribute("lastSequence") = std::to_string(m_next - 1).c_str();
  pugi::xml_node device = root.append_child("Streams").append_child("DeviceStream");
  device.append_attribute("name") = device_name;
  device.append_attribute("uuid") = m_device_uuid.c_str();
  std::array<pugi::xml_node, agent_components.size()> lists;
  for (const Observation* observation : observations) {
    const AgentItem& item = agent_items[observation->item];
    pugi::xml_node& list = lists[item.component];
    if (!list) {
      const AgentComponent& component = agent_components[item.component];
      pugi::xml_node stream = device.append_child("ComponentStream");
      stream.append_attribute("component") = component.element;
      stream.append_attribute("name") = component.name;
      stream.append_attribute("componentId") = component.id;
      list = stream.append_child(item.is_event() ? "Events" : "Samples");  // no component has both
    }
    pugi::xml_node node = list.append_child(item.element);
    node.append_attribute("dataItemId") = item.id;
    node.append_attribute("name") = item.id;
    node.append_attribute("timestamp") = to_text(observation->time).c_str();
    node.append_attribute("sequence") = std::to_string(observation->sequence).c_str();
    if (item.sub_type != nullptr) node.append_attribute("subType") = item.sub_type;
    node.text() = observation->value.c_str();
  }
  return text_of(document);
}

std::string AgentDocuments::error(const AgentError& error, UtcTime now) const {
  pugi::xml_document document;
  pugi::xml_node node =
      add_root(document, "MTConnectError", m_instance, now).append_child("Errors").append_child("Error");
  node.append_attribute("errorCode") = error.code.c_str();
  node.text() = error.text.c_str();
  return text_of(document);
}

}  // namespace zerodrift::machine
