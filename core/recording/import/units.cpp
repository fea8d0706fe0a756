#include "core/recording/import/units.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "core/recording/import/cells.h"

namespace zerodrift::recording {
namespace {

constexpr double inch_um = 25400.0;
constexpr double fahrenheit = 5.0 / 9.0;
constexpr double urad_per_arcsec = std::numbers::pi / 648000.0 * 1e6;

using Units = std::map<std::string, Unit, std::less<>>;

void add(Units& units, std::initializer_list<const char*> names, Unit unit) {
  for (const char* name : names) units.emplace(name, unit);
}

/// By their names without blanks, with "u" for the micro sign and "deg" for the degree sign.
const Units& known_units() {
  static const Units units = [] {
    Units u;
    using Q = Quantity;
    add(u, {"degC", "DegC", "Deg_C", "deg_C", "C", "oC", "Celsius", "celsius", "GradC", "gradC", "℃", "摄氏度"},
        {Q::temperature, "C", 1.0, 0.0});
    add(u, {"degF", "DegF", "deg_F", "F", "Fahrenheit", "fahrenheit", "GradF", "℉", "华氏度"},
        {Q::temperature, "C", fahrenheit, -32.0 * fahrenheit});
    add(u, {"K", "degK", "Kelvin", "kelvin", "开尔文"}, {Q::temperature, "C", 1.0, -273.15});
    add(u, {"mK", "millikelvin"}, {Q::other, "", 1.0, 0.0});
    add(u, {"um", "micron", "microns", "Micron", "micrometer", "micrometre", "Mikrometer", "微米"},
        {Q::length, "um", 1.0, 0.0});
    add(u, {"nm", "纳米"}, {Q::length, "um", 1e-3, 0.0});
    add(u, {"mm", "millimeter", "millimetre", "Millimeter", "毫米"}, {Q::length, "um", 1e3, 0.0});
    add(u, {"m", "meter", "metre"}, {Q::length, "um", 1e6, 0.0});
    add(u, {"in", "inch", "inches", "Inch", "Zoll", "英寸", "\""}, {Q::length, "um", inch_um, 0.0});
    add(u, {"uin", "microinch", "microinches", "uinch"}, {Q::length, "um", inch_um * 1e-6, 0.0});
    add(u, {"mil", "mils", "thou", "thousandths"}, {Q::length, "um", inch_um * 1e-3, 0.0});
    add(u, {"urad"}, {Q::angle, "urad", 1.0, 0.0});
    add(u, {"um/m"}, {Q::angle, "urad", 1.0, 0.0});
    add(u, {"mrad", "mm/m"}, {Q::angle, "urad", 1e3, 0.0});
    add(u, {"rad"}, {Q::angle, "urad", 1e6, 0.0});
    add(u, {"arcsec", "arcsecs", "arcseconds"}, {Q::angle, "urad", urad_per_arcsec, 0.0});
    add(u, {"rpm", "RPM", "r/min", "rev/min", "U/min", "1/min", "min-1", "min^-1", "min⁻¹", "/min", "转/分", "转/分钟"},
        {Q::speed, "rpm", 1.0, 0.0});
    add(u, {"1/s", "rps", "rev/s", "r/s", "U/s", "s-1", "s^-1", "s⁻¹"}, {Q::speed, "rpm", 60.0, 0.0});
    add(u, {"rad/s"}, {Q::speed, "rpm", 30.0 / std::numbers::pi, 0.0});
    add(u, {"mm/min", "毫米/分"}, {Q::feed, "mm_min", 1.0, 0.0});
    add(u, {"m/min"}, {Q::feed, "mm_min", 1e3, 0.0});
    add(u, {"mm/s"}, {Q::feed, "mm_min", 60.0, 0.0});
    add(u, {"in/min", "ipm", "inch/min"}, {Q::feed, "mm_min", 25.4, 0.0});
    add(u, {"W", "watt", "Watt", "watts", "瓦"}, {Q::power, "W", 1.0, 0.0});
    add(u, {"kW", "KW", "千瓦"}, {Q::power, "W", 1e3, 0.0});
    add(u, {"mW"}, {Q::power, "W", 1e-3, 0.0});
    add(u, {"s", "sec", "secs", "second", "seconds", "Seconds", "Sekunden", "Sek", "S", "秒"},
        {Q::time, "s", 1.0, 0.0});
    add(u, {"ms", "msec", "milliseconds", "毫秒"}, {Q::time, "s", 1e-3, 0.0});
    add(u, {"us", "usec", "microseconds", "微秒"}, {Q::time, "s", 1e-6, 0.0});
    add(u, {"ns", "nanoseconds", "纳秒"}, {Q::time, "s", 1e-9, 0.0});
    add(u, {"min", "mins", "minute", "minutes", "Minuten", "Min", "分钟", "分"}, {Q::time, "s", 60.0, 0.0});
    add(u, {"h", "hr", "hrs", "hour", "hours", "Hours", "Stunden", "Std", "小时", "时"}, {Q::time, "s", 3600.0, 0.0});
    add(u, {"d", "day", "days", "Tage", "天"}, {Q::time, "s", 86400.0, 0.0});
    add(u, {"V",   "mV",  "uV",   "A",   "mA", "%",     "%RH",   "bar", "mbar", "Pa",   "kPa", "MPa", "psi",
            "Hz",  "kHz", "N",    "kN",  "Nm", "l/min", "L/min", "l/h", "m/s",  "m/s2", "g",   "kg",  "ohm",
            "Ohm", "Ω",   "kohm", "deg", "hp", "PS",    "kWh",   "J",   "VA",   "dB",   "ppm", "W/m2"},
        {Q::other, "", 1.0, 0.0});
    return u;
  }();
  return units;
}

void replaced(std::string& text, std::string_view from, std::string_view to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

std::string_view without_brackets(std::string_view text) {
  for (const auto& [open, close] :
       std::array<std::pair<char, char>, 4>{{{'(', ')'}, {'[', ']'}, {'<', '>'}, {'{', '}'}}}) {
    if (text.size() > 2 && text.front() == open && text.back() == close)
      return trimmed(text.substr(1, text.size() - 2));
  }
  return text;
}

/// In the spelling of known_units.
std::string canonical(std::string_view text) {
  std::string out(without_brackets(trimmed(text)));
  replaced(out, "\xC2\xB5", "u");    // micro sign
  replaced(out, "\xCE\xBC", "u");    // Greek mu
  replaced(out, "\xC2\xB0", "deg");  // degree sign
  replaced(out, "\xC2\xBA", "deg");  // masculine ordinal, taken for it
  replaced(out, "\xCB\x9A", "deg");  // ring above, taken for it
  replaced(out, "（", "");
  replaced(out, "）", "");
  std::erase(out, ' ');
  if (out == "Deg.C" || out == "deg.C") out = "degC";
  if (out == "Deg.F" || out == "deg.F") out = "degF";
  return out;
}

/// A unit of one letter needs a sign that it is one: "Motor C" may be the third motor.
bool is_plain_letter(std::string_view text) {
  return text.size() == 1 && std::isalpha(static_cast<unsigned char>(text.front())) != 0;
}

std::string name_before(std::string_view header, std::size_t end) {
  std::string_view name = trimmed(header.substr(0, end));
  while (name.ends_with(',') || name.ends_with(':') || name.ends_with('/'))
    name = trimmed(name.substr(0, name.size() - 1));
  if (name.ends_with(" in")) name = trimmed(name.substr(0, name.size() - 3));
  return std::string(name);
}

/// A unit in brackets anywhere, the last one first; what follows it stays in the name.
std::optional<NameWithUnit> in_brackets(std::string_view header) {
  static const std::array<std::pair<std::string_view, std::string_view>, 4> pairs{
      {{"(", ")"}, {"[", "]"}, {"<", ">"}, {"（", "）"}}};
  for (const auto& [open, close] : pairs) {
    for (auto begin = header.rfind(open); begin != std::string_view::npos;
         begin = begin == 0 ? std::string_view::npos : header.rfind(open, begin - 1)) {
      const auto end = header.find(close, begin + open.size());
      if (end == std::string_view::npos) continue;
      const std::string_view inside = header.substr(begin + open.size(), end - begin - open.size());
      if (!unit_from(inside)) continue;
      std::string name = name_before(header, begin);
      const std::string_view rest = trimmed(header.substr(end + close.size()));
      if (!rest.empty()) name += (name.empty() ? "" : " ") + std::string(rest);
      return NameWithUnit{std::move(name), std::string(trimmed(inside))};
    }
  }
  return std::nullopt;
}

/// "Temp, °C", "Temp, °C (LGR S/N: 1, LBL: Bearing)": the part after a comma.
std::optional<NameWithUnit> after_comma(std::string_view header) {
  for (auto comma = header.find(','); comma != std::string_view::npos; comma = header.find(',', comma + 1)) {
    const auto end = std::min(header.find_first_of(",(", comma + 1), header.size());
    const std::string_view part = trimmed(header.substr(comma + 1, end - comma - 1));
    if (!unit_from(part)) continue;
    std::string name = name_before(header, comma);
    const auto label = header.find("LBL:");  // HOBO: the sensor's label
    if (label != std::string_view::npos) {
      name = std::string(trimmed(header.substr(label + 4, header.find_first_of(",)", label) - label - 4)));
    }
    return NameWithUnit{std::move(name), std::string(part)};
  }
  return std::nullopt;
}

/// "T / °C", as DIN 1313 has it, and "Temp 1 degC".
std::optional<NameWithUnit> at_the_end(std::string_view header) {
  const auto slash = header.rfind(" /");
  if (slash != std::string_view::npos && unit_from(header.substr(slash + 2))) {
    return NameWithUnit{name_before(header, slash), std::string(trimmed(header.substr(slash + 2)))};
  }
  for (auto blank = header.rfind(' '); blank != std::string_view::npos;
       blank = blank == 0 ? std::string_view::npos : header.rfind(' ', blank - 1)) {
    const std::string_view word = header.substr(blank + 1);
    if (word.size() > 14) break;
    if (!is_plain_letter(trimmed(word)) && word != "in" && word != "an" && unit_from(word)) {
      return NameWithUnit{name_before(header, blank), std::string(word)};
    }
  }
  return std::nullopt;
}

/// "T1_F", "dZ_mm", "feed_X_mm_min", "time_ms": the longest unit after an underscore.
std::optional<NameWithUnit> after_underscore(std::string_view header) {
  for (auto at = header.find('_'); at != std::string_view::npos; at = header.find('_', at + 1)) {
    if (at == 0) continue;
    std::string unit(header.substr(at + 1));
    std::replace(unit.begin(), unit.end(), '_', '/');
    if (unit_from(unit)) return NameWithUnit{std::string(header.substr(0, at)), unit};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Unit> unit_from(std::string_view text) {
  if (text.empty() || text.size() > 24) return std::nullopt;
  const auto found = known_units().find(canonical(text));
  if (found == known_units().end()) return std::nullopt;
  return found->second;
}

bool is_unit_word(std::string_view text) {
  return unit_from(text).has_value();
}

NameWithUnit split_unit(std::string_view header) {
  header = trimmed(header);
  for (const auto read : {in_brackets, after_comma, at_the_end, after_underscore}) {
    if (auto found = read(header)) return *found;
  }
  return {std::string(header), {}};
}

namespace {

/// Powers of ten, 1 itself apart: other numbers in a heading are places, types and ranges.
bool is_power_of_ten(std::string_view text) {
  std::string digits(text);
  std::replace(digits.begin(), digits.end(), ',', '.');
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size() || !(value > 0.0)) return false;
  const double power = std::log10(value);
  return std::abs(power - std::round(power)) < 1e-9 && power != 0.0;
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

}  // namespace

std::string factor_in(std::string_view heading) {
  std::string text(heading);
  replaced(text, "\xC3\x97", "x");      // multiplication sign
  replaced(text, "\xC2\xB7", "*");      // middle dot
  replaced(text, "\xE2\x88\x92", "-");  // minus sign
  replaced(text, "\xE2\x81\xBB\xC2\xB9", "^-1");
  replaced(text, "\xE2\x81\xBB\xC2\xB2", "^-2");
  replaced(text, "\xE2\x81\xBB\xC2\xB3", "^-3");
  const auto is_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (!is_digit(text[at]) || (at > 0 && (is_digit(text[at - 1]) || text[at - 1] == '.' || text[at - 1] == ',')))
      continue;
    std::size_t end = at;
    while (end < text.size() && (is_digit(text[end]) || ((text[end] == '.' || text[end] == ',') &&
                                                         end + 1 < text.size() && is_digit(text[end + 1])))) {
      ++end;
    }
    const std::string number = text.substr(at, end - at);
    if (end + 1 < text.size() && (text[end] == 'e' || text[end] == 'E') && (at == 0 || !is_word(text[at - 1]))) {
      const std::size_t digits = text[end + 1] == '-' || text[end + 1] == '+' ? end + 2 : end + 1;
      std::size_t stop = digits;
      while (stop < text.size() && is_digit(text[stop])) ++stop;
      if (stop > digits && (stop == text.size() || !is_word(text[stop]))) return text.substr(at, stop - at);
    }
    if (number == "10" && end + 1 < text.size() && text[end] == '^') {
      std::size_t stop = end + 1;
      if (text[stop] == '-' || text[stop] == '+') ++stop;
      if (stop < text.size() && is_digit(text[stop])) return text.substr(at, stop + 1 - at);
    }
    if (!is_power_of_ten(number)) continue;
    std::size_t before = at;
    while (before > 0 && text[before - 1] == ' ') --before;
    const char sign = before > 0 ? text[before - 1] : '\0';
    const bool own_sign = sign == '*' || before < 2 || !is_word(text[before - 2]);
    if ((sign == 'x' || sign == '*') && own_sign) return text.substr(before - 1, end - before + 1);
    // "/10" ends the heading; "1/100 mm" is a unit; a date and the class of a Pt100 are neither.
    const auto ends_here = [&](std::size_t from) {
      return from >= text.size() || std::string_view(")],;").find(text[from]) != std::string_view::npos;
    };
    std::size_t from = end;
    while (from < text.size() && text[from] == ' ') ++from;
    const std::size_t to = std::min(text.find_first_of(" )],;", from), text.size());
    const bool of_unit = to > from && unit_from(std::string_view(text).substr(from, to - from)) && ends_here(to);
    if (sign == '/') {
      const char divided = before >= 2 ? text[before - 2] : ' ';
      const bool one = divided == '1' && (before < 3 || !is_word(text[before - 3]));
      if (one && of_unit) return "1/" + number;
      std::size_t word = before - 1;
      while (word > 0 && std::string_view(" _[(,").find(text[word - 1]) == std::string_view::npos) --word;
      const bool after_unit = unit_from(std::string_view(text).substr(word, before - 1 - word)).has_value();
      if ((!is_word(divided) || after_unit) && ends_here(from)) return "/" + number;
      continue;
    }
    // A number and a unit: "0.1 °C", "0.01mm". A whole number may be a place or a range: "100 mm".
    const bool fraction = number.find_first_of(".,") != std::string::npos;
    if (!fraction || (at > 0 && is_word(text[at - 1]))) continue;
    if (of_unit) return number;
    std::size_t mark = end;
    while (mark < text.size() && text[mark] == ' ') ++mark;
    if (mark < text.size() && (text[mark] == 'x' || text[mark] == '*')) return number;
  }
  return {};
}

}  // namespace zerodrift::recording
