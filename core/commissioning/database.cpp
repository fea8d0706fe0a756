#include "core/commissioning/database.h"

#include <sqlite3.h>

#include <system_error>
#include <utility>

namespace zerodrift::commissioning {
namespace {

constexpr int busy_timeout_ms = 2000;

bool has_log(const std::filesystem::path& path) {
  std::error_code ignored;
  const auto size = std::filesystem::file_size(path.string() + "-wal", ignored);
  return !ignored && size > 0;
}

/// A reader makes the log's files but must not remove them. The last connection that may write does.
void sweep_empty_log(const std::filesystem::path& path) {
  std::error_code failed;
  if (std::filesystem::file_size(path.string() + "-wal", failed) > 0 || failed) return;
  sqlite3* handle = nullptr;
  if (sqlite3_open_v2(path.string().c_str(), &handle, SQLITE_OPEN_READWRITE, nullptr) == SQLITE_OK) {
    sqlite3_exec(handle, "PRAGMA schema_version", nullptr, nullptr, nullptr);
  }
  sqlite3_close_v2(handle);
}

// A path as a URI; everything but plain characters is escaped.
std::string uri_of(const std::filesystem::path& path) {
  static constexpr char digits[] = "0123456789ABCDEF";
  std::string uri = "file:";
  for (const char c : std::filesystem::absolute(path).string()) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z') || (byte >= '0' && byte <= '9') ||
                       byte == '/' || byte == '.' || byte == '-' || byte == '_';
    if (plain) {
      uri += c;
    } else {
      uri += '%';
      uri += digits[byte >> 4];
      uri += digits[byte & 15];
    }
  }
  return uri + "?immutable=1";
}

}  // namespace

void Statement::Finalizer::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

Statement& Statement::bind(int position, std::int64_t value) {
  sqlite3_bind_int64(m_statement.get(), position, value);
  return *this;
}

Statement& Statement::bind(int position, double value) {
  sqlite3_bind_double(m_statement.get(), position, value);
  return *this;
}

Statement& Statement::bind(int position, std::string_view text) {
  sqlite3_bind_text64(m_statement.get(), position, text.data(), text.size(), SQLITE_TRANSIENT, SQLITE_UTF8);
  return *this;
}

Statement& Statement::bind_bytes(int position, std::string_view bytes) {
  // A null pointer would bind NULL instead of no bytes.
  const char* data = bytes.empty() ? "" : bytes.data();
  sqlite3_bind_blob64(m_statement.get(), position, data, bytes.size(), SQLITE_TRANSIENT);
  return *this;
}

Result<bool> Statement::step() {
  const int code = sqlite3_step(m_statement.get());
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  const Error error = m_database->error(code);
  sqlite3_reset(m_statement.get());
  return fail(error);
}

Status Statement::run() {
  for (;;) {
    ZD_TRY(const bool row, step());
    if (!row) break;
  }
  sqlite3_reset(m_statement.get());
  return {};
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(m_statement.get(), column);
}

double Statement::real(int column) const {
  return sqlite3_column_double(m_statement.get(), column);
}

std::string Statement::text(int column) const {
  const auto* data = sqlite3_column_text(m_statement.get(), column);
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(m_statement.get(), column));
  return data == nullptr ? std::string() : std::string(reinterpret_cast<const char*>(data), size);
}

std::string Statement::bytes(int column) const {
  const void* data = sqlite3_column_blob(m_statement.get(), column);
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(m_statement.get(), column));
  return data == nullptr ? std::string() : std::string(static_cast<const char*>(data), size);
}

Result<std::unique_ptr<Database>> Database::open(const std::filesystem::path& path, OpenMode mode) {
  std::unique_ptr<Database> database(new Database(path));
  ZD_CHECK(database->connect(mode));
  return database;
}

