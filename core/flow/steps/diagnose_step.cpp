#include "core/flow/steps/diagnose_step.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/error_json.h"
#include "core/base/json.h"
#include "core/diagnosis/diagnosis.h"
#include "core/flow/steps/describe_step.h"
#include "core/flow/steps/inputs.h"
#include "core/flow/steps/physics_step.h"
#include "core/flow/steps/recordings_step.h"
#include "core/recording/csv.h"

namespace zerodrift::flow {

using commissioning::NewArtefact;
using diagnosis::Diagnosis;
using nlohmann::json;

namespace {

json heat_json(const Diagnosis& found) {
  if (!found.heat || found.heat->position_mm.size() < 2 || found.heat->time_s.size() < 2) return nullptr;
  const auto& heat = *found.heat;
  json watts = json::array();
  for (const auto& row : heat.watts) {
    json line = json::array();
    for (const double w : row) line.push_back(std::isfinite(w) ? json(std::round(100.0 * w) / 100.0) : json());
    watts.push_back(std::move(line));
  }
  return {{"component", heat.component},   {"from_mm", heat.position_mm.front()}, {"to_mm", heat.position_mm.back()},
          {"from_s", heat.time_s.front()}, {"to_s", heat.time_s.back()},          {"watts", watts}};
}

std::string refined_csv(const Diagnosis& found) {
  recording::Recording refined;
  refined.name = "refined";
  refined.time_s = found.time_s;
  for (const auto& channel : found.channels) refined.ensure(channel.channel).values = channel.explained;
  return recording::to_csv(refined);
}

/// Beside each curve of the simulation, at the same times, what it is with the effects found.
void add_refined_curves(const Diagnosis& found, json& curves) {
  recording::Recording refined;
  refined.time_s = found.time_s;
  for (const auto& channel : found.channels) refined.ensure(channel.channel).values = channel.explained;
  for (auto& curve : curves) {
    const auto* channel = refined.find(curve.at("channel").get<std::string>());
    if (channel == nullptr) continue;
    curve["refined"] = json::array();
    for (const auto& hours : curve.at("time_h")) {
      const double time_s = refined.time_s.front() + 3600.0 * hours.get<double>();
      curve["refined"].push_back(recording::value_at(refined, *channel, time_s));
    }
  }
}

Status add_diagnosis(const Diagnosis& found, NewArtefact& made) {
  ZD_TRY(json body, parse_json(made.body, "physics"));
  body["diagnosis"] = diagnosis::to_json(found);
  body["rmse"]["after"] = body["diagnosis"]["rmse"]["after"];
  body["heat"] = heat_json(found);
  add_refined_curves(found, body["curves"]);
  body["refined_machine"] = physics::to_json(found.refined);
  body["adopted"] = json::array();
  body["rejected"] = json::array();
  made.body = json_text(body);
  made.blobs.push_back({"refined.csv", refined_csv(found)});
  return {};
}

}  // namespace

Result<NewArtefact> with_diagnosis(const commissioning::Job& job, const json& machine, const Diagnosis& found,
                                   const TaskContext& context) {
  ZD_TRY(NewArtefact made, compare_physics(job, context, &machine));
  ZD_CHECK(add_diagnosis(found, made));
  return made;
}

Result<NewArtefact> find_missing(const commissioning::Job& job, const TaskContext& context) {
  ZD_TRY(NewArtefact made, compare_physics(job, context));
  ZD_TRY(const auto own, description_of(job));
  if (!own) return made;
  ZD_TRY(const auto machine, physics::machine_from_json(own->machine, own->file));
  ZD_TRY(const auto warmup, need(job, "physics", "warmup"));
  std::vector<recording::Recording> runs(1);
  ZD_TRY(runs.front(), run_of(job, warmup));
  ZD_TRY(const auto further, further_runs(job));
  runs.insert(runs.end(), further.begin(), further.end());
  if (const auto verification = need(job, "physics", "verification")) {
    if (auto second = run_of(job, *verification)) runs.push_back(std::move(*second));
  }
  const auto diagnosed = diagnosis::diagnose(machine, runs, {}, context);
  if (!diagnosed) {
    if (diagnosed.error().code == ErrorCode::cancelled) return fail(diagnosed.error());
    // The comparison stands on its own; that nothing could be searched is said with it.
    json problem = to_json(diagnosed.error());
    problem["said"] = "not_searched";
    ZD_TRY(json body, parse_json(made.body, "physics"));
    body["problems"] = json::array({problem});
    made.body = json_text(body);
    return made;
  }
  ZD_CHECK(add_diagnosis(*diagnosed, made));
  return made;
}

}  // namespace zerodrift::flow
