#include "app/cli/recording_input.h"

#include "app/text/error_text.h"
#include "core/flow/steps/inputs.h"

namespace zerodrift::cli {

void add_map_option(CLI::App& command, std::string& map) {
  command.add_option("--map", map, "Header map (JSON): what the columns of a file that is not in our form are");
}

Result<recording::HeaderMap> header_map_from(const std::string& file, std::vector<std::string>& warnings) {
  if (file.empty()) return recording::HeaderMap{};
  return recording::read_header_map(file, &warnings);
}

Result<recording::Recording> recording_from(const std::string& file, const std::string& map,
                                            std::vector<std::string>& warnings) {
  ZD_TRY(auto recordings, recordings_from({file}, map, warnings));
  return std::move(recordings.front());
}

Result<std::vector<recording::Recording>> recordings_from(const std::vector<std::string>& files, const std::string& map,
                                                          std::vector<std::string>& warnings) {
  ZD_TRY(const recording::HeaderMap header_map, header_map_from(map, warnings));
  std::vector<recording::Recording> out;
  for (const std::string& file : files) {
    ZD_TRY(recording::Imported imported, recording::import_file(file, header_map));
    for (const Error& warning : imported.warnings) {
      const std::string place = warning.context.contains("file") ? "" : file + ": ";
      warnings.push_back(place + lineOf(warning).toStdString());
    }
    out.push_back(std::move(imported.recording));
  }
  return out;
}

void require_recording_or_job(CLI::App& command, const std::vector<std::string>& recordings, const std::string& job) {
  command.parse_complete_callback([&recordings, &job] {
    if (recordings.empty() == job.empty()) throw CLI::RequiredError("--recording or --job: one of them");
  });
}

Result<recording::Recording> run_in_job(const commissioning::Job& job) {
  ZD_TRY(const flow::Input warmup, flow::need(job, "sensors", "warmup"));
  ZD_TRY(recording::Recording run, flow::run_of(job, warmup));
  run.name = job.path().string();
  return run;
}

}  // namespace zerodrift::cli
