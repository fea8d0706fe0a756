// Register maps out and in: as JSON, and from a CSV list of registers such as a PLC's project exports.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/file.h"
#include "core/base/json.h"
#include "core/controller/register_map.h"
#include "core/controller/register_names.h"
#include "core/recording/csv.h"

namespace zerodrift::controller {
namespace {

using nlohmann::json;
using recording::TextTable;

// Modicon's numbers: 40001 is the first holding register, 30001 the first input register (or with six digits).
constexpr int first_holding = 40001;
constexpr int first_input = 30001;
constexpr int first_holding_long = 400001;
constexpr int first_input_long = 300001;

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return c < 0x80 ? static_cast<char>(std::tolower(c)) : static_cast<char>(c); });
  return text;
}

int column_of(const TextTable& table, const std::vector<std::string>& names) {
  for (const auto& name : names) {
    for (std::size_t i = 0; i < table.header.size(); ++i) {
      if (lower(table.header[i]) == name) return static_cast<int>(i);
    }
  }
  return -1;
}

struct MapColumns {
  int name, address, function, type, count, scale, sign, missing, word_order, byte_order;
};

MapColumns map_columns(const TextTable& table) {
  return {column_of(table, {"name", "register", "meaning", "tag", "symbol", "variable"}),
          column_of(table, {"address", "addr", "adresse", "number", "offset"}),
          column_of(table, {"function", "space", "area", "fc"}),
          column_of(table, {"type", "datatype", "data type", "data_type", "format"}),
          column_of(table, {"count", "length", "size", "elements"}),
          column_of(table, {"scale", "factor", "gain", "multiplier"}),
          column_of(table, {"sign"}),
          column_of(table, {"missing", "no value", "invalid"}),
          column_of(table, {"word_order", "word order", "words"}),
          column_of(table, {"byte_order", "byte order", "bytes"})};
}

std::optional<std::string> type_word(std::string word) {
  word = lower(std::move(word));
  const std::vector<std::pair<const char*, std::vector<const char*>>> known = {
      {"int16", {"int16", "int", "short", "s16", "i16", "signed"}},
      {"uint16", {"uint16", "uint", "word", "ushort", "u16", "unsigned", "bool", ""}},
      {"int32", {"int32", "dint", "long", "s32", "i32"}},
      {"uint32", {"uint32", "udint", "dword", "ulong", "u32"}},
      {"float32", {"float32", "real", "float", "single", "f32"}}};
  for (const auto& [type, words] : known) {
    if (std::any_of(words.begin(), words.end(), [&](const char* one) { return word == one; })) return type;
  }
  return std::nullopt;
}

std::optional<std::string> function_word(std::string word) {
  word = lower(std::move(word));
  for (const char* one : {"holding", "holding register", "hr", "3", "03", "4x", "6", "16", ""}) {
    if (word == one) return "holding";
  }
  for (const char* one : {"input", "input register", "ir", "4", "04", "3x"}) {
    if (word == one) return "input";
  }
  return std::nullopt;
}

std::optional<std::string> order_word(std::string word) {
  word = lower(std::move(word));
  for (const char* one : {"high_first", "high first", "high", "big", "big endian", "abcd", "ab"}) {
    if (word == one) return "high_first";
  }
  for (const char* one : {"low_first", "low first", "low", "little", "little endian", "cdab", "ba", "swapped"}) {
    if (word == one) return "low_first";
  }
  return std::nullopt;
}

/// One row of the list as the JSON of a register; what is wrong names file, line and column.
class RowReader {
 public:
  RowReader(const TextTable& table, const MapColumns& columns, std::size_t row)
      : m_table(table), m_columns(columns), m_row(row) {}

  std::string text(int column) const {
    return column < 0 ? std::string() : m_table.rows[m_row][static_cast<std::size_t>(column)];
  }

