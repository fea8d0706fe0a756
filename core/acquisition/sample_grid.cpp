#include "core/acquisition/sample_grid.h"

#include <algorithm>
#include <cmath>

namespace zerodrift::acquisition {
namespace {

// A sample a little before its time, by jitter of the clocks, counts as the one that was due.
constexpr double early_share = 0.1;

double period_of(double time_s, double period_s) {
  return std::floor(time_s / period_s + early_share);
}

}  // namespace

double next_multiple(double time_s, double period_s) {
  return (period_of(time_s, period_s) + 1.0) * period_s;
}

std::int64_t samples_between(double from_s, double to_s, double period_s) {
  const double passed = period_of(to_s, period_s) - period_of(from_s, period_s) - 1.0;
  return static_cast<std::int64_t>(std::max(0.0, passed));
}

}  // namespace zerodrift::acquisition
