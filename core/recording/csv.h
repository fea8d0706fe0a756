#pragma once
// Recordings and plain tables as text. Reading takes any logger's form (core/recording/import); a file in the
// contract's form - UTF-8, decimal point, comma, time_s first - is its simplest case. Numbers are written with the
// fewest digits that read back the same.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/recording/import/header_map.h"
#include "core/recording/import/number_format.h"
#include "core/recording/recording.h"

namespace zerodrift::recording {

/// A table of text cells with its header in the first line; rows have as many cells as the header.
struct TextTable {
  std::string file;                            // for messages
  std::vector<std::string> header;             // trimmed
  std::vector<std::vector<std::string>> rows;  // trimmed
  std::vector<int> lines;                      // line number of each row in the file (1-based)
  NumberFormat numbers;                        // of the file as a whole

  int column(std::string_view name) const;  // -1 if absent
};

Result<TextTable> parse_table(std::string_view text, const std::string& file);
Result<TextTable> read_table(const std::filesystem::path& path);
/// The number in a cell of a parsed table; an empty cell is NaN; anything else csv_bad_number.
Result<double> number_in(const TextTable& table, std::size_t row, int column);

/// The recording alone of import_recording: for files of our own, and where nobody is there to be told more.
Result<Recording> parse_recording(std::string_view text, const std::string& file, const HeaderMap& map = {});
Result<Recording> read_recording(const std::filesystem::path& path, const HeaderMap& map = {});
std::string to_csv(const Recording& recording);
Status write_recording(const std::filesystem::path& path, const Recording& recording);

/// The shortest text that reads back as the same double; "" for NaN.
std::string number_text(double value);
/// A cell for CSV: quoted when it holds a separator, quote or newline. Text that a spreadsheet would take for a
/// formula, whoever entered it, has an apostrophe before it, which reading takes away. What is no UTF-8 is replaced.
std::string cell_text(std::string_view text);

}  // namespace zerodrift::recording
