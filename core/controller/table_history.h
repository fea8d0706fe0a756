#pragma once
// The tables a machine had before, newest last: what the one-key rollback goes back to. One small JSON file for each
// machine (by serial number) in the user's state folder, written before the machine is.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace zerodrift::controller {

struct FormerTable {
  std::string time;  // when it was replaced, UTC
  std::string who;   // by whom: the name of the user of the computer
  int sequence = 0;
  std::vector<std::uint16_t> words;
  std::uint32_t replaced_by_crc = 0;  // of the table that took its place: only from there does one go back to it
};

class TableHistory {
 public:
  explicit TableHistory(std::filesystem::path folder = default_folder()) : m_folder(std::move(folder)) {}
  /// $ZERODRIFT_STATE_DIR, else $XDG_STATE_HOME/zerodrift, else ~/.local/state/zerodrift.
  static std::filesystem::path default_folder();

  /// Who works at this computer.
  static std::string user();

  Result<std::vector<FormerTable>> read(std::uint32_t serial) const;
  Status push(std::uint32_t serial, FormerTable table) const;
  /// Forgets the newest one.
  Status pop(std::uint32_t serial) const;

 private:
  std::filesystem::path file_of(std::uint32_t serial) const;
  Status write(std::uint32_t serial, const std::vector<FormerTable>& tables) const;

  std::filesystem::path m_folder;
};

}  // namespace zerodrift::controller
