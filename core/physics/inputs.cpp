#include "core/physics/inputs.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace zerodrift::physics {

double noise_width(const std::vector<double>& values, double floor) {
  std::vector<double> present;
  for (const double v : values) {
    if (std::isfinite(v)) present.push_back(v);
  }
  if (present.size() < 10) return floor;
  std::vector<double> second;
  double step = 1e300;
  for (std::size_t i = 1; i < present.size(); ++i) {
    const double d = std::abs(present[i] - present[i - 1]);
    if (d > 1e-9) step = std::min(step, d);
    if (i + 1 < present.size()) second.push_back(std::abs(present[i + 1] - 2.0 * present[i] + present[i - 1]));
  }
  std::sort(second.begin(), second.end());
  constexpr std::size_t few = 30;  // one spike is in three of them, and a tenth must hold all three
  const double resolution = step > 0.004 && step < 1e299 ? step / std::sqrt(12.0) : 0.0;
  double sigma = second[second.size() / 2] / (0.6745 * std::sqrt(6.0));
  if (second.size() >= few) {
    const std::size_t kept = second.size() * 9 / 10;
    double sum = 0.0;
    for (std::size_t i = 0; i < kept; ++i) sum += second[i] * second[i];
    // 1.267 restores what the trimming of a tenth of a normal sample takes away.
    const double trimmed = 1.267 * std::sqrt(sum / static_cast<double>(kept) / 6.0);
    // Where spikes are in more than a tenth only the median is free of them, which steps of a coarse gauge leave blind.
    const double coarsest = std::max(resolution, floor);
    const double spikes_alone = sigma > 1.5 * coarsest ? 3.0 : 8.0;
    if (trimmed < spikes_alone * std::max(sigma, coarsest)) sigma = trimmed;
  }
  return std::max({sigma, resolution, floor});
}

namespace {

constexpr double noise_widths = 8.0;
constexpr double times_around = 2.5;

/// The two nearest samples that are there and no spikes, from `at` in steps of `step`; NaN where there are none near.
std::array<double, 2> sound_from(const std::vector<double>& values, const std::vector<bool>& mark, std::ptrdiff_t at,
                                 std::ptrdiff_t step) {
  constexpr int reach = 5;
  std::array<double, 2> found{std::nan(""), std::nan("")};
  std::size_t count = 0;
  for (int k = 0; k < reach && count < found.size() && at >= 0 && at < std::ssize(values); ++k, at += step) {
    if (std::isfinite(values[at]) && !mark[at]) found[count++] = values[at];
  }
  return found;
}

/// Two in a row hide each other: each is compared with the two sound samples before both and the two after.
void mark_pairs(const std::vector<double>& values, double sigma, std::vector<bool>& mark) {
  for (std::ptrdiff_t i = 0; i + 1 < std::ssize(values); ++i) {
    if (mark[i] || mark[i + 1] || !(std::abs(values[i + 1] - values[i]) >= 0.0)) continue;
    const auto before = sound_from(values, mark, i - 1, -1);
    const auto after = sound_from(values, mark, i + 2, 1);
    if (!std::isfinite(before[1]) || !std::isfinite(after[1])) continue;
    const auto [low, high] = std::minmax({before[0], before[1], after[0], after[1]});
    const double far = std::max(noise_widths * sigma, times_around * (high - low));
    const double middle = 0.5 * (low + high);
    if (std::abs(values[i] - middle) > far && std::abs(values[i + 1] - middle) > far) mark[i] = mark[i + 1] = true;
  }
}

/// Those whose neighbours on both sides stand by the running median of five.
std::vector<bool> alone(const std::vector<double>& values, double sigma) {
  const std::ptrdiff_t n = std::ssize(values);
  std::vector<bool> mark(values.size(), false);
  // Reflected ends: with edge padding a spike in the first sample would be its own median.
  const auto at = [&](std::ptrdiff_t i) {
    if (i < 0) i = -i;
    if (i >= n) i = 2 * (n - 1) - i;
    return values[static_cast<std::size_t>(i)];
  };
  std::vector<double> deviation(values.size(), 0.0);
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    std::array<double, 5> window{};
    std::size_t count = 0;
    for (std::ptrdiff_t k = -2; k <= 2; ++k) {
      if (std::isfinite(at(i + k))) window[count++] = at(i + k);
    }
    if (count == 0 || !std::isfinite(values[i])) continue;
    std::sort(window.begin(), window.begin() + static_cast<std::ptrdiff_t>(count));
    const double median = 0.5 * (window[(count - 1) / 2] + window[count / 2]);
    deviation[i] = std::abs(values[i] - median);
  }
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const double left = i > 0 ? deviation[i - 1] : deviation[i + 1];
    const double right = i + 1 < n ? deviation[i + 1] : deviation[i - 1];
    mark[i] = deviation[i] > noise_widths * sigma && deviation[i] > times_around * std::max(left, right);
  }
  return mark;
}

}  // namespace

