#pragma once
// The latency of a camera: the age that a picture has when it is stamped, by its device or on arrival. A move that is
// commanded shows it: no picture of before can be younger than the controller's word that the machine is at rest, none
// of after can be older than the command.

#include "core/base/clock.h"

namespace zerodrift::acquisition {

/// As long as nothing was measured a picture may be this old, s: of MJPEG, RTSP and USB cameras 0.1 to 2.5 s are known.
inline constexpr double assumed_latency_s = 3.0;

struct Latency {
  double mean_s = 0.5 * assumed_latency_s;
  double spread_s = 0.5 * assumed_latency_s;  // to either side: pictures that are older were not seen
  int observations = 0;                       // 0: assumed

  /// A picture stamped this long after the machine came to rest shows it at rest.
  Seconds settle() const { return Seconds(mean_s + spread_s); }
  static Latency none() { return {0.0, 0.0, 1}; }
};

/// Bounds that one move gives, s: `shortest` from the last picture of before, `longest` from the first of after.
struct LatencyBounds {
  double shortest_s = 0.0;
  double longest_s = 0.0;
};

/// Collects what moves show. Measured bounds replace an assumed latency after a few moves; a measured one is only ever
/// widened, by a picture that was certainly older.
class LatencyWatch {
 public:
  explicit LatencyWatch(Latency known = {}) : m_latency(known) {}
  /// True when the latency had to be widened: pictures were older than was known.
  bool add(const LatencyBounds& bounds);
  const Latency& now() const { return m_latency; }

 private:
  void learn(const LatencyBounds& bounds);

  Latency m_latency;
  int m_seen = 0;  // while it is assumed
  double m_sum_s = 0.0;
  double m_squares_s2 = 0.0;
  double m_longest_s = 0.0;
};

}  // namespace zerodrift::acquisition
