#pragma once
// The decoded value of every register of a map, read as it is: for the editor and the command line. A register that
// cannot be read says why and does not keep the others from being read. Reads only.

#include <string>
#include <vector>

#include "core/controller/link.h"
#include "core/controller/register_map.h"

namespace zerodrift::controller {

struct RegisterValue {
  std::string name;
  std::vector<double> values;  // of a long one only the first; NaN where there is no value
  std::string raw;             // the words as they came, in hex
  Status result;
};

/// In the map's order of addresses. A lost connection ends it: everything after has the same error.
std::vector<RegisterValue> read_all(Link& link, const RegisterMap& map, int most_values = 8);
/// "21.06", "0.000, 0.000, 0.000", "no value", "1, 2, 3, ... (2000)".
std::string text_of(const RegisterValue& value, const Register& entry);

}  // namespace zerodrift::controller
