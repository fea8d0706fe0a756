#pragma once
// What heat can make of an error since it was last measured. A leap beyond that is a picture of another moment, a
// target that slipped in its bracket, a machine that is not where it says: it is refused, until measurements from
// several approaches agree that it stays.

#include <array>
#include <optional>
#include <string>

#include "core/acquisition/error_source.h"
#include "core/base/result.h"

namespace zerodrift::acquisition {

struct DriftRule {
  double um_per_min = 20.0;  // of machine time, in any direction
  double least_um = 3.0;     // between two measurements however close
};

struct Leap {
  std::string axis;        // that leapt furthest beyond its limit
  double change_um = 0.0;  // since the last good measurement
  double limit_um = 0.0;   // what heat can make in that time
  bool confirmed = false;  // it has been found again often enough: it counts from now on
};

class DriftLimit {
 public:
  explicit DriftLimit(DriftRule rule = {}) : m_rule(rule) {}
  /// What is known to be good, X Y Z; NaN where nothing is.
  void know(double time_s, const std::array<double, 3>& error_um, const std::array<double, 3>& sigma_um);
  /// Nothing when the measurement is one that heat can have made; it is the last good one then.
  std::optional<Leap> judge(double time_s, const std::array<double, 3>& error_um,
                            const std::array<double, 3>& sigma_um);

 private:
  struct Point {
    double time_s = 0.0;
    double error_um = 0.0;
    double sigma_um = 0.0;
  };
  using Points = std::array<std::optional<Point>, 3>;
  /// The axis that leapt furthest; nothing when none did.
  std::optional<Leap> leap_from(const Points& from, double time_s, const std::array<double, 3>& error_um,
                                const std::array<double, 3>& sigma_um) const;
  static void put(Points& points, double time_s, const std::array<double, 3>& error_um,
                  const std::array<double, 3>& sigma_um);

  DriftRule m_rule;
  Points m_good;
  Points m_leapt;   // the last one that was refused
  Leap m_first;     // as it was found first
  int m_found = 0;  // how often in a row what leapt was found where it leapt to
};

/// A measurement judged by what heat can have made of it, whatever the machine compensated meanwhile.
struct HeatJudgement {
  std::array<double, 3> by_heat_um{};  // the error less what was compensated
  std::optional<Error> refused;        // error_leapt: the sample holds nothing any more
  std::optional<Error> slipped;        // leap_confirmed: it holds what is there since the slip
};
HeatJudgement judge_by_heat(DriftLimit& limit, double time_s, const std::array<double, 3>& applied_um,
                            ErrorSample& measured);

}  // namespace zerodrift::acquisition
