#include "core/controller/register_list.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/controller/register_list_words.h"
#include "core/controller/register_names.h"
#include "core/recording/import/text_table.h"

namespace zerodrift::controller {
namespace {

using list_words::ListAddress;
using list_words::ListColumn;
using nlohmann::json;
using recording::Cells;

constexpr std::size_t rows_before_the_header = 60;

/// The list as cells: columns by what they hold.
struct List {
  std::string file;
  Cells cells;
  recording::NumberFormat numbers;
  std::size_t header = 0;  // row
  std::map<ListColumn, std::size_t> columns;
  std::optional<int> base;  // as the header of the addresses says: "Address (1-based)"

  std::string text(std::size_t row, ListColumn column) const {
    const auto at = columns.find(column);
    return at == columns.end() ? std::string() : std::string(cells.at(row, at->second));
  }
  std::string heading(ListColumn column) const {
    const auto at = columns.find(column);
    return at == columns.end() ? std::string("address") : std::string(cells.at(header, at->second));
  }
  tl::unexpected<Error> reject(std::size_t row, ListColumn column, const std::string& found,
                               const std::string& expected) const {
    return fail(ErrorCode::column_unclear, {{"file", file},
                                            {"line", std::to_string(cells.line(row))},
                                            {"column", heading(column)},
                                            {"found", found.empty() ? "nothing" : found},
                                            {"expected", expected}});
  }
};

bool holds_numbers(const Cells& cells, std::size_t header, std::size_t column) {
  for (std::size_t row = header + 1; row < cells.rows(); ++row) {
    const std::string_view cell = cells.at(row, column);
    if (!cell.empty() && !list_words::address_word(cell)) return false;
  }
  return true;
}

/// The first row that names a column of names and one of addresses.
std::optional<List> list_in(const recording::SourceCells& source) {
  const Cells& cells = source.cells;
  for (std::size_t row = 0; row < std::min(cells.rows(), rows_before_the_header); ++row) {
    List list;
    std::vector<std::size_t> either;  // names, or addresses where they are numbers
    for (std::size_t k = 0; k < cells.columns(row); ++k) {
      const ListColumn column = list_words::list_column(cells.at(row, k));
      if (list_words::may_be_address(cells.at(row, k)) && holds_numbers(cells, row, k)) {
        either.push_back(k);
      } else if (column != ListColumn::unknown && column != ListColumn::remark) {
        list.columns.try_emplace(column, k);
      }
    }
    for (const std::size_t k : either) {
      const bool address = !list.columns.contains(ListColumn::address);
      list.columns.try_emplace(address ? ListColumn::address : list_words::list_column(cells.at(row, k)), k);
    }
    if (!list.columns.contains(ListColumn::name) || !list.columns.contains(ListColumn::address)) continue;
    list.header = row;
    return list;
  }
  return std::nullopt;
}

Result<List> read_list(std::string_view bytes, const std::string& file) {
  std::string first_line;
  for (const char* separator : {"", ";", "tab", ",", "|", "blanks"}) {
    recording::TableOptions form;
    if (!bytes.starts_with("PK")) form.separator = separator;
    ZD_TRY(recording::SourceCells source, recording::parse_cells(bytes, file, form));
    for (std::size_t row = 0; row < source.cells.rows() && first_line.empty(); ++row) {
      if (!source.cells.is_blank(row)) first_line = fmt::format("{}", fmt::join(source.cells.row(row), ","));
    }
    if (first_line.empty()) return fail(ErrorCode::csv_empty, {{"file", file}});
    auto list = list_in(source);
    if (!list) continue;
    list->file = file;
    list->cells = std::move(source.cells);
    return std::move(*list);
  }
  return fail(
      ErrorCode::csv_bad_header,
      {{"file", file},
       {"column", "name"},
       {"found", first_line},
       {"expected", "name,address and, as needed, function,type,count,scale,sign,missing,word_order,byte_order"}});
}

std::string stated_base(std::string_view heading) {
  std::string text;
  for (const char c : heading) text += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  for (const char* one : {"1-based", "1 based", "from 1", "ab 1", "base 1", "basis 1", "one-based", "从1", "1开始"}) {
    if (text.find(one) != std::string::npos) return "1";
  }
  for (const char* zero : {"0-based", "0 based", "from 0", "ab 0", "base 0", "basis 0", "zero-based", "从0", "0开始"}) {
    if (text.find(zero) != std::string::npos) return "0";
  }
  return {};
}

/// Columns that no name of the list's own covers: empty ones and remarks are listed, the others may change a value.
Status check_unknown_columns(const List& list, std::vector<std::string>* warnings) {
  std::set<std::size_t> used;
  for (const auto& [column, at] : list.columns) used.insert(at);
  for (std::size_t k = 0; k < list.cells.columns(list.header); ++k) {
    if (used.contains(k)) continue;
    const std::string heading(list.cells.at(list.header, k));
    std::optional<std::size_t> filled;
    bool may_matter = false;
    for (std::size_t row = list.header + 1; row < list.cells.rows(); ++row) {
      const std::string_view cell = list.cells.at(row, k);
      if (cell.empty()) continue;
      if (!filled) filled = row;
      const bool matters = recording::looks_like_number(cell) || list_words::order_word(cell) ||
                           list_words::type_word(cell) || list_words::function_word(cell) ||
                           list_words::names_both_orders(cell) || list_words::is_flag(cell);
      if (matters && !may_matter) filled = row;
      may_matter = may_matter || matters;
    }
    if (!filled) continue;
    const bool remark = list_words::list_column(heading) == ListColumn::remark;
    if (!remark && may_matter) {
      return fail(ErrorCode::column_unclear,
                  {{"file", list.file},
                   {"line", std::to_string(list.cells.line(*filled))},
                   {"column", heading.empty() ? fmt::format("#{}", k + 1) : heading},
                   {"found", std::string(list.cells.at(*filled, k))},
                   {"expected", "a column of a known name (scale, type, count, sign ...), or none"}});
    }
    if (warnings != nullptr)
      warnings->push_back(fmt::format("{}: column {}: {}", list.file, heading, "not used: words"));
  }
  return {};
}

Result<recording::NumberFormat> numbers_of(const List& list) {
  recording::NumberEvidence evidence;
  for (const ListColumn column : {ListColumn::scale, ListColumn::divisor, ListColumn::bias, ListColumn::missing}) {
    if (!list.columns.contains(column)) continue;
    for (std::size_t row = list.header + 1; row < list.cells.rows(); ++row) {
      const std::string cell = list.text(row, column);
      evidence.add(cell, [&] {
        return recording::NumberEvidence::Place{cell, list.cells.line(row), list.heading(column)};
      });
    }
  }
  return evidence.decide(list.file);
}

/// What plain numbers and those that may be Modicon's mean in this file.
struct AddressRule {
  bool modicon_5 = false;
  int base = 0;
};

Result<AddressRule> address_rule(const List& list, int base, std::vector<std::string>* warnings) {
  AddressRule rule;
  std::optional<std::size_t> plain;
  std::optional<std::size_t> five;
  bool hexadecimal_only = true;
  for (std::size_t row = list.header + 1; row < list.cells.rows(); ++row) {
    const std::string cell = list.text(row, ListColumn::address);
    const auto address = list_words::address_word(cell);
    if (!address) continue;
    if (address->form == ListAddress::Form::modicon_5 && !five) five = row;
    if (address->form != ListAddress::Form::plain) continue;
    const bool hexadecimal = cell.starts_with("0x") || cell.starts_with("0X");
    hexadecimal_only = hexadecimal_only && hexadecimal;
    if (!hexadecimal && !plain) plain = row;
  }
  const std::string stated = stated_base(list.heading(ListColumn::address));
  rule.base = base >= 0 ? base : stated == "1" ? 1 : 0;
  const bool said = base >= 0 || !stated.empty();
  rule.modicon_5 = five.has_value() && !said;
  if (plain && rule.modicon_5) {
    return list.reject(*plain, ListColumn::address, list.text(*plain, ListColumn::address),
                       fmt::format("numbers of one kind (line {} has {})", list.cells.line(*five),
                                   list.text(*five, ListColumn::address)));
  }
  if (plain && !said && warnings != nullptr) {
    warnings->push_back(
        fmt::format("{}: plain addresses are counted from 0; many lists count from 1: check one value "
                    "that you know, or say --base 1",
                    list.file));
  }
  return rule;
}

/// One row of the list as the JSON of a register.
class RowReader {
 public:
  RowReader(const List& list, const AddressRule& rule, std::size_t row) : m_list(list), m_rule(rule), m_row(row) {}

