#pragma once
// The machine on the wall clock: a thread moves it on, servers ask it from theirs. Machine time = wall time x speedup.

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "app/machine/machine.h"
#include "app/machine/register_bank.h"

namespace zerodrift::machine {

class LiveMachine {
 public:
  /// on_moment is called on the machine's own thread after every turn, under the lock.
  LiveMachine(const MachineParameters& parameters, int speedup, std::function<void(const Machine&)> on_moment,
              RegisterScope scope = RegisterScope::whole_machine);

  controller::RegisterReply read(int address, int count);
  std::optional<controller::ModbusException> write(int address, std::span<const std::uint16_t> words);
  CameraScene scene(View view);
  std::uint32_t serial() const { return m_bank.serial(); }
  /// What the function makes of the machine as it is now; nothing moves meanwhile.
  template <class Function>
  auto with(Function function) {
    const std::scoped_lock lock(m_mutex);
    catch_up();
    return function(m_machine);
  }
  std::optional<double> first_turn_s();
  void set_sensor_fault(SensorFault fault);
  /// The pace of the clock from now on, machine seconds a second of wall time.
  void set_pace(int pace);
  /// Starts the clock.
  void start();
  /// Stops it; the last on_moment has been called when this returns.
  void stop();

 private:
  void run(const std::stop_token& stop);
  void catch_up();

  std::mutex m_mutex;
  Machine m_machine;
  RegisterBank m_bank;
  double m_pace;
  double m_paced_from_s = 0.0;  // machine time at m_begin
  std::function<void(const Machine&)> m_on_moment;
  std::chrono::steady_clock::time_point m_begin{};
  bool m_running = false;
  std::jthread m_thread;
};

}  // namespace zerodrift::machine
