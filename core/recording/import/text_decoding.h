#pragma once
// Bytes of a text file as UTF-8: by its byte order mark, else UTF-16 by its zero bytes, else UTF-8 where all of it is
// valid, else GB18030 where its bytes pair up as Chinese characters, else Windows-1252 (which includes Latin-1).
// Conversion by ICU.

#include <string>
#include <string_view>

#include "core/base/result.h"

namespace zerodrift::recording {

struct DecodedText {
  std::string text;      // UTF-8, without byte order mark
  std::string encoding;  // "UTF-8", "UTF-8 with BOM", "UTF-16LE", "UTF-16BE", "GB18030" or "windows-1252"
};

/// `encoding` as ICU knows it, empty: found from the bytes. Binary data is wrong_format; bytes that the encoding does
/// not know are text_encoding, with the line.
Result<DecodedText> decode_text(std::string_view bytes, const std::string& file, const std::string& encoding = {});

}  // namespace zerodrift::recording
