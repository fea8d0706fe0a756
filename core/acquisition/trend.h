#pragma once
// Where a run is heading: the slopes now, and whether the machine is steady.
// Steady by ISO 230-3 (spindle test): the change of the distortion during the last 60 minutes is less than 15 % of its
// largest change in the first hour. Counted from the last change of speed; a change below 1 um is steady in any case.

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace zerodrift::acquisition {

struct TrendNow {
  std::optional<double> slope_um_per_h;  // of the fastest direction, with its sign
  int slope_axis = 0;                    // 0 X, 1 Y, 2 Z
  std::optional<double> slope_K_per_h;   // of the fastest sensor
  int slope_sensor = 0;
  double largest_error_um = 0.0;  // of all directions so far, absolute
  int largest_axis = 0;
  bool steady = false;
  std::optional<double> change_last_hour_um;  // the largest of the directions
  std::optional<double> change_first_hour_um;
};

class Trend {
 public:
  /// Slopes are taken over the last 15 minutes, or five measurements if they come more slowly.
  explicit Trend(double measure_period_s);

  void conditions_changed(double time_s);
  void add_temperatures(double time_s, std::span<const double> temperature_C);
  void add_error(double time_s, const std::array<double, 3>& error_um);
  const TrendNow& now() const { return m_now; }

 private:
  struct ErrorPoint {
    double time_s;
    std::array<double, 3> error_um;
  };
  void update_errors();
  /// Largest minus smallest in [from, to], of the direction where it is largest; nothing without two points.
  std::optional<double> change_within(double from_s, double to_s) const;

  double m_window_s;
  double m_steady_from_s = 0.0;
  std::vector<ErrorPoint> m_errors;  // since the conditions changed, and at least a window
  std::vector<double> m_times_s;     // of the temperatures in the window
  std::vector<std::vector<double>> m_temperatures;
  TrendNow m_now;
};

}  // namespace zerodrift::acquisition
