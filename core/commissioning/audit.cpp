#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/base/hash.h"
#include "core/base/json.h"
#include "core/base/redact.h"
#include "core/commissioning/job_store.h"
#include "core/commissioning/series_codec.h"

namespace zerodrift::commissioning {
namespace {

using nlohmann::json;

constexpr const char* audit_columns =
    "SELECT id, utc, engineer, machine, action, subject, old_value, new_value, result, previous_hash, hash FROM audit "
    "ORDER BY id";

AuditEntry entry_in(const Statement& row) {
  AuditEntry entry{row.text(3), row.text(4), row.text(5), row.text(6), row.text(7), row.text(8), 0, {}, {}, {}};
  entry.id = row.integer(0);
  entry.utc = row.text(1);
  entry.engineer = row.text(2);
  entry.hash = row.text(10);
  return entry;
}

std::string chained_hash(const AuditEntry& entry, const std::string& previous) {
  const json fields = {previous,     entry.id,      entry.utc,       entry.engineer,  entry.machine,
                       entry.action, entry.subject, entry.old_value, entry.new_value, entry.result};
  return sha256_hex(json_text(fields));
}

}  // namespace

Result<AuditEntry> Job::audit(AuditEntry entry) {
  const std::scoped_lock lock(m_store->mutex);
  ZD_CHECK(m_store->writable());
  Database& database = *m_store->database;
  ZD_TRY(Transaction transaction, Transaction::begin(database));
  ZD_TRY(entry.id, database.integer("SELECT coalesce(max(id), 0) + 1 FROM audit"));
  ZD_TRY(const std::string previous, database.text("SELECT hash FROM audit ORDER BY id DESC LIMIT 1"));
  ZD_TRY(entry.engineer, m_store->header_value("engineer"));
  for (std::string* text : {&entry.machine, &entry.subject, &entry.old_value, &entry.new_value, &entry.result}) {
    *text = without_secrets(*text);
  }
  entry.utc = now_text();
  entry.hash = chained_hash(entry, previous);
  ZD_TRY(Statement add, database.prepare("INSERT INTO audit (id, utc, engineer, machine, action, subject, old_value, "
                                         "new_value, result, previous_hash, hash) "
                                         "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"));
  add.bind(1, entry.id).bind(2, entry.utc).bind(3, entry.engineer).bind(4, entry.machine).bind(5, entry.action);
  add.bind(6, entry.subject).bind(7, entry.old_value).bind(8, entry.new_value).bind(9, entry.result);
  ZD_CHECK(add.bind(10, previous).bind(11, entry.hash).run());
  ZD_CHECK(transaction.commit());
  return entry;
}

Result<std::vector<AuditEntry>> Job::audit_trail() const {
  const std::scoped_lock lock(m_store->mutex);
  ZD_TRY(Statement rows, m_store->database->prepare(audit_columns));
  std::vector<AuditEntry> entries;
  for (;;) {
    ZD_TRY(const bool row, rows.step());
    if (!row) return entries;
    entries.push_back(entry_in(rows));
  }
}

Status Job::verify_audit() const {
  const std::scoped_lock lock(m_store->mutex);
  return m_store->check_audit(nullptr);
}

Status Job::Store::check_audit(int* entries) const {
  const auto broken = [&](std::int64_t id, const char* how) {
    return fail(ErrorCode::job_damaged,
                {{"file", path.string()}, {"detail", fmt::format("audit trail, entry {}: {}", id, how)}});
  };
  ZD_TRY(Statement rows, database->prepare(audit_columns));
  std::string previous;
  std::int64_t last = 0;
  for (;;) {
    ZD_TRY(const bool row, rows.step());
    if (!row) break;
    const AuditEntry entry = entry_in(rows);
    if (entry.id != last + 1) return broken(last + 1, "missing");
    if (rows.text(9) != previous || chained_hash(entry, previous) != entry.hash) return broken(entry.id, "changed");
    previous = entry.hash;
    last = entry.id;
    if (entries != nullptr) ++*entries;
  }
  // The table's counter outlives its rows: a trail cut at the end shows.
  ZD_TRY(const std::int64_t counted, database->integer("SELECT seq FROM sqlite_sequence WHERE name = 'audit'"));
  if (counted > last) return broken(last + 1, "missing");
  return {};
}

}  // namespace zerodrift::commissioning
