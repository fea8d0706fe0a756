#pragma once
// A table into a control without a link: it leaves as a file, a person loads it and reads off the control's check
// value. The switch is off meanwhile. What cannot be confirmed is not switched on.

#include <functional>
#include <string>

#include "core/controller/devices/manual_control.h"
#include "core/controller/upload.h"

namespace zerodrift::controller {

struct ManualUploadOptions {
  bool dry_run = false;
  std::string file;  // that the table is written to
  std::function<void(const UploadStep&)> observer = {};
  /// What is active now, as far as is known: the table that was loaded last.
  std::vector<std::uint16_t> old_words = {};
  int old_sequence = 0;
};

/// `table` gets its version. The record's crc is the check value.
UploadRecord upload_by_hand(ManualControl& control, compensation::Table& table, const ManualUploadOptions& options,
                            const TaskContext& context);

/// The check value of a table, as it stands in its file.
std::string check_value(const compensation::Table& table);

}  // namespace zerodrift::controller