std::vector<bool> spikes(const std::vector<double>& values, double sigma) {
  constexpr int most_passes = 3;  // a large one hides a small one beside it
  std::vector<bool> mark(values.size(), false);
  if (values.size() < 5) return mark;
  std::vector<double> left = values;
  for (int pass = 0; pass < most_passes; ++pass) {
    std::vector<bool> now = alone(left, sigma);
    mark_pairs(left, sigma, now);
    if (std::none_of(now.begin(), now.end(), [](bool one) { return one; })) break;
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (!now[i]) continue;
      mark[i] = true;
      left[i] = std::nan("");
    }
  }
  return mark;
}

std::vector<double> mended(const std::vector<double>& values, const std::vector<double>& time_s) {
  std::vector<double> out = values;
  const std::vector<bool> mark = spikes(values, noise_width(values, 0.01));
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (mark[i]) out[i] = std::nan("");
  }
  std::ptrdiff_t last = -1;
  for (std::ptrdiff_t i = 0; i < std::ssize(out); ++i) {
    if (!std::isfinite(out[i])) continue;
    for (std::ptrdiff_t k = last + 1; k < i; ++k) {
      const double share = last < 0 ? 1.0 : (time_s[k] - time_s[last]) / (time_s[i] - time_s[last]);
      out[k] = (last < 0 ? out[i] : out[last]) * (1.0 - share) + out[i] * share;
    }
    last = i;
  }
  for (std::ptrdiff_t k = last + 1; k < std::ssize(out); ++k) out[k] = last < 0 ? 0.0 : out[last];
  return out;
}

bool nothing_drives(const InputSet& inputs) {
  const auto still = [](const std::vector<double>& row) {
    return std::all_of(row.begin(), row.end(), [](double v) { return v == 0.0; });
  };
  return !inputs.held.empty() && !inputs.held.front().empty() &&
         std::all_of(inputs.held.begin(), inputs.held.end(), still);
}

/// Whether the network uses an input or not: an effect that is absent must not change the steps.
static std::vector<bool> settled_rows(const recording::Recording& recording) {
  constexpr double while_s = 600.0;
  constexpr double step = 0.1;  // of an input's range; less is noise of a measured one
  std::vector<bool> stepped(recording.rows() + 1, false);
  for (const auto& channel : recording.channels) {
    if (!recording::is_input(channel.kind())) continue;
    double low = 1e300, high = -1e300, last = 0.0;
    for (const double v : channel.values) {
      if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
    }
    for (std::size_t k = 0; k < channel.values.size(); ++k) {
      const double now = std::isfinite(channel.values[k]) ? channel.values[k] : last;
      if (k > 0 && std::abs(now - last) > step * (high - low)) stepped[k] = true;
      last = now;
    }
  }
  std::vector<bool> settled(recording.rows(), false);
  double stepped_s = recording.rows() == 0 ? 0.0 : recording.time_s[0];
  for (std::size_t k = 0; k < settled.size(); ++k) {
    if (stepped[k]) stepped_s = recording.time_s[k];
    settled[k] = recording.time_s[k] - stepped_s >= while_s && !stepped[k + 1];
  }
  return settled;
}

InputSet make_inputs(const Network& network, const recording::Recording& recording) {
  InputSet set;
  set.time_s = recording.time_s;
  set.settled = settled_rows(recording);
  const std::size_t rows = set.rows();
  set.held.assign(rows, std::vector<double>(network.held_channels.size(), 0.0));
  set.linear.assign(rows, std::vector<double>(network.linear_channels.size(), 0.0));
  set.signals.assign(rows, std::vector<double>(network.signals.size(), 0.0));
  for (std::size_t c = 0; c < network.held_channels.size(); ++c) {
    const recording::Channel* channel = recording.find(network.held_channels[c]);
    if (channel == nullptr) continue;
    double last = 0.0;
    for (std::size_t k = 0; k < rows; ++k) {
      if (std::isfinite(channel->values[k])) last = channel->values[k];
      set.held[k][c] = last;
    }
  }
  for (std::size_t c = 0; c < network.linear_channels.size(); ++c) {
    const recording::Channel* channel = recording.find(network.linear_channels[c]);
    if (channel == nullptr) continue;
    const auto values = mended(channel->values, recording.time_s);
    for (std::size_t k = 0; k < rows; ++k) set.linear[k][c] = values[k];
  }
  for (std::size_t s = 0; s < network.signals.size(); ++s) {
    for (std::size_t k = 0; k < rows; ++k) {
      set.signals[k][s] = network.signals[s].value(set.held[k].data(), set.linear[k].data(), set.time_s[k]);
    }
  }
  return set;
}

}  // namespace zerodrift::physics
