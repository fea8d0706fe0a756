// kill -9 at random moments: what was acknowledged is in the job, the job opens, the run goes on.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <random>
#include <string>
#include <thread>

#include "core/acquisition/job_sink.h"
#include "core/recording/recording.h"
#include "tests/support/amount.h"

namespace zerodrift::acquisition {
namespace {

/// Runs the victim for so long, kills it, and returns the last number of rows it had acknowledged; -1 if none.
/// Without a life it is killed at its first line; `started` is told how long that took.
std::int64_t run_and_kill(const std::filesystem::path& job, std::optional<std::chrono::milliseconds> life,
                          std::chrono::milliseconds* started = nullptr) {
  int ends[2];
  EXPECT_EQ(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    dup2(ends[1], STDOUT_FILENO);
    close(ends[0]);
    close(ends[1]);
    execl(ZERODRIFT_BIN_DIR "/recording_victim", "recording_victim", job.c_str(), nullptr);
    _exit(127);
  }
  close(ends[1]);
  const auto begin = std::chrono::steady_clock::now();
  std::thread killer([&] {
    if (!life) return;
    std::this_thread::sleep_for(*life);
    kill(child, SIGKILL);
  });
  std::string text;
  char buffer[4096];
  for (ssize_t size = 0; (size = read(ends[0], buffer, sizeof buffer)) > 0;) {
    text.append(buffer, static_cast<std::size_t>(size));
    if (life) continue;
    *started = std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() - begin);
    kill(child, SIGKILL);
    break;
  }
  killer.join();
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status)) << "the victim ended by itself";
  text.resize(text.rfind('\n') + 1);  // whole lines
  if (text.empty()) return -1;
  const auto line = text.rfind('\n', text.size() - 2);
  return std::atoll(text.c_str() + (line == std::string::npos ? 0 : line + 1));
}

TEST(Kill, AgainAndAgainLosesNothingAcknowledged) {
  std::string pattern = (std::filesystem::temp_directory_path() / "zerodrift-kill-XXXXXX").string();
  const std::filesystem::path folder = mkdtemp(pattern.data());
  const auto file = folder / "a.zdj";
  std::mt19937 random(20);
  std::int64_t acknowledged = 0;
  const int kills = amount(20, 200);
  // From before its first row to half a second after it, however long this computer takes to start a program.
  std::chrono::milliseconds start{0};
  run_and_kill(folder / "first.zdj", std::nullopt, &start);
  for (int round = 0; round < kills; ++round) {
    const std::int64_t said =
        run_and_kill(file, start / 2 + std::chrono::milliseconds(random() % 600) + start * (random() % 100) / 100);
    acknowledged = std::max(acknowledged, said);
    if (!std::filesystem::exists(file)) continue;  // killed before it had made the file
    auto job = commissioning::Job::open(file);
    ASSERT_TRUE(job) << describe(job.error());
    const auto report = job->check();
    ASSERT_TRUE(report);
    EXPECT_TRUE(report->ok()) << describe(report->problems.front());
    const auto series = job->series();
    ASSERT_TRUE(series);
    ASSERT_LE(series->size(), 1u) << "an interrupted run is resumed, not begun anew";
    if (series->empty()) continue;
    ASSERT_GE(series->front().rows, acknowledged) << "round " << round;
    const auto recording = job->read_series(series->front().id);
    ASSERT_TRUE(recording) << describe(recording.error());
    EXPECT_EQ(std::int64_t(recording->rows()), series->front().rows);
    for (std::size_t i = 1; i < recording->rows(); ++i) ASSERT_GT(recording->time_s[i], recording->time_s[i - 1]);
  }
  EXPECT_GT(acknowledged, 50);
  auto job = commissioning::Job::open(file);
  ASSERT_TRUE(job);
  const auto interrupted = interrupted_run(*job);
  ASSERT_TRUE(interrupted);
  EXPECT_TRUE(interrupted->has_value());
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace zerodrift::acquisition
