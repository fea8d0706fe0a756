#pragma once
// A person at a control without a link: what is asked of them and what they answer. The window shows a question, the
// command line a dialogue or lines of JSON; a test answers by itself.

#include <array>
#include <map>
#include <optional>
#include <string>

#include "core/base/result.h"

namespace zerodrift::controller {

enum class OperatorAct {
  state,                // say whether the compensation is on
  command,              // spindle, coolant, warm-up path
  move,                 // stop the path and move to the target
  switch_compensation,  // on or off
  offset,               // enter a compensation for each axis, um
  load_table,           // load the file, switch nothing, and read off the control's check value
  check_table,          // read off the check value of the table that is active
};
std::string_view name_of(OperatorAct act);

struct OperatorRequest {
  OperatorAct act = OperatorAct::state;
  double spindle_rpm = 0.0;
  bool coolant_on = false;
  bool path_cycle = false;
  std::map<std::string, double> target_mm = {};
  bool compensation_on = false;
  std::array<double, 3> offset_um{};
  std::string file = {};  // of the table
};

struct OperatorAnswer {
  std::optional<bool> compensation_on;  // to state
  std::string check;                    // to load_table and check_table
};

class Operator {
 public:
  virtual ~Operator() = default;
  /// Returns when it is done. operator_declined when the person says that it cannot be done, operator_gone when nobody
  /// answers any more.
  virtual Result<OperatorAnswer> ask(const OperatorRequest& request) = 0;
};

}  // namespace zerodrift::controller
