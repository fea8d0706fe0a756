// The power goes, the disk is full, the stick is pulled, the program is killed: the job opens and what was acknowledged
// is in it.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <random>
#include <thread>

#include "core/commissioning/job.h"
#include "core/commissioning/schema.h"
#include "core/recording/recording.h"
#include "crash_disk.h"
#include "temporary_folder.h"
#include "tests/support/amount.h"

namespace zerodrift::commissioning {
namespace {

/// What had been acknowledged at a moment.
struct Promise {
  std::size_t moment = 0;
  std::int64_t rows = 0;
  int artefacts = 0;
  int audits = 0;
};

/// A piece of a commissioning: rows, events, artefacts with pictures, writes to a machine.
class Work {
 public:
  Status begin(Job& job) {
    ZD_TRY(m_series, job.start_series("run", {"T1_C", "T2_C", "dZ_um"}));
    return {};
  }
  Status turn(Job& job, int i) {
    for (int row = 0; row < 25; ++row) {
      const std::int64_t n = m_appended;
      ZD_CHECK(
          job.append(m_series, double(n), std::vector<double>{20.0 + double(n), 30.0 - double(n), 0.5 * double(n)}));
      ++m_appended;
    }
    ZD_CHECK(job.flush());
    kept.rows = m_appended;
    if (i % 3 == 0) {
      NewArtefact artefact{
          "model", "{\"n\":" + std::to_string(i) + "}", {}, {{"p.png", std::string(9000, char('a' + i % 26))}}, {}};
      ZD_CHECK(job.put(artefact).map([](const auto&) {}));
      ++kept.artefacts;
    }
    if (i % 4 == 0) {
      AuditEntry entry;
      entry.action = "upload table";
      entry.result = std::to_string(i);
      ZD_CHECK(job.audit(entry).map([](const auto&) {}));
      ++kept.audits;
    }
    return {};
  }
  Promise kept;

