#pragma once
// Uncertainty budgets by GUM (JCGM 100:2008) for tests of thermal effects, contributions as in ISO/TR 230-9:2005.
// Environment is not among them: how the machine follows its room is part of what is measured.

#include <map>
#include <string>
#include <vector>

#include "core/report/source.h"

namespace zerodrift::report {

inline constexpr double coverage_factor = 2.0;  // of the expanded uncertainty, about 95 %

struct Contribution {
  std::string id;                      // "camera"
  std::string what;                    // in the reader's language
  std::string basis;                   // what the figure rests on
  char type = 'B';                     // GUM: A from statistics, B from other knowledge
  std::map<std::string, double> u_um;  // standard uncertainty by direction
  Trace trace{};
};

struct Budget {
  std::vector<Contribution> parts;
  std::map<std::string, double> combined_um() const;
};

/// Of the measured error, at the largest drift of the run. Empty when the errors were not measured with cameras.
Budget budget_of_measurement(const Source& source);
/// Of the position with the compensation on: the measurement, the sensors, the model.
Budget budget_of_compensation(const Source& source);

}  // namespace zerodrift::report
