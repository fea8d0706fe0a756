#pragma once
// How samples lie in the file. A row: time_s, then one double a channel, little endian. A chunk: 960 rows, column after
// column (time first), deflated: quantised readings shrink to about a fifth. Both carry a CRC-32 beside them, since the
// database does not notice bytes flipped inside a blob.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace zerodrift::commissioning {

inline constexpr std::size_t chunk_rows = 960;

std::string encode_row(std::span<const double> row);
/// Appends the row; false when it does not have `width` numbers.
bool decode_row(std::string_view bytes, std::size_t width, std::vector<double>& out);
/// `rows` holds whole rows of `width` numbers, row after row.
std::string encode_chunk(std::span<const double> rows, std::size_t width);
/// Appends the rows, row after row; false when the bytes do not hold `count` rows.
bool decode_chunk(std::string_view bytes, std::size_t count, std::size_t width, std::vector<double>& out);

}  // namespace zerodrift::commissioning
