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
  std::string language = "en";
};

Result<CommandOutput> trace(const commissioning::Job& job, const std::string& id, report::Language language) {
  CommandOutput output;
  ZD_TRY(const auto report, report::build_report(job, language));
  ZD_TRY(const auto figure, report::find_figure(report, id));
  ZD_TRY(output.json, report::origin_of(job, figure));
  output.text = report::origin_in_words(output.json);
  return output;
}

Result<CommandOutput> run(const Options& options) {
  if (options.out.empty() && options.trace.empty()) {
    return fail(ErrorCode::bad_argument, {{"what", "report"}, {"found", "neither"}, {"expected", "--out or --trace"}});
  }
  ZD_TRY(const auto language, report::language_from(options.language));
  ZD_TRY(const auto job, commissioning::Job::open_read_only(options.job));
  if (!options.trace.empty()) return trace(job, options.trace, language);
  ZD_CHECK(check_report_name(options.out));
  ZD_CHECK(write_job_report(job, options.out, language));
  CommandOutput output;
  if (auto warning = nobody_named(job); !warning.empty()) output.warnings.push_back(std::move(warning));
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
  command->add_option("--language", options->language, "Language of the report: en or zh");
  command->add_option("--trace", options->trace, "Say which artefact and rows the figure with this id comes from");
}

}  // namespace zerodrift::cli
