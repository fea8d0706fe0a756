#include "fake_controller.h"

#include <gtest/gtest.h>

#include "core/controller/register_map.h"
#include "core/controller/table_words.h"

namespace zerodrift::controller {

void FakeController::reset_state() {
  const std::scoped_lock guard(m_lock);
  std::fill(m_words.begin(), m_words.begin() + 200, std::uint16_t{0});
  for (const auto& [address, value] : std::vector<std::pair<int, int>>{
           {0, 0x5A44}, {1, 1}, {2, 15}, {3, 2000}, {5, 77}, {6, 20}, {16, 4}, {146, 10}, {213, 100}}) {
    m_words[static_cast<std::size_t>(address)] = static_cast<std::uint16_t>(value);
  }
  for (std::size_t i = 96; i < 120; ++i) m_words[i] = 16 * 25;
}

FakeController::FakeController(std::set<int> without_functions) : m_words(6000, 0) {
  reset_state();
  ModbusServerOptions options;
  options.without_functions = std::move(without_functions);
  options.read = [this](int address, int count) -> RegisterReply {
    const std::scoped_lock guard(m_lock);
    tick();
    if (count > m_longest_read) return tl::unexpected(ModbusException::illegal_value);
    if (address + count > 6000) return tl::unexpected(ModbusException::illegal_address);
    return std::vector<std::uint16_t>(m_words.begin() + address, m_words.begin() + address + count);
  };
  options.write = [this](int address, std::span<const std::uint16_t> values) {
    const std::scoped_lock guard(m_lock);
    return write(address, values);
  };
  options.fault = [this](bool) {
    const std::scoped_lock guard(m_lock);
    const int n = m_requests++;
    const bool hit = m_spoil_at >= 0 && (m_lasting ? n >= m_spoil_at : n == m_spoil_at);
    return hit || (m_strikes && m_strikes(n)) ? m_fault : ReplyFault{};
  };
  auto started = ModbusServer::start(std::move(options));
  if (started) m_server = std::move(*started);
  EXPECT_NE(m_server, nullptr);
}

Profile FakeController::profile() const {
  Profile p;
  p.name = "FakeController";
  p.controller.port = m_server->port();
  p.controller.timeout_ms = 60;
  p.time_factor = 20.0;  // an upload waits a machine's second for what is applied
  for (int i = 1; i <= 20; ++i) p.sensors.push_back({"T" + std::to_string(i) + "_C", "", "", {}, 0.1});
  return p;
}

std::vector<std::uint16_t> FakeController::active() const {
  const std::scoped_lock guard(m_lock);
  return {m_words.begin() + 4000, m_words.begin() + 4000 + m_words[210]};
}

std::uint16_t FakeController::word(int address) const {
  const std::scoped_lock guard(m_lock);
  return m_words[static_cast<std::size_t>(address)];
}

void FakeController::set(int address, std::uint16_t value) {
  const std::scoped_lock guard(m_lock);
  m_words[static_cast<std::size_t>(address)] = value;
}

void FakeController::set_float(int address, double value) {
  std::vector<std::uint16_t> words;
  append_float(words, static_cast<float>(value));
  set(address, words[0]);
  set(address + 1, words[1]);
}

double FakeController::float_at(int address) const {
  const std::scoped_lock guard(m_lock);
  return float_unlocked(address);
}

double FakeController::float_unlocked(int address) const {
  return static_cast<double>(controller::float_at(m_words, static_cast<std::size_t>(address)));
}

void FakeController::spoil(int n, ReplyFault fault, bool lasting) {
  const std::scoped_lock guard(m_lock);
  m_fault = fault;
  m_lasting = lasting;
  m_requests = 0;
  m_strikes = {};
  m_spoil_at = n;
}

void FakeController::spoil_where(std::function<bool(int)> strikes, ReplyFault fault) {
  spoil(-1, fault);
  const std::scoped_lock guard(m_lock);
  m_strikes = std::move(strikes);
}

void FakeController::tick() {
  const double speed = m_clock_speed;
  if (speed == 0.0) return;
  const double seconds = speed * std::chrono::duration<double>(std::chrono::steady_clock::now() - m_started).count();
  const auto hundredths = static_cast<std::uint32_t>(100.0 * seconds);
  m_words[8] = static_cast<std::uint16_t>(hundredths >> 16);
  m_words[9] = static_cast<std::uint16_t>(hundredths & 0xFFFF);
}

std::optional<ModbusException> FakeController::write(int address, std::span<const std::uint16_t> values) {
  if (address + values.size() > 3000) return ModbusException::illegal_address;
  if (on_write) {
    if (auto refused = on_write(address, values)) return refused;
  }
  if (address >= 1000 && m_words[17] != 0) return ModbusException::device_failure;
  std::copy(values.begin(), values.end(), m_words.begin() + address);
  if (address == 76) m_words[17] = values[0];
  if (address == 70) m_words[70] = 0;
  if (address == 205) commit();
  if (address == 140) {  // the applied compensation follows at once
    std::copy(m_words.begin() + 140, m_words.begin() + 146, m_words.begin() + 40);
    m_words[147] = 1;
  }
  return std::nullopt;
}

void FakeController::commit() {
  ++m_commits;
  const std::span<const std::uint16_t> staged(m_words.data() + 1000, std::min<std::size_t>(m_words[200], 2000));
  const std::uint32_t crc = crc_of_words(staged);
  int reason = 0;
  if (m_words[17] != 0) reason = 5;
  if (crc != (static_cast<std::uint32_t>(m_words[202]) << 16 | m_words[203])) reason = 1;
  if (m_words[204] == 0 || m_words[204] != m_words[205]) reason = 8;
  m_words[205] = 0;
  m_words[206] = reason == 0 ? 3 : 4;
  m_words[207] = m_words[204];
  m_words[212] = static_cast<std::uint16_t>(reason);
  if (reason != 0) return;
  std::copy(staged.begin(), staged.end(), m_words.begin() + 4000);
  m_words[208] = static_cast<std::uint16_t>(crc >> 16);
  m_words[209] = static_cast<std::uint16_t>(crc & 0xFFFF);
  m_words[210] = m_words[200];
  m_words[211] = m_words[204];
}

}  // namespace zerodrift::controller
