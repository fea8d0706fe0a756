#pragma once
// A serial line without wires: a pseudo terminal whose other end a host opens as its serial port. Bytes arrive at once,
// whatever the baud rate; a request ends where the line is silent.

#include <memory>
#include <string>
#include <thread>

#include "app/machine/rig/rtu_units.h"

namespace zerodrift::machine {

class SerialLine {
 public:
  /// Serves until destroyed; file_not_writable when the system gives no pseudo terminal.
  static Result<std::unique_ptr<SerialLine>> open(RtuUnits units);
  ~SerialLine();
  SerialLine(const SerialLine&) = delete;
  SerialLine& operator=(const SerialLine&) = delete;

  /// What a host opens, "/dev/pts/5".
  const std::string& path() const { return m_path; }

 private:
  explicit SerialLine(RtuUnits units) : m_units(std::move(units)) {}
  Status open_ends();
  void serve(const std::stop_token& stop) const;

  RtuUnits m_units;
  std::string m_path;
  int m_own_end = -1;
  int m_other_end = -1;  // held open: the line outlives the hosts that come and go
  std::jthread m_thread;
};

}  // namespace zerodrift::machine