  Result<json> read() const {
    json entry = json::object();
    ZD_CHECK(read_address(entry));
    ZD_TRY(entry["type"], word(ListColumn::type, list_words::type_word(text(ListColumn::type)),
                               "int16, uint16, int32, uint32 or float32"));
    if (!text(ListColumn::count).empty()) {
      ZD_TRY(entry["count"], whole(ListColumn::count));
    }
    ZD_CHECK(read_scale(entry));
    if (!text(ListColumn::missing).empty()) {
      ZD_TRY(entry["missing"], number(ListColumn::missing));
    }
    ZD_CHECK(read_orders(entry));
    ZD_CHECK(check_unit());
    return entry;
  }

  std::string text(ListColumn column) const { return m_list.text(m_row, column); }
  tl::unexpected<Error> reject(ListColumn column, const std::string& expected) const {
    return m_list.reject(m_row, column, text(column), expected);
  }

 private:
  Status read_address(json& entry) const {
    const auto address = list_words::address_word(text(ListColumn::address));
    if (!address) return reject(ListColumn::address, "a register: 10, 40011, 400011, 4x00011 or %MW10");
    ZD_TRY(const std::string function,
           word(ListColumn::function, list_words::function_word(text(ListColumn::function)), "holding or input"));
    const bool said = !text(ListColumn::function).empty();
    int number = address->number;
    std::string from_number = address->function;
    if (address->form == ListAddress::Form::plain) {
      number -= m_rule.base;
    } else if (address->form == ListAddress::Form::modicon_5 && !m_rule.modicon_5) {
      number = number + 1 + (from_number == "holding" ? 40000 : 30000) - m_rule.base;
      from_number.clear();
    }
    if (number < 0) return reject(ListColumn::address, "an address of 1 or more");
    if (said && !from_number.empty() && from_number != function) {
      return reject(ListColumn::address, fmt::format("a number of the function in its row ({})", function));
    }
    entry["address"] = number;
    entry["function"] = from_number.empty() ? function : from_number;
    return {};
  }

