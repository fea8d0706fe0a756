#include "app/cli/report_files.h"

#include "app/reporting/writers.h"
#include "core/report/build.h"

namespace zerodrift::cli {

Status check_report_name(const std::filesystem::path& path) {
  const auto extension = path.extension();
  if (extension == ".pdf" || extension == ".html" || extension == ".htm" || extension == ".csv") return {};
  return fail(ErrorCode::wrong_format, {{"file", path.string()},
                                        {"found", "a name ending in \"" + extension.string() + "\""},
                                        {"expected", ".pdf, .html or .csv"}});
}

Status write_job_report(const commissioning::Job& job, const std::filesystem::path& path, report::Language language) {
  ZD_TRY(const auto report, report::build_report(job, language));
  return reporting::write_report(report, path);
}

std::string nobody_named(const commissioning::Job& job) {
  const auto header = job.header();
  if (!header || !header->engineer.empty()) return {};
  return "Nobody is named as the engineer of this job, and the report says so: enter the name on the Report page, or "
         "give it to commission as --engineer.";
}

}  // namespace zerodrift::cli
