#include "core/controller/table_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "core/base/json.h"
#include "core/controller/table_words.h"

namespace zerodrift::controller {

using nlohmann::json;

namespace {

constexpr std::string_view log_format = "zerodrift-table-history/2";
constexpr std::string_view stack_format = "zerodrift-table-history/1";
constexpr std::array<std::string_view, 5> origin_names = {"found", "upload", "correction", "rollback", "restored"};

json json_of(const TableEntry& entry) {
  json out = {{"id", entry.id},           {"time", entry.time}, {"who", entry.who}, {"origin", name_of(entry.origin)},
              {"version", entry.version}, {"crc", entry.crc}};
  if (entry.words) out["words"] = *entry.words;
  if (!entry.of.empty()) out["of"] = entry.of;
  if (!entry.note.empty()) out["note"] = entry.note;
  return out;
}

std::vector<std::uint16_t> words_from(JsonObject& o) {
  std::vector<std::uint16_t> words;
  for (const double word : o.numbers("words")) {
    if (word < 0.0 || word > 65535.0) o.reject("words", fmt::format("{}", word), "register words, 0 to 65535");
    words.push_back(static_cast<std::uint16_t>(word));
  }
  return words;
}

TableEntry entry_from(JsonObject& o) {
  TableEntry entry;
  entry.id = o.text("id");
  entry.time = o.text_or("time", "");
  entry.who = o.text_or("who", "");
  const std::string origin = o.word("origin", std::vector<std::string>(origin_names.begin(), origin_names.end()));
  const auto at = std::find(origin_names.begin(), origin_names.end(), origin);
  entry.origin = static_cast<TableOrigin>(at - origin_names.begin());
  entry.version = o.integer("version", 0, 65535);
  entry.crc = static_cast<std::uint32_t>(o.number("crc", {0.0, 4294967295.0, false, "a check sum"}));
  if (o.has("words")) entry.words = words_from(o);
  entry.of = o.text_or("of", "");
  entry.note = o.text_or("note", "");
  return entry;
}

/// Reads line after line. What was not active is kept until the end: another program may know better in a later line.
class LogReader {
 public:
  void take(JsonObject& o) {
    const std::string what = o.word("line", {"head", "begin", "end", "entry", "adopted", "switch"});
    if (what == "head" || what == "switch") return;
    if (what == "end") return end(o.text("id"), o.flag_or("active", false), o.text_or("time", ""));
    TableEntry entry = entry_from(o.object("table"));
    entry.unsettled = what == "begin";
    if (Row* known = find(entry.id); known != nullptr) {
      if (!known->entry.words) known->entry = std::move(entry);  // its words came to be known
      return;
    }
    auto place = m_rows.end();
    if (what == "adopted") {
      place = std::find_if(m_rows.begin(), m_rows.end(), [&](const Row& r) { return r.entry.time > entry.time; });
    }
    m_rows.insert(place, Row{std::move(entry)});
  }

  std::vector<TableEntry> entries() && {
    std::vector<TableEntry> all;
    for (Row& row : m_rows) {
      if (!row.gone) all.push_back(std::move(row.entry));
    }
    return all;
  }

 private:
  struct Row {
    TableEntry entry;
    bool gone = false;
  };

  Row* find(const std::string& id) {
    const auto at = std::find_if(m_rows.begin(), m_rows.end(), [&](const Row& r) { return r.entry.id == id; });
    return at == m_rows.end() ? nullptr : &*at;
  }

  void end(const std::string& id, bool active, const std::string& time) {
    Row* row = find(id);
    if (row == nullptr) return;
    row->gone = !active;
    row->entry.unsettled = false;
    if (active && !time.empty()) row->entry.time = time;
  }