  Status read_scale(json& entry) const {
    double scale = 1.0;
    bool any = false;
    for (const ListColumn column : {ListColumn::scale, ListColumn::divisor, ListColumn::decimals}) {
      if (text(column).empty()) continue;
      ZD_TRY(const double value, number(column));
      if (any) return reject(column, "one column of a scale");
      if (!(value > 0.0) && column != ListColumn::decimals) return reject(column, "a number above 0");
      scale = column == ListColumn::scale     ? value
              : column == ListColumn::divisor ? 1.0 / value
                                              : std::pow(10.0, -value);
      any = true;
    }
    if (any) entry["scale"] = scale;
    if (!text(ListColumn::bias).empty()) {
      ZD_TRY(const double bias, number(ListColumn::bias));
      if (bias != 0.0) return reject(ListColumn::bias, "0: a register map has a scale and a sign, and no offset");
    }
    if (text(ListColumn::sign).empty()) return {};
    const std::string word = text(ListColumn::sign);
    if (word == "-1" || word == "-") {
      entry["sign"] = -1;
    } else if (word != "1" && word != "+1" && word != "+") {
      return reject(ListColumn::sign, "1 or -1");
    }
    return {};
  }

  Status read_orders(json& entry) const {
    constexpr const char* both_orders = "ABCD, CDAB, BADC or DCBA";
    bool both = false;
    for (const ListColumn column : {ListColumn::word_order, ListColumn::byte_order, ListColumn::endian}) {
      const std::string cell = text(column);
      if (cell.empty() || (column != ListColumn::endian && !list_words::names_both_orders(cell))) continue;
      const auto orders = list_words::endian_word(cell);
      if (!orders) return reject(column, both_orders);
      if (both && (entry["word_order"] != orders->first || entry["byte_order"] != orders->second)) {
        return reject(column, "one order");
      }
      entry["word_order"] = orders->first;
      entry["byte_order"] = orders->second;
      both = true;
    }
    for (const auto& [column, key] :
         {std::pair{ListColumn::word_order, "word_order"}, std::pair{ListColumn::byte_order, "byte_order"}}) {
      const std::string cell = text(column);
      if (cell.empty() || list_words::names_both_orders(cell)) continue;
      if (both) return reject(column, "one column of an order");
      // Of two registers, "little endian" beside "byte order" leaves open in which order the words are.
      const bool two_words = !entry.at("type").get<std::string>().ends_with("16");
      const bool open = column == ListColumn::byte_order && text(ListColumn::word_order).empty() && two_words;
      if (open && list_words::is_endian(cell)) return reject(column, both_orders);
      ZD_TRY(entry[key], word(column, list_words::order_word(cell), "high_first or low_first"));
    }
    return {};
  }

