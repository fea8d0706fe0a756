#include "core/commissioning/schema.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <map>
#include <system_error>

namespace zerodrift::commissioning {
namespace {

// Rows of artefact, blob and audit are never changed or removed: redoing a step adds.
constexpr const char* tables_1 = R"sql(
CREATE TABLE header (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE header_change (id INTEGER PRIMARY KEY AUTOINCREMENT, utc TEXT NOT NULL, engineer TEXT NOT NULL,
  key TEXT NOT NULL, old_value TEXT NOT NULL, new_value TEXT NOT NULL);
CREATE TABLE artefact (id INTEGER PRIMARY KEY AUTOINCREMENT, kind TEXT NOT NULL, body TEXT NOT NULL,
  content_hash TEXT NOT NULL, input_hash TEXT NOT NULL, made_by TEXT NOT NULL, engineer TEXT NOT NULL,
  created_utc TEXT NOT NULL);
CREATE INDEX artefact_by_kind ON artefact (kind, id);
CREATE TABLE artefact_input (artefact INTEGER NOT NULL REFERENCES artefact (id),
  input INTEGER NOT NULL REFERENCES artefact (id), content_hash TEXT NOT NULL,
  PRIMARY KEY (artefact, input)) WITHOUT ROWID;
CREATE TABLE blob (artefact INTEGER NOT NULL REFERENCES artefact (id), name TEXT NOT NULL, sha256 TEXT NOT NULL,
  bytes BLOB NOT NULL, PRIMARY KEY (artefact, name));
CREATE TABLE series (id INTEGER PRIMARY KEY AUTOINCREMENT, name TEXT NOT NULL, channels TEXT NOT NULL,
  details TEXT NOT NULL, state TEXT NOT NULL, made_by TEXT NOT NULL, engineer TEXT NOT NULL, started_utc TEXT NOT NULL,
  last_utc TEXT NOT NULL, content_hash TEXT NOT NULL);
CREATE TABLE chunk (series INTEGER NOT NULL REFERENCES series (id), first_row INTEGER NOT NULL, rows INTEGER NOT NULL,
  crc32 INTEGER NOT NULL, data BLOB NOT NULL, PRIMARY KEY (series, first_row));
CREATE TABLE open_row (series INTEGER NOT NULL REFERENCES series (id), row INTEGER NOT NULL, crc32 INTEGER NOT NULL,
  data BLOB NOT NULL, PRIMARY KEY (series, row)) WITHOUT ROWID;
CREATE TABLE event (id INTEGER PRIMARY KEY AUTOINCREMENT, series INTEGER NOT NULL REFERENCES series (id),
  time_s REAL NOT NULL, utc TEXT NOT NULL, kind TEXT NOT NULL, text TEXT NOT NULL, details TEXT NOT NULL);
CREATE INDEX event_by_series ON event (series, id);
CREATE TABLE audit (id INTEGER PRIMARY KEY AUTOINCREMENT, utc TEXT NOT NULL, engineer TEXT NOT NULL,
  machine TEXT NOT NULL, action TEXT NOT NULL, subject TEXT NOT NULL, old_value TEXT NOT NULL, new_value TEXT NOT NULL,
  result TEXT NOT NULL, previous_hash TEXT NOT NULL, hash TEXT NOT NULL);
CREATE TRIGGER audit_kept BEFORE DELETE ON audit BEGIN SELECT RAISE (ABORT, 'the audit trail is append-only'); END;
CREATE TRIGGER audit_fixed BEFORE UPDATE ON audit BEGIN SELECT RAISE (ABORT, 'the audit trail is append-only'); END;
CREATE TRIGGER artefact_kept BEFORE DELETE ON artefact BEGIN SELECT RAISE (ABORT, 'artefacts are kept'); END;
CREATE TRIGGER artefact_fixed BEFORE UPDATE ON artefact BEGIN SELECT RAISE (ABORT, 'artefacts are kept'); END;
CREATE TRIGGER blob_kept BEFORE DELETE ON blob BEGIN SELECT RAISE (ABORT, 'artefacts are kept'); END;
CREATE TRIGGER blob_fixed BEFORE UPDATE ON blob BEGIN SELECT RAISE (ABORT, 'artefacts are kept'); END;
)sql";

Status to_version_1(Database& database) {
  ZD_CHECK(database.execute(fmt::format("PRAGMA application_id={}", application_id)));
  return database.execute(tables_1);
}

// Readings of the moment, kept beside what counts for equality.
Status to_version_2(Database& database) {
  return database.execute(
      "ALTER TABLE artefact ADD COLUMN observed TEXT NOT NULL DEFAULT '[]';"
      "ALTER TABLE artefact ADD COLUMN body_hash TEXT NOT NULL DEFAULT ''");
}

using Objects = std::map<std::string, std::string>;  // name -> its SQL

/// What acts by itself in a database: triggers, views, virtual tables.
Result<Objects> active_objects(Database& database) {
  ZD_TRY(Statement rows, database.prepare("SELECT name, sql FROM sqlite_master WHERE type IN ('trigger', 'view') OR "
                                          "(type = 'table' AND sql LIKE 'CREATE VIRTUAL%')"));
  Objects objects;
  for (;;) {
    ZD_TRY(const bool row, rows.step());
    if (!row) return objects;
    objects[rows.text(0)] = rows.text(1);
  }
}

Result<Objects> own_objects() {
  ZD_TRY(const auto database, Database::open(":memory:", OpenMode::create));
  ZD_CHECK(database->execute(tables_1));
  return active_objects(*database);
}

}  // namespace

Status check_schema(Database& database) {
  ZD_TRY(const Objects own, own_objects());
  ZD_TRY(const Objects found, active_objects(database));
  for (const auto& [name, sql] : found) {
    const auto at = own.find(name);
    if (at != own.end() && at->second == sql) continue;
    return fail(ErrorCode::job_damaged, {{"file", database.path().string()},
                                         {"detail", fmt::format("\"{}\" in it was not made by this program", name)}});
  }
  return {};
}

Status restore_guards(Database& database) {
  ZD_TRY(const Objects own, own_objects());
  ZD_TRY(const Objects found, active_objects(database));
  for (const auto& [name, sql] : own) {
    if (found.count(name) == 0) ZD_CHECK(database.execute(sql));
  }
  return {};
}

std::span<const Migration> migrations() {
  static const std::array<Migration, 2> steps = {to_version_1, to_version_2};
  return steps;
}

Result<std::int64_t> known_version(Database& database, std::span<const Migration> steps) {
  const std::string file = database.path().string();
  ZD_TRY(const std::int64_t id, database.integer("PRAGMA application_id"));
  ZD_TRY(const std::int64_t version, database.integer("PRAGMA user_version"));
  if (id != application_id || version < 1) return fail(ErrorCode::job_not_a_job, {{"file", file}});
  const auto newest = static_cast<std::int64_t>(steps.size());
  if (version > newest) {
    return fail(ErrorCode::job_newer,
                {{"file", file}, {"found", std::to_string(version)}, {"expected", std::to_string(newest)}});
  }
  return version;
}

Status migrate(Database& database, std::span<const Migration> steps) {
  ZD_TRY(const std::int64_t from, database.integer("PRAGMA user_version"));
  if (from == static_cast<std::int64_t>(steps.size())) return {};
  if (from > 0) {
    const std::filesystem::path copy = fmt::format("{}.v{}.bak", database.path().string(), from);
    std::error_code ignored;
    std::filesystem::remove(copy, ignored);  // left by an attempt that was broken off
    ZD_TRY(Statement statement, database.prepare("VACUUM INTO ?"));
    ZD_CHECK(statement.bind(1, copy.string()).run());
  }
  for (std::size_t version = static_cast<std::size_t>(from); version < steps.size(); ++version) {
    ZD_TRY(Transaction transaction, Transaction::begin(database));
    ZD_CHECK(steps[version](database));
    ZD_CHECK(database.execute(fmt::format("PRAGMA user_version={}", version + 1)));
    ZD_CHECK(transaction.commit());
  }
  return {};
}

}  // namespace zerodrift::commissioning
