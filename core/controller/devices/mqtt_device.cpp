#include "core/controller/devices/mqtt_device.h"

#include <fmt/format.h>
#include <mosquitto.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <condition_variable>
#include <cstring>
#include <limits>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <set>
#include <span>
#include <stop_token>
#include <thread>
#include <variant>

#include "core/base/clock.h"
#include "core/base/json.h"
#include "core/controller/devices/device_tools.h"

namespace zerodrift::controller {
namespace {

constexpr double missing_value = std::numeric_limits<double>::quiet_NaN();
constexpr Seconds first_pause{0.5};
constexpr Seconds longest_pause{30.0};
constexpr int loop_ms = 100;  // until the network thread looks whether it is to end
// Shortest keep-alive that libmosquitto takes; the longest keeps a dead line from being noticed for two minutes.
constexpr int shortest_keep_alive_s = 5;
constexpr int longest_keep_alive_s = 60;
constexpr std::size_t longest_payload = std::size_t{1} << 20;  // a reading takes some bytes, a status document some kB
constexpr int refused_subscription = 0x80;                     // MQTT 3.1.1, 3.9.3

struct TopicSignal {
  std::string name;  // as in the profile
  std::string topic;
  std::optional<nlohmann::json::json_pointer> pointer;
};

tl::unexpected<Error> not_a_signal(const DeviceProfile& profile, const std::string& signal, std::string expected) {
  return fail(ErrorCode::data_does_not_fit, {{"what", fmt::format("the signal of device {}", profile.id)},
                                             {"found", shortened(signal)},
                                             {"expected", std::move(expected)}});
}

Result<TopicSignal> topic_signal(const DeviceProfile& profile, const std::string& signal) {
  TopicSignal parsed{signal, signal.substr(0, signal.find('#')), {}};
  const std::string& topic = parsed.topic;
  // "plant/#/a" asks for a wildcard as well: no one ends the name of a topic in a stroke.
  const bool hash = topic.size() < signal.size();
  const std::string pointer = hash ? signal.substr(topic.size() + 1) : "";
  const bool wildcard = topic.find('+') != std::string::npos || (hash && (pointer.empty() || topic.ends_with('/')));
  if (wildcard) return not_a_signal(profile, signal, "one topic, without the wildcards + and #");
  const bool utf8 = mosquitto_validate_utf8(topic.data(), static_cast<int>(topic.size())) == MOSQ_ERR_SUCCESS;
  if (topic.empty() || !utf8 || mosquitto_pub_topic_check(topic.c_str()) != MOSQ_ERR_SUCCESS) {
    return not_a_signal(profile, signal, "a topic, or topic#/path for a value in a JSON message");
  }
  if (!hash) return parsed;
  try {
    parsed.pointer.emplace(pointer);
  } catch (const nlohmann::json::exception&) {
    return not_a_signal(profile, signal, "after # a JSON pointer such as /sensors/0/temperature");
  }
  return parsed;
}

/// A number, or why there is none.
using Payload = std::variant<double, std::string>;

Payload number_of_text(std::string_view text) {
  if (const auto number = number_in(text)) return *number;
  return says_no_value(text) ? "the device says that it has no value" : "a message is no number";
}

Payload number_of_json(std::string_view text, const nlohmann::json::json_pointer& pointer) {
  const auto document = parse_json(text, "message");
  if (!document) return "a message is no JSON";
  try {
    if (!document->contains(pointer)) return "a message has nothing at this path";
    const nlohmann::json& value = document->at(pointer);
    if (value.is_boolean()) return value.get<bool>() ? 1.0 : 0.0;
    if (value.is_string()) return number_of_text(value.get<std::string>());
    if (value.is_null()) return "the device says that it has no value";
    if (value.is_number() && std::isfinite(value.get<double>())) return value.get<double>();
    return "a message has something other than a number at this path";
  } catch (const nlohmann::json::exception&) {
    return "a message has nothing at this path";
  }
}

Payload payload_of(const TopicSignal& signal, std::string_view text) {
  if (text.size() > longest_payload) return "a message is larger than 1 MB";
  return signal.pointer ? number_of_json(text, *signal.pointer) : number_of_text(text);
}

/// Distinct for each connection: a broker ends the older of two clients of one name.
std::string client_name() {
  std::random_device random;
  return fmt::format("zerodrift-{:08x}", random());
}

std::string words_of(int code, int system_error) {
  switch (code) {
    case MOSQ_ERR_ERRNO:
      return std::strerror(system_error);
    case MOSQ_ERR_TLS:
      return "no TLS connection: the broker's certificate is not of the authority given, or it does not speak TLS";
    case MOSQ_ERR_PROTOCOL:
      return "the answer is not MQTT";
    case MOSQ_ERR_EAI:
      return "the name of the host is not known";
    default: {
      std::string text = mosquitto_strerror(code);
      if (text.ends_with('.')) text.pop_back();
      return text;
    }
  }
}

struct Library {
  Library() { mosquitto_lib_init(); }
  ~Library() { mosquitto_lib_cleanup(); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
};

using Client = std::unique_ptr<mosquitto, decltype(&mosquitto_destroy)>;

class MqttDevice : public Device {
 public:
  MqttDevice(DeviceProfile profile, std::vector<TopicSignal> signals, std::optional<Credentials> credentials,
             std::string authority)
      : m_profile(std::move(profile)),
        m_signals(std::move(signals)),
        m_credentials(std::move(credentials)),
        m_authority(std::move(authority)),
        m_last(m_signals.size(), Reading{missing_value, Seconds(0.0)}) {
    std::set<std::string> topics;
    for (const auto& signal : m_signals) topics.insert(signal.topic);
    m_topics.assign(topics.begin(), topics.end());
    if (m_credentials && !m_profile.tls) {
      m_remarks.add_once("user and password go to the broker unencrypted, because TLS is off");
    }
  }

