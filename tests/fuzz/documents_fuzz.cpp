// Any bytes as each JSON document that the programs read; the first byte says which. An error, or a value that is
// written so that it reads again.

#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/access/pin.h"
#include "core/acquisition/plan.h"
#include "core/analysis/model.h"
#include "core/base/json.h"
#include "core/base/redact.h"
#include "core/compensation/table.h"
#include "core/controller/profile.h"
#include "core/controller/register_map.h"
#include "core/physics/machine.h"
#include "core/vision/calibration.h"
#include "core/vision/target_file.h"

namespace {

using namespace zerodrift;

void read_table(const nlohmann::json& document) {
  const auto table = compensation::table_from_json(document, "fuzz");
  if (!table) return;
  const auto text = compensation::to_json(*table).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  if (!compensation::table_from_json(nlohmann::json::parse(text), "fuzz, written")) std::abort();
  for (const auto& [name, axis] : table->axes) {
    for (const double x : {-1e300, -1.0, 0.0, 12.5, 1e300}) {
      static_cast<void>(compensation::error_um(*table, name, x, compensation::Approach::up, {{"T1_C", 20.0}}));
    }
  }
}

void read_map(const nlohmann::json& document) {
  const auto map = controller::register_map_from_json(document, "fuzz");
  if (!map) return;
  if (!controller::register_map_from_json(controller::to_json(*map), "fuzz, written")) std::abort();
  const std::uint16_t words[4] = {0x7FF8, 0xFFFF, 0x8000, 1};
  for (const auto& [name, entry] : map->registers) {
    if (entry.words_each() <= 4) static_cast<void>(controller::decode(entry, words, 0));
  }
}

void read(unsigned which, const nlohmann::json& document) {
  switch (which) {
    case 0:
      return static_cast<void>(acquisition::plan_from_json(document, "fuzz"));
    case 1:
      return static_cast<void>(analysis::model_from_json(document, "fuzz"));
    case 2:
      return read_table(document);
    case 3:
      return static_cast<void>(controller::profile_from_job(document));
    case 4:
      return read_map(document);
    case 5:
      return static_cast<void>(physics::machine_from_json(document, "fuzz"));
    case 6:
      static_cast<void>(vision::target_from_json(document, "fuzz"));
      return static_cast<void>(vision::calibration_from_json(document, "fuzz"));
    default:
      static_cast<void>(
          read_object(document, "fuzz", nullptr, [](JsonObject& o) { static_cast<void>(access::read_pin(o)); }));
      static_cast<void>(document_without_secrets(document));
      return;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  if (size == 0) return 0;
  const auto document = parse_json({reinterpret_cast<const char*>(bytes) + 1, size - 1}, "fuzz");
  if (document) read(bytes[0] % 8, *document);
  return 0;
}
