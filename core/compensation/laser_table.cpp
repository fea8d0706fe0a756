#include "core/compensation/laser_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/recording/import/number_format.h"

namespace zerodrift::compensation::laser_parts {
namespace {

using recording::Cells;

/// Without the empty cells at its end, which spreadsheets add.
std::size_t used_width(const Cells& cells, std::size_t row) {
  std::size_t width = cells.columns(row);
  while (width > 0 && cells.at(row, width - 1).empty()) --width;
  return width;
}

std::size_t numbers_in(const Cells& cells, std::size_t row) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < cells.columns(row); ++k) count += recording::looks_like_number(cells.at(row, k)) ? 1 : 0;
  return count;
}

std::size_t filled_in(const Cells& cells, std::size_t row) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < cells.columns(row); ++k) count += cells.at(row, k).empty() ? 0 : 1;
  return count;
}

/// Names a position, a measured position or an error.
bool is_header(const Cells& cells, std::size_t row) {
  if (cells.columns(row) < 2) return false;
  const std::size_t numbers = numbers_in(cells, row);
  for (std::size_t k = 0; k < cells.columns(row); ++k) {
    const std::string_view cell = cells.at(row, k);
    if (cell.empty() || recording::looks_like_number(cell)) continue;
    // "pos" or "X" in a row of numbers are no names.
    if (numbers > 0 && (cell.size() < 3 || (numbers > 1 && direction_word(cell)))) continue;
    const ColumnName name = column_name(cell);
    const bool reading = (name.role == ColumnRole::error && !name.value) || name.role == ColumnRole::measured;
    if (reading || name.role == ColumnRole::target) return true;
  }
  return false;
}

std::string joined(const Cells& cells, std::size_t row) {
  std::string out;
  for (std::size_t k = 0; k < cells.columns(row); ++k) {
    if (!cells.at(row, k).empty()) out += (out.empty() ? "" : " ") + std::string(cells.at(row, k));
  }
  return out;
}

/// Some cells of the row say a direction or a run, for the columns below them.
bool is_group_row(const Cells& cells, std::size_t row, std::size_t width) {
  if (cells.columns(row) < 2 || cells.columns(row) > width || numbers_in(cells, row) > 0) return false;
  bool any = false;
  for (std::size_t k = 0; k < cells.columns(row); ++k) {
    const std::string_view cell = cells.at(row, k);
    any = any || direction_in_name(cell) || (run_in_name(cell) && !unit_of(cell));
  }
  return any;
}

/// A table's header from the lines above it.
class HeaderReader {
 public:
  HeaderReader(const Cells& cells, const std::string& file, const std::vector<std::size_t>& above, std::size_t width)
      : m_cells(cells), m_file(file), m_above(above), m_width(width) {}

  Status read(LaserBlock& block) {
    const std::size_t main = main_row();
    if (main == m_above.size()) {
      for (const std::size_t row : m_above) block.titles.push_back(joined(m_cells, row));
      return {};
    }
    const bool group = main > 0 && is_group_row(m_cells, m_above[main - 1], m_width);
    for (std::size_t i = 0; i + (group ? 1 : 0) < main; ++i) block.titles.push_back(joined(m_cells, m_above[i]));
    block.header_line = m_cells.line(m_above[main]);
    std::string over;
    for (std::size_t k = 0; k < m_width; ++k) {
      if (group && !m_cells.at(m_above[main - 1], k).empty()) over = m_cells.at(m_above[main - 1], k);
      ZD_TRY(const std::string text, text_of(main, k, over));
      block.columns.push_back(column_name(text));
    }
    return {};
  }

 private:
  /// The last row that names a position or a reading; else the last one that is as wide as the table and has no number.
  std::size_t main_row() const {
    for (std::size_t i = m_above.size(); i-- > 0;) {
      if (is_header(m_cells, m_above[i])) return i;
    }
    for (std::size_t i = m_above.size(); i-- > 0;) {
      if (m_cells.columns(m_above[i]) == m_width && numbers_in(m_cells, m_above[i]) == 0 &&
          filled_in(m_cells, m_above[i]) > 1) {
        return i;
      }
    }
    return m_above.size();
  }

