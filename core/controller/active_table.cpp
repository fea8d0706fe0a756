#include "core/controller/active_table.h"

#include <algorithm>

#include "core/controller/table_words.h"

namespace zerodrift::controller {
namespace {

constexpr std::size_t empty_table_words = 2;  // version of the layout, number of axes: 0

}  // namespace

Status require_table(const acquisition::MachineIdentity& identity) {
  if (identity.accepts_table) return {};
  return fail(ErrorCode::machine_unsupported,
              {{"what", "the controller's table"}, {"found", "none"}, {"expected", "a table it computes itself"}});
}

Result<ActiveMark> read_active_mark(ModbusMachine& machine) {
  ZD_TRY(const RegisterValues values,
         machine.read_values({"table_active_crc", "table_active_count", "table_active_sequence"}));
  ActiveMark mark;
  mark.crc = static_cast<std::uint32_t>(values.at("table_active_crc").front());
  mark.registers = static_cast<int>(values.at("table_active_count").front());
  mark.sequence = static_cast<int>(values.at("table_active_sequence").front());
  return mark;
}

Result<ActiveTable> read_active(ModbusMachine& machine) {
  ZD_TRY(const ActiveMark mark, read_active_mark(machine));
  ActiveTable active;
  active.crc = mark.crc;
  active.sequence = mark.sequence;
  if (mark.registers == 0) return active;
  ZD_TRY(active.words, machine.read_words("table_active", mark.registers));
  if (crc_of_words(active.words) != active.crc) {
    return fail(ErrorCode::machine_bad_reply, {{"what", "active table"}, {"detail", "its check sum does not fit"}});
  }
  return active;
}

bool is_empty_table(std::size_t words) {
  return words <= empty_table_words;
}

bool is_marked(const ActiveMark& mark, std::span<const std::uint16_t> words) {
  const auto registers = static_cast<std::size_t>(mark.registers);
  if (is_empty_table(registers) || is_empty_table(words.size())) {
    return is_empty_table(registers) && is_empty_table(words.size());
  }
  return registers == words.size() && mark.crc == crc_of_words(words);
}

bool same_table(std::span<const std::uint16_t> one, std::span<const std::uint16_t> other) {
  if (is_empty_table(one.size()) && is_empty_table(other.size())) return true;
  return std::equal(one.begin(), one.end(), other.begin(), other.end());
}

}  // namespace zerodrift::controller
