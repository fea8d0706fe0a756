// Any bytes as a table and as a recording: an error or rows as wide as the header; and a recording that was read is
// written so that it reads again to the same size.

#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/recording/csv.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  namespace recording = zerodrift::recording;
  const std::string_view text(reinterpret_cast<const char*>(bytes), size);
  if (const auto table = recording::parse_table(text, "fuzz")) {
    for (std::size_t row = 0; row < table->rows.size(); ++row) {
      if (table->rows[row].size() != table->header.size()) std::abort();
      for (std::size_t column = 0; column < table->header.size(); ++column) {
        [[maybe_unused]] const auto number = recording::number_in(*table, row, static_cast<int>(column));
      }
    }
  }
  const auto read = recording::parse_recording(text, "fuzz");
  if (!read) return 0;
  const auto again = recording::parse_recording(recording::to_csv(*read), "fuzz, written");
  if (!again || again->channels.size() != read->channels.size() || again->time_s.size() != read->time_s.size()) {
    std::abort();
  }
  return 0;
}
