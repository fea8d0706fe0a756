#include "core/compensation/laser_units.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>
#include <vector>

#include "core/compensation/laser_parts.h"

namespace zerodrift::compensation::laser_parts {
namespace {

constexpr double mm_per_inch = 25.4;

struct LengthWord {
  std::string_view word;  // normalised
  double mm;
};

// "µ" (U+00B5) and "μ" (U+03BC) are the same letter here: both are normalised to U+00B5.
constexpr LengthWord length_words[] = {
    {"mm", 1.0},
    {"millimeter", 1.0},
    {"millimeters", 1.0},
    {"millimetre", 1.0},
    {"millimetres", 1.0},
    {"毫米", 1.0},
    {"um", 1e-3},
    {"µm", 1e-3},
    {"µ", 1e-3},
    {"mum", 1e-3},
    {"my", 1e-3},
    {"micron", 1e-3},
    {"microns", 1e-3},
    {"mikron", 1e-3},
    {"micrometer", 1e-3},
    {"micrometers", 1e-3},
    {"micrometre", 1e-3},
    {"micrometres", 1e-3},
    {"mikrometer", 1e-3},
    {"微米", 1e-3},
    {"nm", 1e-6},
    {"nanometer", 1e-6},
    {"nanometers", 1e-6},
    {"nanometre", 1e-6},
    {"nanometres", 1e-6},
    {"纳米", 1e-6},
    {"cm", 10.0},
    {"m", 1000.0},
    {"meter", 1000.0},
    {"meters", 1000.0},
    {"metre", 1000.0},
    {"metres", 1000.0},
    {"米", 1000.0},
    {"in", mm_per_inch},
    {"in.", mm_per_inch},
    {"inch", mm_per_inch},
    {"inches", mm_per_inch},
    {"zoll", mm_per_inch},
    {"\"", mm_per_inch},
    {"英寸", mm_per_inch},
    {"uin", 1e-6 * mm_per_inch},
    {"uin.", 1e-6 * mm_per_inch},
    {"uinch", 1e-6 * mm_per_inch},
    {"µin", 1e-6 * mm_per_inch},
    {"µin.", 1e-6 * mm_per_inch},
    {"µinch", 1e-6 * mm_per_inch},
    {"u\"", 1e-6 * mm_per_inch},
    {"µ\"", 1e-6 * mm_per_inch},
    {"microin", 1e-6 * mm_per_inch},
    {"microinch", 1e-6 * mm_per_inch},
    {"microinches", 1e-6 * mm_per_inch},
    {"micro-inch", 1e-6 * mm_per_inch},
    {"micro-inches", 1e-6 * mm_per_inch},
    {"mikrozoll", 1e-6 * mm_per_inch},
    {"微英寸", 1e-6 * mm_per_inch},
    {"millionths", 1e-6 * mm_per_inch},
    {"mil", 1e-3 * mm_per_inch},
    {"mils", 1e-3 * mm_per_inch},
    {"thou", 1e-3 * mm_per_inch},
    {"密耳", 1e-3 * mm_per_inch},
    {"tenth", 1e-4 * mm_per_inch},  // of a thousandth of an inch, as machinists say
    {"tenths", 1e-4 * mm_per_inch},
};

constexpr std::string_view angle_words[] = {
    "deg",    "degs", "degree", "degrees", "°",          "grad", "gon",  "arcsec",         "asec",
    "arcmin", "amin", "\"arc",  "rad",     "mrad",       "urad", "µrad", "角秒",           "角分",
    "度",     "弧度", "弧秒",   "arc-sec", "arcseconds", "″",    "′",    "winkelsekunden", "bogensekunden"};

constexpr std::string_view other_words[] = {
    "%",      "percent", "prozent", "百分比", "c",    "°c",    "degc", "celsius", "℃",    "f",   "°f", "degf",
    "k",      "kelvin",  "pa",      "hpa",    "kpa",  "mbar",  "bar",  "mmhg",    "inhg", "v",   "mv", "a",
    "ma",     "w",       "kw",      "db",     "ppm",  "s",     "sec",  "ms",      "min",  "h",   "hz", "khz",
    "rpm",    "1/min",   "u/min",   "mm/min", "mm/s", "m/min", "m/s",  "in/min",  "ipm",  "%rh", "rh", "counts",
    "pulses", "digits",  "steps",   "um/m",   "µm/m", "mm/m",  "1/k",  "um/k",    "µm/k", "kg",  "n",  "nm/s"};

template <std::size_t N>
bool contains(const std::string_view (&words)[N], std::string_view text) {
  return std::find(std::begin(words), std::end(words), text) != std::end(words);
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

std::optional<Unit> plain_unit(const std::string& text) {
  for (const LengthWord& one : length_words) {
    if (text == one.word) return Unit{UnitKind::length, one.mm, text};
  }
  if (contains(other_words, text)) return Unit{UnitKind::other, 0.0, text};
  if (contains(angle_words, text)) return Unit{UnitKind::angle, 0.0, text};
  return std::nullopt;
}

/// Takes "0.0001", "1/1000", "10^-4" or "1e-4" from the front; nothing when no number stands there.
std::optional<double> take_factor(std::string& text) {
  const auto number = [&]() -> std::optional<double> {
    const std::size_t end = std::min(text.find_first_not_of("0123456789.,"), text.size());
    std::string digits = text.substr(0, end);
    std::replace(digits.begin(), digits.end(), ',', '.');
    const auto value = number_from(digits);
    if (value) text.erase(0, end);
    return value;
  };
  const auto blanks = [&] { text.erase(0, std::min(text.find_first_not_of(" x*×"), text.size())); };
  blanks();
  const auto first = number();
  if (!first) return std::nullopt;
  double factor = *first;
  if (text.starts_with('/')) {
    text.erase(0, 1);
    const auto below = number();
    if (!below || *below == 0.0) return std::nullopt;
    factor /= *below;
  } else if (text.starts_with('^') || text.starts_with("e-") || text.starts_with("**")) {
    const bool power = !text.starts_with('e');
    if (power && factor != 10.0) return std::nullopt;
    text.erase(0, text.starts_with("**") ? 2 : 1);
    const bool negative = text.starts_with('-');
    if (negative) text.erase(0, 1);
    const auto exponent = number();
    if (!exponent || *exponent > 12.0) return std::nullopt;
    factor = (power ? 1.0 : factor) * std::pow(10.0, negative ? -*exponent : *exponent);
  }
  blanks();
  if (!(factor > 0.0)) return std::nullopt;
  return factor;
}

/// A word behind a blank that can only be meant as a unit: "Error um", but not "Error in".
bool is_plain_as_last_word(const std::string& word) {
  static constexpr std::string_view words[] = {
      "mm",  "um",   "µm",      "nm",  "inch",    "inches", "zoll",    "uin", "µin",  "microinch", "micron",
      "mil", "mils", "microns", "deg", "degrees", "arcsec", "percent", "%",   "毫米", "微米",      "tenths"};
  return contains(words, word);
}

std::string joined_without(const std::string& text, std::size_t from, std::size_t end) {
  std::string out = text.substr(0, from) + " " + text.substr(std::min(end, text.size()));
  const auto first = out.find_first_not_of(" _/");
  if (first == std::string::npos) return {};
  return out.substr(first, out.find_last_not_of(" _/,") - first + 1);
}

/// The unit in brackets, which may be one of several: "Error (up) (um)".
std::optional<NameAndUnit> unit_in_brackets(const std::string& text) {
  static constexpr std::string_view open = "([{";
  static constexpr std::string_view close = ")]}";
  for (std::size_t end = text.size(); end-- > 0;) {
    const std::size_t kind = close.find(text[end]);
    if (kind == std::string_view::npos) continue;
    const std::size_t from = text.rfind(open[kind], end);
    if (from == std::string::npos) continue;
    if (auto unit = unit_of(text.substr(from + 1, end - from - 1))) {
      return NameAndUnit{joined_without(text, from, end + 1), std::move(unit)};
    }
  }
  return std::nullopt;
}

}  // namespace

std::string normalised(std::string_view given) {
  static constexpr std::pair<std::string_view, std::string_view> others[] = {
      {"Ä", "ae"},
      {"ä", "ae"},
      {"Ö", "oe"},
      {"ö", "oe"},
      {"Ü", "ue"},
      {"ü", "ue"},
      {"ß", "ss"},
      {"a\xCC\x88", "ae"},
      {"o\xCC\x88", "oe"},
      {"u\xCC\x88", "ue"},  // letter and combining diaeresis
      {"μ", "µ"},
      {"−", "-"},
      {"–", "-"},
      {"—", "-"},
      {"－", "-"},
      {"＋", "+"},
      {"（", "("},
      {"）", ")"},
      {"［", "["},
      {"］", "]"},
      {"【", "["},
      {"】", "]"},
      {"：", ":"},
      {"，", ","},
      {"％", "%"},
      {"／", "/"},
      {"＃", "#"},
      {"\xC2\xA0", " "},
      {"\xE2\x80\xAF", " "},
      {"\xE3\x80\x80", " "},
      {"“", "\""},
      {"”", "\""}};
  std::string text = lowered(std::string(given));
  for (const auto& [from, to] : others) replace_all(text, from, to);
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::optional<Unit> unit_of(std::string_view given) {
  std::string text = normalised(given);
  while (text.size() >= 2 && std::string_view("([{").find(text.front()) != std::string_view::npos &&
         std::string_view(")]}").find(text.back()) != std::string_view::npos) {
    text = normalised(text.substr(1, text.size() - 2));
  }
  for (const std::string_view before : {"in ", "unit: ", "unit ", "einheit: ", "单位:"}) {
    if (text.starts_with(before) && text.size() > before.size()) text.erase(0, before.size());
  }
  std::erase(text, ' ');
  if (auto unit = plain_unit(text)) return unit;
  const auto factor = take_factor(text);
  if (!factor) return std::nullopt;
  auto unit = plain_unit(text);
  if (!unit || unit->kind != UnitKind::length) return std::nullopt;
  unit->mm *= *factor;
  unit->name = normalised(given);
  return unit;
}

NameAndUnit split_unit(std::string_view header) {
  std::string text = normalised(header);
  if (auto found = unit_in_brackets(text)) return *found;
  for (std::size_t at = 1; at < text.size(); ++at) {  // as DIN 1313 has it: "Abweichung / µm"
    const bool fraction = text[at] == '/' && text[at - 1] >= '0' && text[at - 1] <= '9';
    if (std::string_view("/:,").find(text[at]) == std::string_view::npos || fraction) continue;
    if (auto unit = unit_of(text.substr(at + 1))) return {joined_without(text, at, text.size()), std::move(unit)};
  }
  if (const auto at = text.rfind(" in "); at != std::string::npos) {
    if (auto unit = unit_of(text.substr(at + 4))) return {joined_without(text, at, text.size()), std::move(unit)};
  }
  if (const auto at = text.rfind('_'); at != std::string::npos && at > 0) {
    if (auto unit = plain_unit(text.substr(at + 1))) return {joined_without(text, at, text.size()), std::move(unit)};
  }
  if (const auto at = text.rfind(' '); at != std::string::npos && is_plain_as_last_word(text.substr(at + 1))) {
    return {joined_without(text, at, text.size()), plain_unit(text.substr(at + 1))};
  }
  if (text.size() > 1 && text.ends_with('%'))
    return {joined_without(text, text.size() - 1, text.size()), plain_unit("%")};
  return {text, std::nullopt};
}

}  // namespace zerodrift::compensation::laser_parts
