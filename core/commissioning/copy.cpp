#include "core/commissioning/copy.h"

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

#include "core/base/hash.h"
#include "core/base/redact.h"
#include "core/commissioning/database.h"

namespace zerodrift::commissioning {
namespace {

struct Column {
  const char* table;
  const char* key;
  const char* column;
};

// Every text that a profile, an address or an error message may stand in.
constexpr Column columns[] = {
    {"artefact", "id", "body"},           {"series", "id", "details"}, {"event", "id", "text"},
    {"event", "id", "details"},           {"audit", "id", "subject"},  {"audit", "id", "old_value"},
    {"audit", "id", "new_value"},         {"audit", "id", "result"},   {"header_change", "id", "old_value"},
    {"header_change", "id", "new_value"}, {"header", "key", "value"}};

struct Change {
  std::string key;
  std::string text;
};

Result<std::vector<Change>> changes_in(Database& database, const Column& column) {
  ZD_TRY(Statement rows,
         database.prepare(fmt::format("SELECT {}, {} FROM {}", column.key, column.column, column.table)));
  std::vector<Change> changes;
  for (;;) {
    ZD_TRY(const bool row, rows.step());
    if (!row) return changes;
    const std::string text = rows.text(1);
    std::string clean = without_secrets(text);
    if (clean != text) changes.push_back({rows.text(0), std::move(clean)});
  }
}

Result<int> clean(Database& database) {
  int count = 0;
  for (const Column& column : columns) {
    ZD_TRY(const auto changes, changes_in(database, column));
    for (const Change& change : changes) {
      // Rows of a job cannot be changed; of this copy they must be.
      ZD_CHECK(database.execute("DROP TRIGGER IF EXISTS artefact_fixed; DROP TRIGGER IF EXISTS audit_fixed"));
      ZD_TRY(Statement update, database.prepare(fmt::format("UPDATE {} SET {} = ? WHERE CAST({} AS TEXT) = ?",
                                                            column.table, column.column, column.key)));
      ZD_CHECK(update.bind(1, change.text).bind(2, change.key).run());
      if (std::string_view(column.table) == "artefact") {  // or its reader would take the copy for damaged
        ZD_TRY(Statement sum, database.prepare("UPDATE artefact SET body_hash = ? WHERE CAST(id AS TEXT) = ?"));
        ZD_CHECK(sum.bind(1, sha256_hex(change.text)).bind(2, change.key).run());
      }
      ++count;
    }
  }
  // What was written over must not stay behind in free pages.
  if (count > 0) ZD_CHECK(database.execute("VACUUM"));
  return count;
}

}  // namespace

Result<int> copy_without_secrets(const std::filesystem::path& job, const std::filesystem::path& copy) {
  std::error_code ignored;
  std::filesystem::remove(copy, ignored);
  {
    ZD_TRY(const auto database, Database::open(job, OpenMode::read_only));
    std::string quoted;
    for (const char c : copy.string()) quoted += c == '\'' ? "''" : std::string(1, c);
    ZD_CHECK(database->execute("VACUUM INTO '" + quoted + "'"));
  }
  ZD_TRY(const auto database, Database::open(copy, OpenMode::read_write));
  return clean(*database);
}

}  // namespace zerodrift::commissioning
