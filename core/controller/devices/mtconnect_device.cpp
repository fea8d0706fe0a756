#include "core/controller/devices/mtconnect_device.h"

#include <fmt/format.h>
#include <httplib.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <pugixml.hpp>
#include <regex>
#include <thread>

#include "core/base/clock.h"
#include "core/base/redact.h"
#include "core/controller/devices/device_tools.h"

namespace zerodrift::controller {
namespace {

constexpr std::size_t longest_answer = std::size_t{8} << 20;  // a large agent's /probe has about 1 MB
constexpr std::string_view unavailable = "UNAVAILABLE";       // the standard's word, MTConnect part 1

struct AgentAddress {
  std::string origin;  // scheme, host, port
  std::string path;    // ends in a stroke
  std::string host;
  std::string port;
  bool https = false;
};

Result<AgentAddress> agent_address(const DeviceProfile& profile) {
  static const std::regex form(R"((https?)://(\[[0-9a-fA-F:.]+\]|[^/:@?#\[\]\s]+)(?::([0-9]{1,5}))?(/[^?#\s]*)?)");
  const auto refused = [&](std::string expected) {
    return fail(ErrorCode::data_does_not_fit, {{"what", fmt::format("the address of device {}", profile.id)},
                                               {"found", without_secrets(profile.url)},
                                               {"expected", std::move(expected)}});
  };
  std::smatch part;
  if (profile.url.find('@') != std::string::npos)
    return refused("an address without a user, who is in credentials_file");
  if (!std::regex_match(profile.url, part, form)) return refused("an address such as http://host:5000/");
  AgentAddress address;
  address.https = part[1] == "https";
#ifndef CPPHTTPLIB_OPENSSL_SUPPORT
  if (address.https) return refused("http: this program was built without https");
#endif
  address.host = part[2];
  address.port = part[3].matched ? part[3].str() : address.https ? "443" : "80";
  address.path = part[4].matched ? part[4].str() : "/";
  if (!address.path.ends_with('/')) address.path += '/';
  address.origin = fmt::format("{}://{}:{}", part[1].str(), address.host, address.port);
  return address;
}

/// value = factor * number + offset
struct UnitRule {
  std::string_view unit;
  double factor;
  double offset;
};
// Names from MTConnect part 2 (units, nativeUnits).
constexpr std::array unit_rules = {
    UnitRule{"CELSIUS", 1.0, 0.0},
    UnitRule{"FAHRENHEIT", 1.0 / 1.8, -32.0 / 1.8},
    UnitRule{"KELVIN", 1.0, -273.15},
    UnitRule{"REVOLUTION/MINUTE", 1.0, 0.0},
    UnitRule{"REVOLUTION/SECOND", 60.0, 0.0},
    UnitRule{"MILLIMETER", 1.0, 0.0},
    UnitRule{"INCH", 25.4, 0.0},
    UnitRule{"DEGREE", 1.0, 0.0},
    UnitRule{"WATT", 1.0, 0.0},
    UnitRule{"KILOWATT", 1000.0, 0.0},
    UnitRule{"PERCENT", 1.0, 0.0},
    UnitRule{"COUNT", 1.0, 0.0},
};

std::string known_units() {
  std::string all;
  for (const UnitRule& rule : unit_rules) all += (all.empty() ? "" : ", ") + std::string(rule.unit);
  return all;
}

/// Without the prefix of its namespace.
std::string_view local_name(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  const std::size_t colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

/// All elements of a document, however deep: pugixml walks without recursion.
struct ElementWalker : pugi::xml_tree_walker {
  explicit ElementWalker(std::function<void(const pugi::xml_node&)> called) : visit(std::move(called)) {}
  bool for_each(pugi::xml_node& node) override {
    if (node.type() == pugi::node_element) visit(node);
    return true;
  }
  std::function<void(const pugi::xml_node&)> visit;
};

void for_each_element(pugi::xml_document& document, std::function<void(const pugi::xml_node&)> visit) {
  ElementWalker walker(std::move(visit));
  document.traverse(walker);
}

struct DataItem {
  std::string id;
  std::string name;
  std::string category;
  std::string unit;
};

class MtConnectDevice : public Device {
 public:
  MtConnectDevice(DeviceProfile profile, AgentAddress address, std::vector<std::string> signals,
                  const std::optional<Credentials>& credentials, const std::string& authority);

  Result<std::vector<Reading>> read() override;
  Result<std::vector<std::string>> samples();
  std::vector<std::string> remarks() const override { return m_remarks.texts(); }

 private:
  struct Item {
    std::string id;
    UnitRule rule;
  };
  struct Answer {
    pugi::xml_document document;
    Seconds at{0.0};  // middle of the request
    std::string instance;
  };
  std::string what(const std::string& request) const { return m_address.origin + m_address.path + request; }
  tl::unexpected<Error> bad_answer(const std::string& request, std::string detail) const {
    return fail(ErrorCode::machine_bad_reply, {{"what", what(request)}, {"detail", std::move(detail)}});
  }
  Result<std::string> get(const std::string& request, Seconds& middle);
  Error no_answer(const std::string& request, httplib::Error error, bool late) const;
  static std::vector<DataItem> items_in(Answer& answer);
  Result<std::unique_ptr<Answer>> ask(const std::string& request, std::string_view kind);
  Status learn_items();
  Result<Item> item_of(const std::string& signal, const std::vector<DataItem>& all) const;
  std::vector<Reading> readings_of(Answer& answer);

  const DeviceProfile m_profile;
  const AgentAddress m_address;
  const std::vector<std::string> m_signals;
  httplib::Client m_client;
  std::optional<std::vector<Item>> m_items;  // of the signals; as the agent of this instance has them
  std::string m_instance;
  RemarkList m_remarks;
};

MtConnectDevice::MtConnectDevice(DeviceProfile profile, AgentAddress address, std::vector<std::string> signals,
                                 const std::optional<Credentials>& credentials, const std::string& authority)
    : m_profile(std::move(profile)),
      m_address(std::move(address)),
      m_signals(std::move(signals)),
      m_client(m_address.origin) {
  const std::chrono::milliseconds timeout(m_profile.timeout_ms);
  m_client.set_connection_timeout(timeout);
  // Longer than get() waits: of two clocks that end at one moment either might be first, and the fault be misnamed.
  m_client.set_read_timeout(2 * timeout);
  m_client.set_write_timeout(2 * timeout);
  m_client.set_keep_alive(true);
  if (credentials) {
    m_client.set_basic_auth(credentials->user, credentials->password);
    if (!m_address.https) m_remarks.add_once("user and password go to the agent unencrypted, because it is not https");
  }
#ifdef CPPHTTPLIB_OPENSSL_SUPPORT
  if (!authority.empty()) m_client.set_ca_cert_path(authority);
#else
  static_cast<void>(authority);
#endif
}

Error MtConnectDevice::no_answer(const std::string& request, httplib::Error error, bool late) const {
  const auto unreachable = [this](std::string detail) {
    return Error{ErrorCode::machine_unreachable,
                 {{"host", m_address.host}, {"port", m_address.port}, {"detail", std::move(detail)}}};
  };
  if (late || error == httplib::Error::ConnectionTimeout) {
    return {ErrorCode::machine_silent, {{"what", what(request)}, {"timeout_ms", std::to_string(m_profile.timeout_ms)}}};
  }
  switch (error) {
    case httplib::Error::Connection:
      return unreachable("no server answers there");
    case httplib::Error::SSLConnection:
    case httplib::Error::SSLLoadingCerts:
    case httplib::Error::SSLServerVerification:
      return unreachable(
          "no TLS connection: the agent's certificate is not of the authority given, or it is not https");
    default:
      return {ErrorCode::machine_link_lost,
              {{"what", what(request)}, {"detail", "the agent closed the connection before its answer was whole"}}};
  }
}

Result<std::string> MtConnectDevice::get(const std::string& request, Seconds& middle) {
  const Seconds begin = host_clock().steady();
  const Seconds deadline = begin + std::chrono::milliseconds(m_profile.timeout_ms);
  // The client's own time-outs begin again with each piece of an answer; this one bounds the whole.
  std::atomic<bool> late = false;
  std::jthread watch([&](const std::stop_token& stop) {
    if (!host_clock().wait_until(deadline, stop)) return;
    late = true;
    m_client.stop();
  });
  std::string body;
  bool too_long = false;
  const httplib::Result result =
      m_client.Get(m_address.path + request, httplib::Headers{{"Accept", "text/xml"}, {"Cache-Control", "no-cache"}},
                   [&](const char* bytes, std::size_t size) {
                     too_long = body.size() + size > longest_answer;
                     if (!too_long && !late) body.append(bytes, size);
                     return !too_long && !late;
                   });
  watch.request_stop();
  watch.join();
  middle = begin + 0.5 * (host_clock().steady() - begin);
  if (too_long) return bad_answer(request, fmt::format("it is longer than {} MB", longest_answer >> 20));
  if (!result) return fail(no_answer(request, result.error(), late));
  if (result->status == 401 || result->status == 403) {
    return fail(ErrorCode::machine_unreachable,
                {{"host", m_address.host}, {"port", m_address.port}, {"detail", "the agent refuses user or password"}});
  }
  if (result->status >= 300 && result->status < 400) {
    const std::string place = shortened(without_secrets(result->get_header_value("Location")));
    return bad_answer(request, fmt::format("the agent refers to another address, {}", place));
  }
  // A refusal in MTConnect's own form says more than its status.
  if (result->status != 200 && body.find("MTConnectError") == std::string::npos) {
    return bad_answer(request, fmt::format("HTTP status {}", result->status));
  }
  return body;
}

Result<std::unique_ptr<MtConnectDevice::Answer>> MtConnectDevice::ask(const std::string& request,
                                                                      std::string_view kind) {
  auto answer = std::make_unique<Answer>();
  ZD_TRY(const std::string body, get(request, answer->at));
  const pugi::xml_parse_result parsed = answer->document.load_buffer(body.data(), body.size());
  if (!parsed) return bad_answer(request, fmt::format("it is no XML: {}", parsed.description()));
  const std::string_view root = local_name(answer->document.document_element());
  if (root == "MTConnectError") {
    std::string told;
    for_each_element(answer->document, [&](const pugi::xml_node& node) {
      if (!told.empty() || local_name(node) != "Error") return;
      told = fmt::format("{} {}", node.attribute("errorCode").value(), node.text().get());
    });
    return bad_answer(request, fmt::format("the agent reports \"{}\"", shortened(told)));
  }
  if (root != kind) {
    return bad_answer(request, fmt::format("it is <{}> instead of <{}>", shortened(std::string(root)), kind));
  }
  for_each_element(answer->document, [&](const pugi::xml_node& node) {
    if (local_name(node) == "Header") answer->instance = node.attribute("instanceId").value();
  });
  return answer;
}

std::vector<DataItem> MtConnectDevice::items_in(Answer& answer) {
  std::vector<DataItem> all;
  for_each_element(answer.document, [&](const pugi::xml_node& node) {
    if (local_name(node) != "DataItem") return;
    // What the agent gives is in `units`; it has converted from nativeUnits.
    const std::string_view units = node.attribute("units").value();
    all.push_back({node.attribute("id").value(), node.attribute("name").value(), node.attribute("category").value(),
                   std::string(units.empty() ? node.attribute("nativeUnits").value() : units)});
  });
  return all;
}

Result<std::vector<std::string>> MtConnectDevice::samples() {
  ZD_TRY(const auto answer, ask("probe", "MTConnectDevices"));
  std::vector<std::string> ids;
  for (const DataItem& item : items_in(*answer)) {
    const bool known = item.unit.empty() ||
                       std::ranges::find(unit_rules, std::string_view(item.unit), &UnitRule::unit) != unit_rules.end();
    if (item.category == "SAMPLE" && known) ids.push_back(item.id);
  }
  return ids;
}

Status MtConnectDevice::learn_items() {
  ZD_TRY(const auto answer, ask("probe", "MTConnectDevices"));
  const std::vector<DataItem> all = items_in(*answer);
  std::vector<Item> items;
  for (const std::string& signal : m_signals) {
    ZD_TRY(Item item, item_of(signal, all));
    if (item.rule.unit.empty()) {
      m_remarks.add_once(fmt::format("{}: the agent states no unit, and its values are taken as they are", signal));
    }
    items.push_back(std::move(item));
  }
  m_items = std::move(items);
  m_instance = answer->instance;
  return {};
}

Result<MtConnectDevice::Item> MtConnectDevice::item_of(const std::string& signal,
                                                       const std::vector<DataItem>& all) const {
  const auto unsupported = [&](std::string found, std::string expected) {
    return fail(ErrorCode::machine_unsupported, {{"what", fmt::format("data item {} of {}", signal, m_address.origin)},
                                                 {"found", std::move(found)},
                                                 {"expected", std::move(expected)}});
  };
  std::vector<const DataItem*> matches;
  for (const DataItem& item : all) {
    if (item.id == signal) matches.push_back(&item);
  }
  if (matches.empty()) {
    for (const DataItem& item : all) {
      if (item.name == signal && !signal.empty()) matches.push_back(&item);
    }
  }
  std::string ids;
  for (const DataItem& item : all) {
    if (matches.empty() || item.name == signal) ids += (ids.empty() ? "" : ", ") + item.id;
  }
  if (matches.empty()) return unsupported("missing", fmt::format("one of {}", shortened(ids)));
  if (matches.size() > 1) return unsupported("the name of several", fmt::format("one of the ids {}", shortened(ids)));
  const DataItem& item = *matches.front();
  if (item.category == "CONDITION") return unsupported("a condition", "a data item with a number");
  if (item.unit.empty()) return Item{item.id, {"", 1.0, 0.0}};
  const auto rule = std::ranges::find(unit_rules, std::string_view(item.unit), &UnitRule::unit);
  if (rule == unit_rules.end()) return unsupported("in " + shortened(item.unit), "one of " + known_units());
  return Item{item.id, *rule};
}

Result<std::vector<Reading>> MtConnectDevice::read() {
  for (int attempt = 0; attempt < 2; ++attempt) {
    if (!m_items) ZD_CHECK(learn_items());
    ZD_TRY(const auto answer, ask("current", "MTConnectStreams"));
    if (answer->instance == m_instance) return readings_of(*answer);
    m_remarks.add("the agent has restarted, and its data items were read again");
    m_items.reset();
  }
  return fail(ErrorCode::machine_link_lost, {{"what", what("current")}, {"detail", "the agent keeps restarting"}});
}

std::vector<Reading> MtConnectDevice::readings_of(Answer& answer) {
  std::map<std::string, std::string, std::less<>> texts;
  for_each_element(answer.document, [&](const pugi::xml_node& node) {
    if (const auto id = node.attribute("dataItemId")) texts.insert_or_assign(id.value(), node.text().get());
  });
  std::vector<Reading> readings;
  for (std::size_t i = 0; i < m_signals.size(); ++i) {
    const Item& item = (*m_items)[i];
    Reading reading{std::numeric_limits<double>::quiet_NaN(), answer.at};
    const auto found = texts.find(item.id);
    if (found == texts.end()) {
      m_remarks.add(fmt::format("{}: an answer of the agent lacks the data item", m_signals[i]));
    } else if (const auto number = number_in(found->second)) {
      reading.value = item.rule.factor * *number + item.rule.offset;
    } else if (found->second != unavailable) {
      m_remarks.add(fmt::format("{}: a value is no number", m_signals[i]));
    }
    readings.push_back(reading);
  }
  return readings;
}

Result<std::unique_ptr<MtConnectDevice>> device_of(const DeviceProfile& profile,
                                                   const std::vector<std::string>& signals) {
  ZD_TRY(AgentAddress address, agent_address(profile));
  ZD_TRY(const auto credentials, read_credentials(profile));
  std::string authority;
  if (!profile.ca_file.empty()) {
    ZD_TRY(const auto path, file_of_profile(profile, "ca_file", profile.ca_file));
    if (!std::filesystem::exists(path)) return fail(ErrorCode::file_not_found, {{"file", path.string()}});
    authority = path.string();
  }
  return std::make_unique<MtConnectDevice>(profile, std::move(address), signals, credentials, authority);
}

}  // namespace

Result<std::vector<std::string>> agent_samples(const DeviceProfile& profile) {
  ZD_TRY(const auto device, device_of(profile, {}));
  return device->samples();
}

Result<std::unique_ptr<Device>> open_mtconnect(const DeviceProfile& profile, const std::vector<std::string>& signals) {
  ZD_TRY(std::unique_ptr<Device> device, device_of(profile, signals));
  return device;
}

}  // namespace zerodrift::controller
