#include "core/recording/import/workbook.h"

#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <pugixml.hpp>
#include <set>
#include <vector>

namespace zerodrift::recording {
namespace {

// A sheet of 100 000 rows and 30 columns has about 100 MB of XML; its tree takes some ten times as much memory.
constexpr std::size_t largest_part_bytes = std::size_t{100} << 20;
constexpr std::size_t most_cells = 20'000'000;
constexpr std::size_t most_columns = 16384;  // of a sheet, by Excel
constexpr int most_rows = 1048576;
constexpr double last_day = 2958466.0;  // 9999-12-31

const char* const expected_workbook = "a workbook (.xlsx) or a text table";

/// A zip archive in memory.
class Archive {
 public:
  Archive(std::string_view bytes, std::string file) : m_file(std::move(file)) {
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
    if (source != nullptr) m_zip.reset(zip_open_from_source(source, ZIP_RDONLY, &error));
    if (m_zip == nullptr && source != nullptr) zip_source_free(source);
    zip_error_fini(&error);
  }

  /// Empty where there is no such part.
  Result<std::string> part(const std::string& name) const {
    if (m_zip == nullptr) return broken();
    const zip_int64_t index = zip_name_locate(m_zip.get(), name.c_str(), 0);
    if (index < 0) return std::string();
    const std::unique_ptr<zip_file_t, decltype(&zip_fclose)> file(
        zip_fopen_index(m_zip.get(), static_cast<zip_uint64_t>(index), 0), zip_fclose);
    if (file == nullptr) return broken();
    std::string out;
    std::vector<char> piece(1 << 16);
    for (;;) {
      const zip_int64_t count = zip_fread(file.get(), piece.data(), piece.size());
      if (count < 0) return broken();
      if (count == 0) return out;
      out.append(piece.data(), static_cast<std::size_t>(count));
      // What the archive says of sizes is not believed.
      if (out.size() > largest_part_bytes) {
        return fail(ErrorCode::file_too_large, {{"file", m_file + ", " + name},
                                                {"size", "> " + std::to_string(out.size())},
                                                {"limit", std::to_string(largest_part_bytes)}});
      }
    }
  }

  tl::unexpected<Error> broken() const {
    return fail(ErrorCode::wrong_format,
                {{"file", m_file}, {"found", "a damaged archive"}, {"expected", expected_workbook}});
  }

 private:
  std::string m_file;
  std::unique_ptr<zip_t, decltype(&zip_discard)> m_zip{nullptr, zip_discard};
};

/// Without a namespace's prefix.
std::string_view local_name(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  const auto colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

pugi::xml_node child_of(const pugi::xml_node& node, std::string_view name) {
  for (const pugi::xml_node child : node.children()) {
    if (local_name(child) == name) return child;
  }
  return {};
}

std::string_view attribute_of(const pugi::xml_node& node, std::string_view name) {
  for (const pugi::xml_attribute attribute : node.attributes()) {
    const std::string_view full = attribute.name();
    const auto colon = full.find(':');
    if ((colon == std::string_view::npos ? full : full.substr(colon + 1)) == name) return attribute.value();
  }
  return {};
}

std::optional<int> whole_number(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value < 0) return std::nullopt;
  return value;
}

/// A text with its runs joined; what says how to pronounce it left out.
std::string text_of_runs(const pugi::xml_node& node) {
  std::string out;
  for (const pugi::xml_node child : node.children()) {
    const auto name = local_name(child);
    if (name == "t") out += child.text().get();
    if (name == "r") out += child_of(child, "t").text().get();
  }
  return out;
}

enum class Shown { number, date, duration };

/// By a format code: what it shows of a serial number of days.
Shown shown_by(std::string_view code) {
  bool quoted = false;
  bool elapsed = false;
  bool date = false;
  for (std::size_t i = 0; i < code.size(); ++i) {
    const char c = code[i];
    if (c == '"') quoted = !quoted;
    if (quoted || c == '"') continue;
    if (c == '\\' || c == '_' || c == '*') {
      ++i;  // the next one is shown as it is
    } else if (c == '[') {
      const auto end = code.find(']', i);
      if (end == std::string_view::npos) break;
      const std::string_view inside = code.substr(i + 1, end - i - 1);
      elapsed = elapsed || (!inside.empty() && inside.find_first_not_of("hHmMsS") == std::string_view::npos);
      i = end;
    } else if (c == ';') {
      break;
    } else if (std::string_view("yYdDhHsS").find(c) != std::string_view::npos) {
      date = true;
    } else if (c == 'm' || c == 'M') {
      date = true;
    } else if (c == '0' || c == '#' || c == '?') {
      if (!date && !elapsed) return Shown::number;
    } else if ((c == 'E' || c == 'G' || c == 'e' || c == 'g') && !date) {
      return Shown::number;  // exponents, "General"
    }
  }
  return elapsed ? Shown::duration : date ? Shown::date : Shown::number;
}

Shown shown_by_builtin(int id) {
  if ((id >= 14 && id <= 22) || (id >= 27 && id <= 36) || (id >= 50 && id <= 58)) return Shown::date;
  return id == 45 || id == 46 || id == 47 ? Shown::duration : Shown::number;
}

/// Days since 1899-12-30 as ISO 8601, or as a time of day below one day.
std::string date_text(double days, Shown shown, bool from_1904) {
  if (from_1904) days += 1462.0;
  const std::int64_t all_ms = std::llround(days * 86400e3);
  const auto time_text = [](std::int64_t ms) {
    std::string text = fmt::format("{:02}:{:02}:{:02}", ms / 3600000, ms / 60000 % 60, ms / 1000 % 60);
    return ms % 1000 == 0 ? text : text + fmt::format(".{:03}", ms % 1000);
  };
  if (shown == Shown::duration || all_ms < 86400000) return time_text(all_ms);
  using namespace std::chrono;
  const year_month_day date{sys_days{year{1899} / 12 / 30} + std::chrono::days{all_ms / 86400000}};
  return fmt::format("{:04}-{:02}-{:02}T{}", static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                     static_cast<unsigned>(date.day()), time_text(all_ms % 86400000));
}

/// "BC12" is column 54; 0 where there are no letters.
std::size_t column_of_reference(std::string_view reference) {
  std::size_t column = 0;
  for (const char c : reference) {
    if (c < 'A' || c > 'Z') break;
    column = 26 * column + static_cast<std::size_t>(c - 'A' + 1);
    if (column > most_columns) return most_columns + 1;
  }
  return column;
}

class WorkbookReader {
 public:
  WorkbookReader(std::string_view bytes, const std::string& file) : m_archive(bytes, file), m_file(file) {}

