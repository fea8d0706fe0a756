#include "core/recording/import/number_format.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace zerodrift::recording {
namespace {

constexpr std::string_view minus_sign = "\xE2\x88\x92";        // U+2212
constexpr std::string_view no_break_space = "\xC2\xA0";        // U+00A0
constexpr std::string_view thin_space = "\xE2\x80\xAF";        // U+202F
constexpr std::string_view right_apostrophe = "\xE2\x80\x99";  // U+2019
constexpr std::size_t longest = 400;                           // characters; the smallest double needs 330

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Groups of three digits after the first one; a blank or an apostrophe between them. Nothing where they are no groups.
std::optional<std::string> without_neutral_groups(std::string_view text) {
  std::string out;
  bool grouped = false;
  std::size_t in_group = 0;
  bool whole = true;  // before the decimal sign
  for (std::size_t i = 0; i < text.size();) {
    std::size_t length = 0;
    for (const std::string_view group :
         {std::string_view(" "), std::string_view("'"), no_break_space, thin_space, right_apostrophe}) {
      if (text.substr(i).starts_with(group)) length = group.size();
    }
    if (length == 0) {
      const char c = text[i++];
      if (is_digit(c)) {
        ++in_group;
      } else {
        if (whole && grouped && in_group != 3) return std::nullopt;
        whole = false;
      }
      out += c;
      continue;
    }
    const bool may_follow = grouped ? in_group == 3 : in_group >= 1 && in_group <= 3;
    if (!whole || !may_follow || i + length >= text.size() || !is_digit(text[i + length])) return std::nullopt;
    grouped = true;
    in_group = 0;
    i += length;
  }
  if (whole && grouped && in_group != 3) return std::nullopt;
  return out;
}

/// Sign first, as the format-free part of a number: "-", then digits, points, commas, exponent. Empty: no number.
std::string plain(std::string_view text) {
  if (text.empty() || text.size() > longest) return {};
  std::string sign;
  if (text.starts_with(minus_sign)) {
    sign = "-";
    text.remove_prefix(minus_sign.size());
  } else if (text.front() == '+' || text.front() == '-') {
    if (text.front() == '-') sign = "-";
    text.remove_prefix(1);
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  }
  if (text.empty() || (!is_digit(text.front()) && text.front() != '.' && text.front() != ',')) return {};
  const auto rest = without_neutral_groups(text);
  if (!rest) return {};
  std::size_t digits = 0;
  std::size_t at = 0;
  for (; at < rest->size() && (is_digit((*rest)[at]) || (*rest)[at] == '.' || (*rest)[at] == ','); ++at) {
    digits += is_digit((*rest)[at]);
  }
  if (digits == 0) return {};
  if (at < rest->size()) {
    if ((*rest)[at] != 'e' && (*rest)[at] != 'E') return {};
    std::size_t exponent = at + 1;
    if (exponent < rest->size() && ((*rest)[exponent] == '+' || (*rest)[exponent] == '-')) ++exponent;
    if (exponent == rest->size() ||
        !std::all_of(rest->begin() + static_cast<std::ptrdiff_t>(exponent), rest->end(), is_digit)) {
      return {};
    }
  }
  return sign + *rest;
}

/// "1.234.567" with its first group of one to three digits and no leading zero.
bool is_in_groups(std::string_view whole, char separator) {
  std::size_t in_group = 0;
  bool first = true;
  for (const char c : whole) {
    if (c != separator) {
      ++in_group;
      continue;
    }
    if (first ? in_group < 1 || in_group > 3 : in_group != 3) return false;
    first = false;
    in_group = 0;
  }
  return !first && in_group == 3 && whole.front() != '0';
}

}  // namespace

