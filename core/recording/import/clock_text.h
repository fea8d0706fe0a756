#pragma once
// Date and time of day as loggers write them: ISO 8601 with zone, 03.11.2025, 11/03/2025, 3-Nov-2025, 2025年11月3日,
// AM and PM, fractions of seconds. What the three numbers of a date mean is decided for a column, not here.

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace zerodrift::recording {

/// Orders of day, month and year.
enum class DateOrder { year_month_day, day_month_year, month_day_year };

struct ClockText {
  std::array<int, 3> date{};      // as they are written; three zeros: no date
  std::vector<DateOrder> orders;  // those that the form allows; empty: no date
  bool has_time = false;
  std::int64_t of_day_ns = 0;       // above 24 h in a duration
  bool whole_seconds = true;        // no fraction is written
  std::optional<int> zone_minutes;  // east of Greenwich

  bool has_date() const { return !orders.empty(); }
};

/// Nothing where the text is neither date nor time.
std::optional<ClockText> read_clock_text(std::string_view text);
/// The same by a pattern of strptime (%d %m %Y %y %b %H %I %M %S %f %p %z %s); nothing where the text does not follow
/// it.
std::optional<ClockText> read_clock_text(std::string_view text, std::string_view pattern);
/// Days since 1970-01-01, or nothing where there is no such day.
std::optional<std::chrono::sys_days> day_of(const ClockText& clock, DateOrder order);

}  // namespace zerodrift::recording