  Result<SourceCells> read(const std::string& sheet) {
    ZD_TRY(const std::string path, sheet_path(sheet));
    ZD_CHECK(read_strings());
    ZD_CHECK(read_styles());
    m_out.form.file = m_file;
    m_out.form.encoding = "xlsx";
    ZD_CHECK(read_sheet(path));
    return std::move(m_out);
  }

 private:
  tl::unexpected<Error> not_a_workbook() const {
    return fail(ErrorCode::wrong_format,
                {{"file", m_file}, {"found", "an archive without a workbook"}, {"expected", expected_workbook}});
  }

  /// An empty document where the part is absent.
  Status load(const std::string& part, pugi::xml_document& document) const {
    ZD_TRY(const std::string text, m_archive.part(part));
    if (text.empty()) return {};
    const auto parsed =
        document.load_buffer(text.data(), text.size(), pugi::parse_default | pugi::parse_ws_pcdata_single);
    if (parsed) return {};
    return fail(ErrorCode::wrong_format,
                {{"file", m_file + ", " + part}, {"found", "damaged XML"}, {"expected", expected_workbook}});
  }

  Result<std::string> sheet_path(const std::string& wanted) {
    pugi::xml_document workbook;
    ZD_CHECK(load("xl/workbook.xml", workbook));
    const pugi::xml_node root = child_of(workbook, "workbook");
    if (!root) return not_a_workbook();
    const auto date1904 = attribute_of(child_of(root, "workbookPr"), "date1904");
    m_from_1904 = date1904 == "1" || date1904 == "true";
    pugi::xml_document relations;
    ZD_CHECK(load("xl/_rels/workbook.xml.rels", relations));
    std::map<std::string, std::string, std::less<>> targets;
    for (const pugi::xml_node relation : child_of(relations, "Relationships").children()) {
      if (!attribute_of(relation, "Type").ends_with("/worksheet")) continue;
      targets.emplace(attribute_of(relation, "Id"), attribute_of(relation, "Target"));
    }
    std::string names;
    for (const pugi::xml_node sheet : child_of(root, "sheets").children()) {
      const std::string name(attribute_of(sheet, "name"));
      const auto target = targets.find(attribute_of(sheet, "id"));
      if (target == targets.end()) continue;
      if (wanted.empty() || wanted == name) {
        m_out.form.sheet = name;
        return target->second.starts_with('/') ? target->second.substr(1) : "xl/" + target->second;
      }
      names += (names.empty() ? "" : ", ") + name;
    }
    if (names.empty()) return not_a_workbook();
    return fail(ErrorCode::bad_argument, {{"what", "--sheet"}, {"found", wanted}, {"expected", names}});
  }

