#include "core/report/comparison.h"

#include <algorithm>
#include <cmath>

namespace zerodrift::report {
namespace {

constexpr double end_share = 0.1;  // of the span: what counts as its end

struct Sizes {
  int count = 0;
  double peak_um = 0.0;
  double rms_um = 0.0;
  double end_um = 0.0;
};

double duration_s(const recording::Recording& run) {
  return run.rows() == 0 ? 0.0 : run.time_s.back() - run.time_s.front();
}

Sizes sizes_of(const recording::Recording& run, const std::string& channel, double span_s) {
  Sizes sizes;
  const auto* values = run.find(channel);
  if (values == nullptr) return sizes;
  double squares = 0.0;
  double end_sum = 0.0;
  int end_count = 0;
  for (std::size_t r = 0; r < run.rows(); ++r) {
    const double at_s = run.time_s[r] - run.time_s.front();
    const double size = std::abs(values->values[r]);
    if (at_s > span_s || std::isnan(size)) continue;
    ++sizes.count;
    squares += size * size;
    sizes.peak_um = std::max(sizes.peak_um, size);
    if (at_s < (1.0 - end_share) * span_s) continue;
    end_sum += size;
    ++end_count;
  }
  if (sizes.count > 0) sizes.rms_um = std::sqrt(squares / sizes.count);
  sizes.end_um = end_count > 0 ? end_sum / end_count : std::nan("");
  return sizes;
}

}  // namespace

Comparison compare_runs(const recording::Recording& before, const recording::Recording& after) {
  Comparison comparison;
  comparison.span_s = std::min(duration_s(before), duration_s(after));
  for (const char axis : {'X', 'Y', 'Z'}) {
    const std::string name(1, axis);
    const Sizes first = sizes_of(before, "d" + name + "_um", comparison.span_s);
    const Sizes second = sizes_of(after, "d" + name + "_um", comparison.span_s);
    if (first.count == 0 || second.count == 0) continue;
    AxisComparison one{name,          first.peak_um, second.peak_um, first.rms_um,
                       second.rms_um, first.end_um,  second.end_um,  0.0};
    if (first.peak_um > 0.0) one.removed_percent = 100.0 * (1.0 - second.peak_um / first.peak_um);
    comparison.axes.push_back(std::move(one));
  }
  return comparison;
}

}  // namespace zerodrift::report
