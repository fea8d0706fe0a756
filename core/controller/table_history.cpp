#include "core/controller/table_history.h"

#include <fmt/format.h>
#include <pwd.h>
#include <unistd.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "core/base/json.h"

namespace zerodrift::controller {
namespace {

constexpr std::size_t most_tables = 50;

FormerTable read_one(JsonObject& o) {
  FormerTable table;
  table.time = o.text_or("time", "");
  table.who = o.text_or("who", "");
  table.sequence = o.integer_or("sequence", 0, 0, 65535);
  table.replaced_by_crc = static_cast<std::uint32_t>(o.number_or("replaced_by_crc", 0.0, not_negative));
  for (const double word : o.numbers("words")) {
    if (word < 0.0 || word > 65535.0) o.reject("words", fmt::format("{}", word), "register words, 0 to 65535");
    table.words.push_back(static_cast<std::uint16_t>(word));
  }
  return table;
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

std::filesystem::path TableHistory::file_of(std::uint32_t serial) const {
  return m_folder / fmt::format("tables-{}.json", serial);
}

Result<std::vector<FormerTable>> TableHistory::read(std::uint32_t serial) const {
  const auto path = file_of(serial);
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return std::vector<FormerTable>{};
  ZD_TRY(const nlohmann::json document, read_json_file(path));
  return from_json<std::vector<FormerTable>>(document, path.string(), nullptr, [](JsonObject& o) {
    std::vector<FormerTable> tables;
    o.word("format", {"zerodrift-table-history/1"});
    for (JsonObject& one : o.objects("tables")) tables.push_back(read_one(one));
    return tables;
  });
}

Status TableHistory::write(std::uint32_t serial, const std::vector<FormerTable>& tables) const {
  std::error_code failed;
  std::filesystem::create_directories(m_folder, failed);
  if (failed) {
    return fail(ErrorCode::file_not_writable, {{"file", m_folder.string()}, {"detail", failed.message()}});
  }
  nlohmann::json list = nlohmann::json::array();
  for (const auto& table : tables) {
    list.push_back({{"time", table.time},
                    {"who", table.who},
                    {"sequence", table.sequence},
                    {"words", table.words},
                    {"replaced_by_crc", table.replaced_by_crc}});
  }
  return write_json_file(file_of(serial),
                         {{"format", "zerodrift-table-history/1"}, {"serial", serial}, {"tables", list}});
}

Status TableHistory::push(std::uint32_t serial, FormerTable table) const {
  ZD_TRY(std::vector<FormerTable> tables, read(serial));
  tables.push_back(std::move(table));
  if (tables.size() > most_tables) tables.erase(tables.begin());
  return write(serial, tables);
}

Status TableHistory::pop(std::uint32_t serial) const {
  ZD_TRY(std::vector<FormerTable> tables, read(serial));
  if (!tables.empty()) tables.pop_back();
  return write(serial, tables);
}

}  // namespace zerodrift::controller