  Result<json> read() const {
    json entry = json::object();
    ZD_TRY(int address, whole(m_columns.address));
    std::string function = text(m_columns.function);
    if (address >= first_holding_long) {
      address -= first_holding_long;
    } else if (address >= first_input_long) {
      address -= first_input_long;
      function = "input";
    } else if (function.empty() && address >= first_holding && address < 50000) {
      address -= first_holding;
    } else if (function.empty() && address >= first_input && address < 40000) {
      address -= first_input;
      function = "input";
    }
    entry["address"] = address;
    ZD_TRY(entry["function"], word(m_columns.function, function_word(function), "holding or input"));
    ZD_TRY(entry["type"],
           word(m_columns.type, type_word(text(m_columns.type)), "int16, uint16, int32, uint32 or float32"));
    if (!text(m_columns.count).empty()) {
      ZD_TRY(entry["count"], whole(m_columns.count));
    }
    for (const auto& [column, key] : {std::pair{m_columns.scale, "scale"}, std::pair{m_columns.missing, "missing"}}) {
      if (text(column).empty()) continue;
      ZD_TRY(entry[key], recording::number_in(m_table, m_row, column));
    }
    if (!text(m_columns.sign).empty()) {
      ZD_TRY(entry["sign"], sign());
    }
    for (const auto& [column, key] :
         {std::pair{m_columns.word_order, "word_order"}, std::pair{m_columns.byte_order, "byte_order"}}) {
      if (text(column).empty()) continue;
      ZD_TRY(entry[key], word(column, order_word(text(column)), "high_first or low_first"));
    }
    return entry;
  }

 private:
  tl::unexpected<Error> reject(int column, const std::string& expected) const {
    const std::string name = column < 0 ? "address" : m_table.header[static_cast<std::size_t>(column)];
    return fail(ErrorCode::data_does_not_fit,
                {{"what", fmt::format("{}, line {}, {}", m_table.file, m_table.lines[m_row], name)},
                 {"found", text(column)},
                 {"expected", expected}});
  }
  Result<int> whole(int column) const {
    std::string digits = text(column);
    int base = 10;
    if (lower(digits).starts_with("0x")) {
      digits = digits.substr(2);
      base = 16;
    }
    int value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, base);
    if (digits.empty() || error != std::errc{} || end != digits.data() + digits.size() || value < 0) {
      return reject(column, "a whole number of 0 or more");
    }
    return value;
  }
  Result<int> sign() const {
    const std::string word = text(m_columns.sign);
    if (word == "-1" || word == "-") return -1;
    if (word == "1" || word == "+1" || word == "+") return 1;
    return reject(m_columns.sign, "1 or -1");
  }
  Result<std::string> word(int column, const std::optional<std::string>& found, const std::string& expected) const {
    if (found) return *found;
    return reject(column, expected);
  }

  const TextTable& m_table;
  const MapColumns& m_columns;
  std::size_t m_row;
};

/// "temperature_C[3]" -> "temperature_C"; empty when the name is no element.
std::string array_of(const std::string& name) {
  const auto open = name.find('[');
  return open == std::string::npos || !name.ends_with("]") ? std::string() : name.substr(0, open);
}

const char* type_name(RegisterType type) {
  switch (type) {
    case RegisterType::int16:
      return "int16";
    case RegisterType::uint16:
      return "uint16";
    case RegisterType::int32:
      return "int32";
    case RegisterType::uint32:
      return "uint32";
    case RegisterType::float32:
      return "float32";
  }
  return "";
}

const char* order_name(bool high_first) {
  return high_first ? "high_first" : "low_first";
}

}  // namespace

json to_json(const Register& entry) {
  json out = {{"address", entry.address}, {"type", type_name(entry.type)}};
  if (entry.space == RegisterSpace::input) out["function"] = "input";
  if (entry.count != 1) out["count"] = entry.count;
  if (entry.scale != 1.0) out["scale"] = entry.scale;
  if (entry.sign != 1) out["sign"] = entry.sign;
  if (entry.missing_raw) out["missing"] = *entry.missing_raw;
  if (!entry.high_word_first) out["word_order"] = order_name(false);
  if (!entry.high_byte_first) out["byte_order"] = order_name(false);
  return out;
}