  std::vector<Row> m_rows;
};

/// The head says which format it is; without one in the first line it is no log.
Status check_head(const json& head, const std::string& file) {
  const bool told = head.is_object() && head.contains("format") && head.at("format").is_string();
  const std::string found = told ? head.at("format").get<std::string>() : "no format";
  if (found == log_format) return {};
  return fail(ErrorCode::wrong_format, {{"file", file}, {"found", found}, {"expected", std::string(log_format)}});
}

/// One line, whatever bytes a name may have.
std::string one_line(const json& value) {
  return json_text(value);
}

}  // namespace

std::string_view name_of(TableOrigin origin) {
  return origin_names.at(static_cast<std::size_t>(origin));
}

const TableEntry* TableLog::find(std::string_view id) const {
  const auto at = std::find_if(entries.begin(), entries.end(), [&](const TableEntry& e) { return e.id == id; });
  return at == entries.end() ? nullptr : &*at;
}

bool holds(const TableEntry& entry, const ActiveTable& active) {
  if (entry.words) return same_table(*entry.words, active.words);
  return entry.crc == crc_of_words(active.words);
}

TableLog with_active(TableLog log, const ActiveTable& active, const std::string& now_utc) {
  auto& entries = log.entries;
  while (!entries.empty() && entries.back().unsettled &&
         !(holds(entries.back(), active) && entries.back().version == active.sequence)) {
    entries.pop_back();
  }
  entries.erase(std::remove_if(entries.begin(), entries.end(),
                               [&](const TableEntry& e) { return e.unsettled && &e != &entries.back(); }),
                entries.end());
  const bool same = !entries.empty() && holds(entries.back(), active);
  const bool guessed = same && !entries.back().words;  // of the first format: the version after the one before
  if (!same || (entries.back().version != active.sequence && !guessed)) {
    TableEntry found{fmt::format("{}-found-{}", now_utc, active.sequence), now_utc, "", TableOrigin::found};
    found.version = active.sequence;
    found.crc = crc_of_words(active.words);
    found.words = active.words;
    if (same) found.of = entries.back().id;  // the same table under another number
    entries.push_back(std::move(found));
    return log;
  }
  TableEntry& last = entries.back();
  last.unsettled = false;
  last.version = active.sequence;
  if (!last.words) last.words = active.words;
  return log;
}

const TableEntry* before_last(const TableLog& log) {
  if (log.entries.empty()) return nullptr;
  const TableEntry* origin = &log.entries.back();
  if (origin->origin == TableOrigin::found && origin->of.empty()) return nullptr;
  // Each step leads to an earlier entry, so a log that was tampered with does not lead round in a circle.
  while (!origin->of.empty()) {
    const TableEntry* earlier = log.find(origin->of);
    if (earlier == nullptr || earlier >= origin) break;
    origin = earlier;
  }
  for (const TableEntry* one = origin; one != log.entries.data();) {
    --one;
    const bool same = one->words && origin->words ? same_table(*one->words, *origin->words) : one->crc == origin->crc;
    if (one->words && !same) return one;
  }
  return nullptr;
}

std::vector<TableEntry> missing_in(const TableLog& log, const std::vector<TableEntry>& others) {
  std::vector<TableEntry> missing;
  for (const TableEntry& other : others) {
    const bool known = std::any_of(log.entries.begin(), log.entries.end(), [&](const TableEntry& own) {
      return own.id == other.id || (own.version == other.version && own.crc == other.crc);
    });
    if (!known) missing.push_back(other);
  }
  return missing;
}

TableLog with_missing(TableLog log, const std::vector<TableEntry>& others) {
  auto missing = missing_in(log, others);
  for (TableEntry& entry : missing) {
    const auto later = std::find_if(log.entries.begin(), log.entries.end(),
                                    [&](const TableEntry& own) { return own.time > entry.time; });
    log.entries.insert(later, std::move(entry));
  }
  return log;
}

std::string line_of_head(std::uint32_t serial) {
  return one_line(json{{"line", "head"}, {"format", log_format}, {"serial", serial}});
}

std::string line_of_begin(const TableEntry& entry) {
  return one_line(json{{"line", "begin"}, {"table", json_of(entry)}});
}

std::string line_of_end(const std::string& id, bool active, const std::string& now_utc) {
  return one_line(json{{"line", "end"}, {"id", id}, {"active", active}, {"time", now_utc}});
}

std::string line_of_entry(const TableEntry& entry, bool adopted) {
  return one_line(json{{"line", adopted ? "adopted" : "entry"}, {"table", json_of(entry)}});
}

std::string line_of_switch(bool on, const std::string& who, const std::string& now_utc) {
  return one_line(json{{"line", "switch"}, {"on", on}, {"who", who}, {"time", now_utc}});
}

Result<TableLog> log_from_lines(std::string_view text, const std::string& file) {
  TableLog log;
  LogReader reader;
  bool first = true;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.empty()) continue;
    const auto document = parse_json(line, file);
    if (first) ZD_CHECK(check_head(document ? *document : json(), file));
    first = false;
    // A line that was torn by a power cut, or damaged on the disk, must not take the others with it.
    const bool good =
        document && read_object(*document, file, nullptr, [&](JsonObject& o) { reader.take(o); }).has_value();
    if (!good) ++log.damaged_lines;
  }
  log.entries = std::move(reader).entries();
  return log;
}

Result<TableLog> log_from_stack(const json& document, const std::string& file) {
  struct Former {
    std::string time;
    std::string who;
    int version = 0;
    std::vector<std::uint16_t> words;
    std::uint32_t replaced_by_crc = 0;
  };
  std::vector<Former> stack;
  ZD_CHECK(read_object(document, file, nullptr, [&](JsonObject& o) {
    o.word("format", {std::string(stack_format)});
    for (JsonObject& one : o.objects("tables")) {
      stack.push_back({one.text_or("time", ""), one.text_or("who", ""), one.integer_or("sequence", 0, 0, 65535),
                       words_from(one),
                       static_cast<std::uint32_t>(one.number_or("replaced_by_crc", 0.0, not_negative))});
    }
  }));
  TableLog log;
  // A former table says when and by whom the next one was written, and that one's check sum. Where the next one on the
  // stack is another (a rollback took something off in between), nobody knows about it.
  const Former* before = nullptr;
  for (const Former& one : stack) {
    TableEntry entry;
    entry.id = fmt::format("former-{}-{}", log.entries.size(), one.version);
    entry.version = one.version;
    entry.crc = crc_of_words(one.words);
    entry.words = one.words;
    if (before != nullptr && before->replaced_by_crc == entry.crc) {
      entry.time = before->time;
      entry.who = before->who;
      entry.origin = TableOrigin::upload;
    }
    log.entries.push_back(std::move(entry));
    before = &one;
  }
  if (before != nullptr) {
    TableEntry last{fmt::format("former-{}-last", log.entries.size()), before->time, before->who, TableOrigin::upload};
    last.version = std::min(before->version + 1, 65535);
    last.crc = before->replaced_by_crc;
    log.entries.push_back(std::move(last));
  }
  return log;
}

}  // namespace zerodrift::controller
