#include "core/base/real_time.h"

#include <gtest/gtest.h>
#include <sched.h>

#include <thread>

namespace zerodrift {
namespace {

int policy() {
  return sched_getscheduler(0) & ~SCHED_RESET_ON_FORK;
}

}  // namespace

TEST(RealTime, TurnsAreAskedForAWhileAndNotForThreadsStartedMeanwhile) {
  const int before = policy();
  {
    const RealTimeTurns turns(false);
    EXPECT_EQ(policy(), before);
  }
  {
    const RealTimeTurns turns(true);
    EXPECT_TRUE(policy() == SCHED_FIFO || policy() == before);  // as the system permits
    int inside = -1;
    std::thread([&] { inside = policy(); }).join();
    EXPECT_EQ(inside, before);
  }
  EXPECT_EQ(policy(), before);
}

}  // namespace zerodrift
