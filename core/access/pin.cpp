#include "core/access/pin.h"

#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/rand.h>

#include <bit>
#include <nlohmann/json.hpp>

#include "core/base/json.h"

namespace zerodrift::access {
namespace {

constexpr std::size_t salt_bytes = 16;
constexpr std::size_t hash_bytes = 32;
constexpr int most_cost = 1 << 17;  // 128 MiB
constexpr int most_block = 8;
constexpr int most_parallel = 4;

unsigned char* bytes_of(std::string& text) {
  return reinterpret_cast<unsigned char*>(text.data());
}

const unsigned char* bytes_of(const std::string& text) {
  return reinterpret_cast<const unsigned char*>(text.data());
}

Result<std::string> derived(std::string_view pin, const PinHash& how) {
  std::string out(hash_bytes, '\0');
  // 128 N r for the table, the rest for its blocks.
  const std::uint64_t memory = 128 * how.block * (how.cost + how.parallel + 2) + (std::uint64_t{1} << 20);
  if (EVP_PBE_scrypt(pin.data(), pin.size(), bytes_of(how.salt), how.salt.size(), how.cost, how.block, how.parallel,
                     memory, bytes_of(out), out.size()) != 1) {
    return fail(ErrorCode::internal, {{"detail", "the PIN could not be hashed"}});
  }
  return out;
}

std::string hex_of(const std::string& bytes) {
  static constexpr char digits[] = "0123456789abcdef";
  std::string text;
  for (const char c : bytes) {
    text += digits[static_cast<unsigned char>(c) >> 4];
    text += digits[static_cast<unsigned char>(c) & 15];
  }
  return text;
}

int digit_of(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return -1;
}

std::string bytes_in(JsonObject& object, const char* key, std::size_t count) {
  const std::string text = object.text(key);
  std::string bytes;
  for (std::size_t i = 0; i + 1 < text.size(); i += 2) {
    const int high = digit_of(text[i]);
    const int low = digit_of(text[i + 1]);
    if (high < 0 || low < 0) break;
    bytes += static_cast<char>(16 * high + low);
  }
  if (text.size() != 2 * count || bytes.size() != count) {
    object.reject(key, "something else", std::to_string(2 * count) + " hexadecimal digits");
  }
  return bytes;
}

}  // namespace

Result<PinHash> hash_pin(std::string_view pin) {
  if (pin.size() < shortest_pin || pin.size() > longest_pin) {
    return fail(ErrorCode::access_bad_pin,
                {{"least", std::to_string(shortest_pin)}, {"most", std::to_string(longest_pin)}});
  }
  PinHash made;
  made.salt.resize(salt_bytes);
  if (RAND_bytes(bytes_of(made.salt), static_cast<int>(salt_bytes)) != 1) {
    return fail(ErrorCode::internal, {{"detail", "no random numbers"}});
  }
  ZD_TRY(made.hash, derived(pin, made));
  return made;
}

Result<bool> matches(const PinHash& kept, std::string_view pin) {
  ZD_TRY(const std::string given, derived(pin.substr(0, longest_pin), kept));
  return given.size() == kept.hash.size() && CRYPTO_memcmp(given.data(), kept.hash.data(), given.size()) == 0 &&
         pin.size() <= longest_pin;
}

nlohmann::json to_json(const PinHash& pin) {
  return {{"kdf", "scrypt"},          {"n", pin.cost},           {"r", pin.block}, {"p", pin.parallel},
          {"salt", hex_of(pin.salt)}, {"hash", hex_of(pin.hash)}};
}

PinHash read_pin(JsonObject& object) {
  object.word("kdf", {"scrypt"});
  PinHash pin;
  pin.cost = static_cast<std::uint64_t>(object.integer("n", 2, most_cost));
  if (!std::has_single_bit(pin.cost)) object.reject("n", std::to_string(pin.cost), "a power of two");
  pin.block = static_cast<std::uint64_t>(object.integer("r", 1, most_block));
  pin.parallel = static_cast<std::uint64_t>(object.integer("p", 1, most_parallel));
  pin.salt = bytes_in(object, "salt", salt_bytes);
  pin.hash = bytes_in(object, "hash", hash_bytes);
  return pin;
}

}  // namespace zerodrift::access
