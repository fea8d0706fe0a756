#include "core/controller/register_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/json.h"
#include "core/base/resources.h"

namespace zerodrift::controller {
namespace {

struct Defaults {
  int base = 0;
  bool high_word_first = true;
  bool high_byte_first = true;
};

RegisterType type_from(const std::string& word) {
  if (word == "int16") return RegisterType::int16;
  if (word == "int32") return RegisterType::int32;
  if (word == "uint32") return RegisterType::uint32;
  return word == "float32" ? RegisterType::float32 : RegisterType::uint16;
}

bool high_first(JsonObject& o, const char* key, bool fallback) {
  return o.has(key) ? o.word(key, {"high_first", "low_first"}) == "high_first" : fallback;
}

RegisterSpace space_from(JsonObject& o) {
  if (!o.has("function")) return RegisterSpace::holding;
  return o.word("function", {"holding", "input"}) == "holding" ? RegisterSpace::holding : RegisterSpace::input;
}

Register read_register(JsonObject& o, const std::string& name, const Defaults& defaults) {
  Register entry;
  entry.name = name;
  entry.space = space_from(o);
  entry.address = o.integer("address", defaults.base, 65535 + defaults.base) - defaults.base;
  entry.type = type_from(o.has("type") ? o.word("type", {"int16", "uint16", "int32", "uint32", "float32"}) : "uint16");
  entry.count = o.integer_or("count", 1, 1, 65536);
  entry.scale = o.number_or("scale", 1.0, positive);
  entry.sign = o.integer_or("sign", 1, -1, 1);
  if (entry.sign == 0) o.reject("sign", "0", "1 or -1");
  entry.missing_raw = o.number_if("missing");
  entry.high_word_first = high_first(o, "word_order", defaults.high_word_first);
  entry.high_byte_first = high_first(o, "byte_order", defaults.high_byte_first);
  if (entry.address + entry.words() > 65536) o.reject("count", std::to_string(entry.count), "registers up to 65535");
  o.raw("comment");
  return entry;
}

RegisterMap read_map(JsonObject& o) {
  RegisterMap map;
  o.word("format", {"zerodrift-register-map/1"});
  map.name = o.text("name");
  o.raw("comment");
  Defaults defaults;
  defaults.base = o.integer_or("base", 0, 0, 1);
  defaults.high_word_first = high_first(o, "word_order", true);
  defaults.high_byte_first = high_first(o, "byte_order", true);
  if (o.has("unit")) map.unit = o.integer("unit", 0, 255);
  if (o.has("magic")) map.magic = o.integer("magic", 0, 65535);
  map.max_read = o.integer_or("max_read", 125, 1, 125);
  map.max_write = o.integer_or("max_write", 123, 1, 123);
  map.host_offset_step_um = o.number_or("host_offset_step_um", 20.0, positive);
  for (JsonObject& b : o.objects_or_empty("readable")) {
    const RegisterSpace space = space_from(b);
    const int first = b.integer("from", defaults.base, 65535 + defaults.base) - defaults.base;
    const int last = b.integer("to", first + defaults.base, 65535 + defaults.base) - defaults.base;
    map.readable.push_back({space, first, last});
  }
  JsonObject& registers = o.object("registers");
  for (const auto& name : registers.keys()) {
    map.registers[name] = read_register(registers.object(name), name, defaults);
  }
  return map;
}

std::uint16_t swapped(std::uint16_t word) {
  return static_cast<std::uint16_t>((word << 8) | (word >> 8));
}

bool reads_across(const RegisterMap& map, RegisterSpace space, int first, int last) {
  return std::any_of(map.readable.begin(), map.readable.end(), [&](const ReadableBlock& block) {
    return block.space == space && block.first <= first && last <= block.last;
  });
}

}  // namespace

int Register::words_each() const {
  return type == RegisterType::int16 || type == RegisterType::uint16 ? 1 : 2;
}

const Register* RegisterMap::find(const std::string& register_name) const {
  const auto at = registers.find(register_name);
  return at == registers.end() ? nullptr : &at->second;
}

Result<Register> RegisterMap::require(const std::string& register_name) const {
  if (const Register* entry = find(register_name); entry != nullptr) return *entry;
  return fail(ErrorCode::machine_register_unknown, {{"register", register_name}, {"map", name}});
}

Result<RegisterMap> register_map_from_json(const nlohmann::json& document, const std::string& file,
                                           std::vector<std::string>* warnings) {
  ZD_TRY(RegisterMap map, from_json<RegisterMap>(document, file, warnings, read_map));
  map.file = file;
  return map;
}

std::filesystem::path register_map_file(const std::string& name_or_path, const std::filesystem::path& beside) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  for (const fs::path& candidate : {beside / name_or_path, fs::path(name_or_path)}) {
    if (fs::is_regular_file(candidate, ignored)) return candidate;
  }
  return {};
}

