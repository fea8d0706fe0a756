#pragma once
// Uploads that can be taken back, the same for the window and the command line: the table a push replaces goes into the
// history before the machine is touched, and a rollback brings it back if the active table is still the one that was
// pushed.

#include "core/controller/table_history.h"
#include "core/controller/upload.h"

namespace zerodrift::controller {

/// upload_table with the old table kept in the history; forgotten again when the old one is active still. `options`'
/// own keep_old is replaced.
UploadRecord push_table(ModbusMachine& machine, const compensation::Table& table, UploadOptions options,
                        const TaskContext& context, const TableHistory& history = TableHistory());

/// What a rollback would bring back. not_enough_data without a former table; data_does_not_fit when the active table
/// was not written from here.
Result<FormerTable> former_table(ModbusMachine& machine, const TableHistory& history = TableHistory());

/// Writes the former table and, when that is done (and no dry run), takes it off the history. The switch is left as it
/// was found.
UploadRecord roll_back(ModbusMachine& machine, const FormerTable& former, UploadOptions options,
                       const TaskContext& context, const TableHistory& history = TableHistory());

}  // namespace zerodrift::controller
