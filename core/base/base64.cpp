#include "core/base/base64.h"

#include <openssl/evp.h>

#include <algorithm>
#include <climits>

namespace zerodrift {
namespace {

constexpr std::size_t longest = INT_MAX / 2;

}  // namespace

std::string base64_of(std::span<const std::uint8_t> bytes) {
  if (bytes.size() > longest) return "";
  std::string out(4 * ((bytes.size() + 2) / 3) + 1, '\0');  // the encoder ends it with a zero
  const int size =
      EVP_EncodeBlock(reinterpret_cast<unsigned char*>(out.data()), bytes.data(), static_cast<int>(bytes.size()));
  out.resize(static_cast<std::size_t>(std::max(size, 0)));
  return out;
}

std::optional<std::vector<std::uint8_t>> from_base64(std::string_view text) {
  if (text.size() % 4 != 0 || text.size() > longest) return std::nullopt;
  std::vector<std::uint8_t> out(3 * (text.size() / 4));
  if (text.empty()) return out;
  const int size =
      EVP_DecodeBlock(out.data(), reinterpret_cast<const unsigned char*>(text.data()), static_cast<int>(text.size()));
  if (size != static_cast<int>(out.size())) return std::nullopt;
  // The decoder counts the padding as zeros.
  const std::size_t padding = (text.back() == '=') + (text[text.size() - 2] == '=');
  out.resize(out.size() - padding);
  return out;
}

}  // namespace zerodrift
