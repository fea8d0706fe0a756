#pragma once
// Reports from the command line: built from the job, drawn without a display.

#include <filesystem>
#include <string>

#include "core/base/result.h"
#include "core/commissioning/job.h"
#include "core/report/text/language.h"

namespace zerodrift::cli {

/// wrong_format when the name does not end in .pdf, .html or .csv; asked before long work, not after.
Status check_report_name(const std::filesystem::path& path);
Status write_job_report(const commissioning::Job& job, const std::filesystem::path& path, report::Language language);
/// A sentence when nobody is named as the engineer; empty otherwise.
std::string nobody_named(const commissioning::Job& job);

}  // namespace zerodrift::cli
