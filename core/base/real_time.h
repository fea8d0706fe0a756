#pragma once
// A thread whose turns must begin on time beside other work.

namespace zerodrift {

/// Asks that the calling thread go before ordinary ones (SCHED_FIFO at its lowest priority, sched(7)); false when the
/// system does not permit it to this user: root, CAP_SYS_NICE or a limit of rtprio is needed. The thread must wait most
/// of the time: one that computes on and on would keep the processor from all others.
bool ask_for_real_time();

/// The same for as long as this lives, and not for threads that are started meanwhile; `wanted` false does nothing.
class RealTimeTurns {
 public:
  explicit RealTimeTurns(bool wanted);
  ~RealTimeTurns();
  RealTimeTurns(const RealTimeTurns&) = delete;
  RealTimeTurns& operator=(const RealTimeTurns&) = delete;

 private:
  bool m_granted = false;
};

}  // namespace zerodrift
