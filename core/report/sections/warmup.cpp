// The warm-up run: errors, temperatures, inputs; ranges in the first hour and over the whole run as in ISO 230-3.

#include <cmath>
#include <limits>

#include "core/report/build.h"

namespace zerodrift::report {
namespace {

/// Largest minus smallest value up to the time; NaN when there is none.
double range_um(const recording::Recording& run, const std::string& channel, double until_s) {
  const auto* values = run.find(channel);
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (std::size_t r = 0; values != nullptr && r < run.rows(); ++r) {
    if (std::isnan(values->values[r]) || run.time_s[r] - run.time_s.front() > until_s) continue;
    low = std::min(low, values->values[r]);
    high = std::max(high, values->values[r]);
  }
  return high >= low ? high - low : std::numeric_limits<double>::quiet_NaN();
}

Figure range_figure(const Source& source, const std::string& channel, double value, const char* id, const char* label) {
  const std::string direction = channel.substr(1, 1);
  Figure figure;
  figure.id = fmt::format("{}_{}_um", id, direction);
  figure.label = source.say(label) + " " + direction;
  figure.value = shown(value, 1);
  figure.unit = "µm";
  figure.trace = source.trace("warmup", channel);
  return figure;
}

Plot plot_of(const Source& source, const recording::Recording& run, const std::vector<std::string>& channels,
             const char* id, const char* title, const char* unit, bool points) {
  Plot plot;
  plot.id = id;
  plot.title = source.say(title);
  plot.x_label = source.say("hours");
  plot.y_label = unit;
  plot.curves = curves_of(run, channels, points);
  plot.trace = source.trace("warmup", id);
  return plot;
}

}  // namespace

std::optional<Section> warmup_section(const Source& source) {
  const auto* run = source.run_of("warmup");
  if (run == nullptr || run->rows() == 0) return std::nullopt;
  Section section{"warmup", source.say("Warm-up run"), {}};
  const auto errors = run->names(recording::ChannelKind::error);
  Figures figures;
  for (const auto& channel : errors) {
    figures.figures.push_back(
        range_figure(source, channel, range_um(*run, channel, 3600.0), "range_60min", "Range in the first 60 min,"));
    figures.figures.push_back(
        range_figure(source, channel, range_um(*run, channel, 1e12), "range_total", "Range over the run,"));
  }
  section.blocks.emplace_back(std::move(figures));
  section.blocks.emplace_back(plot_of(source, *run, errors, "errors", "Errors at the nose", "µm", false));
  section.blocks.emplace_back(plot_of(source, *run, run->names(recording::ChannelKind::temperature), "temperatures",
                                      "Temperatures", "°C", false));
  section.blocks.emplace_back(plot_of(source, *run, {"spindle_rpm"}, "speed", "Spindle speed", "rpm", false));
  return section;
}

}  // namespace zerodrift::report
