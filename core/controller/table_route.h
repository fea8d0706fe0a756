#pragma once
// How a table gets into a control: the strategy of the upload transaction (upload.h), over the control's link or by the
// hands of a person. The transaction checks, compares, switches and keeps the record; a route does what only it can.

#include <functional>
#include <string>
#include <vector>

#include "core/controller/upload.h"

namespace zerodrift::controller {

/// A transaction under way, as its route sees it.
struct UploadAttempt {
  UploadRecord& record;
  const UploadOptions& options;
  const TaskContext& context;
  std::function<void(UploadState state, std::string detail)> enter;
  bool was_on = false;  // the switch, before
};

class TableRoute {
 public:
  virtual ~TableRoute() = default;
  virtual acquisition::MachineIo& machine() = 0;
  virtual const Profile& profile() const = 0;
  /// In registers.
  virtual int capacity(const acquisition::MachineIdentity& identity) const = 0;
  virtual Status ready(const acquisition::MachineSample& sample) = 0;
  /// The old table and the version of the new one, into the record.
  virtual Status save_old(UploadRecord& record) = 0;
  /// By what the control shows that it has the record's new table.
  virtual std::uint32_t check_value(const UploadRecord& record) const = 0;
  /// Before the switch goes off.
  virtual Status prepare(UploadAttempt& attempt) = 0;
  /// With the switch off: the new table is active, and proved to be, when this is done.
  virtual Status transfer(UploadAttempt& attempt) = 0;
  /// After the first act that failed; how the upload ends.
  virtual Status undo(UploadAttempt& attempt, const Error& reason) = 0;
};

/// Given the capacity.
using MakeWords = std::function<Result<std::vector<std::uint16_t>>(int)>;
/// The whole transaction; `table` is null for words that were saved before.
UploadRecord run_upload(TableRoute& route, const MakeWords& make_words, const compensation::Table* table,
                        const UploadOptions& options, const TaskContext& context);

}  // namespace zerodrift::controller
