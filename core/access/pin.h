#pragma once
// A PIN as it is kept: scrypt (RFC 7914) over a random salt. The costs stand beside the hash, so that they can grow
// without making old files useless.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace zerodrift {
class JsonObject;
}

namespace zerodrift::access {

inline constexpr std::size_t shortest_pin = 6;
inline constexpr std::size_t longest_pin = 64;

struct PinHash {
  std::string salt;                             // bytes
  std::string hash;                             // bytes
  std::uint64_t cost = std::uint64_t{1} << 15;  // N; 32 MiB and some 80 ms a try
  std::uint64_t block = 8;                      // r
  std::uint64_t parallel = 1;                   // p
};

/// access_bad_pin when it is shorter or longer than allowed.
Result<PinHash> hash_pin(std::string_view pin);
/// Takes the same time whatever differs.
Result<bool> matches(const PinHash& kept, std::string_view pin);

nlohmann::json to_json(const PinHash& pin);
/// Throws JsonFault; costs that a hostile file makes absurd are refused.
PinHash read_pin(JsonObject& object);

}  // namespace zerodrift::access
