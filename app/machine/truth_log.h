#pragma once
// What the machine truly does, as a CSV for judging (docs/virtual-machine.md lists the columns). Rows are appended as
// the machine's time passes, every two machine seconds, and flushed about once a second of wall time.

#include <chrono>
#include <filesystem>
#include <fstream>

#include "app/machine/machine.h"
#include "core/base/result.h"

namespace zerodrift::machine {

class TruthLog {
 public:
  Status open(const std::filesystem::path& path);
  /// Writes a row if one is due.
  void moment(const Machine& machine);
  void close();

 private:
  std::ofstream m_file;
  double m_next_s = 0.0;
  std::chrono::steady_clock::time_point m_flushed{};
};

}  // namespace zerodrift::machine
