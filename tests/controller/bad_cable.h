#pragma once
// A TCP relay between host and device that spoils the stream at one chosen byte: cuts the connection, turns a byte
// over, loses one, sends one twice or two in the wrong order, holds everything back for a while, lets each travel alone
// or stops passing anything on. What the upload is tried against, byte by byte.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>

namespace zerodrift::controller {

class BadCable {
 public:
  enum class Fault {
    cut,        // both sides are closed
    corrupt,    // a byte is turned over
    duplicate,  // a byte comes twice
    delay,      // this byte and what follows come later than the host waits
    stall,      // nothing passes any more on this connection
    drop,       // a byte is missing
    reorder,    // a byte comes after the one behind it
    split,      // the next bytes travel alone, each a while after the one before
  };

  explicit BadCable(int device_port);
  ~BadCable();
  BadCable(const BadCable&) = delete;
  BadCable& operator=(const BadCable&) = delete;

  int port() const { return m_port; }
  /// From now on: the fault strikes once, at byte n of both directions together, counted from here.
  void strike(Fault fault, long n);
  long passed() const { return m_passed; }
  /// Did the chosen byte pass, so that the fault happened?
  bool struck() const { return m_strike_at >= 0 && m_passed > m_strike_at; }
  void set_delay(std::chrono::milliseconds delay) { m_delay = delay; }

 private:
  void serve(const std::stop_token& stop);
  void relay(int host, const std::stop_token& stop);
  bool pass(int from, int to);

  int m_device_port;
  int m_listener = -1;
  int m_port = 0;
  std::atomic<long> m_passed{0};
  std::atomic<long> m_strike_at{-1};
  std::atomic<Fault> m_fault{Fault::cut};
  std::chrono::milliseconds m_delay{100};
  bool m_stalled = false;
  std::jthread m_thread;
};

}  // namespace zerodrift::controller
