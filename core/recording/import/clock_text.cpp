#include "core/recording/import/clock_text.h"

#include <algorithm>
#include <cctype>

namespace zerodrift::recording {
namespace {

constexpr std::int64_t second_ns = 1'000'000'000;
constexpr std::size_t longest_text = 64;

/// Reads from the front of a text; every reader takes what it understands away and says whether it did.
struct Scanner {
  std::string_view rest;

  bool take(char c) {
    if (rest.empty() || rest.front() != c) return false;
    rest.remove_prefix(1);
    return true;
  }
  bool take(std::string_view word) {
    if (!rest.starts_with(word)) return false;
    rest.remove_prefix(word.size());
    return true;
  }
  void blanks() {
    while (take(' ')) {
    }
  }
  /// Digits in a row, at most `most`; their number in `count`.
  std::optional<int> number(std::size_t most, std::size_t* count = nullptr) {
    std::size_t n = 0;
    int value = 0;
    while (n < rest.size() && n < most && rest[n] >= '0' && rest[n] <= '9') value = 10 * value + (rest[n++] - '0');
    if (n == 0) return std::nullopt;
    rest.remove_prefix(n);
    if (count != nullptr) *count = n;
    return value;
  }
  /// Letters in a row, lower case.
  std::string letters() {
    std::string out;
    while (!rest.empty() && std::isalpha(static_cast<unsigned char>(rest.front())) != 0) {
      out += static_cast<char>(std::tolower(static_cast<unsigned char>(rest.front())));
      rest.remove_prefix(1);
    }
    return out;
  }
};

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

/// Chinese marks of date and time as the signs that mean the same.
std::string with_plain_marks(std::string_view text) {
  std::string out(text);
  if (std::all_of(out.begin(), out.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; })) return out;
  for (const auto& [from, to] : std::array<std::pair<std::string_view, std::string_view>, 11>{{
           {"年", "-"},
           {"月", "-"},
           {"日", " "},
           {"时", ":"},
           {"時", ":"},
           {"分", ":"},
           {"秒", ""},
           {"上午", " AM "},
           {"下午", " PM "},
           {"\xC2\xA0", " "},
           {"\xE2\x80\xAF", " "},
       }}) {
    replace_all(out, from, to);
  }
  return out;
}

/// 1 to 12 from an English or German month's first three letters, 0 otherwise.
int month_from(const std::string& word) {
  static const std::array<const char*, 12> english{"jan", "feb", "mar", "apr", "may", "jun",
                                                   "jul", "aug", "sep", "oct", "nov", "dec"};
  static const std::array<const char*, 12> german{"jan", "feb", "mrz", "apr", "mai", "jun",
                                                  "jul", "aug", "sep", "okt", "nov", "dez"};
  if (word.size() < 3) return 0;
  const std::string first = word.substr(0, 3);
  for (int month = 0; month < 12; ++month) {
    if (first == english[static_cast<std::size_t>(month)] || first == german[static_cast<std::size_t>(month)]) {
      return month + 1;
    }
  }
  return 0;
}

bool is_weekday(const std::string& word) {
  static const std::array<const char*, 7> days{"mon", "tue", "wed", "thu", "fri", "sat", "sun"};
  return word.size() >= 3 && std::any_of(days.begin(), days.end(), [&](const char* d) { return word.starts_with(d); });
}

int full_year(int year, std::size_t digits) {
  if (digits > 2) return year;
  return year < 70 ? 2000 + year : 1900 + year;  // as POSIX reads %y
}

/// After the seconds: a fraction of any length in ns.
std::int64_t fraction_ns(Scanner& scan) {
  std::int64_t value = 0;
  std::int64_t unit = second_ns / 10;
  while (!scan.rest.empty() && scan.rest.front() >= '0' && scan.rest.front() <= '9') {
    value += unit * (scan.rest.front() - '0');
    unit /= 10;
    scan.rest.remove_prefix(1);
  }
  return value;
}

bool starts_with_digit(std::string_view text) {
  return !text.empty() && text.front() >= '0' && text.front() <= '9';
}

/// "am", "p.m." and the like; 0 for none, 1 before and 2 after noon.
int half_of_day(Scanner& scan) {
  scan.blanks();
  for (const auto& [word, half] : std::array<std::pair<std::string_view, int>, 8>{
           {{"AM", 1}, {"am", 1}, {"a.m.", 1}, {"A.M.", 1}, {"PM", 2}, {"pm", 2}, {"p.m.", 2}, {"P.M.", 2}}}) {
    if (scan.take(word)) return half;
  }
  return 0;
}

bool take_time(Scanner& scan, ClockText& out) {
  const int before = half_of_day(scan);  // Chinese writes it first
  scan.blanks();
  auto hour = scan.number(4);
  if (!hour || !scan.take(':')) return false;
  std::size_t digits = 0;
  const auto minute = scan.number(2, &digits);
  if (!minute || *minute > 59) return false;
  int second = 0;
  std::int64_t fraction = 0;
  if (scan.take(':') && starts_with_digit(scan.rest)) {
    second = *scan.number(2);
    if (second > 60) return false;
    Scanner after = scan;
    if ((after.take('.') || after.take(',') || after.take(':')) && starts_with_digit(after.rest)) {
      scan = after;
      fraction = fraction_ns(scan);
      out.whole_seconds = false;
    }
  }
  const int after = half_of_day(scan);
  const int half = before != 0 ? before : after;
  if (half != 0) {
    if (*hour < 1 || *hour > 12) return false;
    hour = *hour % 12 + (half == 2 ? 12 : 0);
  }
  out.has_time = true;
  out.of_day_ns = (std::int64_t{*hour} * 3600 + *minute * 60 + second) * second_ns + fraction;
  return true;
}

bool take_zone(Scanner& scan, ClockText& out) {
  scan.blanks();
  if (scan.take('Z') || scan.take('z')) {
    out.zone_minutes = 0;
    return true;
  }
  const bool named = scan.take("UTC") || scan.take("GMT");
  if (named) out.zone_minutes = 0;
  if (scan.rest.empty() || (scan.rest.front() != '+' && scan.rest.front() != '-')) return named;
  const int sign = scan.rest.front() == '-' ? -1 : 1;
  scan.rest.remove_prefix(1);
  std::size_t digits = 0;
  const auto hours = scan.number(2, &digits);
  if (!hours || *hours > 14) return false;
  scan.take(':');
  const auto minutes = scan.number(2);
  out.zone_minutes = sign * (*hours * 60 + minutes.value_or(0));
  return true;
}

/// Three numbers with the same sign between them, or with the month as a word.
bool take_date(Scanner& scan, ClockText& out) {
  std::array<std::size_t, 3> digits{};
  std::string word = Scanner{scan.rest}.letters();
  if (is_weekday(word)) {
    scan.letters();
    scan.take(',');
    scan.blanks();
    word = Scanner{scan.rest}.letters();
  }
  if (const int month = month_from(word); month != 0) {  // Nov 3, 2025
    scan.letters();
    scan.take('.');
    scan.blanks();
    const auto day = scan.number(2);
    if (!day) return false;
    scan.take(',');
    scan.blanks();
    const auto year = scan.number(4, &digits[2]);
    if (!year || digits[2] != 4) return false;
    out.date = {*year, month, *day};
    out.orders = {DateOrder::year_month_day};
    return true;
  }
  const auto first = scan.number(8, &digits[0]);
  if (!first) return false;
  if (digits[0] == 8) {  // 20251103T071240 is read; eight digits alone are a number
    if (!scan.rest.starts_with('T')) return false;
    out.date = {*first / 10000, *first / 100 % 100, *first % 100};
    out.orders = {DateOrder::year_month_day};
    return true;
  }
  if (digits[0] == 3 || digits[0] > 4) return false;
  const char sign = scan.rest.empty() ? '\0' : scan.rest.front();
  if (sign != '-' && sign != '/' && sign != '.' && sign != ' ') return false;
  scan.rest.remove_prefix(1);
  scan.blanks();
  if (const int month = month_from(Scanner{scan.rest}.letters()); month != 0) {  // 3-Nov-2025, 3. Nov 2025
    scan.letters();
    scan.take('.');
    if (!scan.take(sign)) scan.blanks();
    scan.take('-');
    const auto year = scan.number(4, &digits[2]);
    if (!year || (digits[2] != 4 && digits[2] != 2) || digits[0] > 2) return false;
    out.date = {full_year(*year, digits[2]), month, *first};
    out.orders = {DateOrder::year_month_day};
    return true;
  }
  if (sign == ' ') return false;
  const auto second = scan.number(4, &digits[1]);
  if (!second || digits[1] > 2 || !scan.take(sign)) return false;
  scan.blanks();
  const auto third = scan.number(4, &digits[2]);
  if (!third || digits[2] == 3) return false;
  out.date = {*first, *second, *third};
  if (digits[0] == 4) {
    if (digits[2] > 2) return false;
    out.orders = {DateOrder::year_month_day};
  } else if (sign == '.') {
    out.orders = {DateOrder::day_month_year};
  } else if (digits[2] == 4) {
    out.orders = {DateOrder::day_month_year, DateOrder::month_day_year};
  } else {
    out.orders = {DateOrder::year_month_day, DateOrder::day_month_year, DateOrder::month_day_year};
  }
  return true;
}

/// 20251103T071240: hours, minutes and seconds without signs between.
bool take_compact_time(Scanner& scan, ClockText& out) {
  std::size_t digits = 0;
  const auto number = scan.number(6, &digits);
  if (!number || digits != 6) return false;
  const std::int64_t hour = *number / 10000;
  const std::int64_t minute = *number / 100 % 100;
  const std::int64_t second = *number % 100;
  if (hour > 23 || minute > 59 || second > 60) return false;
  out.has_time = true;
  out.of_day_ns = (hour * 3600 + minute * 60 + second) * second_ns;
  if (scan.take('.') || scan.take(',')) {
    out.of_day_ns += fraction_ns(scan);
    out.whole_seconds = false;
  }
  return true;
}

}  // namespace

