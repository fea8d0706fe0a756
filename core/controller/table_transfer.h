#pragma once
// One table's way into the controller: staged, read back, announced, committed, and the active copy compared. Part of
// the upload transaction (upload.h), which uses it for the new table and, when something fails, for the old one.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/task_context.h"
#include "core/controller/active_table.h"
#include "core/controller/upload.h"

namespace zerodrift::controller {

/// What the controller tells of the last commit.
struct TableStatus {
  int commit = 0;  // not taken up yet when above 0
  int status = 0;
  int sequence = 0;
  int reason = 0;  // of a rejection
};
Result<TableStatus> read_table_status(ModbusMachine& machine);

/// After a commit that ended in doubt: waits until the controller has finished its check before judging.
Result<ActiveTable> settled_active(ModbusMachine& machine);

class TableTransfer {
 public:
  using Enter = std::function<void(UploadState state, std::string detail)>;

  TableTransfer(ModbusMachine& machine, const std::vector<std::uint16_t>& words, int sequence, Enter enter)
      : m_machine(machine), m_words(words), m_sequence(sequence), m_enter(std::move(enter)) {}

  Status run(const TaskContext& context);
  /// From the commit on the controller may have taken it, whatever the link says.
  bool committed() const { return m_committed; }

 private:
  Status compare_staging();
  Status announce();
  Status commit();
  Status wait_for_check();

  ModbusMachine& m_machine;
  const std::vector<std::uint16_t>& m_words;
  int m_sequence;
  Enter m_enter;
  bool m_committed = false;
};

}  // namespace zerodrift::controller
