#include "core/flow/steps/physics_step.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/analysis/checked.h"
#include "core/diagnosis/answer/sentences.h"
#include "core/flow/steps/describe_step.h"
#include "core/flow/steps/inputs.h"
#include "core/physics/placement.h"
#include "core/physics/simulate.h"
#include "core/recording/csv.h"

namespace zerodrift::flow {

using nlohmann::json;

namespace {

constexpr std::size_t most_points = 400;  // of a curve kept for drawing; the whole prediction is in the blob

json curve_of(const recording::Recording& prediction, const std::string& channel, bool temperature) {
  json curve = {
      {"channel", channel}, {"unit", temperature ? "C" : "um"}, {"time_h", json::array()}, {"values", json::array()}};
  const auto* values = prediction.find(channel);
  const std::size_t stride = prediction.rows() / most_points + 1;
  for (std::size_t r = 0; values != nullptr && r < prediction.rows(); r += stride) {
    curve["time_h"].push_back((prediction.time_s[r] - prediction.time_s.front()) / 3600.0);
    curve["values"].push_back(values->values[r]);
  }
  return curve;
}

json placement_json(const physics::Placement& placement) {
  json along = json::array();
  for (const auto& place : placement.along) {
    along.push_back({{"position_mm", place.position_mm},
                     {"correlation", place.correlation},
                     {"residual_um", place.residual_um},
                     {"lag_s", place.lag_s}});
  }
  return {{"component", placement.component},
          {"length_mm", placement.length_mm},
          {"from_mm", placement.from_mm},
          {"to_mm", placement.to_mm},
          {"along", along}};
}

diagnosis::Sentence sentence_of(const physics::ChannelDifference& worst) {
  return {"simulation_differs",
          {{"channel", worst.channel},
           {"rms", fmt::format("{:.2f}", worst.rms)},
           {"largest", fmt::format("{:.2f}", worst.largest)},
           {"unit", worst.temperature ? "K" : "µm"},
           {"minutes", fmt::format("{:.0f}", worst.largest_at_s / 60.0)}},
          ""};
}

diagnosis::Sentence sentence_of(const physics::Placement& placement) {
  return {"sensor_region",
          {{"component", placement.component},
           {"from", fmt::format("{:.1f}", placement.from_mm)},
           {"to", fmt::format("{:.1f}", placement.to_mm)}},
          ""};
}

/// Keeps the sentence as id and facts, and its English text for readers of the file.
void add_sentence(json& body, const diagnosis::Sentence& sentence) {
  body["said"].push_back(diagnosis::to_json(sentence));
  body["sentences"].push_back(diagnosis::said(sentence));
}

}  // namespace

Result<commissioning::NewArtefact> compare_physics(const commissioning::Job& job, const TaskContext& context,
                                                   const json* given) {
  std::vector<commissioning::ArtefactId> inputs;
  json description = given != nullptr ? *given : json(nullptr);
  std::string description_file = "machine.json";
  if (given == nullptr) {
    ZD_TRY(const auto own, description_of(job));
    if (own) {
      description = own->machine;
      description_file = own->file;
      inputs = own->sources;
    }
  }
  ZD_TRY(const Input warmup, need(job, "physics", "warmup"));
  inputs.push_back(warmup.id);
  ZD_TRY(const auto recorded, run_of(job, warmup));
  json body = {{"rmse", {{"before", json::object()}}},
               {"largest", json::object()},
               {"curves", json::array()},
               {"placement", nullptr},
               {"notes", json::array()},
               {"sentences", json::array()},
               {"said", json::array()}};
  if (description.is_null()) {
    add_sentence(body, {"nothing_to_simulate", {}, ""});
    return commissioning::NewArtefact::of("physics", body, inputs);
  }
  ZD_TRY(const auto machine, physics::machine_from_json(description, description_file));
  const recording::Recording run = analysis::checked(recorded, physics::measured_boundaries(machine)).recording;
  ZD_TRY(const auto simulation, physics::simulate(machine, run, context));
  const auto differences = physics::compare(simulation.prediction, run);
  const physics::ChannelDifference* worst = nullptr;
  for (const auto& difference : differences) {
    body["rmse"]["before"][difference.channel] = difference.rms;
    body["largest"][difference.channel] = difference.largest;
    body["curves"].push_back(curve_of(simulation.prediction, difference.channel, difference.temperature));
    if (difference.temperature && (worst == nullptr || difference.rms > worst->rms)) worst = &difference;
  }
  if (worst != nullptr) add_sentence(body, sentence_of(*worst));
  for (const auto& note : simulation.notes) body["notes"].push_back(note);
  if (const auto placement = physics::place_sensor(machine, run, {}, context)) {
    body["placement"] = placement_json(*placement);
    add_sentence(body, sentence_of(*placement));
  }
  return commissioning::NewArtefact::of("physics", body, inputs,
                                        {{"prediction.csv", recording::to_csv(simulation.prediction)}});
}

}  // namespace zerodrift::flow
