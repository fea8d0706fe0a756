#include "core/commissioning/job.h"

#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "core/base/time_text.h"
#include "core/base/write_failure.h"
#include "core/commissioning/job_store.h"
#include "core/commissioning/schema.h"

namespace zerodrift::commissioning {
namespace {

constexpr const char* header_keys[] = {"machine", "serial", "customer", "engineer", "notes"};

std::string& field(JobHeader& header, std::string_view key) {
  if (key == "machine") return header.machine;
  if (key == "serial") return header.serial;
  if (key == "customer") return header.customer;
  if (key == "engineer") return header.engineer;
  return header.notes;
}

Status write_header_value(Database& database, std::string_view key, std::string_view value) {
  ZD_TRY(Statement statement, database.prepare("INSERT OR REPLACE INTO header (key, value) VALUES (?, ?)"));
  return statement.bind(1, key).bind(2, value).run();
}

// The whole file is made under another name first: a job is there with all its tables or not at all.
Status make_file(const std::filesystem::path& path, const JobHeader& header) {
  // The database's own words for a folder that may not be written to are of no use.
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  if (::access(folder.c_str(), W_OK) != 0) return fail(write_failure(path, errno));
  const std::filesystem::path temporary = path.string() + ".new";
  std::error_code ignored;
  std::filesystem::remove(temporary, ignored);
  {
    ZD_TRY(const auto database, Database::open(temporary, OpenMode::create));
    ZD_CHECK(migrate(*database, migrations()));
    ZD_CHECK(write_header_value(*database, "created_utc", now_text()));
    JobHeader copy = header;
    for (const char* key : header_keys) ZD_CHECK(write_header_value(*database, key, field(copy, key)));
  }
  std::error_code error;
  std::filesystem::create_hard_link(temporary, path, error);  // unlike a rename it never replaces a file
  if (error && error != std::errc::file_exists) std::filesystem::rename(temporary, path, error);  // no links here (FAT)
  std::filesystem::remove(temporary, ignored);
  if (error) return fail(write_failure(path, error.value()));
  return {};
}

}  // namespace

std::string now_text() {
  return to_text(std::chrono::time_point_cast<std::chrono::milliseconds>(std::chrono::system_clock::now()));
}

std::string program_name() {
  return "zerodrift " ZERODRIFT_VERSION;
}

Job::Job(std::unique_ptr<Store> store) : m_store(std::move(store)) {}
Job::Job(Job&&) noexcept = default;
Job& Job::operator=(Job&&) noexcept = default;

Job::~Job() {
  // What is buffered was not promised, but keep it if the disk lets us.
  if (m_store != nullptr && !m_store->read_only) static_cast<void>(flush());
}

Result<Job> Job::create(const std::filesystem::path& path, const JobHeader& header) {
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored)) {
    return fail(ErrorCode::file_not_writable, {{"file", path.string()}, {"detail", "the file is there already"}});
  }
  ZD_CHECK(make_file(path, header));
  return open(path);
}

Result<Job> Job::open(const std::filesystem::path& path) {
  return open_checked(path, false);
}

Result<Job> Job::open_or_create(const std::filesystem::path& path, const JobHeader& header) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored) ? open(path) : create(path, header);
}

Result<Job> Job::open_read_only(const std::filesystem::path& path) {
  return open_checked(path, true);
}

