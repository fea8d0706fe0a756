#pragma once
// Everything that was ever active in a machine's controller, in the order in which it became active, and how it is
// kept: lines of JSON that are only ever added to. A line says that a table is about to be written, how that ended, or
// that a table was found; read one after the other they give the log. Nothing is taken out: going back is an entry too.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/controller/active_table.h"

namespace zerodrift::controller {

/// How a table came to be active.
enum class TableOrigin {
  found,       // it was in the controller: written from elsewhere, or before there was a log
  upload,      // of a model's table
  correction,  // of a verification
  rollback,
  restored,  // after an upload that failed
};
std::string_view name_of(TableOrigin origin);  // "rollback"

struct TableEntry {
  std::string id{};    // unique in the log
  std::string time{};  // UTC, when it became active; of a found one, when it was seen first; "" when nobody knows
  std::string who{};   // the name of the user of the computer; "" when nobody knows
  TableOrigin origin = TableOrigin::found;
  int version = 0;  // the controller's sequence number
  std::uint32_t crc = 0;
  std::optional<std::vector<std::uint16_t>> words{};  // nothing: only its check sum was kept
  std::string of{};                                   // id of the entry whose table it is: brought back, found again
  std::string note{};                                 // why it was restored
  /// Writing it began here and nobody saw how that ended: the machine tells at the next look.
  bool unsettled = false;
};

struct TableLog {
  std::vector<TableEntry> entries;  // oldest first
  int damaged_lines = 0;            // left out

  const TableEntry* find(std::string_view id) const;
};

bool holds(const TableEntry& entry, const ActiveTable& active);

/// The log with the machine as it is now: open ends are settled, and a table that is not the last one is added as
/// found. The last entry is the active one then.
TableLog with_active(TableLog log, const ActiveTable& active, const std::string& now_utc);

/// What one goes back to when nothing else is asked for: the table that was active before the last entry's. Going back
/// twice is two tables back, not here and there, since an entry that brought a table back stands for that table. Null
/// when there is none, and when the last one was found: what was before something from elsewhere is no safe guess.
const TableEntry* before_last(const TableLog& log);

/// What another keeper of the same machine's tables has and this log has not; and the log with it, each at its time.
std::vector<TableEntry> missing_in(const TableLog& log, const std::vector<TableEntry>& others);
TableLog with_missing(TableLog log, const std::vector<TableEntry>& others);

// The lines.
std::string line_of_head(std::uint32_t serial);
std::string line_of_begin(const TableEntry& entry);
std::string line_of_end(const std::string& id, bool active, const std::string& now_utc);
/// `adopted`: it takes its place by its time, not at the end.
std::string line_of_entry(const TableEntry& entry, bool adopted = false);
/// No table, and no entry therefore: who switched the compensation.
std::string line_of_switch(bool on, const std::string& who, const std::string& now_utc);
/// Lines that cannot be read are counted and left out; a newer format is refused.
Result<TableLog> log_from_lines(std::string_view text, const std::string& file);
/// The first format: a stack of the tables before the active one, each with when and by whom it was replaced.
Result<TableLog> log_from_stack(const nlohmann::json& document, const std::string& file);

}  // namespace zerodrift::controller
