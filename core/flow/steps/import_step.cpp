#include "core/flow/steps/import_step.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/acquisition/plan.h"
#include "core/base/json.h"
#include "core/flow/steps/inputs.h"

namespace zerodrift::flow {

using nlohmann::json;
using recording::ChannelKind;
using recording::Recording;

namespace {

constexpr std::size_t least_rows = 20;
constexpr double least_duration_s = 60.0;
constexpr std::size_t most_steps = 40;  // speeds that change more often are a signal, not a plan

std::size_t most_present(const Recording& run, ChannelKind kind) {
  std::size_t most = 0;
  for (const auto& channel : run.channels) {
    if (channel.kind() == kind) most = std::max(most, recording::present_count(channel));
  }
  return most;
}

double median_period_s(const Recording& run) {
  std::vector<double> periods;
  for (std::size_t i = 1; i < run.rows(); ++i) periods.push_back(run.time_s[i] - run.time_s[i - 1]);
  const auto middle = periods.begin() + static_cast<std::ptrdiff_t>(periods.size() / 2);
  std::nth_element(periods.begin(), middle, periods.end());
  return *middle;
}

/// What the machine did, as steps of a plan: the verification runs the same speeds in another order.
std::vector<acquisition::PlanStep> steps_of(const Recording& run) {
  const double end_s = run.time_s.back();
  const auto held = [&](const char* name, double time_s) {
    const auto* channel = run.find(name);
    const double value = channel == nullptr ? 0.0 : recording::held_value_at(run, *channel, time_s);
    return std::isfinite(value) ? value : 0.0;
  };
  const bool moves = std::any_of(run.channels.begin(), run.channels.end(), [](const auto& channel) {
    return channel.kind() == ChannelKind::feed &&
           std::any_of(channel.values.begin(), channel.values.end(), [](double v) { return std::abs(v) > 0.0; });
  });
  std::vector<acquisition::PlanStep> steps;
  double from_s = run.time_s.front();
  for (std::size_t i = 0; i < run.rows(); ++i) {
    const double rpm = std::round(held("spindle_rpm", run.time_s[i]));
    const bool coolant = held("coolant_on", run.time_s[i]) > 0.5;
    if (!steps.empty() && steps.back().spindle_rpm == rpm && steps.back().coolant_on == coolant) continue;
    if (!steps.empty()) steps.back().duration_s = run.time_s[i] - from_s;
    from_s = run.time_s[i];
    steps.push_back({0.0, rpm, coolant, moves && rpm > 0.0});
  }
  steps.back().duration_s = end_s - from_s;
  std::erase_if(steps, [](const acquisition::PlanStep& step) { return step.duration_s <= 0.0; });
  if (steps.size() > most_steps || steps.empty()) {
    double sum = 0.0;
    for (const double t : run.time_s) sum += held("spindle_rpm", t);
    steps = {{end_s - run.time_s.front(), std::round(sum / static_cast<double>(run.rows())), false, moves}};
  }
  return steps;
}

}  // namespace

Result<commissioning::SeriesId> keep_run(commissioning::Job& job, const Recording& run, const std::string& name,
                                         const json& details) {
  std::vector<std::string> channels;
  for (const auto& channel : run.channels) channels.push_back(channel.name);
  ZD_TRY(const auto series, job.start_series(name, channels, json_text(details)));
  std::vector<double> row(channels.size());
  for (std::size_t i = 0; i < run.rows(); ++i) {
    for (std::size_t c = 0; c < channels.size(); ++c) row[c] = run.channels[c].values[i];
    ZD_CHECK(job.append(series, run.time_s[i], row));
  }
  ZD_CHECK(job.flush());
  ZD_CHECK(job.finish_series(series));
  return series;
}

Status fit_for_warmup(const Recording& run, const std::string& file, bool errors_needed) {
  const std::size_t temperatures = most_present(run, ChannelKind::temperature);
  const std::size_t errors = most_present(run, ChannelKind::error);
  if (temperatures < least_rows || (errors_needed && errors < least_rows)) {
    return fail(
        ErrorCode::data_does_not_fit,
        {{"what", file},
         {"found", std::to_string(temperatures) + " temperatures and " + std::to_string(errors) + " errors"},
         {"expected", "channels <name>_C and <name>_um with at least " + std::to_string(least_rows) + " values each"}});
  }
  if (run.time_s.back() - run.time_s.front() < least_duration_s) {
    return fail(ErrorCode::not_enough_data,
                {{"what", file},
                 {"found", std::to_string(std::lround(run.time_s.back() - run.time_s.front())) + " s"},
                 {"needed", std::to_string(std::lround(least_duration_s)) + " s"}});
  }
  return {};
}

Result<commissioning::NewArtefact> import_warmup(commissioning::Job& job, const Recording& run, const std::string& file,
                                                 const json& how) {
  ZD_CHECK(fit_for_warmup(run, file, how.is_null()));
  std::vector<commissioning::ArtefactId> inputs;
  for (const char* kind : {"machine", "calibration"}) {
    ZD_TRY(const auto latest, job.latest(kind));
    if (latest) inputs.push_back(latest->id);
  }
  acquisition::Plan plan;
  plan.name = file;
  plan.sample_period_s = median_period_s(run);
  plan.steps = steps_of(run);
  const double duration_s = run.time_s.back() - run.time_s.front();
  const std::size_t measurements = most_present(run, ChannelKind::error);
  plan.measure_period_s =
      std::max(plan.sample_period_s, duration_s / static_cast<double>(std::max<std::size_t>(measurements, 1)));
  const json details = {{"plan", acquisition::to_json(plan)}, {"machine_serial", 0}, {"origin_s", 0.0}};
  ZD_TRY(const auto series, keep_run(job, run, "warm-up", details));
  json body = {{"series", series},
               {"plan", acquisition::to_json(plan)},
               {"source", "file"},
               {"file", file},
               {"zero_um", nullptr},
               {"rows", run.rows()},
               {"lost_samples", 0},
               {"measurements", measurements},
               {"refused", 0},
               {"gaps", 0},
               {"duration_s", duration_s},
               {"peak_um", json::object()},
               {"problems", {"imported from " + file + ": that the compensation was off is not recorded"}}};
  if (!how.is_null()) body["import"] = how;
  for (const auto& [direction, size] : error_sizes(run, assigned_axes(body))) body["peak_um"][direction] = size.peak_um;
  return commissioning::NewArtefact::of("warmup", body, inputs);
}

}  // namespace zerodrift::flow