  Result<std::vector<Reading>> read() override;
  std::vector<std::string> remarks() const override { return m_remarks.texts(); }

 private:
  std::string broker() const { return fmt::format("broker {}:{}", m_profile.host, m_profile.port); }
  Error silent() const {
    return {ErrorCode::machine_silent, {{"what", broker()}, {"timeout_ms", std::to_string(m_profile.timeout_ms)}}};
  }
  void keep_connected(const std::stop_token& stop);
  Status connection(const std::stop_token& stop);
  Status prepare(mosquitto* client);
  Error fault(int code, int system_error) const;
  void on_connect(mosquitto* client, int answer);
  void on_subscribe(std::span<const int> granted);
  void on_message(const mosquitto_message& message);

  const DeviceProfile m_profile;
  const std::vector<TopicSignal> m_signals;
  const std::optional<Credentials> m_credentials;
  const std::string m_authority;
  std::vector<std::string> m_topics;

  RemarkList m_remarks;
  mutable std::mutex m_lock;
  std::condition_variable m_changed;
  std::vector<Reading> m_last;
  std::optional<Error> m_fault;  // why there is no connection
  bool m_subscribed = false;
  int m_refusal = 0;       // network thread: the broker's answer to CONNECT
  std::jthread m_network;  // last: ends before the rest goes
};

Result<std::vector<Reading>> MqttDevice::read() {
  if (!m_network.joinable()) m_network = std::jthread([this](const std::stop_token& stop) { keep_connected(stop); });
  std::unique_lock guard(m_lock);
  m_changed.wait_for(guard, std::chrono::milliseconds(m_profile.timeout_ms),
                     [this] { return m_subscribed || m_fault.has_value(); });
  if (!m_subscribed) return fail(m_fault.value_or(silent()));
  const Seconds now = host_clock().steady();
  std::vector<Reading> readings = m_last;
  for (Reading& reading : readings) {
    if (reading.at.count() == 0.0) reading.at = now;
    if (now - reading.at > Seconds(m_profile.stale_after_s)) reading.value = missing_value;
  }
  return readings;
}

void MqttDevice::keep_connected(const std::stop_token& stop) {
  Seconds pause = first_pause;
  while (!stop.stop_requested()) {
    const Status ended = connection(stop);
    if (stop.stop_requested()) return;
    {
      const std::scoped_lock guard(m_lock);
      if (m_subscribed) {
        m_remarks.add("the connection to the broker was lost and opened anew");
        pause = first_pause;
      }
      m_subscribed = false;
      if (!ended) m_fault = ended.error();
    }
    m_changed.notify_all();
    host_clock().wait_for(pause, stop);
    pause = std::min(2.0 * pause, longest_pause);
  }
}

/// One connection from its beginning to its end. A client of its own, because libmosquitto's own thread gives up for
/// good after some faults (TLS, a peer that speaks no MQTT).
Status MqttDevice::connection(const std::stop_token& stop) {
  static const Library library;
  const Client client(mosquitto_new(client_name().c_str(), true, this), &mosquitto_destroy);
  if (!client) return fail(fault(MOSQ_ERR_NOMEM, 0));
  ZD_CHECK(prepare(client.get()));
  const int keep_alive_s =
      static_cast<int>(std::clamp<double>(m_profile.stale_after_s, shortest_keep_alive_s, longest_keep_alive_s));
  m_refusal = 0;
  int code = mosquitto_connect_async(client.get(), m_profile.host.c_str(), m_profile.port, keep_alive_s);
  const Seconds deadline = host_clock().steady() + std::chrono::milliseconds(m_profile.timeout_ms);
  while (code == MOSQ_ERR_SUCCESS) {
    code = mosquitto_loop(client.get(), loop_ms, 1);
    const int system_error = errno;
    if (m_refusal != 0) {
      return fail(ErrorCode::machine_unreachable,
                  {{"host", m_profile.host},
                   {"port", std::to_string(m_profile.port)},
                   {"detail", m_refusal == 4 || m_refusal == 5 ? "the broker refuses user or password"
                                                               : mosquitto_connack_string(m_refusal)}});
    }
    if (code != MOSQ_ERR_SUCCESS) return fail(fault(code, system_error));
    if (stop.stop_requested()) {
      mosquitto_disconnect(client.get());
      return {};
    }
    const std::scoped_lock guard(m_lock);
    if (!m_subscribed && host_clock().steady() > deadline) return fail(silent());
  }
  return fail(fault(code, errno));
}

Status MqttDevice::prepare(mosquitto* client) {
  int code = MOSQ_ERR_SUCCESS;
  if (m_credentials) {
    code = mosquitto_username_pw_set(client, m_credentials->user.c_str(), m_credentials->password.c_str());
  }
  if (code == MOSQ_ERR_SUCCESS && m_profile.tls) {
    code = m_authority.empty() ? mosquitto_int_option(client, MOSQ_OPT_TLS_USE_OS_CERTS, 1)
                               : mosquitto_tls_set(client, m_authority.c_str(), nullptr, nullptr, nullptr, nullptr);
  }
  if (code != MOSQ_ERR_SUCCESS) return fail(fault(code, errno));
  mosquitto_connect_callback_set(
      client, [](mosquitto* c, void* device, int answer) { static_cast<MqttDevice*>(device)->on_connect(c, answer); });
  mosquitto_subscribe_callback_set(client, [](mosquitto*, void* device, int, int count, const int* granted) {
    static_cast<MqttDevice*>(device)->on_subscribe({granted, static_cast<std::size_t>(count)});
  });
  mosquitto_message_callback_set(client, [](mosquitto*, void* device, const mosquitto_message* message) {
    static_cast<MqttDevice*>(device)->on_message(*message);
  });
  return {};
}

Error MqttDevice::fault(int code, int system_error) const {
  const std::scoped_lock guard(m_lock);
  std::string detail = words_of(code, system_error);
  if (m_subscribed) return {ErrorCode::machine_link_lost, {{"what", broker()}, {"detail", std::move(detail)}}};
  return {ErrorCode::machine_unreachable,
          {{"host", m_profile.host}, {"port", std::to_string(m_profile.port)}, {"detail", std::move(detail)}}};
}

void MqttDevice::on_connect(mosquitto* client, int answer) {
  m_refusal = answer;
  if (answer != 0) return;
  if (m_topics.empty()) return on_subscribe({});
  std::vector<char*> topics;
  for (std::string& topic : m_topics) topics.push_back(topic.data());
  mosquitto_subscribe_multiple(client, nullptr, static_cast<int>(topics.size()), topics.data(), 0, 0, nullptr);
}

void MqttDevice::on_subscribe(std::span<const int> granted) {
  const std::scoped_lock guard(m_lock);
  for (std::size_t i = 0; i < std::min(granted.size(), m_topics.size()); ++i) {
    if (granted[i] == refused_subscription) {
      m_remarks.add_once(fmt::format("{}: the broker does not let this user read the topic", m_topics[i]));
    }
  }
  m_subscribed = true;
  m_fault.reset();
  m_changed.notify_all();
}

void MqttDevice::on_message(const mosquitto_message& message) {
  const Seconds now = host_clock().steady();
  const std::string_view text(static_cast<const char*>(message.payload), static_cast<std::size_t>(message.payloadlen));
  const std::scoped_lock guard(m_lock);
  for (std::size_t i = 0; i < m_signals.size(); ++i) {
    const TopicSignal& signal = m_signals[i];
    if (signal.topic != message.topic) continue;
    if (message.retain) {
      m_remarks.add_once(fmt::format("{}: a retained message is not used, because its age is unknown", signal.topic));
      continue;
    }
    const Payload payload = payload_of(signal, text);
    const double* number = std::get_if<double>(&payload);
    m_last[i] = {number != nullptr ? *number : missing_value, now};
    if (number == nullptr) m_remarks.add(fmt::format("{}: {}", signal.name, std::get<std::string>(payload)));
  }
}

}  // namespace

Result<std::unique_ptr<Device>> open_mqtt(const DeviceProfile& profile, const std::vector<std::string>& signals) {
  std::vector<TopicSignal> parsed;
  for (const std::string& signal : signals) {
    ZD_TRY(TopicSignal one, topic_signal(profile, signal));
    parsed.push_back(std::move(one));
  }
  ZD_TRY(auto credentials, read_credentials(profile));
  std::string authority;
  if (profile.tls && !profile.ca_file.empty()) {
    ZD_TRY(const auto path, file_of_profile(profile, "ca_file", profile.ca_file));
    if (!std::filesystem::exists(path)) return fail(ErrorCode::file_not_found, {{"file", path.string()}});
    authority = path.string();
  }
  return std::make_unique<MqttDevice>(profile, std::move(parsed), std::move(credentials), std::move(authority));
}

}  // namespace zerodrift::controller
