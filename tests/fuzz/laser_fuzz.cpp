// Any bytes as a laser report or an axis file in every form that is read: Renishaw .rtl and .REN, .pos, CSV. The first
// byte says under which name it comes; with its highest bit set a header map stands before a form feed, with the next
// ones an axis is chosen and the sign turned.

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/compensation/laser.h"
#include "core/compensation/laser_columns.h"
#include "core/recording/import/header_map.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  namespace compensation = zerodrift::compensation;
  if (size == 0) return 0;
  constexpr std::array names = {"fuzz.rtl", "fuzz.REN", "fuzz.pos", "fuzz.csv"};
  std::string_view text(reinterpret_cast<const char*>(bytes) + 1, size - 1);
  const char* name = names[bytes[0] % names.size()];
  compensation::LaserOptions options;
  if ((bytes[0] & 0x80) != 0) {
    const std::size_t end = text.find('\f');
    if (end == std::string_view::npos) return 0;
    const auto document = nlohmann::json::parse(text.substr(0, end), nullptr, false);
    if (document.is_discarded()) return 0;
    const auto map = zerodrift::recording::header_map_from_json(document, "fuzz.json", nullptr);
    if (!map) return 0;
    options.map = *map;
    text.remove_prefix(end + 1);
  }
  if ((bytes[0] & 0x40) != 0) options.axis = "X";
  options.negate = (bytes[0] & 0x20) != 0;
  static_cast<void>(compensation::preview_laser(text, name));
  const auto report = compensation::parse_laser(text, name, options);
  if (!report) return 0;
  double last = -INFINITY;
  for (const double target : report->targets_mm) {
    if (!std::isfinite(target) || target <= last) std::abort();
    last = target;
  }
  for (const auto& reading : report->readings) {
    if (reading.target >= report->targets_mm.size() || !std::isfinite(reading.deviation_um)) std::abort();
  }
  static_cast<void>(compensation::points_of(*report));
  return 0;
}
