#include "core/diagnosis/input/thinning.h"

#include <algorithm>
#include <cmath>

#include "core/physics/inputs.h"

namespace zerodrift::diagnosis {
namespace {

using recording::Channel;
using recording::Recording;

/// Does a held input really change here? Noise of a measured load is no change.
bool steps_at(const Channel& channel, double range, std::size_t row) {
  const double change = channel.values[row] - channel.values[row - 1];
  return std::isfinite(change) && std::abs(change) > 0.1 * range;
}

double range_over(const Channel& channel) {
  double low = 1e300, high = -1e300;
  for (const double v : channel.values) {
    if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  }
  return std::max(0.0, high - low);
}

/// First rows of the bins: every `step` rows, where an input steps and after a gap.
std::vector<std::size_t> bin_starts(const Recording& recording, std::size_t step) {
  std::vector<std::pair<const Channel*, double>> inputs;
  for (const Channel& channel : recording.channels) {
    if (recording::is_input(channel.kind())) inputs.emplace_back(&channel, range_over(channel));
  }
  const double period_s = (recording.time_s.back() - recording.time_s.front()) / static_cast<double>(recording.rows());
  std::vector<std::size_t> starts{0};
  for (std::size_t k = 1; k < recording.rows(); ++k) {
    const bool gap = recording.time_s[k] - recording.time_s[k - 1] > 5.0 * period_s;
    const bool steps =
        std::any_of(inputs.begin(), inputs.end(), [&](const auto& in) { return steps_at(*in.first, in.second, k); });
    if (gap || steps || k - starts.back() >= step) starts.push_back(k);
  }
  return starts;
}

}  // namespace

Recording thinned(const Recording& recording, std::size_t most_rows) {
  if (recording.rows() <= most_rows + most_rows / 3) return recording;
  const std::size_t step = (recording.rows() + most_rows - 1) / most_rows;
  std::vector<std::size_t> starts = bin_starts(recording, step);
  // Inputs that step all the time leave nothing to average: then every so many rows are kept.
  if (starts.size() > 2 * most_rows) {
    starts.clear();
    for (std::size_t k = 0; k < recording.rows(); k += step) starts.push_back(k);
  }
  Recording out;
  out.name = recording.name;
  const auto end_of = [&](std::size_t b) { return b + 1 < starts.size() ? starts[b + 1] : recording.rows(); };
  for (std::size_t b = 0; b < starts.size(); ++b) {
    double sum_s = 0.0;
    for (std::size_t k = starts[b]; k < end_of(b); ++k) sum_s += recording.time_s[k] - recording.time_s[starts[b]];
    out.time_s.push_back(recording.time_s[starts[b]] + sum_s / static_cast<double>(end_of(b) - starts[b]));
  }
  for (const Channel& channel : recording.channels) {
    const bool spiky = !recording::is_input(channel.kind());
    const std::vector<bool> spike = spiky ? physics::spikes(channel.values, physics::noise_width(channel.values, 0.01))
                                          : std::vector<bool>(channel.values.size(), false);
    Channel mean{channel.name, {}};
    for (std::size_t b = 0; b < starts.size(); ++b) {
      double sum = 0.0;
      int count = 0;
      for (std::size_t k = starts[b]; k < end_of(b); ++k) {
        if (!std::isfinite(channel.values[k]) || spike[k]) continue;
        sum += channel.values[k];
        ++count;
      }
      mean.values.push_back(count > 0 ? sum / count : std::nan(""));
    }
    out.channels.push_back(std::move(mean));
  }
  return out;
}

}  // namespace zerodrift::diagnosis
