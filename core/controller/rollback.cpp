#include "core/controller/rollback.h"

#include <fmt/format.h>

#include "core/base/time_text.h"
#include "core/controller/table_words.h"

namespace zerodrift::controller {

UploadRecord push_table(ModbusMachine& machine, const compensation::Table& table, UploadOptions options,
                        const TaskContext& context, const TableHistory& history) {
  bool kept = false;
  options.keep_old = [&](const UploadRecord& record) {
    kept = true;
    return history.push(record.serial, {to_text(record.started), TableHistory::user(), record.old_sequence,
                                        record.old_words, record.crc});
  };
  UploadRecord done = upload_table(machine, table, options, context);
  // The old table is active still: there is nothing to go back from.
  if (kept && !done.result && done.reached != UploadState::restore_failed) {
    if (const Status popped = history.pop(done.serial); !popped) done.warnings.push_back(describe(popped.error()));
  }
  return done;
}

Result<FormerTable> former_table(ModbusMachine& machine, const TableHistory& history) {
  ZD_TRY(const auto identity, machine.identify());
  ZD_TRY(const auto former, history.read(identity.serial));
  if (former.empty()) {
    return fail(
        ErrorCode::not_enough_data,
        {{"what", fmt::format("former tables of machine {}", identity.serial)}, {"found", "0"}, {"needed", "1"}});
  }
  ZD_TRY(const ActiveTable active, read_active(machine));
  const FormerTable& last = former.back();
  const bool interrupted = active.words == last.words;  // a rollback that was not taken off the history
  if (!interrupted && crc_of_words(active.words) != last.replaced_by_crc) {
    return fail(ErrorCode::data_does_not_fit,
                {{"what", "the active table"},
                 {"found", fmt::format("version {}, not written from here", active.sequence)},
                 {"expected", "the table that was pushed last"}});
  }
  return last;
}

UploadRecord roll_back(ModbusMachine& machine, const FormerTable& former, UploadOptions options,
                       const TaskContext& context, const TableHistory& history) {
  options.activation = Activation::as_before;
  UploadRecord record = upload_words(machine, former.words, options, context);
  if (!record.result || options.dry_run) return record;
  if (const Status popped = history.pop(record.serial); !popped) record.result = popped;
  return record;
}

}  // namespace zerodrift::controller
