// simulate --machine M.json --inputs R.csv --out prediction.csv: the machine description's own prediction of a run.

#include "core/physics/simulate.h"

#include <fmt/format.h>

#include "app/cli/recording_input.h"
#include "core/recording/csv.h"

namespace zerodrift::cli {
namespace simulate_command {

struct SimulateArguments {
  std::string machine;
  std::string inputs;
  std::string map;
  std::string out;
};

Result<CommandOutput> run_simulate(const SimulateArguments& arguments, const TaskContext& context) {
  CommandOutput output;
  ZD_TRY(const physics::Machine machine, physics::read_machine(arguments.machine, &output.warnings));
  ZD_TRY(const recording::Recording read, recording_from(arguments.inputs, arguments.map, output.warnings));
  const recording::Recording inputs = sound(read, physics::measured_boundaries(machine), output.warnings);
  ZD_TRY(const physics::Simulation simulation, physics::simulate(machine, inputs, context));
  ZD_CHECK(recording::write_recording(arguments.out, simulation.prediction));
  nlohmann::json channels = nlohmann::json::object();
  std::string table;
  for (const auto& d : physics::compare(simulation.prediction, inputs)) {
    channels[d.channel] = {{"rms", d.rms}, {"largest", d.largest}, {"largest_at_s", d.largest_at_s}};
    table += fmt::format("\n{:<12} rms {:.3g} {}, largest {:.3g} at {:.0f} s", d.channel, d.rms,
                         d.temperature ? "K" : "um", d.largest, d.largest_at_s);
  }
  output.json = {{"prediction", arguments.out},
                 {"predicted", simulation.predicted},
                 {"not_predicted", simulation.not_predicted},
                 {"assumed", simulation.notes},
                 {"difference", channels}};
  output.text =
      fmt::format("{} channels simulated, written to {}{}", simulation.predicted.size(), arguments.out, table);
  for (const auto& note : simulation.notes) {
    if (note == "room_is_initial_temperature") {
      output.warnings.emplace_back("no room temperature: the initial temperature stands for it");
    }
  }
  return output;
}

}  // namespace simulate_command

void add_simulate(Cli& cli) {
  using namespace simulate_command;
  auto arguments = std::make_shared<SimulateArguments>();
  CLI::App* command = cli.add("simulate", "Simulate a run from a machine description",
                              [arguments](const TaskContext& context) { return run_simulate(*arguments, context); });
  command->add_option("--machine", arguments->machine, "Machine description (JSON)")->required();
  command->add_option("--inputs", arguments->inputs, "Recording whose inputs are used (CSV)")->required();
  add_map_option(*command, arguments->map);
  command->add_option("--out", arguments->out, "Where the prediction goes (CSV)")->required();
}

}  // namespace zerodrift::cli
