#pragma once
// The pace of the clock from standard input: whoever started the machine names it, a whole number a line, in machine
// seconds a second of wall time. So a machine that is only looked at need not go through hours while somebody reads.

#include <chrono>
#include <optional>
#include <string>

namespace zerodrift::machine {

class PaceInput {
 public:
  /// Reads this file; -1: nobody names a pace.
  explicit PaceInput(int file) : m_file(file) {}
  /// Waits so long, or until a line has come: the pace it names. What is no pace from 1 to `fastest` is passed over.
  std::optional<int> wait(std::chrono::milliseconds time, int fastest);

 private:
  int m_file;
  std::string m_begun;  // of a line
};

}  // namespace zerodrift::machine
