#pragma once
// A serial port has one owner among the programs of this computer and takes turns among the connections of this one:
// units on one line are asked one after the other, in the order in which they came, and after a reply that did not come
// the line is left in peace for all of them.

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

#include "core/base/result.h"

namespace zerodrift::controller {

class SerialLine {
 public:
  /// The one of this port; kept as long as somebody has it.
  static std::shared_ptr<SerialLine> of(const std::string& port);
  explicit SerialLine(std::string port) : m_port(std::move(port)) {}
  ~SerialLine();
  SerialLine(const SerialLine&) = delete;
  SerialLine& operator=(const SerialLine&) = delete;

  /// Held while a request is answered.
  class Turn {
   public:
    explicit Turn(SerialLine& line);
    ~Turn();
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

   private:
    SerialLine& m_line;
  };

  /// How many wait for their turn.
  std::size_t waiting();

  /// With a turn. Keeps other programs off the port (flock); machine_unreachable when one has it or there is no port.
  Status claim();
  /// With a turn.
  void leave_in_peace(std::chrono::milliseconds duration);
  void wait_for_peace() const;

 private:
  std::string m_port;
  int m_claim = -1;  // file descriptor
  std::chrono::steady_clock::time_point m_in_peace_until{};
  std::mutex m_mutex;
  std::condition_variable m_next;
  std::uint64_t m_drawn = 0;    // tickets
  std::uint64_t m_serving = 0;  // whose turn it is
};

}  // namespace zerodrift::controller