std::optional<double> NumberFormat::number(std::string_view text) const {
  if (!text.empty() && (is_digit(text.front()) || text.front() == '-') && decimal == '.') {  // nearly every cell
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool digits = is_digit(text.back()) || text.back() == '.';  // no "-inf"
    if (error == std::errc{} && end == text.data() + text.size() && digits && std::isfinite(value)) return value;
  }
  std::string digits = plain(text);
  if (digits.empty()) return std::nullopt;
  const char group = decimal == '.' ? ',' : '.';
  if (digits.find(group) != std::string::npos) {
    if (!grouped) return std::nullopt;
    const std::string_view unsigned_part = std::string_view(digits).substr(digits.front() == '-' ? 1 : 0);
    const std::string_view whole = unsigned_part.substr(0, unsigned_part.find_first_of(decimal == '.' ? ".eE" : ",eE"));
    if (!is_in_groups(whole, group)) return std::nullopt;
    std::erase(digits, group);
  }
  if (decimal == ',') std::replace(digits.begin(), digits.end(), ',', '.');
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

bool looks_like_number(std::string_view text) {
  return NumberFormat{'.', true}.number(text) || NumberFormat{',', true}.number(text);
}

NumberEvidence::Kind NumberEvidence::kind_of_cell(std::string_view text) {
  if (text.find_first_of(".,") == std::string_view::npos) return Kind::nothing;
  std::string digits = plain(text);
  if (digits.empty()) return Kind::nothing;
  if (digits.front() == '-') digits.erase(0, 1);
  const std::size_t exponent = digits.find_first_of("eE");
  const std::string_view mantissa = std::string_view(digits).substr(0, exponent);
  const auto points = std::count(mantissa.begin(), mantissa.end(), '.');
  const auto commas = std::count(mantissa.begin(), mantissa.end(), ',');
  if (points > 0 && commas > 0) {
    const bool point_last = mantissa.rfind('.') > mantissa.rfind(',');
    const char decimal = point_last ? '.' : ',';
    if ((point_last ? points : commas) != 1) return Kind::nothing;
    if (!is_in_groups(mantissa.substr(0, mantissa.find(decimal)), point_last ? ',' : '.')) return Kind::nothing;
    return point_last ? Kind::comma_groups : Kind::point_groups;
  }
  const char sign = points > 0 ? '.' : ',';
  if (points + commas == 0) return Kind::nothing;
  const bool groups = is_in_groups(mantissa, sign) && exponent == std::string::npos;
  if (points > 1 || commas > 1) {
    if (!groups) return Kind::nothing;
    return points > 0 ? Kind::point_groups : Kind::comma_groups;
  }
  if (groups) return points > 0 ? Kind::point_weak : Kind::comma_weak;
  return points > 0 ? Kind::point : Kind::comma;
}

Result<NumberFormat> NumberEvidence::decide(const std::string& file) const {
  const auto seen = [&](Kind kind) -> const std::optional<Place>& { return m_seen[static_cast<int>(kind)]; };
  const auto& for_point = seen(Kind::point) ? seen(Kind::point) : seen(Kind::comma_groups);
  const auto& for_comma = seen(Kind::comma) ? seen(Kind::comma) : seen(Kind::point_groups);
  if (for_point && for_comma) {
    const auto& later = for_point->line > for_comma->line ? *for_point : *for_comma;
    const auto& earlier = for_point->line > for_comma->line ? *for_comma : *for_point;
    return fail(ErrorCode::numbers_mixed, {{"file", file},
                                           {"line", std::to_string(later.line)},
                                           {"column", later.column},
                                           {"found", later.cell},
                                           {"other", earlier.cell},
                                           {"other_line", std::to_string(earlier.line)}});
  }
  if (for_comma) return NumberFormat{',', seen(Kind::point_weak) || seen(Kind::point_groups)};
  if (for_point) return NumberFormat{'.', seen(Kind::comma_weak) || seen(Kind::comma_groups)};
  if (const auto& weak = seen(Kind::comma_weak)) {
    return fail(
        ErrorCode::number_ambiguous,
        {{"file", file}, {"line", std::to_string(weak->line)}, {"column", weak->column}, {"found", weak->cell}});
  }
  return NumberFormat{};
}

}  // namespace zerodrift::recording
