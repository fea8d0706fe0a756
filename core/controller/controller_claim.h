#pragma once
// A controller has one owner among the programs of this computer: who may write to it claims its address, and who comes
// second is refused by the owner's process number. Reading claims nothing. The claim is a socket bound to a name in the
// system's abstract name space: no file that could be left behind, the same for every user, and gone with the process
// however that ends. Not of a serial line: its port has one owner already (serial_line.h).

#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/controller/profile.h"

namespace zerodrift::controller {

class ControllerClaim {
 public:
  /// All connections of this program share it; it is given back when the last of them ends. machine_not_ready naming
  /// the process that has it. Nothing is claimed over a serial line.
  static Result<std::unique_ptr<ControllerClaim>> take(const ControllerSettings& settings);
  ~ControllerClaim();
  ControllerClaim(const ControllerClaim&) = delete;
  ControllerClaim& operator=(const ControllerClaim&) = delete;

 private:
  ControllerClaim() = default;
  std::vector<std::string> m_names;  // one for each address that the host's name has
};

}  // namespace zerodrift::controller
