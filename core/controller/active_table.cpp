#include "core/controller/active_table.h"

#include <algorithm>

#include "core/controller/table_words.h"

namespace zerodrift::controller {
namespace {

constexpr std::size_t empty_table_words = 2;  // version of the layout, number of axes: 0

}  // namespace

Result<ActiveTable> read_active(ModbusMachine& machine) {
  ZD_TRY(const RegisterValues values,
         machine.read_values({"table_active_crc", "table_active_count", "table_active_sequence"}));
  ActiveTable active;
  active.crc = static_cast<std::uint32_t>(values.at("table_active_crc").front());
  active.sequence = static_cast<int>(values.at("table_active_sequence").front());
  const int count = static_cast<int>(values.at("table_active_count").front());
  if (count == 0) return active;
  ZD_TRY(active.words, machine.read_words("table_active", count));
  if (crc_of_words(active.words) != active.crc) {
    return fail(ErrorCode::machine_bad_reply, {{"what", "active table"}, {"detail", "its check sum does not fit"}});
  }
  return active;
}
bool same_table(std::span<const std::uint16_t> one, std::span<const std::uint16_t> other) {
  if (one.size() <= empty_table_words && other.size() <= empty_table_words) return true;
  return std::equal(one.begin(), one.end(), other.begin(), other.end());
}

}  // namespace zerodrift::controller
