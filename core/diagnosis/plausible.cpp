#include "core/diagnosis/plausible.h"

#include <fmt/format.h>

#include <algorithm>

namespace zerodrift::diagnosis {
namespace {

/// What is missing changes a rise by tens of percent, heat that nobody described by a few times; no effect makes it a
/// hundred times larger or smaller.
constexpr double beyond_any_effect = 100.0;

struct Movement {
  double measured = 0.0;
  double simulated = 0.0;
};

double spread(std::vector<double> values) {
  if (values.size() < 3) return 0.0;
  std::sort(values.begin(), values.end());
  return values[values.size() * 98 / 100] - values[values.size() * 2 / 100];
}

Movement movement(const MeasuredChannel& channel, const std::vector<double>& simulated) {
  std::vector<double> measured, predicted;
  for (std::size_t k = 0; k < channel.values.size(); ++k) {
    if (!channel.present[k]) continue;
    measured.push_back(channel.values[k]);
    predicted.push_back(simulated[k]);
  }
  return {spread(std::move(measured)), spread(std::move(predicted))};
}

}  // namespace

Status check_scale(const physics::Machine& machine, const Dataset& data, const physics::Prediction& nominal) {
  for (const auto& component : machine.components) {
    for (const auto& source : component.sources) {
      if (source.power_unknown) return {};  // nothing to compare with
    }
  }
  for (const bool temperature : {true, false}) {
    Movement largest;
    std::string name;
    for (std::size_t c = 0; c < data.channels.size(); ++c) {
      const MeasuredChannel& channel = data.channels[c];
      if (channel.samples == 0 || channel.temperature != temperature) continue;
      const Movement here = movement(channel, nominal.channels[c].values);
      if (here.measured > largest.measured) name = channel.name;
      largest.measured = std::max(largest.measured, here.measured);
      largest.simulated = std::max(largest.simulated, here.simulated);
    }
    // Both have to move by more than noise and a changing room would explain.
    constexpr double little = 0.01;
    const double much = temperature ? 5.0 : 20.0;
    const bool too_large = largest.measured > much && largest.simulated > little &&
                           largest.measured > beyond_any_effect * largest.simulated;
    const bool too_small = largest.simulated > much && largest.simulated > beyond_any_effect * largest.measured;
    if (!too_large && !too_small) continue;
    const char* unit = temperature ? "K" : "um";
    return fail(ErrorCode::data_does_not_fit,
                {{"what", data.recording->name + (name.empty() ? "" : ", channel " + name)},
                 {"found", fmt::format("a movement of {:.3g} {}", largest.measured, unit)},
                 {"expected", fmt::format("about {:.3g} {} for {}; check units, geometry and powers", largest.simulated,
                                          unit, machine.file)}});
  }
  return {};
}

}  // namespace zerodrift::diagnosis
