// zerodrift-cli recording: a run of a job as CSV, for other tools and for cluster, fit and diagnose.

#include <fmt/format.h>

#include "app/cli/command.h"
#include "app/text/error_text.h"
#include "core/commissioning/job.h"
#include "core/recording/csv.h"

namespace zerodrift::cli {
namespace recording_command {

struct Options {
  std::string job;
  std::string run = "warm-up";
  std::string out;
};

Result<CommandOutput> run(const Options& options) {
  ZD_TRY(const auto job, commissioning::Job::open_read_only(options.job));
  ZD_TRY(const auto all, job.series());
  const commissioning::SeriesInfo* chosen = nullptr;
  std::string names;
  for (const auto& series : all) {
    if (series.name == options.run) chosen = &series;
    names += (names.empty() ? "" : ", ") + series.name;
  }
  if (chosen == nullptr) {
    return fail(ErrorCode::bad_argument,
                {{"what", "--run"}, {"found", options.run}, {"expected", names.empty() ? "a job with a run" : names}});
  }
  std::vector<Error> damaged;
  ZD_TRY(const auto recording, job.read_series(chosen->id, &damaged));
  if (recording.rows() == 0 && !damaged.empty()) return fail(damaged.front());
  ZD_CHECK(recording::write_recording(options.out, recording));
  CommandOutput output;
  for (const auto& error : damaged) output.warnings.push_back("left out: " + lineOf(error).toStdString());
  output.json = {{"run", options.run}, {"rows", recording.rows()}, {"out", options.out}};
  output.text = fmt::format("{}: {} rows of {}", options.out, recording.rows(), options.run);
  return output;
}

}  // namespace recording_command

void add_recording(Cli& cli) {
  using namespace recording_command;
  auto options = std::make_shared<Options>();
  auto* command =
      cli.add("recording", "Write a run of a job as CSV", [options](const TaskContext&) { return run(*options); });
  command->add_option("--job", options->job, "Job file")->required();
  command->add_option("--run", options->run, "warm-up or verification; the newest of this name");
  command->add_option("--out", options->out, "CSV to write")->required();
}

}  // namespace zerodrift::cli