json to_json(const RegisterMap& map) {
  json registers = json::object();
  for (const auto& [name, entry] : map.registers) registers[name] = to_json(entry);
  json readable = json::array();
  for (const auto& block : map.readable) {
    json one = {{"from", block.first}, {"to", block.last}};
    if (block.space == RegisterSpace::input) one["function"] = "input";
    readable.push_back(std::move(one));
  }
  json out = {{"format", "zerodrift-register-map/1"},
              {"name", map.name},
              {"base", 0},
              {"max_read", map.max_read},
              {"max_write", map.max_write},
              {"host_offset_step_um", map.host_offset_step_um},
              {"readable", readable},
              {"registers", registers}};
  if (map.unit) out["unit"] = *map.unit;
  if (map.magic) out["magic"] = *map.magic;
  return out;
}

Result<RegisterMap> register_map_from_csv(std::string_view text, const std::string& file,
                                          std::vector<std::string>* warnings) {
  ZD_TRY(const TextTable table, recording::parse_table(text, file));
  const MapColumns columns = map_columns(table);
  if (columns.name < 0 || columns.address < 0) {
    return fail(ErrorCode::csv_bad_header, {{"file", file},
                                            {"column", columns.name < 0 ? "name" : "address"},
                                            {"found", fmt::format("{}", fmt::join(table.header, ","))},
                                            {"expected",
                                             "name,address and, as needed, function,type,count,scale,sign,"
                                             "missing,word_order,byte_order"}});
  }
  json registers = json::object();
  std::map<std::string, int> elements;  // of arrays given one by one
  std::vector<std::string> unused;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const RowReader reader(table, columns, row);
    std::string name = reader.text(columns.name);
    const auto at_line = fmt::format("{}, line {}", file, table.lines[row]);
    ZD_TRY(json entry, reader.read());
    if (const std::string array = array_of(name); !array.empty()) {
      if (const int so_far = elements[array]++; so_far > 0) {
        const int words = entry.at("type").get<std::string>().ends_with("16") ? 1 : 2;
        const int expected = registers.at(array).at("address").get<int>() + so_far * words;
        if (entry.at("address") != expected) {
          return fail(ErrorCode::data_does_not_fit,
                      {{"what", fmt::format("{}, address of {}", at_line, name)},
                       {"found", std::to_string(entry.at("address").get<int>())},
                       {"expected", std::to_string(expected) + ", next to the one before"}});
        }
        registers[array]["count"] = so_far + 1;
        continue;
      }
      name = array;
    }
    if (name.empty() || registers.contains(name)) {
      return fail(ErrorCode::data_does_not_fit, {{"what", at_line + ", name"},
                                                 {"found", name.empty() ? "none" : name + ", a second time"},
                                                 {"expected", "a name of its own for each register"}});
    }
    if (find_register_name(name) == nullptr) unused.push_back(name);
    registers[name] = std::move(entry);
  }
  if (!unused.empty() && warnings != nullptr) {
    warnings->push_back(fmt::format("{}: no use is known for {}; give them one of the names of docs/register-maps.md",
                                    file, fmt::join(unused, ", ")));
  }
  const json document = {{"format", "zerodrift-register-map/1"},
                         {"name", std::filesystem::path(file).stem().string()},
                         {"base", 0},
                         {"registers", registers}};
  return register_map_from_json(document, file, warnings);
}

Result<RegisterMap> read_register_list(const std::filesystem::path& path, std::vector<std::string>* warnings) {
  ZD_TRY(const std::string text, read_file(path));
  const auto first = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (first == std::string::npos || text[first] != '{') return register_map_from_csv(text, path.string(), warnings);
  ZD_TRY(const json document, parse_json(text, path.string()));
  return register_map_from_json(document, path.string(), warnings);
}

}  // namespace zerodrift::controller
