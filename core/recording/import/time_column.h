#pragma once
// The time of a recording out of its table: which column it is, what its cells mean, and the seconds since the first
// row.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/recording/import/header_map.h"
#include "core/recording/import/text_table.h"

namespace zerodrift::recording {

/// How the time was read.
struct TimeReading {
  std::vector<std::size_t> columns;  // of the table; date and time of day, or milliseconds beside, are two
  std::string rule;  // "elapsed", "epoch", "clock" (with date), "time-of-day", "interval" (no column; rows come evenly)
  std::string unit;  // of elapsed and epoch: s, ms, us, ns, min, h, d
  std::string order;  // of a date of three numbers: "year-month-day", "day-month-year", "month-day-year"
  std::string start;  // local time of the first row in ISO 8601, with its zone where that is known; empty: not known
  std::vector<double> time_s;     // of the rows that are kept, from 0 on unless the column is time_s itself
  std::vector<std::size_t> rows;  // those rows of the table
  std::vector<Error> warnings;
};

/// `labels` as the map may call the columns. time_missing, time_unit_unknown, time_ambiguous, time_unreadable and
/// csv_time_order name column and line.
Result<TimeReading> read_time(const SourceTable& table, const HeaderMap& map, const std::vector<std::string>& labels);

}  // namespace zerodrift::recording
