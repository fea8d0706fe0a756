// Register maps out and in: as JSON, and from a list of registers such as a PLC's project exports.

#include <nlohmann/json.hpp>

#include "core/base/file.h"
#include "core/base/json.h"
#include "core/controller/register_list.h"
#include "core/controller/register_map.h"

namespace zerodrift::controller {
namespace {

using nlohmann::json;
const char* type_name(RegisterType type) {
  switch (type) {
    case RegisterType::int16:
      return "int16";
    case RegisterType::uint16:
      return "uint16";
    case RegisterType::int32:
      return "int32";
    case RegisterType::uint32:
      return "uint32";
    case RegisterType::float32:
      return "float32";
  }
  return "";
}

const char* order_name(bool high_first) {
  return high_first ? "high_first" : "low_first";
}

}  // namespace

json to_json(const Register& entry) {
  json out = {{"address", entry.address}, {"type", type_name(entry.type)}};
  if (entry.space == RegisterSpace::input) out["function"] = "input";
  if (entry.count != 1) out["count"] = entry.count;
  if (entry.scale != 1.0) out["scale"] = entry.scale;
  if (entry.sign != 1) out["sign"] = entry.sign;
  if (entry.missing_raw) out["missing"] = *entry.missing_raw;
  if (!entry.high_word_first) out["word_order"] = order_name(false);
  if (!entry.high_byte_first) out["byte_order"] = order_name(false);
  return out;
}

json to_json(const RegisterMap& map) {
  json registers = json::object();
  for (const auto& [name, entry] : map.registers) registers[name] = to_json(entry);
  json readable = json::array();
  for (const auto& block : map.readable) {
    json one = {{"from", block.first}, {"to", block.last}};
    if (block.space == RegisterSpace::input) one["function"] = "input";
    readable.push_back(std::move(one));
  }
  json out = {{"format", "zerodrift-register-map/1"},
              {"name", map.name},
              {"base", 0},
              {"max_read", map.max_read},
              {"max_write", map.max_write},
              {"host_offset_step_um", map.host_offset_step_um},
              {"readable", readable},
              {"registers", registers}};
  if (map.unit) out["unit"] = *map.unit;
  if (map.magic) out["magic"] = *map.magic;
  return out;
}

Result<RegisterMap> register_map_from_list(std::string_view bytes, const std::string& file, int base,
                                           std::vector<std::string>* warnings) {
  ZD_TRY(const json document, register_list_to_json(bytes, file, base, warnings));
  return register_map_from_json(document, file, warnings);
}

Result<RegisterMap> read_register_list(const std::filesystem::path& path, int base,
                                       std::vector<std::string>* warnings) {
  ZD_TRY(const std::string text, read_file(path));
  const auto first = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (first == std::string::npos || text[first] != '{') {
    return register_map_from_list(text, path.string(), base, warnings);
  }
  ZD_TRY(const json document, parse_json(text, path.string()));
  return register_map_from_json(document, path.string(), warnings);
}

}  // namespace zerodrift::controller
