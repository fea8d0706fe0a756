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

}  // namespace zerodrift
