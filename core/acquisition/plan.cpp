#include "core/acquisition/plan.h"

#include <nlohmann/json.hpp>

#include "core/base/json.h"

namespace zerodrift::acquisition {
namespace {

using nlohmann::json;

constexpr double day_s = 86400.0;
constexpr NumberRange period{0.05, 3600.0, false, "a time from 0.05 to 3600 s"};
constexpr NumberRange long_period{0.05, day_s, false, "a time from 0.05 to 86400 s"};
constexpr NumberRange step_time{0.0, 14 * day_s, true, "a time above 0, at most 14 days, in s"};
constexpr NumberRange speed{0.0, 200000.0, false, "a speed from 0 to 200000 rpm"};
constexpr NumberRange travel{-100000.0, 100000.0, false, "a position in mm"};

PlanStep step_from(JsonObject& object) {
  PlanStep step;
  step.duration_s = object.number("duration_s", step_time);
  step.spindle_rpm = object.number("spindle_rpm", speed);
  step.coolant_on = object.flag_or("coolant_on", false);
  step.path_cycle = object.has("path") && object.word("path", {"cycle", "still"}) == "cycle";
  return step;
}

Plan plan_from(JsonObject& object) {
  Plan plan;
  plan.name = object.text_or("name", "");
  plan.sample_period_s = object.number_or("sample_period_s", plan.sample_period_s, period);
  plan.measure_period_s = object.number_or("measure_period_s", plan.measure_period_s, long_period);
  if (plan.measure_period_s < plan.sample_period_s) {
    object.reject("measure_period_s", std::to_string(plan.measure_period_s), "at least sample_period_s");
  }
  if (JsonObject* position = object.object_if("measure_position_mm")) {
    for (const std::string& axis : position->keys()) {
      if (axis != "X" && axis != "Y" && axis != "Z") position->reject(axis, axis, "one of X, Y, Z");
      plan.measure_position_mm[axis] = position->number(axis, travel);
    }
  }
  for (JsonObject& step : object.objects("steps")) plan.steps.push_back(step_from(step));
  if (plan.steps.empty()) object.reject("steps", "an empty list", "at least one step");
  return plan;
}

Plan preset(std::string name, double sample_s, double measure_s, std::vector<PlanStep> steps) {
  return {std::move(name), sample_s, measure_s, {}, std::move(steps)};
}

}  // namespace

double Plan::duration_s() const {
  double total = 0.0;
  for (const PlanStep& step : steps) total += step.duration_s;
  return total;
}

std::size_t Plan::index_at(double time_s) const {
  double end = 0.0;
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
    end += steps[i].duration_s;
    if (time_s < end) return i;
  }
  return steps.empty() ? 0 : steps.size() - 1;
}

const PlanStep& Plan::step_at(double time_s) const {
  return steps.at(index_at(time_s));
}

Result<Plan> plan_from_json(const json& document, const std::string& file, std::vector<std::string>* warnings) {
  return from_json<Plan>(document, file, warnings, plan_from);
}

json to_json(const Plan& plan) {
  json steps = json::array();
  for (const PlanStep& step : plan.steps) {
    steps.push_back({{"duration_s", step.duration_s},
                     {"spindle_rpm", step.spindle_rpm},
                     {"coolant_on", step.coolant_on},
                     {"path", step.path_cycle ? "cycle" : "still"}});
  }
  json document = {{"name", plan.name},
                   {"sample_period_s", plan.sample_period_s},
                   {"measure_period_s", plan.measure_period_s},
                   {"steps", steps}};
  if (!plan.measure_position_mm.empty()) document["measure_position_mm"] = plan.measure_position_mm;
  return document;
}

Result<Plan> read_plan(const std::filesystem::path& path, std::vector<std::string>* warnings) {
  ZD_TRY(const json document, read_json_file(path));
  return plan_from_json(document, path.string(), warnings);
}

Result<Plan> with_measuring_position(Plan plan, const std::map<std::string, double>& of_profile) {
  for (const auto& [axis, position_mm] : of_profile) {
    if (axis == "X" || axis == "Y" || axis == "Z") plan.measure_position_mm.try_emplace(axis, position_mm);
  }
  if (plan.measure_position_mm.empty()) return fail(ErrorCode::no_measuring_position, {{"axes", "X, Y, Z"}});
  return plan;
}

std::vector<Plan> preset_plans() {
  constexpr double hour = 3600.0;
  return {
      // How heat splits between motor and bearings shows only when the speed changes, and how it leaves only at rest.
      preset("Warm-up, 4 h, stepped speeds", 10.0, 120.0,
             {{2 * hour, 3000.0, true, true},
              {0.8 * hour, 6000.0, true, true},
              {0.6 * hour, 1500.0, false, true},
              {0.6 * hour, 0.0, false, false}}),
      preset("Warm-up, 4 h at 3000 rpm", 10.0, 60.0, {{4 * hour, 3000.0, true, true}}),
      preset("Warm-up and cooling, 3000 rpm", 10.0, 60.0,
             {{4 * hour, 3000.0, true, true}, {2 * hour, 0.0, false, false}}),
      // Several speeds, so that a fit can be tried on speeds it has not seen.
      preset("Stepped speed spectrum", 10.0, 60.0,
             {{1 * hour, 1500.0, true, true},
              {0.5 * hour, 0.0, true, true},
              {1 * hour, 4500.0, true, true},
              {0.5 * hour, 1000.0, true, true},
              {1 * hour, 3000.0, true, true},
              {0.5 * hour, 6000.0, true, true},
              {1 * hour, 0.0, false, false}}),
      // Environmental temperature variation error: the machine stands, ISO 230-3 clause 5.
      preset("ISO 230-3 environment (ETVE), 24 h", 60.0, 300.0, {{24 * hour, 0.0, false, false}}),
      // Distortion by the rotating spindle: 4 h turning, 1 h at rest, axes still, ISO 230-3 clause 6.
      preset("ISO 230-3 spindle, constant speed", 10.0, 60.0,
             {{4 * hour, 3000.0, false, false}, {hour, 0.0, false, false}}),
      preset("ISO 230-3 spindle, varying speed", 10.0, 60.0,
             {{900.0, 2000.0, false, false},
              {900.0, 4000.0, false, false},
              {900.0, 1000.0, false, false},
              {900.0, 6000.0, false, false},
              {900.0, 3000.0, false, false},
              {900.0, 5000.0, false, false},
              {900.0, 0.0, false, false},
              {900.0, 4000.0, false, false},
              {hour, 0.0, false, false}}),
      // Distortion by moving linear axes: spindle at rest, axes run the path, ISO 230-3 clause 7.
      preset("ISO 230-3 linear axes", 10.0, 300.0, {{4 * hour, 0.0, false, true}, {hour, 0.0, false, false}}),
      preset("Short check, 30 min at 3000 rpm", 10.0, 60.0, {{0.5 * hour, 3000.0, true, true}}),
  };
}

}  // namespace zerodrift::acquisition
