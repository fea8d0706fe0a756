#pragma once
// Where the log of a machine's tables (table_log.h) is kept: one file for each machine, by serial number, in the user's
// state folder. It is added to before the machine is written, so that a table that is active is never unknown here.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/controller/table_log.h"

namespace zerodrift::controller {

class TableHistory {
 public:
  explicit TableHistory(std::filesystem::path folder = default_folder()) : m_folder(std::move(folder)) {}
  /// $ZERODRIFT_STATE_DIR, else $XDG_STATE_HOME/zerodrift, else ~/.local/state/zerodrift.
  static std::filesystem::path default_folder();

  /// Who works at this computer.
  static std::string user();

  /// Empty where nothing was ever written. A stack of the first format is read as the log it tells of.
  Result<TableLog> read(std::uint32_t serial) const;
  /// Brings the file in line with the machine and returns the log; its last entry is the active table.
  Result<TableLog> note_active(std::uint32_t serial, const ActiveTable& active) const;
  /// A table is about to be written; gives the entry its id.
  Status begin(std::uint32_t serial, TableEntry& entry) const;
  /// How that ended.
  Status end(std::uint32_t serial, const std::string& id, bool active) const;
  Status add(std::uint32_t serial, TableEntry entry) const;
  /// The compensation is about to be switched outside of any job.
  Status note_switch(std::uint32_t serial, bool on) const;
  /// Entries that another keeper has, a job file from another computer for example, take their place by their time.
  Status adopt(std::uint32_t serial, const std::vector<TableEntry>& entries) const;

 private:
  std::filesystem::path log_file(std::uint32_t serial) const;
  std::filesystem::path stack_file(std::uint32_t serial) const;
  Status append(std::uint32_t serial, const std::vector<std::string>& lines) const;
  Status start_log(std::uint32_t serial) const;

  std::filesystem::path m_folder;
};

}  // namespace zerodrift::controller
