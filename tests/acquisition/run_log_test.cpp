#include "core/acquisition/run_log.h"

#include <gtest/gtest.h>

#include <future>

#include "memory_sink.h"

namespace zerodrift::acquisition {
namespace {

constexpr std::array<double, 2> pair_of_values = {1.0, 2.0};

/// Refuses one row for good, or throws.
class BrokenSink : public MemorySink {
 public:
  Status append(double time_s, std::span<const double> row) override {
    if (throws) throw std::runtime_error("broken");
    if (time_s == refused_s) return fail(ErrorCode::bad_argument);
    return MemorySink::append(time_s, row);
  }
  double refused_s = -1.0;
  bool throws = false;
};

TEST(RunLog, CommitsByItselfWithinThePeriod) {
  MemorySink sink;
  RunLog log(sink, 0.05);
  ASSERT_TRUE(log.append(0.0, pair_of_values));
  for (int i = 0; i < 1000 && log.committed_rows() == 0; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(log.committed_rows(), 1);
}

TEST(RunLog, NobodyWaitsForASlowSinkLongerThanThereIsTime) {
  MemorySink sink;
  std::promise<void> let_go;
  sink.in_flush = [answer = let_go.get_future().share()] { answer.wait(); };
  RunLog log(sink, 0.01);
  // The sink answers none of these: whoever waited for it would wait for good.
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(log.append(double(i), pair_of_values));
    log.commit_before_waiting(0.01);
  }
  EXPECT_EQ(log.rows(), 20);
  EXPECT_EQ(log.committed_rows(), 0) << "nothing is acknowledged before it is there";
  let_go.set_value();
  log.commit();
  EXPECT_EQ(log.committed_rows(), 20);
  EXPECT_EQ(sink.times.size(), 20U);
}

TEST(RunLog, AFullDiskIsTriedAgainAndKeepsTheOrder) {
  MemorySink sink;
  sink.full = true;
  RunLog log(sink, 0.01);
  ASSERT_TRUE(log.append(1.0, pair_of_values));
  log.event({1.0, "note", "first", "{}"});
  log.commit();
  ASSERT_TRUE(log.failure());
  EXPECT_EQ(log.failure()->code, ErrorCode::disk_full);
  ASSERT_TRUE(log.append(2.0, pair_of_values));
  log.event({2.0, "note", "second", "{}"});
  log.commit();
  EXPECT_EQ(log.committed_rows(), 0);
  sink.full = false;
  log.commit();
  EXPECT_FALSE(log.failure());
  EXPECT_EQ(log.committed_rows(), 2);
  EXPECT_EQ(sink.times, (std::vector<double>{1.0, 2.0}));
  ASSERT_EQ(sink.events.size(), 2U);
  EXPECT_EQ(sink.events.back().text, "second");
}

TEST(RunLog, WhatIsLeftIsCommittedWhenItGoes) {
  MemorySink sink;
  {
    RunLog log(sink, 3600.0);
    ASSERT_TRUE(log.append(1.0, pair_of_values));
  }
  EXPECT_EQ(sink.committed, 1U);
}

TEST(RunLog, ManyRowsWaitForTheSinkInsteadOfTakingAllMemory) {
  MemorySink sink;
  sink.flush_takes = std::chrono::milliseconds(20);
  RunLog log(sink, 3600.0);
  for (int i = 0; i < 25000; ++i) ASSERT_TRUE(log.append(double(i), pair_of_values));
  EXPECT_GE(log.committed_rows(), 10000);
  log.commit();
  EXPECT_EQ(log.committed_rows(), 25000);
}

TEST(RunLog, ARowThatTheSinkRefusesEndsTheRun) {
  BrokenSink sink;
  sink.refused_s = 2.0;
  RunLog log(sink, 3600.0);
  for (const double time_s : {1.0, 2.0, 3.0}) ASSERT_TRUE(log.append(time_s, pair_of_values));
  log.commit();
  EXPECT_EQ(log.committed_rows(), 0);
  const auto next = log.append(4.0, pair_of_values);
  ASSERT_FALSE(next);
  EXPECT_EQ(next.error().code, ErrorCode::bad_argument);
}

TEST(RunLog, AnExceptionOfTheSinkGoesOnInTheCallersThread) {
  BrokenSink sink;
  sink.throws = true;
  RunLog log(sink, 3600.0);
  ASSERT_TRUE(log.append(1.0, pair_of_values));
  EXPECT_THROW(log.commit(), std::runtime_error);
}

}  // namespace
}  // namespace zerodrift::acquisition