  /// "temperature_C" in degrees Celsius: a unit that says other than the name would scale the value.
  Status check_unit() const {
    const std::string unit = text(ListColumn::unit);
    const std::string name = text(ListColumn::name);
    if (unit.empty() || unit == "-") return {};
    static const std::vector<std::pair<std::string_view, std::vector<std::string_view>>> known = {
        {"_C", {"C", "°C", "degC", "deg C", "℃", "Grad C", "GradC"}},
        {"_um", {"um", "µm", "μm", "微米", "micron"}},
        {"_mm", {"mm", "毫米"}},
        {"_rpm", {"rpm", "1/min", "U/min", "r/min", "min-1", "转/分"}},
        {"_W", {"W", "瓦"}},
        {"_s", {"s", "sec", "秒"}},
        {"_mm_min", {"mm/min"}},
        {"_deg", {"deg", "°", "度"}},
        {"_percent", {"%"}}};
    const std::string plain_name = name.substr(0, name.find('['));
    for (const auto& [suffix, words] : known) {
      if (!plain_name.ends_with(suffix)) continue;
      if (std::find(words.begin(), words.end(), unit) != words.end()) return {};
      return reject(ListColumn::unit, fmt::format("{}, as the name says", words.front()));
    }
    return {};
  }

  Result<double> number(ListColumn column) const {
    const auto value = m_list.numbers.number(text(column));
    if (value) return *value;
    return fail(ErrorCode::csv_bad_number, {{"file", m_list.file},
                                            {"line", std::to_string(m_list.cells.line(m_row))},
                                            {"column", m_list.heading(column)},
                                            {"found", text(column)}});
  }
  Result<int> whole(ListColumn column) const {
    ZD_TRY(const double value, number(column));
    constexpr double most = 65536.0;
    if (value < 0.0 || value > most || value != std::floor(value)) return reject(column, "a whole number of 0 or more");
    return static_cast<int>(value);
  }
  Result<std::string> word(ListColumn column, const std::optional<std::string>& found,
                           const std::string& expected) const {
    if (found) return *found;
    return reject(column, expected);
  }