Result<RegisterMap> load_register_map(const std::string& name_or_path, const std::filesystem::path& beside,
                                      std::vector<std::string>* warnings) {
  std::filesystem::path path = register_map_file(name_or_path, beside);
  if (path.empty()) {
    ZD_TRY(path, find_resource("register_maps/" + name_or_path + ".json"));
  }
  ZD_TRY(const nlohmann::json document, read_json_file(path));
  return register_map_from_json(document, path.string(), warnings);
}

double decode(const Register& entry, std::span<const std::uint16_t> words, int index) {
  const auto word = [&](int i) {
    const std::uint16_t raw = words[static_cast<std::size_t>(index) * static_cast<std::size_t>(entry.words_each()) +
                                    static_cast<std::size_t>(i)];
    return entry.high_byte_first ? raw : swapped(raw);
  };
  double raw = 0.0;
  if (entry.words_each() == 1) {
    raw = entry.type == RegisterType::int16 ? static_cast<std::int16_t>(word(0)) : word(0);
  } else {
    const std::uint32_t high = word(entry.high_word_first ? 0 : 1);
    const std::uint32_t low = word(entry.high_word_first ? 1 : 0);
    const std::uint32_t bits = high << 16 | low;
    if (entry.type == RegisterType::float32) {
      raw = std::bit_cast<float>(bits);
    } else {
      raw = entry.type == RegisterType::int32 ? static_cast<std::int32_t>(bits) : static_cast<double>(bits);
    }
  }
  if (!std::isfinite(raw) || (entry.missing_raw && raw == *entry.missing_raw)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return entry.sign * entry.scale * raw;
}

Result<std::vector<std::uint16_t>> encode(const Register& entry, double value) {
  const double raw = value / (entry.sign * entry.scale);
  double low = 0.0;
  double high = 65535.0;
  if (entry.type == RegisterType::int16) std::tie(low, high) = std::pair{-32768.0, 32767.0};
  if (entry.type == RegisterType::int32) std::tie(low, high) = std::pair{-2147483648.0, 2147483647.0};
  if (entry.type == RegisterType::uint32) high = 4294967295.0;
  if (entry.type == RegisterType::float32) std::tie(low, high) = std::pair{-3.4028234e38, 3.4028234e38};
  const double rounded = entry.type == RegisterType::float32 ? raw : std::round(raw);
  if (!(rounded >= low && rounded <= high)) {
    return fail(ErrorCode::limit_exceeded, {{"what", "the value for register " + entry.name},
                                            {"found", fmt::format("{}", value)},
                                            {"limit", fmt::format("{}", raw < low ? low : high)}});
  }
  std::uint32_t bits = 0;
  if (entry.type == RegisterType::float32) {
    bits = std::bit_cast<std::uint32_t>(static_cast<float>(rounded));
  } else {
    bits = static_cast<std::uint32_t>(static_cast<std::int64_t>(rounded));
  }
  std::vector<std::uint16_t> words;
  if (entry.words_each() == 2) words.push_back(static_cast<std::uint16_t>(bits >> 16));
  words.push_back(static_cast<std::uint16_t>(bits & 0xFFFFU));
  if (!entry.high_word_first) std::reverse(words.begin(), words.end());
  if (!entry.high_byte_first) std::transform(words.begin(), words.end(), words.begin(), swapped);
  return words;
}

std::vector<ReadSpan> plan_reads(const RegisterMap& map, const std::vector<const Register*>& entries) {
  std::vector<const Register*> sorted = entries;
  std::sort(sorted.begin(), sorted.end(), [](const Register* a, const Register* b) {
    return std::pair{a->space, a->address} < std::pair{b->space, b->address};
  });
  std::vector<ReadSpan> spans;
  for (const Register* entry : sorted) {
    const int end = entry->address + entry->words();
    if (!spans.empty() && spans.back().space == entry->space) {
      ReadSpan& last = spans.back();
      const int last_end = last.address + last.count;
      const bool joins = entry->address <= last_end || reads_across(map, entry->space, last.address, end - 1);
      if (joins && std::max(end, last_end) - last.address <= map.max_read) {
        last.count = std::max(end, last_end) - last.address;
        continue;
      }
    }
    spans.push_back({entry->space, entry->address, entry->words()});
  }
  return spans;
}

void append_float(std::vector<std::uint16_t>& words, float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  words.push_back(static_cast<std::uint16_t>(bits >> 16));
  words.push_back(static_cast<std::uint16_t>(bits & 0xFFFFU));
}

float float_at(std::span<const std::uint16_t> words, std::size_t index) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(words[index]) << 16 | words[index + 1]);
}

std::string bytes_of(std::span<const std::uint16_t> words) {
  std::string bytes;
  bytes.reserve(2 * words.size());
  for (const std::uint16_t word : words) {
    bytes.push_back(static_cast<char>(word >> 8));
    bytes.push_back(static_cast<char>(word & 0xFF));
  }
  return bytes;
}

}  // namespace zerodrift::controller
