#include "core/recording/unit_suspicion.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace zerodrift::recording {
namespace {

constexpr std::size_t start_samples = 9;
// Absolute temperatures of a machine in a workshop; nothing on a machine is that hot in degrees Celsius at its start.
constexpr double least_kelvin = 200.0;
constexpr double most_kelvin = 400.0;
// A workshop of 10 to 49 degrees Celsius, in degrees Fahrenheit.
constexpr double least_fahrenheit = 50.0;
constexpr double most_fahrenheit = 120.0;

double median_of_all(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct Temperatures {
  std::size_t channel;
  double start;
  double least;
};

std::optional<Temperatures> look_at(std::size_t channel, const std::vector<double>& values) {
  std::vector<double> there;
  std::copy_if(values.begin(), values.end(), std::back_inserter(there), [](double v) { return std::isfinite(v); });
  if (there.empty()) return std::nullopt;
  const double least = *std::min_element(there.begin(), there.end());
  there.resize(std::min(there.size(), start_samples));
  return Temperatures{channel, median_of_all(std::move(there)), least};
}

/// One sensor alone: where the others start alike, and in degrees Celsius it would start among them.
bool falls_among_others(const std::vector<Temperatures>& all, std::size_t one) {
  std::vector<double> others;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i != one) others.push_back(all[i].start);
  }
  if (others.empty()) return false;
  const double middle = median_of_all(others);
  const auto alike = std::count_if(others.begin(), others.end(), [&](double s) { return std::abs(s - middle) < 3.0; });
  if (5 * alike < 3 * std::ssize(others)) return false;
  return all[one].start - middle > 20.0 && std::abs((all[one].start - 32.0) / 1.8 - middle) < 1.5;
}

}  // namespace

std::vector<UnitSuspicion> suspected_units(const std::vector<std::vector<double>>& channels) {
  std::vector<UnitSuspicion> suspicions;
  std::vector<Temperatures> rest;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const auto one = look_at(c, channels[c]);
    if (!one) continue;
    if (one->least > least_kelvin && one->start < most_kelvin) {
      suspicions.push_back({c, true, one->start});
    } else {
      rest.push_back(*one);
    }
  }
  const bool all = !rest.empty() && std::all_of(rest.begin(), rest.end(), [](const auto& one) {
    return one.start > least_fahrenheit;
  }) && std::any_of(rest.begin(), rest.end(), [](const auto& one) { return one.start < most_fahrenheit; });
  for (std::size_t i = 0; i < rest.size(); ++i) {
    if (all || falls_among_others(rest, i)) suspicions.push_back({rest[i].channel, false, rest[i].start});
  }
  return suspicions;
}

}  // namespace zerodrift::recording
