#pragma once
// What a Job holds; shared by its source files only.

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/commissioning/database.h"
#include "core/commissioning/job.h"
#include "core/commissioning/lock_file.h"

namespace zerodrift::commissioning {

/// The rows of a running series since its last full chunk.
struct SeriesTail {
  std::size_t channels = 0;
  std::int64_t base_row = 0;     // first row of the block
  std::int64_t stored_rows = 0;  // rows on the disk
  std::vector<double> block;     // row after row: time, then the channels
  double last_time_s = 0.0;

  std::size_t width() const { return channels + 1; }
  std::int64_t total_rows() const { return base_row + static_cast<std::int64_t>(block.size() / width()); }
};

struct Job::Store {
  std::filesystem::path path;
  bool read_only = false;
  std::unique_ptr<LockFile> lock;  // released after the database is closed
  std::unique_ptr<Database> database;
  mutable std::mutex mutex;
  std::map<SeriesId, SeriesTail> tails;
  /// By kind, once asked for: nothing changes an artefact, so its text is read and its checksum looked at once.
  mutable std::map<std::string, std::optional<Artefact>> newest;

  // These expect the mutex to be held.
  Status writable() const;
  Result<std::string> header_value(const std::string& key) const;
  Result<Artefact> read_artefact(ArtefactId id) const;
  Result<SeriesInfo> read_series_info(SeriesId id) const;
  Result<SeriesTail*> tail_of(SeriesId id);
  Status flush();
  Status write_tail(SeriesId id, SeriesTail& tail, bool fold_all);
  Status check_audit(int* entries) const;
};

std::string now_text();
std::string program_name();

}  // namespace zerodrift::commissioning