Status Database::connect(OpenMode mode) {
  m_mode = mode;
  const auto open_with = [&](const std::string& name, int flags) {
    sqlite3_close_v2(m_handle);
    m_handle = nullptr;
    // Opening never fails on a bad file: the first statement does.
    const int code = sqlite3_open_v2(name.c_str(), &m_handle, flags | SQLITE_OPEN_NOMUTEX, nullptr);
    if (code != SQLITE_OK) return code;
    sqlite3_extended_result_codes(m_handle, 1);
    sqlite3_busy_timeout(m_handle, busy_timeout_ms);
    // A job may come from elsewhere: its schema must not reach beyond its own tables.
    sqlite3_db_config(m_handle, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_db_config(m_handle, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    return sqlite3_exec(m_handle, "PRAGMA foreign_keys=ON; PRAGMA cell_size_check=ON; PRAGMA schema_version", nullptr,
                        nullptr, nullptr);
  };
  int flags = SQLITE_OPEN_READWRITE;
  if (mode == OpenMode::create) flags |= SQLITE_OPEN_CREATE;
  if (mode == OpenMode::read_only) flags = SQLITE_OPEN_READONLY;
  int code = open_with(m_path.string(), flags);
  // On a read-only disk the shared index of the log cannot be made; without a log the file alone is the whole job.
  const bool cannot = (code & 0xFF) == SQLITE_CANTOPEN || (code & 0xFF) == SQLITE_READONLY;
  if (mode == OpenMode::read_only && cannot && !has_log(m_path)) {
    code = open_with(uri_of(m_path), flags | SQLITE_OPEN_URI);
  }
  if (code != SQLITE_OK) return fail(error(code));
  return {};
}

Database::~Database() {
  sqlite3_close_v2(m_handle);
  if (m_mode == OpenMode::read_only) sweep_empty_log(m_path);
}

Error Database::error(int code) const {
  const std::string file = m_path.string();
  // The library's own words are for the log; people read ours.
  const std::string sqlite = m_handle == nullptr ? sqlite3_errstr(code) : sqlite3_errmsg(m_handle);
  const auto of = [&](ErrorCode kind, const char* detail) {
    return Error{kind, {{"file", file}, {"detail", detail}, {"sqlite", sqlite}}};
  };
  switch (code & 0xFF) {
    case SQLITE_NOTADB:
      return {ErrorCode::job_not_a_job, {{"file", file}}};
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return {ErrorCode::job_busy, {{"file", file}}};
    case SQLITE_FULL:
      return {ErrorCode::disk_full, {{"file", file}}};
    case SQLITE_READONLY:
      return of(ErrorCode::file_not_writable, "it is read-only");
    case SQLITE_PERM:
      return of(ErrorCode::file_unreadable, "it may not be read");
    case SQLITE_CANTOPEN:
      return of(ErrorCode::file_unreadable, "it cannot be opened");
    case SQLITE_IOERR:
      return of(ErrorCode::file_unreadable, "the disk gives an error");
    case SQLITE_CONSTRAINT:
      return of(ErrorCode::internal, "entries of the job contradict one another");
    case SQLITE_CORRUPT:
      return of(ErrorCode::job_damaged, "its pages do not hold together");
    // The statements are ours, so one that the file does not understand means tables are missing.
    default:
      return of(ErrorCode::job_damaged, "a part of it is missing");
  }
}

Status Database::execute(const std::string& sql) {
  const int code = sqlite3_exec(m_handle, sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) return fail(error(code));
  return {};
}

Result<Statement> Database::prepare(std::string_view sql) {
  sqlite3_stmt* statement = nullptr;
  const int code = sqlite3_prepare_v2(m_handle, sql.data(), static_cast<int>(sql.size()), &statement, nullptr);
  if (code != SQLITE_OK) return fail(error(code));
  return Statement(*this, statement);
}

Result<std::int64_t> Database::integer(std::string_view sql) {
  ZD_TRY(Statement statement, prepare(sql));
  ZD_TRY(const bool row, statement.step());
  return row ? statement.integer(0) : 0;
}

Result<std::string> Database::text(std::string_view sql) {
  ZD_TRY(Statement statement, prepare(sql));
  ZD_TRY(const bool row, statement.step());
  return row ? statement.text(0) : std::string();
}

std::int64_t Database::last_row_id() const {
  return sqlite3_last_insert_rowid(m_handle);
}

Result<Transaction> Transaction::begin(Database& database) {
  ZD_CHECK(database.execute("BEGIN IMMEDIATE"));
  return Transaction(database);
}

Transaction::Transaction(Transaction&& other) noexcept : m_database(std::exchange(other.m_database, nullptr)) {}

Transaction::~Transaction() {
  // A failed statement may have ended the transaction already; then this one fails and nothing is lost.
  if (m_database != nullptr) static_cast<void>(m_database->execute("ROLLBACK"));
}

Status Transaction::commit() {
  ZD_CHECK(m_database->execute("COMMIT"));
  m_database = nullptr;
  return {};
}

}  // namespace zerodrift::commissioning
