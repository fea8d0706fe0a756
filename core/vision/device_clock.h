#pragma once
// Relates the clock of a camera to the host's. A picture arrives after its stamp by a delay that is never below the
// least one, and jitters upwards: host = offset + rate * device + delay. The line is the one below all arrivals of the
// last minute whose delays have the least sum: the edge of their lower convex hull under the mean device time
// (Moon, Skelly, Towsley, "Estimation and removal of clock skew from network delay measurements", INFOCOM 1999). A
// stamp is thus the time at which the picture would have arrived at the earliest: jitter of the network and of a busy
// computer is taken out; the least delay stays in the camera's latency, as of a camera without stamps. A crystal is
// within 500 ppm; over a short span the rate is held there.

#include <deque>

#include "core/base/clock.h"

namespace zerodrift::vision {

class DeviceClock {
 public:
  /// The stamp on the host's clock of the picture that the device stamped `device` and that arrived at `arrived`. Never
  /// after its arrival. A device clock that runs backwards or leaps was set anew: the relation begins again.
  Seconds to_host(Seconds device, Seconds arrived);

 private:
  struct Arrival {
    double device_s, host_s;
  };
  std::deque<Arrival> m_hull;  // lower convex hull of the arrivals, ascending device time
  std::deque<double> m_times;  // device times of the span, for their mean
  double m_sum_s = 0.0;
  double m_first_s = 0.0;  // device time that others count from, so that sums stay exact
};

}  // namespace zerodrift::vision
