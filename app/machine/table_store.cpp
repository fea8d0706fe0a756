#include "app/machine/table_store.h"

#include <cmath>
#include <string>

#include "core/base/hash.h"

namespace zerodrift::machine {
namespace {

constexpr double check_s = 0.3;
constexpr std::uint16_t nanometres_per_unit = 1000;

std::uint32_t crc_of(std::span<const std::uint16_t> words) {
  std::string bytes;
  for (const std::uint16_t word : words) {
    bytes += static_cast<char>(word >> 8U);
    bytes += static_cast<char>(word & 0xFFU);
  }
  return crc32_of(bytes);
}

}  // namespace

TableStore::TableStore() : m_staging(table_capacity, 0), m_active{1, 0}, m_active_crc(crc_of(m_active)) {}

void TableStore::stage(int index, std::uint16_t word) {
  m_staging[index] = word;
  if (m_status != TableStatus::checking) {
    m_status = TableStatus::staging;
    m_reason = Rejection::none;
  }
}

void TableStore::commit(std::uint16_t asked) {
  m_pending = asked;
  m_wait_s = check_s;
  m_status = TableStatus::checking;
  m_status_sequence = asked;
  m_reason = Rejection::none;
}

Rejection TableStore::check(const Compensator& compensator, const Motion& motion,
                            const TableTemperatures& temperature_C, CompensationTable& table) const {
  if (compensator.is_on()) return Rejection::switch_on;
  if (motion.moving() || motion.cycling()) return Rejection::axes_move;
  if (*m_pending == 0 || *m_pending != sequence) return Rejection::sequence;
  if (scale != nanometres_per_unit) return Rejection::scale;
  if (count < 2 || count > table_capacity) return Rejection::count;
  const auto words = std::span(m_staging).first(count);
  if (crc_of(words) != crc) return Rejection::crc;
  auto decoded = decode_table(words);
  if (!decoded) return decoded.error();
  table = std::move(*decoded);
  const Axes before = Compensator::asked_um(compensator.table(), motion, temperature_C);
  const Axes after = Compensator::asked_um(table, motion, temperature_C);
  for (int axis = 0; axis < linear_axes; ++axis) {
    if (std::abs(after[axis] - before[axis]) > largest_compensation_um) return Rejection::limit;
  }
  return Rejection::none;
}

void TableStore::advance(double duration_s, Compensator& compensator, const Motion& motion,
                         const TableTemperatures& temperature_C) {
  if (!m_pending) return;
  m_wait_s -= duration_s;
  if (m_wait_s > 0.0) return;
  CompensationTable table;
  m_reason = check(compensator, motion, temperature_C, table);
  if (m_reason == Rejection::none) {
    compensator.activate(std::move(table));
    m_active.assign(m_staging.begin(), m_staging.begin() + count);
    m_active_crc = crc;
    m_active_sequence = sequence;
  }
  m_status = m_reason == Rejection::none ? TableStatus::active : TableStatus::rejected;
  m_pending.reset();
}

}  // namespace zerodrift::machine
