#include "core/diagnosis/inference/settings.h"

#include <fmt/format.h>

namespace zerodrift::diagnosis {

Status DiagnosisSettings::check() const {
  const auto wrong = [](const char* what, double found, const char* expected) {
    return fail(ErrorCode::bad_argument,
                {{"what", what}, {"found", fmt::format("{:g}", found)}, {"expected", expected}});
  };
  if (most_rows < 100) return wrong("most_rows", static_cast<double>(most_rows), ">= 100");
  if (slow_times_s.empty() || slow_times_s.front() <= 0.0) return wrong("slow_times_s", 0.0, "> 0");
  if (slow_sizes.empty()) return wrong("slow_sizes", 0.0, ">= 1");
  if (repeatable_sizes.empty()) return wrong("repeatable_sizes", 0.0, ">= 1");
  for (std::size_t i = 1; i < slow_sizes.size(); ++i) {
    if (slow_sizes[i] <= slow_sizes[i - 1]) return wrong("slow_sizes", slow_sizes[i], "increasing");
  }
  const double shares = common_share + part_share + near_share;
  if (shares > 1.0 || common_share < 0.0 || part_share < 0.0 || near_share < 0.0)
    return wrong("shares", shares, "0..1");
  if (decisive <= 0.0 || margin <= decisive) return wrong("margin", margin, "> decisive");
  return {};
}

}  // namespace zerodrift::diagnosis
