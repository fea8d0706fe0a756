#pragma once
// Step "upload" (C5): the model's table into the controller as a transaction, after the sign check, with everything
// that is written put into the audit trail before and after. Makes the artefact "upload":
//   {"table": {...zerodrift-table/1...}, "kind": "upload" | "correction" | "rollback", "version", "crc32", "registers",
//   "largest_change_um",
//    "difference": [{what, old, new}], "states": [{state, at_s, detail}], "sign_check": {...} | null, "record": {...}}

#include <functional>
#include <optional>

#include "core/base/task_context.h"
#include "core/commissioning/job.h"
#include "core/controller/sign_check.h"
#include "core/controller/table_log.h"
#include "core/controller/upload.h"
#include "core/flow/devices.h"
#include "core/flow/machine_write.h"

namespace zerodrift::flow {

struct UploadPreview {
  compensation::Table table;
  controller::UploadRecord record;  // a dry run: old table, difference, warnings
  double largest_change_um = 0.0;
  std::string largest_change_axis;
  std::string model_outdated_by;  // "sensors", "warmup": made anew since the model was fitted; empty otherwise

  /// The largest change and its axis, from the record's difference.
  void note_largest();
};

struct UploadStepOptions {
  Consent consent;  // asked with the difference before anything is written
  std::function<void(const controller::UploadStep&)> observer;
  std::function<void(const controller::SignCheckRecord&)> sign_observer;
  bool sign_check = true;
  /// A check that passed on this machine a short while ago: it stands for the one before the upload.
  std::optional<controller::SignCheckRecord> checked_signs;
  std::optional<compensation::Table> table;  // instead of the model's: a correction
};

/// [{what, old, new}]: terms, offsets and points of both tables.
nlohmann::json table_difference(const compensation::Table& old_table, const compensation::Table& new_table);

/// The artefact's body for a transaction that is done; `table` with the version it has now.
nlohmann::json upload_body(const controller::UploadRecord& record, const compensation::Table& table,
                           controller::TableOrigin origin);

/// What this job wrote into the machine of this serial number, for a log that does not have it: the job may come from
/// another computer, or be older than the log.
std::vector<controller::TableEntry> tables_of(const commissioning::Job& job, std::uint32_t serial);

/// What would be written, against what is there; writes nothing. data_does_not_fit when another machine is connected.
Result<UploadPreview> preview_upload(const commissioning::Job& job, Devices& devices,
                                     const std::optional<compensation::Table>& table, const TaskContext& context);

/// Moves each axis by a small offset and watches it, as a part of `write`.
Result<controller::SignCheckRecord> watch_signs(const commissioning::Job& job, Devices& devices,
                                                const MachineWrite& write, const TaskContext& context);

Result<commissioning::NewArtefact> upload(commissioning::Job& job, Devices& devices, const UploadStepOptions& options,
                                          const TaskContext& context);

}  // namespace zerodrift::flow
