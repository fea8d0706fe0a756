#include "core/controller/table_history.h"

#include <fmt/format.h>
#include <pwd.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "core/base/file.h"
#include "core/base/json.h"
#include "core/base/time_text.h"
#include "core/base/write_failure.h"

namespace zerodrift::controller {
namespace {

std::string now_utc() {
  return to_text(SystemClock().utc());
}

/// Two programs may add at the same time: the time alone is not enough.
std::string new_id() {
  static std::atomic<int> count = 0;
  return fmt::format("{}-{}-{}", now_utc(), ::getpid(), ++count);
}

bool is_there(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

}  // namespace

std::filesystem::path TableHistory::default_folder() {
  if (const char* own = std::getenv("ZERODRIFT_STATE_DIR"); own != nullptr && *own != '\0') return own;
  if (const char* state = std::getenv("XDG_STATE_HOME"); state != nullptr && *state != '\0') {
    return std::filesystem::path(state) / "zerodrift";
  }
  const char* home = std::getenv("HOME");
  return std::filesystem::path(home == nullptr ? "." : home) / ".local" / "state" / "zerodrift";
}

std::string TableHistory::user() {
  const passwd* entry = ::getpwuid(::getuid());
  return entry == nullptr ? std::to_string(::getuid()) : entry->pw_name;
}

std::filesystem::path TableHistory::log_file(std::uint32_t serial) const {
  return m_folder / fmt::format("tables-{}.jsonl", serial);
}

std::filesystem::path TableHistory::stack_file(std::uint32_t serial) const {
  return m_folder / fmt::format("tables-{}.json", serial);
}

Result<TableLog> TableHistory::read(std::uint32_t serial) const {
  if (const auto path = log_file(serial); is_there(path)) {
    ZD_TRY(const std::string text, read_file(path));
    return log_from_lines(text, path.string());
  }
  const auto path = stack_file(serial);
  if (!is_there(path)) return TableLog{};
  ZD_TRY(const nlohmann::json document, read_json_file(path));
  return log_from_stack(document, path.string());
}

/// The head, and what the first format held. Its file stays where it is.
Status TableHistory::start_log(std::uint32_t serial) const {
  if (is_there(log_file(serial))) return {};
  std::error_code failed;
  std::filesystem::create_directories(m_folder, failed);
  if (failed) return fail(write_failure(m_folder, failed.value()));
  ZD_TRY(const TableLog before, read(serial));
  std::string text = line_of_head(serial) + '\n';
  for (const TableEntry& entry : before.entries) text += line_of_entry(entry) + '\n';
  return write_file(log_file(serial), text);
}

Status TableHistory::append(std::uint32_t serial, const std::vector<std::string>& lines) const {
  if (lines.empty()) return {};
  ZD_CHECK(start_log(serial));
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return append_file(log_file(serial), text);
}

Result<TableLog> TableHistory::note_active(std::uint32_t serial, const ActiveTable& active) const {
  ZD_TRY(const TableLog before, read(serial));
  const std::string now = now_utc();
  TableLog after = with_active(before, active, now);
  std::vector<std::string> lines;
  for (const TableEntry& entry : before.entries) {
    const TableEntry* kept = after.find(entry.id);
    if (entry.unsettled) lines.push_back(line_of_end(entry.id, kept != nullptr, kept == nullptr ? now : entry.time));
  }
  const TableEntry& last = after.entries.back();
  const TableEntry* known = before.find(last.id);
  const bool fuller = known != nullptr && !known->words;  // its words were not kept, and the machine has them
  if (known == nullptr || fuller) lines.push_back(line_of_entry(last));
  ZD_CHECK(append(serial, lines));
  return after;
}

Status TableHistory::begin(std::uint32_t serial, TableEntry& entry) const {
  entry.id = new_id();
  entry.time = now_utc();
  return append(serial, {line_of_begin(entry)});
}

Status TableHistory::end(std::uint32_t serial, const std::string& id, bool active) const {
  return append(serial, {line_of_end(id, active, now_utc())});
}

Status TableHistory::add(std::uint32_t serial, TableEntry entry) const {
  entry.id = new_id();
  entry.time = now_utc();
  return append(serial, {line_of_entry(entry)});
}

Status TableHistory::note_switch(std::uint32_t serial, bool on) const {
  return append(serial, {line_of_switch(on, user(), now_utc())});
}

Status TableHistory::adopt(std::uint32_t serial, const std::vector<TableEntry>& entries) const {
  ZD_TRY(const TableLog log, read(serial));
  std::vector<std::string> lines;
  for (const TableEntry& entry : missing_in(log, entries)) lines.push_back(line_of_entry(entry, true));
  return append(serial, lines);
}

}  // namespace zerodrift::controller
