#include "core/controller/register_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace zerodrift::controller {
namespace {

using Words = std::vector<std::uint16_t>;

/// The device answered, but not for these registers: the others may be read all the same.
bool only_these(const Error& error) {
  return error.code == ErrorCode::machine_exception || error.code == ErrorCode::machine_failed ||
         error.code == ErrorCode::machine_function_missing;
}

RegisterValue decoded(const Register& shown, std::span<const std::uint16_t> words) {
  RegisterValue out{shown.name, {}, {}, {}};
  for (int i = 0; i < shown.count; ++i) out.values.push_back(decode(shown, words, i));
  for (const std::uint16_t word : words) out.raw += fmt::format("{}{:04X}", out.raw.empty() ? "" : " ", word);
  return out;
}

RegisterValue read_one(Link& link, const Register& shown) {
  const auto words = link.read(shown.space, shown.address, shown.words(), shown.name);
  if (words) return decoded(shown, *words);
  return {shown.name, {}, {}, fail(words.error())};
}

std::string number_of(double value, const Register& entry) {
  if (std::isnan(value)) return "no value";
  const bool whole = entry.type != RegisterType::float32 && entry.scale == std::round(entry.scale);
  return whole ? fmt::format("{:.0f}", value) : fmt::format("{:.3f}", value + 0.0);
}

}  // namespace

std::vector<RegisterValue> read_all(Link& link, const RegisterMap& map, int most_values) {
  std::vector<Register> shown;
  for (const auto& [name, entry] : map.registers) {
    shown.push_back(entry);
    shown.back().count = std::min(entry.count, most_values);
  }
  std::sort(shown.begin(), shown.end(), [](const Register& a, const Register& b) {
    return std::tie(a.space, a.address, a.name) < std::tie(b.space, b.address, b.name);
  });
  std::vector<const Register*> entries;
  for (const Register& entry : shown) entries.push_back(&entry);
  std::vector<RegisterValue> out;
  std::size_t next = 0;
  for (const ReadSpan& span : plan_reads(map, entries)) {
    const auto words = link.read(span.space, span.address, span.count, fmt::format("registers from {}", span.address));
    const bool lost = !words && !only_these(words.error());
    if (lost) {
      for (; next < shown.size(); ++next) out.push_back({shown[next].name, {}, {}, fail(words.error())});
      break;
    }
    for (; next < shown.size(); ++next) {
      const Register& entry = shown[next];
      const int from = entry.address - span.address;
      if (entry.space != span.space || from < 0 || from + entry.words() > span.count) break;
      if (words) {
        const auto part =
            std::span(*words).subspan(static_cast<std::size_t>(from), static_cast<std::size_t>(entry.words()));
        out.push_back(decoded(entry, part));
      } else {
        out.push_back(read_one(link, entry));
      }
    }
  }
  return out;
}

std::string text_of(const RegisterValue& value, const Register& entry) {
  if (!value.result) return {};
  std::string text;
  for (const double one : value.values) text += (text.empty() ? "" : ", ") + number_of(one, entry);
  if (static_cast<int>(value.values.size()) < entry.count) text += fmt::format(", ... ({})", entry.count);
  return text;
}

}  // namespace zerodrift::controller
