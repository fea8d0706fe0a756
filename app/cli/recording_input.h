#pragma once
// How commands take recordings: files in any logger's form, a header map for them, or the runs of a job.

#include <string>
#include <vector>

#include "app/cli/command.h"
#include "core/commissioning/job.h"
#include "core/recording/import/importer.h"

namespace zerodrift::cli {

/// --map of a command that reads a recording.
void add_map_option(CLI::App& command, std::string& map);

/// The recording, and in words what its import has to say.
Result<recording::Recording> recording_from(const std::string& file, const std::string& map,
                                            std::vector<std::string>& warnings);
Result<std::vector<recording::Recording>> recordings_from(const std::vector<std::string>& files, const std::string& map,
                                                          std::vector<std::string>& warnings);
/// For a command that takes recordings from files or a run from a job: one of both, else wrong usage.
void require_recording_or_job(CLI::App& command, const std::vector<std::string>& recordings, const std::string& job);
/// The warm-up run of a job.
Result<recording::Recording> run_in_job(const commissioning::Job& job);
/// An empty name is a map that says nothing.
Result<recording::HeaderMap> header_map_from(const std::string& file, std::vector<std::string>& warnings);

}  // namespace zerodrift::cli
