// zerodrift-cli report: the report of a job, and where a figure in it comes from.

#include <fmt/format.h>

#include "app/cli/command.h"
#include "app/cli/report_files.h"
#include "core/commissioning/job.h"
#include "core/report/build.h"
#include "core/report/find_figure.h"

namespace zerodrift::cli {
namespace report_command {

struct Options {
  std::string job;
  std::string out;
  std::string trace;
};

Result<CommandOutput> trace(const commissioning::Job& job, const std::string& id) {
  CommandOutput output;
  ZD_TRY(const auto report, report::build_report(job));
  ZD_TRY(const auto figure, report::find_figure(report, id));
  output.json = {{"figure", figure.id},
                 {"label", figure.label},
                 {"value", figure.value},
                 {"unit", figure.unit},
                 {"artefact", figure.trace.artefact},
                 {"artefact_id", figure.trace.id},
                 {"detail", figure.trace.detail}};
  output.text = fmt::format("{} = {} {} ({}), from artefact {} #{}: {}", figure.id, figure.value, figure.unit,
                            figure.label, figure.trace.artefact, figure.trace.id, figure.trace.detail);
  return output;
}

Result<CommandOutput> run(const Options& options) {
  if (options.out.empty() && options.trace.empty()) {
    return fail(ErrorCode::bad_argument, {{"what", "report"}, {"found", "neither"}, {"expected", "--out or --trace"}});
  }
  ZD_TRY(const auto job, commissioning::Job::open_read_only(options.job));
  if (!options.trace.empty()) return trace(job, options.trace);
  ZD_CHECK(check_report_name(options.out));
  ZD_CHECK(write_job_report(job, options.out));
  CommandOutput output;
  output.json = {{"report", options.out}};
  output.text = "report: " + options.out;
  return output;
}

}  // namespace report_command

void add_report(Cli& cli) {
  using namespace report_command;
  auto options = std::make_shared<Options>();
  auto* command =
      cli.add("report", "Write the report of a job", [options](const TaskContext&) { return run(*options); });
  command->add_option("--job", options->job, "Job file")->required();
  command->add_option("--out", options->out, "Report to write: .pdf, .html or .csv");
  command->add_option("--trace", options->trace, "Say where the figure with this id comes from");
}

}  // namespace zerodrift::cli