  Result<std::string> text_of(std::size_t main, std::size_t column, const std::string& over) const {
    std::string text(m_cells.at(m_above[main], column));
    const bool own_direction = direction_in_name(text).has_value();
    if (!over.empty() && !own_direction && column_name(text).role != ColumnRole::target) text = over + " " + text;
    for (std::size_t i = main + 1; i < m_above.size(); ++i) {
      const std::string below(m_cells.at(m_above[i], column));
      if (below.empty() || below.find_first_not_of("-/.") == std::string::npos) continue;
      const auto unit = unit_of(below);
      if (!unit) {
        text += " " + below;
        continue;
      }
      const NameAndUnit named = split_unit(text);
      if (named.unit && (named.unit->kind != unit->kind || named.unit->mm != unit->mm)) {
        return unclear(m_file, m_cells.line(m_above[i]), text, below, "one unit for each column");
      }
      if (!named.unit) text += fmt::format(" ({})", normalised(below) == "\"" ? "inch" : below);
    }
    return text;
  }

  const Cells& m_cells;
  const std::string& m_file;
  const std::vector<std::size_t>& m_above;
  std::size_t m_width;
};

/// Finds tables row by row.
class BlockFinder {
 public:
  BlockFinder(const Cells& cells, const std::string& file) : m_cells(cells), m_file(file) {}

  Result<std::vector<LaserBlock>> find() {
    for (std::size_t row = 0; row < m_cells.rows(); ++row) {
      if (m_cells.is_comment(row)) {
        if (direction_in_name(m_cells.at(row, 0)) || run_in_name(m_cells.at(row, 0))) close();
        m_above.push_back(row);
      } else if (m_cells.is_blank(row)) {
        m_after_blank = true;
      } else {
        ZD_CHECK(take(row));
        m_after_blank = false;
      }
    }
    close();
    return std::move(m_blocks);
  }

 private:
  Status take(std::size_t row) {
    const std::size_t numbers = numbers_in(m_cells, row);
    // Where the rows before have their first number a header has a name; looking at names takes a while.
    const bool like_before = m_open && numbers >= 2 && recording::looks_like_number(m_cells.at(row, m_first_number));
    const bool header = !like_before && is_header(m_cells, row);
    const std::size_t width = used_width(m_cells, row);
    if (m_open && !header && (numbers >= 2 || belongs(row, numbers))) {
      if (width > m_block.width || m_cells.columns(row) < m_block.width) {
        return fail(ErrorCode::csv_cell_count, {{"file", m_file},
                                                {"line", std::to_string(m_cells.line(row))},
                                                {"found", std::to_string(m_cells.columns(row))},
                                                {"expected", std::to_string(m_block.width)}});
      }
      m_block.rows.push_back(row);
      return {};
    }
    close();
    if (header || numbers < 2) {
      m_above.push_back(row);
      return {};
    }
    return open(row);
  }

  /// A row with a cell that cannot be read is a row all the same; what follows a blank line may be something else.
  bool belongs(std::size_t row, std::size_t numbers) const {
    if (numbers == 0 || m_cells.columns(row) != m_cells.columns(m_block.rows.front())) return false;
    return !m_after_blank || recording::looks_like_number(m_cells.at(row, m_first_number));
  }

  Status open(std::size_t row) {
    m_block = {};
    m_block.width = used_width(m_cells, row);
    for (const std::size_t above : m_above) {
      if (is_header(m_cells, above)) m_block.width = std::max(m_block.width, used_width(m_cells, above));
    }
    m_block.width = std::min(m_block.width, m_cells.columns(row));
    m_block.rows.push_back(row);
    m_first_number = 0;
    while (!recording::looks_like_number(m_cells.at(row, m_first_number))) ++m_first_number;
    ZD_CHECK(HeaderReader(m_cells, m_file, m_above, m_block.width).read(m_block));
    if (m_block.columns.empty() && !m_blocks.empty() && m_blocks.back().width == m_block.width) {
      m_block.columns = m_blocks.back().columns;
      m_block.header_line = m_blocks.back().header_line;
      m_block.inherited = true;
    }
    m_above.clear();
    m_open = true;
    return {};
  }

  void close() {
    if (m_open) m_blocks.push_back(std::move(m_block));
    m_open = false;
  }

  const Cells& m_cells;
  const std::string& m_file;
  std::vector<LaserBlock> m_blocks;
  std::vector<std::size_t> m_above;
  LaserBlock m_block;
  bool m_open = false;
  bool m_after_blank = false;
  std::size_t m_first_number = 0;
};

}  // namespace

Result<std::vector<LaserBlock>> blocks_of(const Cells& cells, const std::string& file) {
  return BlockFinder(cells, file).find();
}

tl::unexpected<Error> unclear(const std::string& file, int line, const std::string& column, const std::string& found,
                              const std::string& expected) {
  return fail(
      ErrorCode::column_unclear,
      {{"file", file}, {"line", std::to_string(line)}, {"column", column}, {"found", found}, {"expected", expected}});
}

}  // namespace zerodrift::compensation::laser_parts
