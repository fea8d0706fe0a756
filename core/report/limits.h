#pragma once
// What a figure may be before it is doubtful. Pages and report judge by the same numbers.

namespace zerodrift::report::limits {

// The machine at rest
inline constexpr double spread_K = 1.0;  // warmest sensor minus coldest
inline constexpr double round_trip_ms = 100.0;
inline constexpr double clock_difference_s = 2.0;
// The camera
inline constexpr double calibration_rms_um = 2.0;
inline constexpr double calibration_uncertainty_um = 0.5;  // added to an error of 100 um
// The run. Temperatures of a machine change over minutes: a shorter hole is bridged without harm, a hole as long as the
// time constant of a spindle's front bearing (some ten minutes) may hide a part of the course.
inline constexpr double harmless_hole_s = 120.0;
inline constexpr double worst_hole_s = 600.0;
// The sensors
inline constexpr double unseen_error_um = 5.0;
inline constexpr double lost_against_all_percent = 10.0;
inline constexpr double lost_against_all_um = 0.2;  // less is no reason for another cable, whatever its share
// Belsley, Kuh, Welsch (1980): from 30 on coefficients disturb one another.
inline constexpr double condition_number = 30.0;
// The model
inline constexpr double attainable_peak_um = 5.0;
inline constexpr double removed_percent = 85.0;
inline constexpr double coverage_percent = 85.0;
// The verification: single measurements with their noise may be so many times what the fit left of means.
inline constexpr double promise_reach = 1.25;

}  // namespace zerodrift::report::limits
