#pragma once
// A small controller with the documented table transaction behind our own server, whose replies can be spoilt at a
// chosen request: what the upload and the compensator are tried against.

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <vector>

#include "core/access/access.h"
#include "core/controller/modbus_server.h"
#include "core/controller/profile.h"

namespace zerodrift::controller {

/// For Device::on_write: the next write to this address is refused as a value that is not allowed.
inline std::function<std::optional<ModbusException>(int, std::span<const std::uint16_t>)> refusing_once(int address) {
  return
      [address, done = false](int written, std::span<const std::uint16_t>) mutable -> std::optional<ModbusException> {
        if (done || written != address) return std::nullopt;
        done = true;
        return ModbusException::illegal_value;
      };
}

/// The right to write, as whoever has set no PIN has it.
inline access::Permit engineer() {
  return access::Access().permit("a test").value();
}

class FakeController {
 public:
  explicit FakeController(std::set<int> without_functions = {});

  Profile profile() const;
  std::vector<std::uint16_t> active() const;
  int commits() const { return m_commits; }
  std::uint16_t word(int address) const;
  void set(int address, std::uint16_t value);
  void set_float(int address, double value);
  double float_at(int address) const;
  /// From on_write, where the lock is held.
  double float_unlocked(int address) const;
  /// The reply to request number n (counted from now, from 0) is spoilt; every one from there on with `lasting`.
  void spoil(int n, ReplyFault fault, bool lasting = false);
  /// From on_write, where the lock is held.
  void set_unlocked(int address, std::uint16_t value) { m_words[static_cast<std::size_t>(address)] = value; }
  /// Referenced, standing, identity as shipped: a corrupted write may have hit any of it.
  void reset_state();
  int requests() const { return m_requests; }
  /// Longer reads are refused.
  void limit_reads(int registers) { m_longest_read = registers; }
  /// The device's clock runs so much faster than ours; 0: it stands until it is set.
  void run_clock(double speed) { m_clock_speed = speed; }
  /// The reply to a request that `strikes` (asked with the number of the request, from 0 since the last spoil) is
  /// spoilt.
  void spoil_where(std::function<bool(int)> strikes, ReplyFault fault);
  /// Called on each write, with the lock held; may refuse.
  std::function<std::optional<ModbusException>(int address, std::span<const std::uint16_t>)> on_write;
  /// The same while requests are under way.
  void set_on_write(decltype(on_write) called) {
    const std::scoped_lock guard(m_lock);
    on_write = std::move(called);
  }

 private:
  std::optional<ModbusException> write(int address, std::span<const std::uint16_t> values);
  void commit();

  void tick();

  mutable std::mutex m_lock;
  std::vector<std::uint16_t> m_words;
  std::atomic<int> m_requests{0};
  std::atomic<int> m_commits{0};
  std::atomic<int> m_spoil_at{-1};
  std::atomic<bool> m_lasting{false};
  std::atomic<int> m_longest_read{125};
  std::function<bool(int)> m_strikes;
  ReplyFault m_fault;
  std::atomic<double> m_clock_speed{0.0};
  std::chrono::steady_clock::time_point m_started = std::chrono::steady_clock::now();
  std::unique_ptr<ModbusServer> m_server;  // last: stops before the rest goes
};

}  // namespace zerodrift::controller
