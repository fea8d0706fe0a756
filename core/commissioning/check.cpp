#include <fmt/format.h>

#include <algorithm>

#include "core/base/hash.h"
#include "core/commissioning/artefact_hash.h"
#include "core/commissioning/job_store.h"

namespace zerodrift::commissioning {
namespace {

class Checker {
 public:
  Checker(Database& database, CheckReport& report) : m_database(database), m_report(report) {}

  void damaged(std::string detail) {
    m_report.problems.push_back(
        {ErrorCode::job_damaged, {{"file", m_database.path().string()}, {"detail", std::move(detail)}}});
  }

  void structure() {
    const auto answer = m_database.text("PRAGMA integrity_check(1)");
    if (!answer) {
      m_report.problems.push_back(answer.error());
    } else if (*answer != "ok") {
      damaged("its pages do not hold together");
      std::string words = *answer;
      std::replace(words.begin(), words.end(), '\n', ' ');
      m_report.problems.back().context["sqlite"] = std::move(words);
    }
  }

  /// Every row of a query; a database that cannot go on is a problem of its own.
  template <class Visit>
  void each(std::string_view sql, Visit visit) {
    auto rows = m_database.prepare(sql);
    if (!rows) return m_report.problems.push_back(rows.error());
    for (;;) {
      const auto row = rows->step();
      if (!row) return m_report.problems.push_back(row.error());
      if (!*row) return;
      visit(*rows);
    }
  }

  void samples() {
    each("SELECT series, first_row, rows, crc32, data FROM chunk", [&](const Statement& row) {
      ++m_report.chunks;
      if (crc32_of(row.bytes(4)) == row.integer(3)) return;
      damaged(fmt::format("series {}, rows {} to {}: checksum", row.integer(0), row.integer(1),
                          row.integer(1) + row.integer(2) - 1));
    });
    each("SELECT series, row, crc32, data FROM open_row", [&](const Statement& row) {
      ++m_report.open_rows;
      if (crc32_of(row.bytes(3)) == row.integer(2)) return;
      damaged(fmt::format("series {}, row {}: checksum", row.integer(0), row.integer(1)));
    });
  }

  void artefacts() {
    std::map<std::int64_t, std::map<std::string, std::string>> blob_hashes;
    each("SELECT artefact, name, sha256, bytes FROM blob", [&](const Statement& row) {
      blob_hashes[row.integer(0)][row.text(1)] = row.text(2);
      if (sha256_hex(row.bytes(3)) != row.text(2)) {
        damaged(fmt::format("artefact {}, {}: checksum", row.integer(0), row.text(1)));
      }
    });
    each("SELECT id, kind, body, content_hash, observed, body_hash FROM artefact", [&](const Statement& row) {
      ++m_report.artefacts;
      const auto id = row.integer(0);
      const std::string body = row.text(2);
      const std::string body_hash = row.text(5);  // none in artefacts of the first version
      const bool whole = body_hash.empty() || sha256_hex(body) == body_hash;
      const auto content_hash = content_hash_of(row.text(1), body, keys_from(row.text(4)), blob_hashes[id]);
      if (whole && content_hash == row.text(3)) return;
      damaged(fmt::format("artefact {} ({}): checksum", id, row.text(1)));
    });
  }

 private:
  Database& m_database;
  CheckReport& m_report;
};

}  // namespace

Result<CheckReport> Job::check() const {
  const std::scoped_lock lock(m_store->mutex);
  CheckReport report;
  // Beside somebody who writes, all of it as it was at one moment.
  const bool aside = m_store->read_only;
  if (aside) ZD_CHECK(m_store->database->execute("BEGIN"));
  Checker checker(*m_store->database, report);
  checker.structure();
  checker.samples();
  checker.artefacts();
  if (const Status trail = m_store->check_audit(&report.audit_entries); !trail)
    report.problems.push_back(trail.error());
  if (aside) ZD_CHECK(m_store->database->execute("END"));
  return report;
}

}  // namespace zerodrift::commissioning
