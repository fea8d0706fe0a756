#pragma once
// Words that stand in cells instead of numbers: what loggers and spreadsheets write for a sample that is missing, and
// for a switch that is on or off. Compared without case.

#include <optional>
#include <string_view>

namespace zerodrift::recording {

/// Empty, NaN, OL, ---, +++++, #N/A, 1.#QNAN, BURNOUT, UNAVAILABLE, NULL, 9.9E+37 and the like.
bool means_missing(std::string_view cell);
/// ON, TRUE, yes, ein, 开: 1. OFF, FALSE, no, aus, 关: 0.
std::optional<double> switch_value(std::string_view cell);
bool is_empty(std::string_view cell);

}  // namespace zerodrift::recording