 private:
  SeriesId m_series = 0;
  std::int64_t m_appended = 0;
};

void expect_promises_kept(const std::filesystem::path& file, const Promise& promise, const std::string& what) {
  auto job = Job::open(file);
  ASSERT_TRUE(job.has_value()) << what << ": " << describe(job.error());
  const auto report = job->check();
  ASSERT_OK(report);
  ASSERT_TRUE(report->ok()) << what << ": " << describe(report->problems.front());
  EXPECT_GE(report->artefacts, promise.artefacts) << what;
  EXPECT_GE(report->audit_entries, promise.audits) << what;
  const auto series = job->series();
  ASSERT_OK(series);
  if (promise.rows == 0) return;
  ASSERT_EQ(series->size(), 1U) << what;
  const auto run = job->read_series(1);
  ASSERT_TRUE(run.has_value()) << what << ": " << describe(run.error());
  ASSERT_GE(std::int64_t(run->rows()), promise.rows) << what;
  for (std::size_t i = 0; i < run->rows(); ++i) {
    ASSERT_EQ(run->time_s[i], double(i)) << what;
    ASSERT_EQ(run->channels[2].values[i], 0.5 * double(i)) << what;
  }
  // And the work goes on.
  EXPECT_OK(job->append(1, 1e6, std::vector<double>{1.0, 2.0, 3.0}));
  EXPECT_OK(job->flush());
}

}  // namespace

TEST(PowerCut, AtAnyWrite) {
  const TemporaryFolder folder;
  std::mt19937 dice(41);
  CrashDisk disk;
  std::vector<Promise> promises;
  {
    auto job = Job::create(folder / "a.zdj", {"VMC", "1", "", "Ann", ""});
    ASSERT_OK(job);
    Work work;
    ASSERT_OK(work.begin(*job));
    promises.push_back(work.kept);
    promises.back().moment = disk.moment();
    for (int i = 0; i < 60; ++i) {
      ASSERT_OK(work.turn(*job, i));
      promises.push_back(work.kept);
      promises.back().moment = disk.moment();
    }
  }
  const std::size_t begin = promises.front().moment;
  const std::size_t end = disk.moment();
  ASSERT_GT(end - begin, 300U);
  const int cuts = amount(150, 2000);
  for (int cut = 0; cut < cuts; ++cut) {
    const std::size_t moment = begin + dice() % (end - begin + 1);
    Promise promise;
    for (const auto& p : promises) {
      if (p.moment <= moment) promise = p;
    }
    const TemporaryFolder after;
    disk.after_power_cut(moment, dice, after.path());
    expect_promises_kept(after / "a.zdj", promise, "cut " + std::to_string(cut));
    if (testing::Test::HasFatalFailure()) return;
  }
  std::printf("%d power cuts among %zu deeds of the disk\n", cuts, end - begin);
}

// The disk is full, or the stick is pulled, or the system has made the disk read-only, from any write on: an error by
// name, what was kept stays, and with room again the same job goes on.
TEST(PowerCut, DiskFullOrGoneFromAnyWrite) {
  const int steps = amount(40, 400);
  for (const auto& [code, expected] :
       {std::pair{SQLITE_FULL, ErrorCode::disk_full}, std::pair{SQLITE_IOERR_WRITE, ErrorCode::file_unreadable},
        std::pair{SQLITE_READONLY, ErrorCode::file_not_writable}}) {
    for (int step = 0; step < steps; ++step) {
      const TemporaryFolder folder;
      CrashDisk disk;
      Promise promise;
      {
        auto job = Job::create(folder / "a.zdj");
        ASSERT_OK(job);
        Work work;
        ASSERT_OK(work.begin(*job));
        ASSERT_OK(work.turn(*job, 0));
        disk.fail_writes_from(step, code);
        Status status;
        for (int i = 1; i < 400 && status; ++i) {
          status = work.turn(*job, i);
          promise = work.kept;
        }
        ASSERT_FALSE(status) << "write " << step << " never failed";
        EXPECT_EQ(status.error().code, expected) << describe(status.error());
        disk.heal();
        const Status again = job->flush();
        EXPECT_TRUE(again) << describe(again.error());
      }
      expect_promises_kept(folder / "a.zdj", promise, "write " + std::to_string(step));
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

// kill -9 while artefacts are saved, and while an old file is brought up to date.
TEST(PowerCut, KilledWhileSaving) {
  const int kills = amount(10, 200);
  std::mt19937 dice(43);
  const TemporaryFolder folder;
  int saved = 0;
  for (int kill_number = 0; kill_number < kills; ++kill_number) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const pid_t child = fork();
    if (child == 0) {
      ::close(ends[0]);
      auto job = Job::open_or_create(folder / "a.zdj");
      for (int i = 0; job && i < 100000; ++i) {
        const std::string picture(std::size_t(1000 + 997 * i % 60000), char('a' + i % 26));
        if (!job->put({"model", "{\"n\":" + std::to_string(i) + "}", {}, {{"p.png", picture}}, {}})) break;
        if (::write(ends[1], "x", 1) != 1) break;
      }
      ::_exit(1);
    }
    ::close(ends[1]);
    char buffer[256];
    // Every other one is let live until it has saved something, however busy this computer is.
    if (kill_number % 2 == 1) saved += int(std::max<ssize_t>(0, ::read(ends[0], buffer, 1)));
    std::thread killer([child, life = std::chrono::milliseconds(5 + dice() % 120)] {
      std::this_thread::sleep_for(life);
      ::kill(child, SIGKILL);
    });
    for (ssize_t got = 0; (got = ::read(ends[0], buffer, sizeof buffer)) > 0;) saved += int(got);
    killer.join();
    ::close(ends[0]);
    ::waitpid(child, nullptr, 0);
    if (!std::filesystem::exists(folder / "a.zdj")) continue;
    const auto job = Job::open(folder / "a.zdj");
    ASSERT_TRUE(job.has_value()) << describe(job.error());
    const auto report = job->check();
    ASSERT_OK(report);
    ASSERT_TRUE(report->ok()) << describe(report->problems.front());
    ASSERT_GE(report->artefacts, saved) << "kill " << kill_number;
  }
  EXPECT_GT(saved, 0);
  std::printf("%d kills, %d artefacts acknowledged, all there\n", kills, saved);
}

TEST(PowerCut, KilledWhileMigrating) {
  const int kills = amount(10, 200);
  std::mt19937 dice(44);
  int found_old = 0;
  for (int kill_number = 0; kill_number < kills; ++kill_number) {
    const TemporaryFolder folder;
    const auto file = folder / "old.zdj";
    {
      const auto database = Database::open(file, OpenMode::create);
      ASSERT_OK(database);
      ASSERT_OK(migrate(**database, migrations().first(1)));
      std::string fill = "BEGIN;INSERT INTO header VALUES ('created_utc', '2026-01-01');";
      for (int i = 0; i < 300; ++i) {
        fill += "INSERT INTO audit VALUES (NULL,'','','','a','','" + std::string(3000, 'o') + "','','','','');";
      }
      ASSERT_OK((*database)->execute(fill + "COMMIT"));
    }
    const pid_t child = fork();
    if (child == 0) {
      static_cast<void>(Job::open(file));
      ::_exit(0);
    }
    std::this_thread::sleep_for(std::chrono::microseconds(dice() % 30000));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    {
      const auto database = Database::open(file, OpenMode::read_only);
      ASSERT_OK(database);
      found_old += int((*database)->integer("PRAGMA user_version").value_or(0) == 1);
    }
    auto job = Job::open(file);
    ASSERT_TRUE(job.has_value()) << "kill " << kill_number << ": " << describe(job.error());
    EXPECT_EQ(job->audit_trail()->size(), 300U);
  }
  std::printf("%d kills, %d of them before the new version was committed\n", kills, found_old);
}

}  // namespace zerodrift::commissioning
