#include "core/base/time_text.h"

#include <fmt/format.h>

#include <cstdio>

namespace zerodrift {

std::string to_text(UtcTime time) {
  using namespace std::chrono;
  const auto day = floor<days>(time);
  const year_month_day date(day);
  const hh_mm_ss clock(time - day);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z", int(date.year()), unsigned(date.month()),
                     unsigned(date.day()), clock.hours().count(), clock.minutes().count(), clock.seconds().count(),
                     clock.subseconds().count());
}

Result<UtcTime> utc_from_text(const std::string& text) {
  using namespace std::chrono;
  int y = 0;
  unsigned mo = 0, d = 0;
  int h = 0, mi = 0, s = 0, ms = 0;
  const int read = std::sscanf(text.c_str(), "%d-%u-%uT%d:%d:%d.%dZ", &y, &mo, &d, &h, &mi, &s, &ms);
  const year_month_day date{year{y}, month{mo}, day{d}};
  if (read < 6 || !date.ok()) {
    return fail(ErrorCode::bad_argument, {{"what", "time stamp"}, {"found", text}, {"expected", "ISO 8601 UTC"}});
  }
  return UtcTime{sys_days{date}} + hours{h} + minutes{mi} + seconds{s} + milliseconds{ms};
}

}  // namespace zerodrift
