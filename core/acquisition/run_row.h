#pragma once
// From a machine reading to a row of the recording: which channels a run has, in the contract's names, and their
// values. Beside the contract's channels there are free inputs "sigma_<axis>_nm", the standard uncertainty of each
// error, and in a compensated run "compensation_on" and "applied_<axis>_nm", what the controller applies (nm: "_um"
// would be an error).

#include <string>
#include <vector>

#include "core/acquisition/error_source.h"
#include "core/acquisition/machine_io.h"

namespace zerodrift::acquisition {

class RowLayout {
 public:
  RowLayout(const MachineIdentity& identity, const MachineSample& first, bool with_compensation);

  const std::vector<std::string>& channels() const { return m_channels; }
  /// Without an error sample its channels are missing (NaN).
  std::vector<double> row(const MachineSample& sample, const ErrorSample* error) const;

 private:
  std::vector<std::string> m_channels;
  std::vector<std::string> m_feed_axes;
  std::size_t m_sensors;
  bool m_with_compensation;
};

/// The state between two readings, `part` (0 .. 1) of the way from the first; switches and inputs as in the later one.
MachineSample between(const MachineSample& before, const MachineSample& after, double part);

}  // namespace zerodrift::acquisition
