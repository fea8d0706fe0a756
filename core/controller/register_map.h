#pragma once
// A register map: which Modbus register holds what, as JSON, so that another controller is connected without code.
// Registers have well-known names ("temperature_C", "table_commit", ...; docs/register-maps.md); a map names those its
// controller has. Floats and words are packed here: library helpers differ between versions and do not round-trip.

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace zerodrift::controller {

enum class RegisterSpace {
  holding,  // function codes 3, 6, 16
  input,    // function code 4
};

enum class RegisterType {
  int16,
  uint16,
  int32,
  uint32,
  float32,
};

struct Register {
  std::string name;
  RegisterSpace space = RegisterSpace::holding;
  int address = 0;  // as on the wire, from 0
  RegisterType type = RegisterType::uint16;
  int count = 1;       // values one after another
  double scale = 1.0;  // value = sign * scale * raw
  int sign = 1;
  std::optional<double> missing_raw;  // this raw value means "no value"
  bool high_word_first = true;
  bool high_byte_first = true;

  int words_each() const;
  int words() const { return count * words_each(); }
};

struct ReadableBlock {
  RegisterSpace space = RegisterSpace::holding;
  int first = 0;
  int last = 0;
};

struct RegisterMap {
  std::string name;
  std::string file;
  std::optional<int> unit;  // overrides the profile's
  int max_read = 125;
  int max_write = 123;
  double host_offset_step_um = 20.0;          // largest step of a host offset the controller takes
  std::optional<int> magic;                   // what register "magic" must hold
  std::vector<ReadableBlock> readable;        // blocks that may be read across, gaps included
  std::map<std::string, Register> registers;  // by name

  const Register* find(const std::string& register_name) const;
  /// The register, or machine_register_unknown.
  Result<Register> require(const std::string& register_name) const;
};

Result<RegisterMap> register_map_from_json(const nlohmann::json& document, const std::string& file,
                                           std::vector<std::string>* warnings = nullptr);
/// From a list of registers (register_list.h); `base`: what the first one is called where addresses are plain numbers,
/// -1 for as the list says, else 0.
Result<RegisterMap> register_map_from_list(std::string_view bytes, const std::string& file, int base = -1,
                                           std::vector<std::string>* warnings = nullptr);
/// A map in either form, told from its content.
Result<RegisterMap> read_register_list(const std::filesystem::path& path, int base = -1,
                                       std::vector<std::string>* warnings = nullptr);
nlohmann::json to_json(const Register& entry);
/// With base 0; reads back as the same map.
nlohmann::json to_json(const RegisterMap& map);
/// The file that a name means when it is a path, as load_register_map looks for it; empty: none.
std::filesystem::path register_map_file(const std::string& name_or_path, const std::filesystem::path& beside);
/// A path to a JSON map, or the name of a shipped one; relative paths are looked up beside `beside` first.
Result<RegisterMap> load_register_map(const std::string& name_or_path, const std::filesystem::path& beside = {},
                                      std::vector<std::string>* warnings = nullptr);

/// The value number `index` of a register; NaN when it is the "missing" one or not finite.
double decode(const Register& entry, std::span<const std::uint16_t> words, int index = 0);
/// Words of one value; limit_exceeded when it does not fit the type.
Result<std::vector<std::uint16_t>> encode(const Register& entry, double value);

/// One request that covers several registers.
struct ReadSpan {
  RegisterSpace space = RegisterSpace::holding;
  int address = 0;
  int count = 0;
};
/// The fewest requests for these registers: neighbours, and across gaps within a readable block.
std::vector<ReadSpan> plan_reads(const RegisterMap& map, const std::vector<const Register*>& entries);

/// IEEE 754 single, high word first, as in docs/register-map.md.
void append_float(std::vector<std::uint16_t>& words, float value);
float float_at(std::span<const std::uint16_t> words, std::size_t index);
/// Registers as bytes, high byte first, for a CRC.
std::string bytes_of(std::span<const std::uint16_t> words);

}  // namespace zerodrift::controller
