#include "app/machine/motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace zerodrift::machine {
namespace {

constexpr double rapid_mm_s = 20000.0 / 60.0;
constexpr double rapid_deg_s = 180.0;
constexpr Axes cycle_reach_mm{60.0, 50.0, 40.0};
constexpr Axes cycle_feed_mm_s{40.0, 27.0, 20.0};
constexpr double swivel_reach_deg = 30.0;
constexpr double swivel_deg_s = 10.0;
constexpr double table_deg_s = 36.0;
constexpr double feed_window_s = 10.0;

struct PitchError {
  double um_per_m;
  double wave_um;  // over the length of the screw
  double wave_length_mm;
  double reversal_um;  // far from the measuring position, between the two directions
};
constexpr std::array<PitchError, linear_axes> pitch_errors{
    {{11.0, 1.6, 240.0, 3.0}, {-9.0, 1.2, 200.0, 2.4}, {13.0, 1.0, 160.0, 2.0}}};

}  // namespace

double geometric_error_um(int axis, double position_mm, bool upwards) {
  const PitchError& error = pitch_errors[axis];
  const double steady = error.um_per_m * position_mm / 1000.0 +
                        error.wave_um * std::sin(2.0 * std::numbers::pi * position_mm / error.wave_length_mm);
  const double reversal = error.reversal_um / 2.0 * (1.0 - std::exp(-std::abs(position_mm) / 40.0));
  return steady + (upwards ? -reversal : reversal);
}

void Motion::start_cycle() {
  m_moving = false;
  m_cycling = true;
}

void Motion::stop() {
  m_moving = false;
  m_cycling = false;
}

void Motion::move_to(const Axes& target_mm) {
  m_target_mm = target_mm;
  m_cycling = false;
  m_moving = true;
}

void Motion::go(int axis, double to_mm) {
  const double way = to_mm - m_position_mm[axis];
  if (way != 0.0) m_upwards[axis] = way > 0.0;
  m_way_mm[axis] += std::abs(way);
  m_position_mm[axis] = to_mm;
}

void Motion::advance(double duration_s) {
  if (m_cycling) advance_cycle(duration_s);
  if (m_moving) advance_move(duration_s);
  m_time_s += duration_s;
  m_marks.push_back({m_time_s, m_way_mm});
  while (m_marks.size() > 1 && m_marks[1].time_s <= m_time_s - feed_window_s) m_marks.pop_front();
}

void Motion::advance_cycle(double duration_s) {
  for (int axis = 0; axis < linear_axes; ++axis) {
    double& sense = m_cycle_sense[axis];
    if (std::abs(m_position_mm[axis]) >= cycle_reach_mm[axis]) sense = m_position_mm[axis] > 0 ? -1.0 : 1.0;
    double left_mm = cycle_feed_mm_s[axis] * duration_s;
    const double border = sense * cycle_reach_mm[axis];
    const double to_border = std::abs(border - m_position_mm[axis]);
    if (left_mm > to_border) {
      go(axis, border);
      left_mm -= to_border;
      sense = -sense;
    }
    go(axis, m_position_mm[axis] + sense * left_mm);
  }
  double& swivel = m_rotation_deg[0];
  swivel += m_swivel_sense * swivel_deg_s * duration_s;
  if (std::abs(swivel) >= swivel_reach_deg) m_swivel_sense = swivel > 0 ? -1.0 : 1.0;
  m_rotation_deg[1] = std::fmod(m_rotation_deg[1] + table_deg_s * duration_s, 360.0);
}

void Motion::advance_move(double duration_s) {
  bool there = true;
  for (int axis = 0; axis < linear_axes; ++axis) {
    const double left = m_target_mm[axis] - m_position_mm[axis];
    const double reach = rapid_mm_s * duration_s;
    if (std::abs(left) > reach) there = false;
    go(axis, std::abs(left) > reach ? m_position_mm[axis] + std::copysign(reach, left) : m_target_mm[axis]);
  }
  for (double& rotation : m_rotation_deg) {
    const double home = rotation > 180.0 ? 360.0 : 0.0;
    const double reach = rapid_deg_s * duration_s;
    if (std::abs(home - rotation) > reach) {
      rotation += std::copysign(reach, home - rotation);
      there = false;
    } else {
      rotation = 0.0;
    }
  }
  m_moving = !there;
}

double Motion::mean_feed_mm_min(int axis) const {
  if (m_marks.size() < 2) return 0.0;
  const double seconds = m_time_s - m_marks.front().time_s;
  return seconds > 0.0 ? (m_way_mm[axis] - m_marks.front().way_mm[axis]) / std::max(seconds, feed_window_s) * 60.0
                       : 0.0;
}

}  // namespace zerodrift::machine
