#include "core/base/file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "core/base/clock.h"

namespace zerodrift {

TEST(File, WritesWholeAndReadsBack) {
  const auto folder = std::filesystem::path(testing::TempDir()) / ("zd_file_test_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  ASSERT_TRUE(write_file(folder / "a.txt", "hello").has_value());
  EXPECT_EQ(read_file(folder / "a.txt").value(), "hello");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);  // no temporary left
  std::filesystem::remove_all(folder);
}

TEST(File, FailuresAreNamed) {
  EXPECT_EQ(read_file("/nonexistent/a").error().code, ErrorCode::file_not_found);
  EXPECT_EQ(read_file("/").error().code, ErrorCode::file_unreadable);
  EXPECT_EQ(write_file("/nonexistent/a", "x").error().code, ErrorCode::file_not_writable);
  EXPECT_EQ(write_file("/nonexistent/a", "x").error().context.at("detail"), "there is no folder /nonexistent");
  EXPECT_EQ(write_file("/dev/null/a", "x").error().context.at("detail"), "/dev/null is no folder");
  EXPECT_EQ(write_file("/dev/full", "x").error().code, ErrorCode::disk_full);
}

TEST(File, APipeIsReadToItsEnd) {
  const auto pipe = std::filesystem::path(testing::TempDir()) / ("zd_pipe_" + std::to_string(::getpid()));
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const std::string text(200'000, 'x');  // more than a pipe holds
  std::thread writer([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(120));  // the reader is there first
    EXPECT_TRUE(write_file(pipe, text));
  });
  const auto read = read_file(pipe);
  writer.join();
  std::filesystem::remove(pipe);
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, text);
}

TEST(Clock, ManualClockNeverSleeps) {
  ManualClock clock;
  std::stop_source stop;
  EXPECT_TRUE(clock.wait_for(Seconds(3600), stop.get_token()));
  EXPECT_EQ(clock.steady().count(), 3600.0);
  stop.request_stop();
  EXPECT_FALSE(clock.wait_for(Seconds(1), stop.get_token()));
}

}  // namespace zerodrift
