#pragma once
// Faults of one temperature series: found, named, repaired where that is honest.

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/analysis/findings.h"

namespace zerodrift::analysis {

inline constexpr double missing_sample = std::numeric_limits<double>::quiet_NaN();

/// Infinite becomes missing; isolated spikes (Hampel 1974: far from the median of the neighbours, in units of their
/// median absolute deviation) become missing. Returns how many spikes there were.
int remove_spikes(std::vector<double>& values);

/// The same for measured errors, which may kink where the speed changes: a measurement becomes missing when it stands
/// out from the two before and the two after it by more than a fifth of the range of all (without the outermost 2 %)
/// and by far more than neighbours scatter.
int remove_wild_errors(std::vector<double>& values);

/// A stretch in which a sensor gave one value that is not its own: it left at once for it and came back at once (a
/// transmitter that reads 0 while its cable is off). Made missing; less than half of the samples. A value repeated for
/// long by what is noisy otherwise needs smaller jumps. What a sensor that froze repeats is its own last value, and
/// none.
struct Dropout {
  std::size_t first = 0;
  std::size_t last = 0;  // row after it
  double value = 0.0;
};
std::vector<Dropout> remove_dropouts(std::vector<double>& values);
/// "reads 0 from 6540 to 8340 s" each.
std::vector<Finding> told(const std::vector<Dropout>& dropouts, const std::string& channel,
                          const std::vector<double>& time_s);

/// A fault that makes the whole series useless, if there is one: dead, died half-way, constant.
std::optional<Finding> fatal_fault(const std::string& channel, const std::vector<double>& time_s,
                                   const std::vector<double>& values);

/// The rows [first, last) in which a sensor that is noisy otherwise repeats one value for more than a tenth of the run:
/// its reading was not renewed, whether or not it came back.
std::optional<std::pair<std::size_t, std::size_t>> frozen_stretch(const std::vector<double>& time_s,
                                                                  const std::vector<double>& values);

/// Missing samples: straight line between neighbours, held at the ends. Returns the longest gap bridged in s.
double bridge_gaps(const std::vector<double>& time_s, std::vector<double>& values);
/// Missing samples of an input: held from the sample before; before the first one its value.
void hold_gaps(std::vector<double>& values);

/// Names series that may be in K or in Fahrenheit. Nothing is converted: units come from names, headers or the user,
/// and a motor may well start at 55 C. A cold machine stands between about 0 and 45 C, so a whole set that starts above
/// 50 is suspected of Fahrenheit, and anything that stays above 200 of kelvin.
void suspect_units(const std::vector<std::string>& channels, const std::vector<std::vector<double>>& values,
                   std::vector<Finding>& findings);

}  // namespace zerodrift::analysis