std::optional<ClockText> read_clock_text(std::string_view text) {
  if (text.size() < 4 || text.size() > longest_text) return std::nullopt;
  const std::string plain = with_plain_marks(text);
  ClockText out;
  Scanner scan{plain};
  scan.blanks();
  Scanner attempt = scan;
  if (take_date(attempt, out)) {
    scan = attempt;
    const bool letter = scan.take('T');
    if (!letter) {
      scan.take(',');
      scan.blanks();
    }
    Scanner time = scan;
    if (take_time(time, out) || (letter && take_compact_time(time = scan, out))) scan = time;
  } else {
    out = {};
    if (!take_time(scan, out)) return std::nullopt;
  }
  if (out.has_time) {
    Scanner zone = scan;
    if (take_zone(zone, out)) scan = zone;
    if (out.has_date() && out.of_day_ns > 86400 * second_ns) return std::nullopt;
  }
  scan.blanks();
  if (!scan.rest.empty()) return std::nullopt;
  return out;
}

std::optional<ClockText> read_clock_text(std::string_view text, std::string_view pattern) {
  ClockText out;
  Scanner scan{text};
  std::optional<int> year, month, day, hour, half;
  std::int64_t rest_ns = 0;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    if (pattern[i] == ' ') {
      scan.blanks();
      continue;
    }
    if (pattern[i] != '%' || i + 1 == pattern.size()) {
      if (!scan.take(pattern[i])) return std::nullopt;
      continue;
    }
    std::optional<int> number = 0;
    switch (pattern[++i]) {
      case 'Y':
        number = year = scan.number(4);
        break;
      case 'y':
        number = scan.number(2);
        if (number) year = full_year(*number, 2);
        break;
      case 'm':
        number = month = scan.number(2);
        break;
      case 'd':
      case 'e':
        scan.blanks();
        number = day = scan.number(2);
        break;
      case 'b':
      case 'B':
        number = month = month_from(scan.letters());
        break;
      case 'H':
      case 'I':
        number = hour = scan.number(2);
        break;
      case 'M':
        number = scan.number(2);
        rest_ns += number.value_or(0) * 60 * second_ns;
        break;
      case 'S': {
        number = scan.number(2);
        rest_ns += number.value_or(0) * second_ns;
        Scanner after = scan;
        const bool in_pattern =
            i + 1 < pattern.size() && std::string_view(".,:").find(pattern[i + 1]) != std::string_view::npos;
        if (!in_pattern && (after.take('.') || after.take(',')) && starts_with_digit(after.rest)) {
          scan = after;
          rest_ns += fraction_ns(scan);
          out.whole_seconds = false;
        }
        break;
      }
      case 'f':
        if (!starts_with_digit(scan.rest)) return std::nullopt;
        rest_ns += fraction_ns(scan);
        out.whole_seconds = false;
        break;
      case 'p':
        half = half_of_day(scan);
        number = *half != 0 ? half : std::nullopt;
        break;
      case 'z':
        if (!take_zone(scan, out)) return std::nullopt;
        break;
      case 's':
        return std::nullopt;  // epoch seconds have a unit of their own in the map
      case '%':
        if (!scan.take('%')) return std::nullopt;
        break;
      default:
        return std::nullopt;
    }
    if (!number) return std::nullopt;
  }
  scan.blanks();
  if (!scan.rest.empty()) return std::nullopt;
  if (year || month || day) {
    if (!year || !month || !day) return std::nullopt;
    out.date = {*year, *month, *day};
    out.orders = {DateOrder::year_month_day};
  }
  if (hour) {
    out.has_time = true;
    if (half) hour = *hour % 12 + (*half == 2 ? 12 : 0);
    out.of_day_ns = std::int64_t{*hour} * 3600 * second_ns + rest_ns;
  }
  if (!out.has_date() && !out.has_time) return std::nullopt;
  return out;
}

std::optional<std::chrono::sys_days> day_of(const ClockText& clock, DateOrder order) {
  auto [year, month, day] = clock.date;
  if (order == DateOrder::day_month_year) std::swap(year, day);
  if (order == DateOrder::month_day_year) {
    month = clock.date[0];
    day = clock.date[1];
    year = clock.date[2];
  }
  if (year < 100) year = full_year(year, 2);
  if (year < 1900 || year > 2200 || month < 1 || month > 12 || day < 1 || day > 31) return std::nullopt;
  const std::chrono::year_month_day date{std::chrono::year{year}, std::chrono::month{static_cast<unsigned>(month)},
                                         std::chrono::day{static_cast<unsigned>(day)}};
  if (!date.ok()) return std::nullopt;
  return std::chrono::sys_days{date};
}

}  // namespace zerodrift::recording
