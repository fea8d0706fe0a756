#pragma once
// A controller at a serial line (a pseudo-terminal), with what real lines and devices do beside the standard.

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "core/controller/profile.h"

namespace zerodrift::controller {

struct SerialHabits {
  bool echo = false;     // the adapter hears what it sends
  int zeros_before = 0;  // zero bytes before each reply
  int zeros_after = 0;
  int unit = 1;                                                      // in the replies
  std::set<int> without_functions = {};                              // answered with exception 1
  std::function<std::chrono::milliseconds(int request)> delay = {};  // of the reply to this request, from 0
};

class SerialDevice {
 public:
  explicit SerialDevice(SerialHabits habits = {});
  ~SerialDevice();
  SerialDevice(const SerialDevice&) = delete;
  SerialDevice& operator=(const SerialDevice&) = delete;

  ControllerSettings settings() const;
  std::uint16_t word(int address) const;
  void set(int address, std::uint16_t value);
  /// Function codes of the requests so far.
  std::vector<int> functions() const;

 private:
  void serve(const std::stop_token& stop);
  /// Takes one whole request from the front; false when there is none yet.
  bool answer(std::vector<std::uint8_t>& bytes);
  std::vector<std::uint8_t> reply_to(std::span<const std::uint8_t> request);
  void send(std::span<const std::uint8_t> bytes) const;

  SerialHabits m_habits;
  int m_master = -1;
  int m_slave = -1;  // kept open, so that the line stays when the host closes it
  std::string m_port;
  mutable std::mutex m_lock;
  std::array<std::uint16_t, 6000> m_words{};
  std::vector<int> m_functions;
  std::jthread m_thread;
};

}  // namespace zerodrift::controller
