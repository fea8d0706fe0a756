#pragma once
// A disk that forgets: stands between the database and the files, writes down every write, and can say what a disk may
// hold after the power went at any moment - everything up to a file's last flush, and of what came after any part, a
// sector torn in the middle included. It can also be full, or gone, from any write on.

#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace zerodrift::commissioning {

class CrashDisk {
 public:
  /// One at a time: while it lives the database library uses it for every file.
  CrashDisk();
  ~CrashDisk();
  CrashDisk(const CrashDisk&) = delete;
  CrashDisk& operator=(const CrashDisk&) = delete;

  /// From the n-th write from now on (0: the next) every write fails with this code: SQLITE_FULL, SQLITE_IOERR_WRITE.
  void fail_writes_from(long n, int code);
  void heal();
  /// Writes until now, of all files together.
  long writes() const;
  /// What happened until now; a moment to be remembered with something that was acknowledged.
  std::size_t moment() const;
  /// The files as they may be after the power went at that moment, written into the folder under their names.
  void after_power_cut(std::size_t moment, std::mt19937& dice, const std::filesystem::path& folder) const;
};

}  // namespace zerodrift::commissioning
