#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/hash.h"
#include "core/base/json.h"
#include "core/commissioning/job_store.h"
#include "core/commissioning/series_codec.h"
#include "core/recording/recording.h"

namespace zerodrift::commissioning {
namespace {

using nlohmann::json;

std::string text_of(SeriesState state) {
  if (state == SeriesState::finished) return "finished";
  return state == SeriesState::aborted ? "aborted" : "open";
}

SeriesState state_from(const std::string& text) {
  if (text == "finished") return SeriesState::finished;
  return text == "aborted" ? SeriesState::aborted : SeriesState::open;
}

tl::unexpected<Error> wrong(const char* what, std::string found, std::string expected) {
  return fail(ErrorCode::bad_argument,
              {{"what", what}, {"found", std::move(found)}, {"expected", std::move(expected)}});
}

tl::unexpected<Error> damaged_rows(const std::filesystem::path& path, SeriesId id, std::int64_t first,
                                   std::int64_t count) {
  return fail(ErrorCode::job_damaged,
              {{"file", path.string()},
               {"detail", fmt::format("series {}, rows {} to {}: checksum", id, first, first + count - 1)}});
}

struct StoredRows {
  std::int64_t first = 0;
  std::int64_t count = 0;
  bool whole = false;        // checksum and size are right
  std::vector<double> rows;  // row after row
};

// One statement for both layouts: chunks, then the rows of the open chunk.
Result<Statement> stored_rows(Database& database, SeriesId id) {
  ZD_TRY(Statement statement, database.prepare("SELECT first_row, rows, crc32, data, 1 FROM chunk WHERE series = ?1 "
                                               "UNION ALL SELECT row, 1, crc32, data, 0 FROM open_row "
                                               "WHERE series = ?1 ORDER BY 1"));
  statement.bind(1, id);
  return statement;
}

StoredRows decode(const Statement& statement, std::size_t width) {
  constexpr std::int64_t most_rows = 1 << 20;  // no chunk of ours is so long; a damaged count must not take the memory
  StoredRows stored{statement.integer(0), statement.integer(1), false, {}};
  const std::string data = statement.bytes(3);
  if (stored.count < 1 || stored.count > most_rows || crc32_of(data) != statement.integer(2)) return stored;
  const auto count = static_cast<std::size_t>(stored.count);
  stored.whole =
      statement.integer(4) != 0 ? decode_chunk(data, count, width, stored.rows) : decode_row(data, width, stored.rows);
  return stored;
}

}  // namespace

Result<SeriesId> Job::start_series(const std::string& name, const std::vector<std::string>& channels,
                                   const std::string& details) {
  const std::scoped_lock lock(m_store->mutex);
  ZD_CHECK(m_store->writable());
  Database& database = *m_store->database;
  ZD_TRY(const std::string engineer, m_store->header_value("engineer"));
  ZD_TRY(Statement add,
         database.prepare("INSERT INTO series (name, channels, details, state, made_by, engineer, started_utc, "
                          "last_utc, content_hash) VALUES (?, ?, ?, 'open', ?, ?, ?, ?, '')"));
  const std::string utc = now_text();
  add.bind(1, name).bind(2, json_text(json(channels))).bind(3, details).bind(4, program_name()).bind(5, engineer);
  ZD_CHECK(add.bind(6, utc).bind(7, utc).run());
  const SeriesId id = database.last_row_id();
  SeriesTail tail;
  tail.channels = channels.size();
  tail.last_time_s = -std::numeric_limits<double>::infinity();
  m_store->tails[id] = std::move(tail);
  return id;
}

Result<SeriesTail*> Job::Store::tail_of(SeriesId id) {
  if (const auto at = tails.find(id); at != tails.end()) return &at->second;
  ZD_TRY(const SeriesInfo info, read_series_info(id));
  if (info.state != SeriesState::open) return wrong("series", text_of(info.state), "one that is not closed");
  SeriesTail tail;
  tail.channels = info.channels.size();
  tail.stored_rows = info.rows;
  tail.last_time_s = -std::numeric_limits<double>::infinity();
  ZD_TRY(Statement rows, stored_rows(*database, id));
  for (;;) {
    ZD_TRY(const bool row, rows.step());
    if (!row) break;
    const StoredRows stored = decode(rows, tail.width());
    const bool chunk = rows.integer(4) != 0;
    // A damaged chunk is a gap for the reader and no reason not to go on after it.
    if (!stored.whole && !chunk) return damaged_rows(path, id, stored.first, stored.count);
    if (stored.whole) tail.last_time_s = stored.rows[stored.rows.size() - tail.width()];
    if (chunk) {
      tail.base_row = stored.first + stored.count;
    } else {
      tail.block.insert(tail.block.end(), stored.rows.begin(), stored.rows.end());
    }
  }
  return &(tails[id] = std::move(tail));
}

Status Job::append(SeriesId series, double time_s, std::span<const double> values) {
  const std::scoped_lock lock(m_store->mutex);
  ZD_CHECK(m_store->writable());
  ZD_TRY(SeriesTail * tail, m_store->tail_of(series));
  if (values.size() != tail->channels) {
    return wrong("values of a row", std::to_string(values.size()), std::to_string(tail->channels));
  }
  if (!std::isfinite(time_s) || time_s <= tail->last_time_s) {
    return wrong("time of a row", fmt::format("{} s", time_s), fmt::format("after {} s", tail->last_time_s));
  }
  tail->block.push_back(time_s);
  tail->block.insert(tail->block.end(), values.begin(), values.end());
  tail->last_time_s = time_s;
  return {};
}

Status Job::flush() {
  const std::scoped_lock lock(m_store->mutex);
  return m_store->flush();
}

Status Job::Store::flush() {
  for (auto& [id, tail] : tails) {
    if (tail.total_rows() > tail.stored_rows) ZD_CHECK(write_tail(id, tail, false));
  }
  return {};
}

/// Writes what is not on the disk yet; full chunks (with `fold_all` the last short one too) replace their single rows.
/// The tail changes only once the transaction is through.
Status Job::Store::write_tail(SeriesId id, SeriesTail& tail, bool fold_all) {
  ZD_TRY(Transaction transaction, Transaction::begin(*database));
  const std::span<const double> block = tail.block;
  const std::size_t rows_in_block = block.size() / tail.width();
  std::size_t folded = 0;  // rows of the block that are in chunks now
  for (;;) {
    const std::size_t count = std::min(chunk_rows, rows_in_block - folded);
    if (count == 0 || (count < chunk_rows && !fold_all)) break;
    const std::string data = encode_chunk(block.subspan(folded * tail.width(), count * tail.width()), tail.width());
    ZD_TRY(Statement add,
           database->prepare("INSERT INTO chunk (series, first_row, rows, crc32, data) VALUES (?, ?, ?, ?, ?)"));
    add.bind(1, id).bind(2, tail.base_row + static_cast<std::int64_t>(folded));
    add.bind(3, static_cast<std::int64_t>(count)).bind(4, static_cast<std::int64_t>(crc32_of(data)));
    ZD_CHECK(add.bind_bytes(5, data).run());
    folded += count;
  }
  const std::int64_t new_base = tail.base_row + static_cast<std::int64_t>(folded);
  if (folded > 0) {
    ZD_TRY(Statement drop, database->prepare("DELETE FROM open_row WHERE series = ? AND row < ?"));
    ZD_CHECK(drop.bind(1, id).bind(2, new_base).run());
  }
  ZD_TRY(Statement add, database->prepare("INSERT INTO open_row (series, row, crc32, data) VALUES (?, ?, ?, ?)"));
  for (std::int64_t row = std::max(tail.stored_rows, new_base); row < tail.total_rows(); ++row) {
    const auto offset = static_cast<std::size_t>(row - tail.base_row) * tail.width();
    const std::string data = encode_row(block.subspan(offset, tail.width()));
    add.bind(1, id).bind(2, row).bind(3, static_cast<std::int64_t>(crc32_of(data))).bind_bytes(4, data);
    ZD_CHECK(add.run());
  }
  ZD_TRY(Statement stamp, database->prepare("UPDATE series SET last_utc = ? WHERE id = ?"));
  ZD_CHECK(stamp.bind(1, now_text()).bind(2, id).run());
  ZD_CHECK(transaction.commit());
  tail.stored_rows = tail.total_rows();
  tail.block.erase(tail.block.begin(), tail.block.begin() + static_cast<std::ptrdiff_t>(folded * tail.width()));
  tail.base_row = new_base;
  return {};
}

Status Job::add_event(SeriesId series, const Event& event) {
  const std::scoped_lock lock(m_store->mutex);
  ZD_CHECK(m_store->writable());
  ZD_CHECK(m_store->flush());
  ZD_TRY(Statement add, m_store->database->prepare("INSERT INTO event (series, time_s, utc, kind, text, details) "
                                                   "VALUES (?, ?, ?, ?, ?, ?)"));
  add.bind(1, series).bind(2, event.time_s).bind(3, now_text()).bind(4, event.kind).bind(5, event.text);
  return add.bind(6, event.details).run();
}

Status Job::finish_series(SeriesId series, SeriesState state) {
  const std::scoped_lock lock(m_store->mutex);
  ZD_CHECK(m_store->writable());
  Database& database = *m_store->database;
  ZD_TRY(SeriesTail * tail, m_store->tail_of(series));
  ZD_CHECK(m_store->write_tail(series, *tail, true));
  ZD_TRY(const SeriesInfo info, m_store->read_series_info(series));
  std::string text = json_text(json(info.channels)) + "\n" + info.details + "\n";
  ZD_TRY(Statement chunks, database.prepare("SELECT data FROM chunk WHERE series = ? ORDER BY first_row"));
  chunks.bind(1, series);
  for (;;) {
    ZD_TRY(const bool row, chunks.step());
    if (!row) break;
    text += sha256_hex(chunks.bytes(0)) + "\n";
  }
  ZD_TRY(Statement close, database.prepare("UPDATE series SET state = ?, content_hash = ?, last_utc = ? WHERE id = ?"));
  ZD_CHECK(close.bind(1, text_of(state)).bind(2, sha256_hex(text)).bind(3, now_text()).bind(4, series).run());
  m_store->tails.erase(series);
  return {};
}

Result<SeriesInfo> Job::Store::read_series_info(SeriesId id) const {
  ZD_TRY(Statement rows,
         database->prepare("SELECT name, channels, details, state, made_by, engineer, started_utc, last_utc, "
                           "content_hash, (SELECT coalesce(sum(rows), 0) FROM chunk WHERE series = ?1) + "
                           "(SELECT count(*) FROM open_row WHERE series = ?1) FROM series WHERE id = ?1"));
  ZD_TRY(const bool row, rows.bind(1, id).step());
  if (!row) return wrong("series", std::to_string(id), "one that is in the job");
  SeriesInfo info{id,           rows.text(0), {},           rows.text(2), state_from(rows.text(3)), rows.text(4),
                  rows.text(5), rows.text(6), rows.text(7), rows.text(8), rows.integer(9)};
  const json channels = json::parse(rows.text(1), nullptr, false);
  if (!channels.is_array()) {
    return fail(ErrorCode::job_damaged,
                {{"file", path.string()}, {"detail", "channels of series " + std::to_string(id)}});
  }
  for (const json& channel : channels) info.channels.push_back(channel.is_string() ? channel.get<std::string>() : "");
  return info;
}

Result<SeriesInfo> Job::series_info(SeriesId series) const {
  const std::scoped_lock lock(m_store->mutex);
  return m_store->read_series_info(series);
}

Result<std::vector<SeriesInfo>> Job::series() const {
  const std::scoped_lock lock(m_store->mutex);
  ZD_TRY(Statement rows, m_store->database->prepare("SELECT id FROM series ORDER BY id"));
  std::vector<SeriesInfo> all;
  for (;;) {
    ZD_TRY(const bool row, rows.step());
    if (!row) return all;
    ZD_TRY(SeriesInfo info, m_store->read_series_info(rows.integer(0)));
    all.push_back(std::move(info));
  }
}

Result<std::vector<Event>> Job::events(SeriesId series) const {
  const std::scoped_lock lock(m_store->mutex);
  ZD_TRY(Statement rows,
         m_store->database->prepare("SELECT time_s, kind, text, details, utc FROM event WHERE series = ? ORDER BY id"));
  rows.bind(1, series);
  std::vector<Event> events;
  for (;;) {
    ZD_TRY(const bool row, rows.step());
    if (!row) return events;
    events.push_back({rows.real(0), rows.text(1), rows.text(2), rows.text(3), rows.text(4)});
  }
}

Result<recording::Recording> Job::read_series(SeriesId series, std::vector<Error>* damaged) const {
  const std::scoped_lock lock(m_store->mutex);
  ZD_TRY(const SeriesInfo info, m_store->read_series_info(series));
  recording::Recording out;
  out.name = info.name;
  const auto rows = static_cast<std::size_t>(info.rows);
  out.time_s.reserve(rows);
  for (const auto& name : info.channels) {
    out.channels.push_back({name, {}});
    out.channels.back().values.reserve(rows);
  }
  ZD_TRY(Statement statement, stored_rows(*m_store->database, series));
  const std::size_t width = info.channels.size() + 1;
  for (;;) {
    ZD_TRY(const bool row, statement.step());
    if (!row) return out;
    const StoredRows stored = decode(statement, width);
    if (!stored.whole) {
      const auto error = damaged_rows(m_store->path, series, stored.first, stored.count);
      if (damaged == nullptr) return error;
      damaged->push_back(error.value());
      continue;
    }
    for (std::size_t at = 0; at < stored.rows.size(); at += width) {
      out.time_s.push_back(stored.rows[at]);
      for (std::size_t c = 0; c + 1 < width; ++c) out.channels[c].values.push_back(stored.rows[at + 1 + c]);
    }
  }
}

}  // namespace zerodrift::commissioning
