#pragma once
// The periods of a run's samples: what is due when, and what was lost. A sample is due at each multiple of the period
// and takes the place of the one period that it falls in, late or not.

#include <cstdint>

namespace zerodrift::acquisition {

/// The next time that is a multiple of the period; one that is all but reached has passed.
double next_multiple(double time_s, double period_s);

/// How many periods lie between the one of `from_s` and the one of `to_s`: samples that were due and have no row.
std::int64_t samples_between(double from_s, double to_s, double period_s);

}  // namespace zerodrift::acquisition
