#pragma once
// The table transaction of the controller: staging area, commit, check, active table (docs/register-map.md).

#include <cstdint>
#include <optional>
#include <vector>

#include "app/machine/compensator.h"

namespace zerodrift::machine {

inline constexpr int table_capacity = 2000;

enum class TableStatus : std::uint16_t {
  idle = 0,
  staging = 1,
  checking = 2,
  active = 3,
  rejected = 4,
};

class TableStore {
 public:
  TableStore();

  void stage(int index, std::uint16_t word);
  void commit(std::uint16_t sequence);
  /// Carries out a commit a moment after it was asked for.
  void advance(double duration_s, Compensator& compensator, const Motion& motion,
               const TableTemperatures& temperature_C);

  std::uint16_t staged(int index) const { return m_staging[index]; }
  std::uint16_t active(int index) const { return index < static_cast<int>(m_active.size()) ? m_active[index] : 0; }
  int active_count() const { return static_cast<int>(m_active.size()); }
  std::uint32_t active_crc() const { return m_active_crc; }
  std::uint16_t active_sequence() const { return m_active_sequence; }
  TableStatus status() const { return m_status; }
  std::uint16_t status_sequence() const { return m_status_sequence; }
  Rejection reason() const { return m_reason; }
  std::uint16_t pending() const { return m_pending.value_or(0); }

  std::uint16_t count = 0;
  std::uint16_t scale = 1000;
  std::uint32_t crc = 0;
  std::uint16_t sequence = 0;

 private:
  Rejection check(const Compensator& compensator, const Motion& motion, const TableTemperatures& temperature_C,
                  CompensationTable& table) const;

  std::vector<std::uint16_t> m_staging;
  std::vector<std::uint16_t> m_active;
  std::uint32_t m_active_crc = 0;
  std::uint16_t m_active_sequence = 0;
  TableStatus m_status = TableStatus::idle;
  std::uint16_t m_status_sequence = 0;
  Rejection m_reason = Rejection::none;
  std::optional<std::uint16_t> m_pending;
  double m_wait_s = 0.0;
};

}  // namespace zerodrift::machine
