// diagnose --machine M.json --recording R.csv [--recording ...] --out diagnosis.json [--refined M2.json] [--report
// p.html] All recordings are explained together.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <map>

#include "app/cli/recording_input.h"
#include "app/reporting/proof_html.h"
#include "core/base/file.h"
#include "core/base/json.h"
#include "core/commissioning/job.h"
#include "core/diagnosis/diagnosis.h"
#include "core/flow/flow.h"
#include "core/flow/steps/diagnose_step.h"
#include "core/flow/steps/recordings_step.h"

namespace zerodrift::cli {
namespace diagnose_command {

struct DiagnoseArguments {
  std::string machine;
  std::vector<std::string> recordings;
  std::string map;
  std::string job;
  std::string out;
  std::string refined;
  std::string report;
};

/// Said as a warning.
bool is_of_a_run(const diagnosis::Sentence& sentence) {
  return sentence.id.starts_with("run_");
}

std::string row_of(const std::string& channel, double nominal, double refitted, double explained) {
  return fmt::format("\n{:<14} {:>8.3g} {:>10.3g} {:>12.3g}", channel, nominal, refitted, explained);
}

/// When and by how many watts a channel that stays unexplained is off.
std::string when_of(const diagnosis::ChannelReport& channel) {
  if (channel.verdict != diagnosis::ChannelVerdict::unexplained) return {};
  std::string text;
  for (const auto& [from_s, to_s] : channel.time_s)
    text += fmt::format("{}{:.0f}-{:.0f}", text.empty() ? " at " : ", ", from_s / 60.0, to_s / 60.0);
  if (!text.empty()) text += " min";
  if (channel.temperature && channel.missing_heat_W != 0.0) text += fmt::format(", {:.0f} W", channel.missing_heat_W);
  return text;
}

/// The explanations that were likeliest, and how far the others are behind.
std::string tried_of(const diagnosis::Diagnosis& d) {
  constexpr std::size_t most = 5;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, d.tried.size()); ++i) {
    const diagnosis::Tried& one = d.tried[i];
    std::vector<std::string> parts = one.effects;
    parts.insert(parts.end(), one.mistakes.begin(), one.mistakes.end());
    text += fmt::format("{}{} ({:.2f}, {:.1f} behind)", i == 0 ? "tried: " : "; ",
                        parts.empty() ? "as described" : fmt::format("{}", fmt::join(parts, " + ")), one.probability,
                        one.behind);
  }
  return text.empty() ? text : text + "\n";
}

std::string text_of(const diagnosis::Diagnosis& d) {
  std::string text;
  for (const auto& sentence : d.sentences) {
    if (!is_of_a_run(sentence)) text += sentence.english + "\n";
  }
  for (const auto& effect : d.effects) {
    text += fmt::format("- {} (confidence {:.2f}): {}\n", effect.id, effect.confidence, effect.explanation.english);
  }
  for (const auto& rival : d.ambiguous_with) text += "  " + rival.why.english + "\n";
  if (d.suggested && !d.suggested->text.english.empty()) text += "  " + d.suggested->text.english + "\n";
  text += tried_of(d);
  text += fmt::format("{:<14} {:>8} {:>10} {:>12}  {:<12} rms in K or um", d.held_out.empty() ? "" : "first", "nominal",
                      "re-fitted", "with effect", "verdict");
  for (const auto& channel : d.channels) {
    text += row_of(channel.channel, channel.rms_nominal, channel.rms_refitted, channel.rms_explained) + "  " +
            std::string(diagnosis::name_of(channel.verdict)) + when_of(channel);
  }
  for (const auto& other : d.held_out) {
    text += "\n" + other.recording;
    for (const auto& channel : d.channels) {
      const auto rms = [&](const std::map<std::string, double>& all) {
        const auto found = all.find(channel.channel);
        return found == all.end() ? std::numeric_limits<double>::quiet_NaN() : found->second;
      };
      if (other.nominal.count(channel.channel) == 0) continue;
      text += row_of(channel.channel, rms(other.nominal), rms(other.refitted), rms(other.explained));
    }
  }
  return text;
}