Result<Job> Job::open_checked(const std::filesystem::path& path, bool read_only) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return fail(ErrorCode::file_not_found, {{"file", path.string()}});
  if (std::filesystem::is_directory(path, ignored)) return fail(ErrorCode::job_not_a_job, {{"file", path.string()}});
  auto store = std::make_unique<Store>();
  store->path = path;
  store->read_only = read_only;
  {
    // A look first, so that a foreign file gets neither a lock nor a log beside it.
    ZD_TRY(const auto database, Database::open(path, OpenMode::read_only));
    ZD_TRY(const std::int64_t version, known_version(*database, migrations()));
    ZD_CHECK(check_schema(*database));
    if (read_only && version < static_cast<std::int64_t>(migrations().size())) {
      return fail(ErrorCode::file_not_writable,
                  {{"file", path.string()}, {"detail", "its older format needs updating"}});
    }
  }
  if (!read_only) {
    ZD_TRY(store->lock, LockFile::take(path));
    if (::access(path.c_str(), W_OK) != 0) {  // the database would open such a file for reading without a word
      return fail(ErrorCode::file_not_writable, {{"file", path.string()}, {"detail", "Permission denied"}});
    }
  }
  ZD_TRY(store->database, Database::open(path, read_only ? OpenMode::read_only : OpenMode::read_write));
  if (!read_only) {
    ZD_CHECK(store->database->execute("PRAGMA journal_mode=WAL; PRAGMA synchronous=FULL"));
    ZD_CHECK(migrate(*store->database, migrations()));
  }
  for (const char* table : {"header", "artefact", "artefact_input", "blob", "series", "chunk", "open_row", "event",
                            "audit", "header_change"}) {
    ZD_CHECK(store->database->prepare(std::string("SELECT * FROM ") + table + " LIMIT 1"));
  }
  if (!read_only) ZD_CHECK(restore_guards(*store->database));
  return Job(std::move(store));
}

const std::filesystem::path& Job::path() const {
  return m_store->path;
}

bool Job::read_only() const {
  return m_store->read_only;
}

std::string Job::created_utc() const {
  const std::scoped_lock lock(m_store->mutex);
  return m_store->header_value("created_utc").value_or(std::string());
}

Status Job::Store::writable() const {
  if (!read_only) return {};
  return fail(ErrorCode::file_not_writable, {{"file", path.string()}, {"detail", "opened for reading"}});
}

Result<std::string> Job::Store::header_value(const std::string& key) const {
  ZD_TRY(Statement statement, database->prepare("SELECT value FROM header WHERE key = ?"));
  ZD_TRY(const bool row, statement.bind(1, key).step());
  return row ? statement.text(0) : std::string();
}

Result<JobHeader> Job::header() const {
  const std::scoped_lock lock(m_store->mutex);
  JobHeader header;
  for (const char* key : header_keys) {
    ZD_TRY(field(header, key), m_store->header_value(key));
  }
  return header;
}

Status Job::set_header(const JobHeader& header) {
  const std::scoped_lock lock(m_store->mutex);
  ZD_CHECK(m_store->writable());
  Database& database = *m_store->database;
  ZD_TRY(Transaction transaction, Transaction::begin(database));
  const std::string utc = now_text();
  JobHeader wanted = header;
  for (const char* key : header_keys) {
    ZD_TRY(const std::string old_value, m_store->header_value(key));
    if (old_value == field(wanted, key)) continue;
    ZD_CHECK(write_header_value(database, key, field(wanted, key)));
    ZD_TRY(Statement log, database.prepare("INSERT INTO header_change (utc, engineer, key, old_value, new_value) "
                                           "VALUES (?, ?, ?, ?, ?)"));
    ZD_CHECK(
        log.bind(1, utc).bind(2, wanted.engineer).bind(3, key).bind(4, old_value).bind(5, field(wanted, key)).run());
  }
  return transaction.commit();
}

Result<std::vector<HeaderChange>> Job::header_changes() const {
  const std::scoped_lock lock(m_store->mutex);
  ZD_TRY(Statement rows,
         m_store->database->prepare("SELECT utc, engineer, key, old_value, new_value FROM header_change ORDER BY id"));
  std::vector<HeaderChange> changes;
  for (;;) {
    ZD_TRY(const bool row, rows.step());
    if (!row) return changes;
    changes.push_back({rows.text(0), rows.text(1), rows.text(2), rows.text(3), rows.text(4)});
  }
}

}  // namespace zerodrift::commissioning
