#include "app/machine/rig/temperature_publisher.h"

#include <fmt/format.h>
#include <mosquitto.h>

#include <array>
#include <mutex>
#include <thread>

#include "core/base/clock.h"

namespace zerodrift::machine {
namespace {

constexpr double shortest_period_s = 0.1;
constexpr double reconnect_s = 1.0;
constexpr int keepalive_s = 10;
constexpr int loop_turn_ms = 10;
constexpr double conversion_step_C = 1.0 / 16.0;

struct Topic {
  int sensor;  // 0: the room
  const char* name;
};
constexpr std::array topics{Topic{19, "shop/T19"}, Topic{20, "shop/T20"}, Topic{0, "shop/room"}};

std::string payload_of(std::int16_t raw) {
  return raw == dead_reading ? R"({"temperature_C": null})"
                             : fmt::format(R"({{"temperature_C": {:.2f}}})", raw * conversion_step_C);
}

/// The library once for the program, as it asks for.
void initialise_library() {
  static std::once_flag once;
  std::call_once(once, [] { mosquitto_lib_init(); });
}

}  // namespace

class TemperaturePublisher::Impl {
 public:
  Impl(LiveMachine& machine, MqttBroker broker, double machine_second_s)
      : m_machine(machine), m_broker(std::move(broker)), m_period(std::max(machine_second_s, shortest_period_s)) {
    initialise_library();
    m_client = mosquitto_new(nullptr, true, nullptr);
    if (m_client == nullptr) return;
    m_thread = std::jthread([this](const std::stop_token& stop) { run(stop); });
  }
  ~Impl() {
    m_thread.request_stop();
    if (m_thread.joinable()) m_thread.join();
    if (m_client != nullptr) mosquitto_destroy(m_client);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

 private:
  void run(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      if (mosquitto_connect(m_client, m_broker.host.c_str(), m_broker.port, keepalive_s) == MOSQ_ERR_SUCCESS) {
        publish_while_connected(stop);
      }
      host_clock().wait_for(Seconds(reconnect_s), stop);
    }
    mosquitto_disconnect(m_client);
  }

  void publish_while_connected(const std::stop_token& stop) {
    Seconds due = host_clock().steady();
    while (!stop.stop_requested() && mosquitto_loop(m_client, loop_turn_ms, 1) == MOSQ_ERR_SUCCESS) {
      if (host_clock().steady() < due) continue;
      due = std::max(due + m_period, host_clock().steady());
      for (const Topic& topic : topics) {
        const std::string payload =
            m_machine.with([&](const Machine& machine) { return payload_of(machine.raw_temperature(topic.sensor)); });
        // One that is lost is followed by the next.
        mosquitto_publish(m_client, nullptr, topic.name, static_cast<int>(payload.size()), payload.data(), 0, true);
      }
    }
  }

  LiveMachine& m_machine;
  MqttBroker m_broker;
  Seconds m_period;
  mosquitto* m_client = nullptr;
  std::jthread m_thread;
};

TemperaturePublisher::TemperaturePublisher(LiveMachine& machine, MqttBroker broker, double machine_second_s)
    : m_impl(std::make_unique<Impl>(machine, std::move(broker), machine_second_s)) {}
TemperaturePublisher::~TemperaturePublisher() = default;

}  // namespace zerodrift::machine
