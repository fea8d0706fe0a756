// Any bytes as a file for a controller, in each format (the first byte says which): an error, or a table with finite
// numbers. What a table of ours could hold is written again, in every format: an error, or a file that reads.

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/controller/exports/export_format.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  namespace controller = zerodrift::controller;
  if (size == 0) return 0;
  const auto& formats = controller::export_formats();
  controller::ExportOptions options;
  options.temperatures = {{"T1_C", 21.5}, {"T2_C", 23.0}};
  options.linuxcnc_type = bytes[0] / 16 % 2;
  options.sinumerik_cec = bytes[0] / 32 % 2 != 0;
  const std::string_view text(reinterpret_cast<const char*>(bytes) + 1, size - 1);
  const auto table = formats[bytes[0] % 16 % formats.size()].read(text, options);
  if (!table) return 0;
  for (const auto& [name, axis] : table->axes) {
    for (const auto& point : axis.points) {
      if (!std::isfinite(point.position_mm) || !std::isfinite(point.error_up_um)) std::abort();
    }
  }
  if (!zerodrift::compensation::table_from_json(zerodrift::compensation::to_json(*table), "fuzz")) return 0;
  for (const auto& [name, axis] : table->axes) {
    options.axis = name;
    for (const auto& format : formats) {
      const auto written = format.write(*table, options);
      if (written && !(written->loss_um >= 0.0)) std::abort();
    }
  }
  return 0;
}
