#pragma once
// Five axes that take their time: rapid moves to a position, the fixed path of the warm-up cycle, and where they really
// stand: commanded position + geometric error. The geometric error is that of the screw's pitch, it depends on the
// direction of approach, and is zero at the measuring position.

#include <array>
#include <deque>

namespace zerodrift::machine {

inline constexpr int linear_axes = 3;
using Axes = std::array<double, linear_axes>;

inline constexpr Axes travel_mm{300.0, 250.0, 200.0};  // plus and minus

class Motion {
 public:
  void advance(double duration_s);
  void start_cycle();
  void stop();
  /// Ends the cycle and goes to the target at rapid; A and C turn back to 0.
  void move_to(const Axes& target_mm);

  bool cycling() const { return m_cycling; }
  bool moving() const { return m_moving; }
  const Axes& position_mm() const { return m_position_mm; }
  double rotation_deg(int axis) const { return m_rotation_deg[axis]; }  // 0 A, 1 C
  /// The axis came to where it is in the positive direction.
  bool upwards(int axis) const { return m_upwards[axis]; }
  /// Mean of the absolute feed over the last 10 s, mm/min.
  double mean_feed_mm_min(int axis) const;
  /// Way travelled since the start, mm.
  double way_mm(int axis) const { return m_way_mm[axis]; }

 private:
  void advance_cycle(double duration_s);
  void advance_move(double duration_s);
  void go(int axis, double to_mm);

  bool m_cycling = false;
  bool m_moving = false;
  Axes m_position_mm{};
  Axes m_target_mm{};
  std::array<double, 2> m_rotation_deg{};
  std::array<bool, linear_axes> m_upwards{true, true, true};
  std::array<double, linear_axes> m_cycle_sense{1, 1, 1};
  double m_swivel_sense = 1.0;
  Axes m_way_mm{};
  double m_time_s = 0.0;
  struct Mark {
    double time_s;
    Axes way_mm;
  };
  std::deque<Mark> m_marks;  // of the last 10 s
};

/// Actual - commanded of one axis at a position, um.
double geometric_error_um(int axis, double position_mm, bool upwards);

}  // namespace zerodrift::machine