  Status read_strings() {
    pugi::xml_document document;
    ZD_CHECK(load("xl/sharedStrings.xml", document));
    for (const pugi::xml_node item : child_of(document, "sst").children()) {
      if (local_name(item) == "si") m_strings.push_back(text_of_runs(item));
    }
    return {};
  }

  Status read_styles() {
    pugi::xml_document document;
    ZD_CHECK(load("xl/styles.xml", document));
    const pugi::xml_node root = child_of(document, "styleSheet");
    std::map<int, Shown> formats;
    for (const pugi::xml_node format : child_of(root, "numFmts").children()) {
      if (const auto id = whole_number(attribute_of(format, "numFmtId"))) {
        formats[*id] = shown_by(attribute_of(format, "formatCode"));
      }
    }
    for (const pugi::xml_node style : child_of(root, "cellXfs").children()) {
      if (local_name(style) != "xf") continue;
      const int id = whole_number(attribute_of(style, "numFmtId")).value_or(0);
      const auto own = formats.find(id);
      m_styles.push_back(own == formats.end() ? shown_by_builtin(id) : own->second);
    }
    return {};
  }

  Status read_sheet(const std::string& path) {
    pugi::xml_document document;
    ZD_CHECK(load(path, document));
    const pugi::xml_node data = child_of(child_of(document, "worksheet"), "sheetData");
    if (!data) return not_a_workbook();
    int line = 0;
    std::size_t cells = 0;
    for (const pugi::xml_node row : data.children()) {
      if (local_name(row) != "row") continue;
      const auto given = whole_number(attribute_of(row, "r"));
      line = given && *given > line && *given <= most_rows ? *given : line + 1;
      m_out.cells.begin_row(line);
      std::size_t column = 0;
      for (const pugi::xml_node cell : row.children()) {
        if (local_name(cell) != "c") continue;
        const std::size_t place = column_of_reference(attribute_of(cell, "r"));
        const std::size_t at = place > column && place <= most_columns ? place : column + 1;
        cells += at - column;
        if (cells > most_cells || at > most_columns) {
          return fail(
              ErrorCode::file_too_large,
              {{"file", m_file}, {"size", "> " + std::to_string(most_cells)}, {"limit", std::to_string(most_cells)}});
        }
        for (; column + 1 < at; ++column) m_out.cells.add({});
        ZD_TRY(const std::string text, cell_text_of(cell, line, at));
        m_out.cells.add(text);
        column = at;
      }
    }
    return {};
  }

  Result<std::string> cell_text_of(const pugi::xml_node& cell, int line, std::size_t column) const {
    const std::string_view type = attribute_of(cell, "t");
    if (type == "inlineStr") return std::string(trimmed(text_of_runs(child_of(cell, "is"))));
    const pugi::xml_node value = child_of(cell, "v");
    const std::string text(trimmed(value.text().get()));
    if (text.empty()) {
      if (!child_of(cell, "f")) return std::string();
      return fail(ErrorCode::workbook_formula,
                  {{"file", m_file}, {"line", std::to_string(line)}, {"column", std::to_string(column)}});
    }
    if (type == "s") {
      const auto index = whole_number(text);
      if (!index || static_cast<std::size_t>(*index) >= m_strings.size()) return m_archive.broken();
      return std::string(trimmed(m_strings[static_cast<std::size_t>(*index)]));
    }
    if (type == "b") return std::string(text == "1" || text == "true" ? "TRUE" : "FALSE");
    if (type == "str" || type == "e" || type == "d") return text;
    return number_as_shown(text, attribute_of(cell, "s"));
  }

  std::string number_as_shown(const std::string& text, std::string_view style) const {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return text;
    const auto index = whole_number(style);
    const bool known = index && static_cast<std::size_t>(*index) < m_styles.size();
    const Shown shown = known ? m_styles[static_cast<std::size_t>(*index)] : Shown::number;
    if (shown != Shown::number && value >= 0.0 && value < last_day) return date_text(value, shown, m_from_1904);
    return fmt::format("{}", value);
  }

  Archive m_archive;
  std::string m_file;
  bool m_from_1904 = false;
  std::vector<std::string> m_strings;
  std::vector<Shown> m_styles;
  SourceCells m_out;
};

}  // namespace

bool is_workbook(std::string_view bytes) {
  return bytes.starts_with("PK\x03\x04");
}

Result<SourceCells> parse_workbook(std::string_view bytes, const std::string& file, const std::string& sheet) {
  return WorkbookReader(bytes, file).read(sheet);
}

}  // namespace zerodrift::recording
