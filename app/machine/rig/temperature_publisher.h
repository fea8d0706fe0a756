#pragma once
// Wireless sensors of the shop at an MQTT broker: T19, T20 and the room as {"temperature_C": 21.37} on shop/T19,
// shop/T20 and shop/room, retained, quality of service 0; null for a dead sensor. A broker that is gone is tried again
// every second.

#include <memory>
#include <string>

#include "app/machine/live_machine.h"

namespace zerodrift::machine {

struct MqttBroker {
  std::string host;
  int port = 1883;
};

class TemperaturePublisher {
 public:
  /// Publishes until destroyed: once a machine second, at most 10 times a second.
  TemperaturePublisher(LiveMachine& machine, MqttBroker broker, double machine_second_s);
  ~TemperaturePublisher();
  TemperaturePublisher(const TemperaturePublisher&) = delete;
  TemperaturePublisher& operator=(const TemperaturePublisher&) = delete;

 private:
  class Impl;
  std::unique_ptr<Impl> m_impl;
};

}  // namespace zerodrift::machine
