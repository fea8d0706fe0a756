#pragma once
// The upload transaction (C5). A table is never half active: staged, read back, committed under a sequence number and a
// check sum, and the active copy is compared register by register. A step that fails restores the old table; a restore
// that fails says so. A commit is never repeated without reading the status first.

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/clock.h"
#include "core/base/result.h"
#include "core/base/task_context.h"
#include "core/compensation/table.h"
#include "core/controller/active_table.h"
#include "core/controller/modbus_machine.h"

namespace zerodrift::controller {

enum class UploadState {
  checking,    // machine ready, table fits machine and limits
  saving_old,  // the active table is read and kept
  switching_off,
  staging,
  reading_back,
  announcing,  // count, scale, CRC, sequence
  committing,
  waiting,    // for the controller's check
  comparing,  // the active copy
  switching_on,
  ramping,
  done,
  restoring,
  restored,
  restore_failed,
};
std::string_view name_of(UploadState state);  // "reading_back"

struct UploadStep {
  UploadState state = UploadState::checking;
  UtcTime time;
  std::string detail;
};

struct UploadRecord;

enum class Activation {
  on,         // the switch is on afterwards
  as_before,  // as it was found
  off,
};

struct UploadOptions {
  bool dry_run = false;  // read and compare only; nothing is written, not even the switch
  Activation activation = Activation::on;
  bool check_machine_name = true;
  std::function<void(const UploadStep&)> observer;
  /// Called with the old and the new words in the record before anything is written; an error stops the upload.
  std::function<Status(const UploadRecord&)> keep_old;
};

/// What was done, for the audit trail.
struct UploadRecord {
  UtcTime started;
  std::string machine;
  std::uint32_t serial = 0;
  bool dry_run = false;
  std::vector<std::uint16_t> old_words;
  std::vector<std::uint16_t> new_words;
  int old_sequence = 0;
  int sequence = 0;  // of the new table; the version the controller shows
  std::uint32_t crc = 0;
  std::optional<int> restored_sequence;  // the old table had to be written again: the version it has since
  compensation::Table old_table;
  std::vector<compensation::AxisDifference> difference;  // compensations at the present temperatures
  std::vector<std::string> warnings;
  std::vector<UploadStep> steps;
  UploadState reached = UploadState::checking;  // done, restored, restore_failed, or where it was refused
  Status result;
};
nlohmann::json to_json(const UploadRecord& record);

/// The difference at the present temperatures into the record, and the machine's limits for it: no axis may jump by
/// more than it takes, no term be steeper.
Status compare_tables(UploadRecord& record, const Profile& profile, const acquisition::MachineSample& sample);
/// Is `table` too steep, and is the machine inside the range it was made in? The latter is a warning.
Status check_for_machine(UploadRecord& record, const compensation::Table& table, const Profile& profile,
                         const acquisition::MachineSample& sample);

/// Does the whole transaction; the record's result tells how it ended.
UploadRecord upload_table(ModbusMachine& machine, const compensation::Table& table, const UploadOptions& options,
                          const TaskContext& context);
/// The same with words saved before: rollback.
UploadRecord upload_words(ModbusMachine& machine, std::vector<std::uint16_t> words, const UploadOptions& options,
                          const TaskContext& context);

}  // namespace zerodrift::controller
