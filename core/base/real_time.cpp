#include "core/base/real_time.h"

#include <pthread.h>
#include <sched.h>

namespace zerodrift {

bool ask_for_real_time() {
  sched_param lowest{};
  int policy = SCHED_OTHER;
  if (pthread_getschedparam(pthread_self(), &policy, &lowest) == 0 && (policy == SCHED_FIFO || policy == SCHED_RR))
    return true;  // a service
  lowest.sched_priority = sched_get_priority_min(SCHED_FIFO);
  return pthread_setschedparam(pthread_self(), SCHED_FIFO, &lowest) == 0;
}

RealTimeTurns::RealTimeTurns(bool wanted) {
  if (!wanted || sched_getscheduler(0) != SCHED_OTHER) return;
  sched_param lowest{};
  lowest.sched_priority = sched_get_priority_min(SCHED_FIFO);
  m_granted = sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &lowest) == 0;
}

RealTimeTurns::~RealTimeTurns() {
  const sched_param ordinary{};
  if (m_granted) sched_setscheduler(0, SCHED_OTHER, &ordinary);
}

}  // namespace zerodrift
