#pragma once
// SHA-256 (FIPS 180-4, OpenSSL) for provenance and commitments; CRC-32 (ISO 3309, zlib) for chunks and tables.

#include <cstdint>
#include <string>
#include <string_view>

namespace zerodrift {

/// 64 lower-case hexadecimal digits.
std::string sha256_hex(std::string_view bytes);
std::uint32_t crc32_of(std::string_view bytes);

}  // namespace zerodrift
