#include "app/machine/live_machine.h"

#include <utility>

namespace zerodrift::machine {
namespace {

constexpr std::chrono::milliseconds turn{5};
constexpr std::uint32_t first_serial = 850000;

}  // namespace

LiveMachine::LiveMachine(const MachineParameters& parameters, int speedup,
                         std::function<void(const Machine&)> on_moment, RegisterScope scope)
    : m_machine(parameters),
      m_bank(m_machine, first_serial + static_cast<std::uint32_t>(parameters.seed), speedup, scope),
      m_pace(speedup),
      m_on_moment(std::move(on_moment)) {}

void LiveMachine::start() {
  const std::scoped_lock lock(m_mutex);
  m_begin = std::chrono::steady_clock::now();
  m_running = true;
  m_thread = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

void LiveMachine::set_pace(int pace) {
  const std::scoped_lock lock(m_mutex);
  catch_up();
  const auto now = std::chrono::steady_clock::now();
  if (m_running) m_paced_from_s += std::chrono::duration<double>(now - m_begin).count() * m_pace;
  m_begin = now;
  m_pace = pace;
  m_bank.set_time_factor(pace);
}

void LiveMachine::stop() {
  m_thread.request_stop();
  if (m_thread.joinable()) m_thread.join();
}

void LiveMachine::catch_up() {
  if (!m_running) return;
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - m_begin;
  m_machine.advance_to(m_paced_from_s + wall.count() * m_pace);
  if (m_on_moment) m_on_moment(m_machine);
}

void LiveMachine::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    {
      const std::scoped_lock lock(m_mutex);
      catch_up();
    }
    std::this_thread::sleep_for(turn);
  }
}

controller::RegisterReply LiveMachine::read(int address, int count) {
  const std::scoped_lock lock(m_mutex);
  catch_up();
  return m_bank.read(address, count);
}

std::optional<controller::ModbusException> LiveMachine::write(int address, std::span<const std::uint16_t> words) {
  const std::scoped_lock lock(m_mutex);
  catch_up();
  return m_bank.write(address, words);
}

std::optional<double> LiveMachine::first_turn_s() {
  const std::scoped_lock lock(m_mutex);
  return m_machine.first_turn_s();
}

CameraScene LiveMachine::scene(View view) {
  const std::scoped_lock lock(m_mutex);
  catch_up();
  return m_machine.scene(view);
}

void LiveMachine::set_sensor_fault(SensorFault fault) {
  const std::scoped_lock lock(m_mutex);
  m_machine.set_sensor_fault(fault);
}

}  // namespace zerodrift::machine
