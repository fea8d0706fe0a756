// Any bytes as a logger's file, by themselves or packed as the parts of a workbook, and any header map for it: an error
// or a recording; and a recording that was read is written so that it reads again to the same size.

#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "core/recording/csv.h"
#include "core/recording/import/importer.h"
#include "tests/support/workbook_writer.h"

namespace {

namespace recording = zerodrift::recording;

void import(std::string_view bytes, const recording::HeaderMap& map) {
  const auto read = recording::import_recording(bytes, "fuzz", map);
  if (!read) return;
  for (const auto& channel : read->recording.channels) {
    if (channel.values.size() != read->recording.time_s.size()) std::abort();
  }
  [[maybe_unused]] const auto report = recording::to_json(*read);
  [[maybe_unused]] const auto saved = recording::map_of(*read, map);
  if (!map.columns.empty()) return;  // a map may give names that say another unit than the values have
  const auto again = recording::parse_recording(recording::to_csv(read->recording), "fuzz, written");
  if (!again || again->channels.size() != read->recording.channels.size() ||
      again->time_s.size() != read->recording.time_s.size()) {
    std::abort();
  }
}

/// Text up to the next form feed.
std::string next_part(std::string_view& text) {
  const std::size_t end = text.find('\f');
  const std::string part(text.substr(0, end));
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return part;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  std::string_view text(reinterpret_cast<const char*>(bytes), size);
  if (text.starts_with('M')) {
    text.remove_prefix(1);
    const auto document = nlohmann::json::parse(next_part(text), nullptr, false);
    if (document.is_discarded()) return 0;
    const auto map = recording::header_map_from_json(document, "fuzz.json", nullptr);
    if (map) import(text, *map);
  } else if (text.starts_with('W')) {
    text.remove_prefix(1);
    std::map<std::string, std::string> parts;
    for (const char* name : {"xl/workbook.xml", "xl/_rels/workbook.xml.rels", "xl/styles.xml", "xl/sharedStrings.xml",
                             "xl/worksheets/sheet1.xml"}) {
      parts[name] = next_part(text);
    }
    import(zerodrift::zip_of(parts), {});
  } else if (text.starts_with('S')) {
    import(zerodrift::workbook_of({{ "a", std::string(text.substr(1)) }}, {"Time", "T1_C", "dZ (mm)"}), {});
  } else {
    import(text, {});
  }
  return 0;
}
