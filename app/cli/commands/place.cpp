// place --machine M.json --inputs R.csv [--error dZ_um] --out placement.json: the best sensor region by bisection.

#include <fmt/format.h>

#include <algorithm>

#include "app/cli/recording_input.h"
#include "core/base/json.h"
#include "core/physics/placement.h"
#include "core/recording/csv.h"

namespace zerodrift::cli {
namespace place_command {

struct PlaceArguments {
  std::string machine;
  std::string inputs;
  std::string map;
  std::string error = "dZ_um";
  std::string out;
};

nlohmann::json json_of(const physics::PlaceScore& score) {
  return {{"position_mm", score.position_mm},
          {"correlation", score.correlation},
          {"residual_um", score.residual_um},
          {"lag_s", score.lag_s},
          {"um_per_K", score.um_per_K}};
}

nlohmann::json json_of(const physics::Placement& placement) {
  nlohmann::json out = {
      {"component", placement.component}, {"error", placement.error},
      {"length_mm", placement.length_mm}, {"region_mm", {placement.from_mm, placement.to_mm}},
      {"best", json_of(placement.best)},  {"displacement", placement.measured ? "measured" : "simulated"},
      {"assumed", placement.notes}};
  for (const auto& step : placement.steps) {
    out["steps"].push_back({{"region_mm", {step.from_mm, step.to_mm}},
                            {"left", json_of(step.left)},
                            {"right", json_of(step.right)},
                            {"took", step.took_left ? "left" : "right"}});
  }
  for (const auto& score : placement.along) out["along"].push_back(json_of(score));
  for (std::size_t i = 0; i < placement.sensors.size(); ++i) {
    nlohmann::json sensor = json_of(placement.sensors[i]);
    sensor["channel"] = placement.sensor_channels[i];
    out["sensors"].push_back(sensor);
  }
  return out;
}

Result<CommandOutput> run_place(const PlaceArguments& arguments, const TaskContext& context) {
  CommandOutput output;
  ZD_TRY(const physics::Machine machine, physics::read_machine(arguments.machine, &output.warnings));
  ZD_TRY(const recording::Recording read, recording_from(arguments.inputs, arguments.map, output.warnings));
  const recording::Recording inputs = sound(read, physics::measured_boundaries(machine), output.warnings);
  physics::PlacementOptions options;
  options.error = arguments.error;
  ZD_TRY(const physics::Placement placement, physics::place_sensor(machine, inputs, options, context));
  output.json = json_of(placement);
  ZD_CHECK(write_json_file(arguments.out, output.json));
  output.text = fmt::format(
      "Put a sensor on {} between {:.1f} and {:.1f} mm from the fixed end: its temperature explains {} to "
      "{:.2f} um rms (r = {:.4f}, {:.2f} um/K, lag {:.0f} s).",
      placement.component, placement.from_mm, placement.to_mm, placement.error, placement.best.residual_um,
      placement.best.correlation, placement.best.um_per_K, placement.best.lag_s);
  if (std::find(placement.notes.begin(), placement.notes.end(), "no_excitation") != placement.notes.end()) {
    output.warnings.emplace_back("nothing drives the machine in this recording: the place means little");
  }
  return output;
}

}  // namespace place_command

void add_place(Cli& cli) {
  using namespace place_command;
  auto arguments = std::make_shared<PlaceArguments>();
  CLI::App* command = cli.add("place", "Find the place on a rod whose temperature follows the displacement best",
                              [arguments](const TaskContext& context) { return run_place(*arguments, context); });
  command->add_option("--machine", arguments->machine, "Machine description (JSON)")->required();
  command->add_option("--inputs", arguments->inputs, "Recording whose inputs are used (CSV)")->required();
  add_map_option(*command, arguments->map);
  command->add_option("--error", arguments->error, "The displacement to follow");
  command->add_option("--out", arguments->out, "Where the placement goes (JSON)")->required();
}

}  // namespace zerodrift::cli
