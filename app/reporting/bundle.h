#pragma once
// The technical bundle for support: one zip with the job, its report, the runs as CSV, what was fitted and written, the
// log, screenshots and versions. Passwords are never in it.

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/commissioning/job.h"
#include "core/report/text/language.h"

namespace zerodrift::reporting {

struct BundleExtra {
  std::string name;  // "screenshots/01-machine.png"
  std::string bytes;
};

struct BundleOptions {
  report::Language language = report::Language::english;
  std::string log;                  // of the window, as lines
  std::vector<BundleExtra> extras;  // pictures
};

/// Written whole or not at all. Needs a QApplication for the report.
Status write_bundle(const commissioning::Job& job, const std::filesystem::path& path, const BundleOptions& options);

}  // namespace zerodrift::reporting
