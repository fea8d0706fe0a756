#include "core/base/error.h"

#include <array>
#include <utility>

namespace zerodrift {
namespace {

struct Row {
  std::string_view name;
  std::string_view keys;
};

constexpr std::array rows = {
#define ZERODRIFT_ERROR(code, keys) Row{#code, keys},
#include "core/base/error_codes.inc"
#undef ZERODRIFT_ERROR
};

}  // namespace

Error Error::with(std::string key, std::string value) && {
  context.emplace(std::move(key), std::move(value));
  return std::move(*this);
}

std::string_view name_of(ErrorCode code) {
  return rows.at(static_cast<std::size_t>(code)).name;
}

std::string_view context_keys_of(ErrorCode code) {
  return rows.at(static_cast<std::size_t>(code)).keys;
}

int error_code_count() {
  return static_cast<int>(rows.size());
}

std::string shortened(std::string found) {
  constexpr std::size_t longest_shown = 60;
  constexpr std::string_view more = "...";
  if (found.size() <= longest_shown) return found;
  std::size_t end = longest_shown - more.size();
  // Not within a character of several bytes (UTF-8).
  while (end > 0 && (static_cast<unsigned char>(found[end]) & 0xC0) == 0x80) --end;
  found.resize(end);
  return found.append(more);
}

std::string describe(const Error& error) {
  std::string text(name_of(error.code));
  for (const auto& [key, value] : error.context) {
    text += ' ';
    text += key;
    text += '=';
    text += value;
  }
  return text;
}

}  // namespace zerodrift
