// Any bytes as a list of registers (CSV, tab, semicolons), counted from 0, from 1 or as it says itself; and as the
// words of a table area out of a controller.

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "core/controller/profile.h"
#include "core/controller/register_map.h"
#include "core/controller/table_words.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  namespace controller = zerodrift::controller;
  if (size == 0) return 0;
  if (bytes[0] % 2 == 0) {
    const std::string_view text(reinterpret_cast<const char*>(bytes) + 1, size - 1);
    const int base = bytes[0] / 2 % 3 - 1;
    std::vector<std::string> warnings;
    const auto map = controller::register_map_from_list(text, "fuzz", base, &warnings);
    if (!map) return 0;
    const auto again = controller::register_map_from_json(controller::to_json(*map), "fuzz, written");
    if (!again || again->registers.size() != map->registers.size()) std::abort();
    for (const auto& [name, entry] : map->registers) {
      const auto* other = again->find(name);
      if (other == nullptr || other->address != entry.address || other->count != entry.count ||
          other->words() != entry.words()) {
        std::abort();
      }
    }
    return 0;
  }
  std::vector<std::uint16_t> words((size - 1) / 2);
  if (!words.empty()) std::memcpy(words.data(), bytes + 1, 2 * words.size());
  controller::Profile profile;
  for (const char* channel : {"T1_C", "T2_C", "T3_C"}) profile.sensors.push_back({channel, channel, "", {}, 0.1});
  const auto table = controller::decode_table(words, profile);
  if (table) static_cast<void>(controller::encode_table(*table, profile));
  return 0;
}
