#include "core/recording/import/text_decoding.h"

#include <unicode/ucnv.h>
#include <unicode/ucnv_err.h>
#include <unicode/utf8.h>

#include <algorithm>
#include <limits>
#include <memory>

namespace zerodrift::recording {
namespace {

constexpr std::size_t zero_search_bytes = 4096;

/// The offset of the first byte that is no UTF-8, or npos.
std::size_t first_fault_of_utf8(std::string_view bytes) {
  const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  for (std::size_t at = 0; at < bytes.size();) {
    if (data[at] < 0x80) {
      ++at;
      continue;
    }
    // ICU's macros count in 32 bits; a character has four bytes at most.
    std::int32_t i = 0;
    const auto left = static_cast<std::int32_t>(std::min<std::size_t>(bytes.size() - at, 4));
    UChar32 character = 0;
    U8_NEXT(data + at, i, left, character);
    if (character < 0) return at;
    at += static_cast<std::size_t>(i);
  }
  return std::string_view::npos;
}

/// "UTF-16LE" or "UTF-16BE" where letters of Latin script have a zero beside them; else empty.
std::string_view utf16_without_mark(std::string_view bytes) {
  const std::size_t pairs = std::min(bytes.size(), zero_search_bytes) / 2;
  std::size_t zero_first = 0;
  std::size_t zero_second = 0;
  for (std::size_t i = 0; i < pairs; ++i) {
    zero_first += bytes[2 * i] == '\0';
    zero_second += bytes[2 * i + 1] == '\0';
  }
  if (pairs < 2 || bytes.size() % 2 != 0) return {};
  if (3 * zero_second > pairs && zero_first == 0) return "UTF-16LE";
  if (3 * zero_first > pairs && zero_second == 0) return "UTF-16BE";
  return {};
}

/// Bytes above 127 come in pairs, nearly all of them symbols or common characters (rows 1 to 9 and 16 to 55 of GB
/// 2312). Letters with accents of Western Europe stand alone between plain ones.
bool looks_chinese(std::string_view bytes) {
  std::size_t common = 0;
  std::size_t others = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const auto lead = static_cast<unsigned char>(bytes[i]);
    if (lead < 0x80) continue;
    const auto trail = i + 1 < bytes.size() ? static_cast<unsigned char>(bytes[i + 1]) : 0;
    const bool row = (lead >= 0xA1 && lead <= 0xA9) || (lead >= 0xB0 && lead <= 0xD7);
    if (row && trail >= 0xA1 && trail <= 0xFE) {
      ++common;
      ++i;
    } else if (lead >= 0x81 && lead <= 0xFE && trail >= 0x40) {
      ++others;
      ++i;
    } else {
      ++others;
    }
  }
  return common > 4 * others;
}

std::string chosen_encoding(std::string_view bytes) {
  if (bytes.starts_with("\xEF\xBB\xBF")) return "UTF-8 with BOM";
  if (bytes.starts_with("\xFF\xFE")) return "UTF-16LE";
  if (bytes.starts_with("\xFE\xFF")) return "UTF-16BE";
  if (const auto found = utf16_without_mark(bytes); !found.empty()) return std::string(found);
  if (first_fault_of_utf8(bytes) == std::string_view::npos) return "UTF-8";
  return looks_chinese(bytes) ? "GB18030" : "windows-1252";
}

std::string_view mark_of(std::string_view bytes) {
  for (const std::string_view mark : {"\xEF\xBB\xBF", "\xFF\xFE", "\xFE\xFF"}) {
    if (bytes.starts_with(mark)) return mark;
  }
  return {};
}

void append_utf8(std::string& out, const UChar* from, const UChar* to) {
  for (const UChar* at = from; at < to;) {
    UChar32 character = *at++;
    if (U16_IS_LEAD(character) && at < to && U16_IS_TRAIL(*at)) character = U16_GET_SUPPLEMENTARY(character, *at++);
    if (U16_IS_SURROGATE(character)) character = 0xFFFD;
    char units[4];
    std::int32_t length = 0;
    U8_APPEND_UNSAFE(units, length, character);
    out.append(units, static_cast<std::size_t>(length));
  }
}

/// Nothing where a byte means nothing in this encoding; `out` is then the text before it.
bool converted(std::string_view bytes, UConverter* converter, std::string& out) {
  UErrorCode status = U_ZERO_ERROR;
  ucnv_setToUCallBack(converter, UCNV_TO_U_CALLBACK_STOP, nullptr, nullptr, nullptr, &status);
  const char* at = bytes.data();
  const char* const end = at + bytes.size();
  UChar units[4096];
  for (;;) {
    UChar* to = units;
    status = U_ZERO_ERROR;
    ucnv_toUnicode(converter, &to, units + std::size(units), &at, end, nullptr, true, &status);
    append_utf8(out, units, to);
    if (status == U_BUFFER_OVERFLOW_ERROR) continue;
    return U_SUCCESS(status);
  }
}

tl::unexpected<Error> undecodable(const std::string& file, const std::string& encoding, std::string_view before) {
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  return fail(ErrorCode::text_encoding, {{"file", file}, {"line", std::to_string(line)}, {"encoding", encoding}});
}

}  // namespace

Result<DecodedText> decode_text(std::string_view bytes, const std::string& file, const std::string& encoding) {
  DecodedText out;
  out.encoding = encoding.empty() ? chosen_encoding(bytes) : encoding;
  bytes.remove_prefix(mark_of(bytes).size());
  if (out.encoding.starts_with("UTF-8")) {
    const std::size_t fault = first_fault_of_utf8(bytes);
    if (fault != std::string_view::npos) return undecodable(file, out.encoding, bytes.substr(0, fault));
    out.text = bytes;
  } else {
    UErrorCode status = U_ZERO_ERROR;
    const std::unique_ptr<UConverter, decltype(&ucnv_close)> converter(ucnv_open(out.encoding.c_str(), &status),
                                                                       ucnv_close);
    if (U_FAILURE(status)) return undecodable(file, out.encoding, {});
    if (!converted(bytes, converter.get(), out.text)) return undecodable(file, out.encoding, out.text);
  }
  if (out.text.find('\0') != std::string::npos) {
    return fail(ErrorCode::wrong_format, {{"file", file}, {"found", "binary data"}, {"expected", "a CSV text table"}});
  }
  return out;
}

}  // namespace zerodrift::recording