Result<std::vector<recording::Recording>> recordings_of(const DiagnoseArguments& arguments,
                                                        std::vector<std::string>& warnings) {
  if (arguments.job.empty()) return recordings_from(arguments.recordings, arguments.map, warnings);
  ZD_TRY(const auto job, commissioning::Job::open_read_only(arguments.job));
  ZD_TRY(auto run, run_in_job(job));
  ZD_TRY(auto runs, flow::further_runs(job));
  runs.insert(runs.begin(), std::move(run));
  return runs;
}

Status keep_diagnosis(const DiagnoseArguments& arguments, const diagnosis::Diagnosis& result,
                      const TaskContext& context) {
  ZD_TRY(const nlohmann::json machine, read_json_file(arguments.machine));
  ZD_TRY(auto job, commissioning::Job::open(arguments.job));
  // The machine is a file here, no artefact of the job.
  const auto keep = [&](commissioning::Job& in, const TaskContext& inner) {
    return flow::with_diagnosis(in, machine, result, inner);
  };
  return flow::Flow().take_in(job, "physics", keep, context).map([](const auto&) {});
}

Result<CommandOutput> run_diagnose(const DiagnoseArguments& arguments, const TaskContext& context) {
  CommandOutput output;
  ZD_TRY(const physics::Machine machine, physics::read_machine(arguments.machine, &output.warnings));
  ZD_TRY(const std::vector<recording::Recording> recordings, recordings_of(arguments, output.warnings));
  ZD_TRY(const diagnosis::Diagnosis result, diagnosis::diagnose(machine, recordings, {}, context));
  output.json = diagnosis::to_json(result);
  ZD_CHECK(write_json_file(arguments.out, output.json));
  if (!arguments.job.empty()) ZD_CHECK(keep_diagnosis(arguments, result, context));
  if (!arguments.refined.empty()) ZD_CHECK(write_json_file(arguments.refined, physics::to_json(result.refined)));
  if (!arguments.report.empty()) ZD_CHECK(write_file(arguments.report, reporting::proof_html(machine, result)));
  output.text = text_of(result);
  for (const auto& sentence : result.sentences) {
    if (is_of_a_run(sentence)) output.warnings.push_back(sentence.english);
  }
  for (const auto& note : result.notes) {
    if (note.code == diagnosis::NoteCode::no_excitation)
      output.warnings.emplace_back("nothing drives the machine in this recording: little can be learned from it");
    if (note.code == diagnosis::NoteCode::missing_channel)
      output.warnings.push_back(note.facts.at("recording") + " has no channel " + note.facts.at("channel"));
  }
  return output;
}

}  // namespace diagnose_command

void add_diagnose(Cli& cli) {
  using namespace diagnose_command;
  auto arguments = std::make_shared<DiagnoseArguments>();
  CLI::App* command = cli.add("diagnose", "Find the physics that a simulation left out",
                              [arguments](const TaskContext& context) { return run_diagnose(*arguments, context); });
  command->add_option("--machine", arguments->machine, "Machine description (JSON)")->required();
  command->add_option("--recording", arguments->recordings,
                      "Recording (CSV); several of one machine are explained together");
  command->add_option("--job", arguments->job, "Job whose run is taken instead; what was found is kept in it");
  require_recording_or_job(*command, arguments->recordings, arguments->job);
  add_map_option(*command, arguments->map);
  command->add_option("--out", arguments->out, "Where the diagnosis goes (JSON)")->required();
  command->add_option("--refined", arguments->refined, "Where the refined machine description goes (JSON)");
  command->add_option("--report", arguments->report, "Where the proof goes (HTML)");
}

}  // namespace zerodrift::cli
