#pragma once
// The job: one file a commissioning. Every artefact with what it was made from, by whom and when; every run sample by
// sample; everything that was written to a machine.
//
// Safe to use from several threads: one lock inside, held for a call. One process writes a job at a time (job_busy);
// others may read. What a call has acknowledged is on the disk (WAL, synchronous FULL), except appended rows: they are
// from flush() on, which a recorder calls once a second.

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/commissioning/artefact.h"

namespace zerodrift::recording {
struct Recording;
}

namespace zerodrift::commissioning {

class Job {
 public:
  /// file_not_writable when the file is there already.
  static Result<Job> create(const std::filesystem::path& path, const JobHeader& header = {});
  /// job_not_a_job, job_newer, job_damaged, job_busy, file_not_found. Older files are brought up to date.
  static Result<Job> open(const std::filesystem::path& path);
  static Result<Job> open_or_create(const std::filesystem::path& path, const JobHeader& header = {});
  /// Works beside a writer and on a read-only disk. A file of an older version must be opened for writing once.
  static Result<Job> open_read_only(const std::filesystem::path& path);
  Job(Job&&) noexcept;
  Job& operator=(Job&&) noexcept;
  ~Job();

  const std::filesystem::path& path() const;
  bool read_only() const;
  std::string created_utc() const;

  // Header: changes are logged.
  Result<JobHeader> header() const;
  Status set_header(const JobHeader& header);
  Result<std::vector<HeaderChange>> header_changes() const;

  // Artefacts, in artefacts.cpp.
  Result<Artefact> put(const NewArtefact& artefact);
  Result<std::optional<Artefact>> latest(const std::string& kind) const;
  Result<Artefact> artefact(ArtefactId id) const;
  /// All of a kind, oldest first.
  Result<std::vector<Artefact>> history(const std::string& kind) const;
  /// The kinds there are.
  Result<std::vector<std::string>> kinds() const;
  Result<std::string> blob(ArtefactId id, const std::string& name) const;

  // Series, in series.cpp.
  /// `details` is a JSON text. Samples of a run still open after a crash may be appended to as before.
  Result<SeriesId> start_series(const std::string& name, const std::vector<std::string>& channels,
                                const std::string& details = "{}");
  /// Buffers one row; time_s strictly increasing; one value a channel, NaN for a missing one.
  Status append(SeriesId series, double time_s, std::span<const double> values);
  /// Writes the buffered rows of all series to the disk in one transaction. After a failure they stay buffered.
  Status flush();
  /// On the disk when it returns, together with the rows before it.
  Status add_event(SeriesId series, const Event& event);
  Status finish_series(SeriesId series, SeriesState state = SeriesState::finished);
  Result<SeriesInfo> series_info(SeriesId series) const;
  /// All, oldest first.
  Result<std::vector<SeriesInfo>> series() const;
  Result<std::vector<Event>> events(SeriesId series) const;
  /// The rows on the disk. A damaged chunk is job_damaged; with `damaged` given it is left out as a gap and listed
  /// there.
  Result<recording::Recording> read_series(SeriesId series, std::vector<Error>* damaged = nullptr) const;

  // Audit trail, in audit.cpp.
  Result<AuditEntry> audit(AuditEntry entry);
  Result<std::vector<AuditEntry>> audit_trail() const;
  /// job_damaged naming the first entry that was changed, removed or inserted.
  Status verify_audit() const;

  /// Everything: the database's own check, checksums of chunks, rows, blobs and artefacts, the audit trail.
  Result<CheckReport> check() const;

 private:
  struct Store;
  explicit Job(std::unique_ptr<Store> store);
  static Result<Job> open_checked(const std::filesystem::path& path, bool read_only);
  std::unique_ptr<Store> m_store;
};

}  // namespace zerodrift::commissioning