  const List& m_list;
  const AddressRule& m_rule;
  std::size_t m_row;
};

/// "temperature_C[3]": the array and the number of its element.
struct Element {
  std::string array;
  int index = 0;
};

Result<std::optional<Element>> element_of(const List& list, std::size_t row) {
  const std::string name = list.text(row, ListColumn::name);
  const auto open = name.find('[');
  if (open == std::string::npos) return std::optional<Element>{};
  const auto value = name.ends_with("]")
                         ? recording::NumberFormat{}.number(name.substr(open + 1, name.size() - open - 2))
                         : std::nullopt;
  constexpr double most = 65535.0;
  if (!value || *value < 0.0 || *value > most || *value != std::floor(*value)) {
    return list.reject(row, ListColumn::name, name, "a number in the brackets, for example temperature_C[3]");
  }
  return std::optional(Element{name.substr(0, open), static_cast<int>(*value)});
}

struct Row {
  std::size_t row = 0;
  int index = 0;
  json entry;
};

/// Elements in the order of their numbers, which must be that of their addresses.
Result<json> array_of(const List& list, const std::string& name, std::vector<Row> elements) {
  std::sort(elements.begin(), elements.end(), [](const Row& a, const Row& b) { return a.index < b.index; });
  const Row& first = elements.front();
  if (first.index > 1) {
    return list.reject(first.row, ListColumn::name, list.text(first.row, ListColumn::name),
                       fmt::format("{}[1] or {}[0] as the first element", name, name));
  }
  const int words = first.entry.at("type").get<std::string>().ends_with("16") ? 1 : 2;
  for (std::size_t i = 1; i < elements.size(); ++i) {
    const Row& one = elements[i];
    const std::string cell = list.text(one.row, ListColumn::name);
    if (one.index != first.index + static_cast<int>(i)) {
      return list.reject(one.row, ListColumn::name, cell, "each element once, none left out");
    }
    const int expected = first.entry.at("address").get<int>() + static_cast<int>(i) * words;
    if (one.entry.at("address") != expected) {
      return list.reject(one.row, ListColumn::address, list.text(one.row, ListColumn::address),
                         fmt::format("{} behind element {}: an array's elements follow each other (from 0: {})", cell,
                                     one.index - 1, expected));
    }
    json same = one.entry;
    same["address"] = first.entry.at("address");
    if (same != first.entry) {
      return list.reject(one.row, ListColumn::name, cell, "type, scale and the like as those of the first element");
    }
  }
  json out = first.entry;
  if (out.contains("count") && out.at("count") != 1) {
    return list.reject(first.row, ListColumn::count, list.text(first.row, ListColumn::count), "one for each element");
  }
  out["count"] = elements.size();
  return out;
}

Status take_slave(const List& list, json& document) {
  if (!list.columns.contains(ListColumn::slave)) return {};
  std::optional<int> unit;
  for (std::size_t row = list.header + 1; row < list.cells.rows(); ++row) {
    const std::string cell = list.text(row, ListColumn::slave);
    if (cell.empty()) continue;
    const auto value = recording::NumberFormat{}.number(cell);
    const bool good = value && *value >= 0.0 && *value <= 255.0 && *value == std::floor(*value);
    if (!good || (unit && *unit != static_cast<int>(*value))) {
      return list.reject(row, ListColumn::slave, cell, "one unit number for the whole list");
    }
    unit = static_cast<int>(*value);
  }
  if (unit) document["unit"] = *unit;
  return {};
}

}  // namespace

Result<json> register_list_to_json(std::string_view bytes, const std::string& file, int base,
                                   std::vector<std::string>* warnings) {
  ZD_TRY(List list, read_list(bytes, file));
  ZD_CHECK(check_unknown_columns(list, warnings));
  ZD_TRY(list.numbers, numbers_of(list));
  ZD_TRY(const AddressRule rule, address_rule(list, base, warnings));
  json registers = json::object();
  std::map<std::string, std::vector<Row>> arrays;
  std::vector<std::string> unused;
  for (std::size_t row = list.header + 1; row < list.cells.rows(); ++row) {
    if (list.cells.is_blank(row) || list.cells.is_comment(row)) continue;
    const RowReader reader(list, rule, row);
    ZD_TRY(json entry, reader.read());
    ZD_TRY(const std::optional<Element> element, element_of(list, row));
    const std::string name = element ? element->array : reader.text(ListColumn::name);
    const bool known = registers.contains(name) || (!element && arrays.contains(name));
    if (name.empty() || known) {
      return list.reject(row, ListColumn::name, name.empty() ? "none" : name + ", a second time",
                         "a name of its own for each register");
    }
    if (find_register_name(name) == nullptr && !arrays.contains(name)) unused.push_back(name);
    if (element) {
      arrays[name].push_back({row, element->index, std::move(entry)});
    } else {
      registers[name] = std::move(entry);
    }
  }
  for (auto& [name, elements] : arrays) {
    ZD_TRY(registers[name], array_of(list, name, std::move(elements)));
  }
  if (!unused.empty() && warnings != nullptr) {
    warnings->push_back(fmt::format("{}: no use is known for {}; give them one of the names of docs/register-maps.md",
                                    file, fmt::join(unused, ", ")));
  }
  json document = {{"format", "zerodrift-register-map/1"},
                   {"name", std::filesystem::path(file).stem().string()},
                   {"base", 0},
                   {"registers", registers}};
  ZD_CHECK(take_slave(list, document));
  return document;
}

}  // namespace zerodrift::controller
