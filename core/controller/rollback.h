#pragma once
// Uploads that can be taken back, the same for the window and the command line: everything that becomes active goes
// into the machine's log (table_log.h), and any table in it can be brought back through the same transaction.

#include <optional>
#include <string>

#include "core/controller/table_history.h"
#include "core/controller/upload.h"

namespace zerodrift::controller {

/// upload_table with the log kept: what was active before, what is written, and how that ended. `options`' own keep_old
/// is replaced.
UploadRecord push_table(ModbusMachine& machine, const compensation::Table& table, TableOrigin origin,
                        UploadOptions options, const TaskContext& context,
                        const TableHistory& history = TableHistory());

/// Which table to go back to; without either the one before the active one (before_last).
struct RollbackChoice {
  std::optional<int> version;  // the newest table of this number
  std::string id;              // of the entry
};

struct RollbackTarget {
  TableEntry table;
  ActiveTable active;  // what it takes the place of
};

/// not_enough_data without a former table; data_does_not_fit when nothing was chosen and the active table was not
/// written from here; bad_argument for a version that is not there, or is active.
Result<RollbackTarget> rollback_target(ModbusMachine& machine, const RollbackChoice& choice = {},
                                       const TableHistory& history = TableHistory());

/// Writes the target's table as a new version. The switch is left as it was found. Refused when another table has
/// become active since the target was chosen.
UploadRecord roll_back(ModbusMachine& machine, const RollbackTarget& target, UploadOptions options,
                       const TaskContext& context, const TableHistory& history = TableHistory());

}  // namespace zerodrift::controller
