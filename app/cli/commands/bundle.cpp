// zerodrift-cli bundle: everything support needs of a job, in one zip, without passwords.

#include "app/reporting/bundle.h"

#include <algorithm>

#include "app/cli/command.h"
#include "core/base/file.h"

namespace zerodrift::cli {
namespace bundle_command {

struct Options {
  std::string job;
  std::string out;
  std::string pictures;
  std::string language = "en";
};

/// The pictures of a folder, by name.
Result<std::vector<reporting::BundleExtra>> pictures_of(const std::string& folder) {
  std::vector<reporting::BundleExtra> pictures;
  if (folder.empty()) return pictures;
  std::error_code problem;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder, problem)) {
    if (entry.path().extension() == ".png") files.push_back(entry.path());
  }
  if (problem) return fail(ErrorCode::file_unreadable, {{"file", folder}, {"detail", problem.message()}});
  std::sort(files.begin(), files.end());
  for (const auto& file : files) {
    ZD_TRY(std::string bytes, read_file(file));
    pictures.push_back({"screenshots/" + file.filename().string(), std::move(bytes)});
  }
  return pictures;
}

Result<CommandOutput> run(const Options& options) {
  if (std::filesystem::path(options.out).extension() != ".zip") {
    return fail(ErrorCode::wrong_format,
                {{"file", options.out}, {"found", "another ending"}, {"expected", "a name ending in .zip"}});
  }
  reporting::BundleOptions bundle;
  ZD_TRY(bundle.language, report::language_from(options.language));
  ZD_TRY(bundle.extras, pictures_of(options.pictures));
  ZD_TRY(const auto job, commissioning::Job::open_read_only(options.job));
  ZD_CHECK(reporting::write_bundle(job, options.out, bundle));
  CommandOutput output;
  output.json = {{"bundle", options.out}};
  output.text = "bundle: " + options.out;
  return output;
}

}  // namespace bundle_command

void add_bundle(Cli& cli) {
  using namespace bundle_command;
  auto options = std::make_shared<Options>();
  auto* command = cli.add("bundle", "One zip of a job for support: job, report, runs, tables, log; no passwords",
                          [options](const TaskContext&) { return run(*options); });
  command->add_option("--job", options->job, "Job file")->required();
  command->add_option("--out", options->out, "Bundle to write: .zip")->required();
  command->add_option("--pictures", options->pictures, "Folder whose PNG pictures go into it");
  command->add_option("--language", options->language, "Language of its report: en or zh");
}

}  // namespace zerodrift::cli
