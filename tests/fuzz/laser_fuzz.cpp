// Any bytes as a laser report in every form that is read: Renishaw .rtl and .REN, .pos, CSV; the first byte says under
// which name it comes.

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/compensation/laser.h"
#include "core/compensation/laser_columns.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  namespace compensation = zerodrift::compensation;
  if (size == 0) return 0;
  constexpr std::array names = {"fuzz.rtl", "fuzz.REN", "fuzz.pos", "fuzz.csv"};
  const std::string_view text(reinterpret_cast<const char*>(bytes) + 1, size - 1);
  const char* name = names[bytes[0] % names.size()];
  static_cast<void>(compensation::preview_laser(text, name));
  const auto report = compensation::parse_laser(text, name);
  if (!report) return 0;
  for (const double target : report->targets_mm) {
    if (!std::isfinite(target)) std::abort();
  }
  for (const auto& reading : report->readings) {
    if (reading.target >= report->targets_mm.size() || !std::isfinite(reading.deviation_um)) std::abort();
  }
  return 0;
}
