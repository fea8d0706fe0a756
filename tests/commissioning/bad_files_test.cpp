#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "core/commissioning/job.h"
#include "core/recording/recording.h"
#include "temporary_folder.h"

namespace zerodrift::commissioning {
namespace {

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

void make_job(const std::filesystem::path& path) {
  auto job = Job::create(path, {"VMC", "1", "", "Ann", ""});
  ASSERT_OK(job);
  const auto series = job->start_series("run", {"T1_C", "dZ_um"});
  ASSERT_OK(series);
  for (int i = 0; i < 3000; ++i) EXPECT_OK(job->append(*series, i, std::vector<double>{20.0 + i * 0.37, i * 1.7}));
  EXPECT_OK(job->flush());
  ASSERT_OK(job->put({"model", R"({"a":1})", {}, {{"t.png", std::string(20000, 'x')}}, {}}));
  ASSERT_OK(job->audit({}));
}

TEST(BadFiles, AbsentFolderForeign) {
  const TemporaryFolder folder;
  EXPECT_EQ(code_of(Job::open(folder / "none.zdj")), ErrorCode::file_not_found);
  EXPECT_EQ(code_of(Job::open(folder.path())), ErrorCode::job_not_a_job);
  EXPECT_EQ(code_of(Job::create(folder / "none" / "a.zdj")), ErrorCode::file_not_writable);
  write_bytes(folder / "text.zdj", "time_s,dZ_um\n0,1\n");
  EXPECT_EQ(code_of(Job::open(folder / "text.zdj")), ErrorCode::job_not_a_job);
  write_bytes(folder / "empty.zdj", "");
  EXPECT_EQ(code_of(Job::open(folder / "empty.zdj")), ErrorCode::job_not_a_job);
  EXPECT_EQ(bytes_of(folder / "empty.zdj"), "");
  run_sql(folder / "other.zdj", "CREATE TABLE t (x); INSERT INTO t VALUES (1)");
  const std::string before = bytes_of(folder / "other.zdj");
  EXPECT_EQ(code_of(Job::open(folder / "other.zdj")), ErrorCode::job_not_a_job);
  EXPECT_EQ(bytes_of(folder / "other.zdj"), before);
}

TEST(BadFiles, FromANewerProgram) {
  const TemporaryFolder folder;
  make_job(folder / "a.zdj");
  run_sql(folder / "a.zdj", "PRAGMA user_version = 99");
  const auto job = Job::open(folder / "a.zdj");
  ASSERT_EQ(code_of(job), ErrorCode::job_newer);
  EXPECT_EQ(job.error().context.at("found"), "99");
  EXPECT_EQ(code_of(Job::open_read_only(folder / "a.zdj")), ErrorCode::job_newer);
}

TEST(BadFiles, WithAMissingTable) {
  const TemporaryFolder folder;
  make_job(folder / "a.zdj");
  run_sql(folder / "a.zdj", "DROP TABLE event");
  EXPECT_EQ(code_of(Job::open(folder / "a.zdj")), ErrorCode::job_damaged);
}

// A job from elsewhere brings no program of its own: not when it is opened, not when it is written to.
TEST(BadFiles, WithSomebodysTriggersAndViews) {
  const TemporaryFolder folder;
  for (const char* sql :
       {"CREATE TRIGGER forget AFTER INSERT ON audit BEGIN DELETE FROM open_row; END",
        "DROP TRIGGER audit_kept; CREATE TRIGGER audit_kept BEFORE DELETE ON audit BEGIN SELECT 1; END",
        "CREATE VIEW more AS SELECT * FROM artefact", "DROP TABLE event; CREATE VIEW event AS SELECT * FROM audit",
        "CREATE VIRTUAL TABLE words USING fts5(a)"}) {
    const auto file = folder / "a.zdj";
    std::filesystem::remove(file);
    make_job(file);
    run_sql(file, sql);
    EXPECT_EQ(code_of(Job::open(file)), ErrorCode::job_damaged) << sql;
    EXPECT_EQ(code_of(Job::open_read_only(file)), ErrorCode::job_damaged) << sql;
  }
}

TEST(BadFiles, GuardsThatWereTakenAwayAreBack) {
  const TemporaryFolder folder;
  make_job(folder / "a.zdj");
  run_sql(folder / "a.zdj", "DROP TRIGGER audit_kept");
  { ASSERT_OK(Job::open(folder / "a.zdj")); }
  sqlite3* handle = nullptr;
  ASSERT_EQ(sqlite3_open((folder / "a.zdj").c_str(), &handle), SQLITE_OK);
  EXPECT_NE(sqlite3_exec(handle, "DELETE FROM audit", nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_close(handle);
}

TEST(BadFiles, CutShort) {
  const TemporaryFolder folder;
  make_job(folder / "a.zdj");
  const std::string whole = bytes_of(folder / "a.zdj");
  for (const std::size_t size : {whole.size() / 2, whole.size() - 4096, std::size_t{4096}, std::size_t{50}}) {
    write_bytes(folder / "b.zdj", whole.substr(0, size));
    const auto job = Job::open(folder / "b.zdj");
    ASSERT_FALSE(job) << size;
    const bool named = job.error().code == ErrorCode::job_damaged || job.error().code == ErrorCode::job_not_a_job;
    EXPECT_TRUE(named) << size << " " << describe(job.error());
  }
}

// Whatever is broken: an error or right data, and check() sees what reading sees.
TEST(BadFiles, WithFlippedBytes) {
  const TemporaryFolder folder;
  make_job(folder / "a.zdj");
  const std::string whole = bytes_of(folder / "a.zdj");
  std::mt19937 random(7);
  for (int trial = 0; trial < 60; ++trial) {
    std::string broken = whole;
    for (int i = 0; i < 8; ++i) broken[random() % broken.size()] = static_cast<char>(random());
    if (trial % 4 == 0) broken.replace(random() % (broken.size() / 4096) * 4096, 4096, std::string(4096, '\0'));
    write_bytes(folder / "b.zdj", broken);
    const auto job = Job::open(folder / "b.zdj");
    if (!job) continue;
    const auto report = job->check();
    ASSERT_OK(report);
    const auto recording = job->read_series(1);
    if (!recording || !report->ok()) continue;
    ASSERT_EQ(recording->rows(), 3000u);
    for (std::size_t i = 0; i < 3000; ++i) ASSERT_EQ(recording->channels[1].values[i], double(i) * 1.7);
  }
}

// A figure that somebody wrote over is not read, so that no report can say it.
TEST(BadFiles, ArtefactThatSomebodyChangedIsNotRead) {
  const TemporaryFolder folder;
  make_job(folder / "a.zdj");
  {
    auto job = Job::open(folder / "a.zdj");
    ASSERT_OK(job);
    NewArtefact artefact;
    artefact.kind = "verification";
    artefact.body = R"({"peak_um": 19.0})";
    ASSERT_OK(job->put(artefact));
  }
  run_sql(folder / "a.zdj",
          R"(DROP TRIGGER artefact_fixed; UPDATE artefact SET body = '{"peak_um": 0.1}' WHERE kind = 'verification')");
  const auto job = Job::open(folder / "a.zdj");
  ASSERT_OK(job);
  EXPECT_EQ(code_of(job->latest("verification")), ErrorCode::job_damaged);
  EXPECT_EQ(code_of(job->history("verification")), ErrorCode::job_damaged);
  EXPECT_FALSE(job->check()->ok());
}

TEST(BadFiles, DamagedChunkIsAGapWhenAsked) {
  const TemporaryFolder folder;
  make_job(folder / "a.zdj");
  run_sql(folder / "a.zdj", "UPDATE chunk SET data = zeroblob(length(data)) WHERE first_row = 960");
  auto job = Job::open(folder / "a.zdj");
  ASSERT_OK(job);
  EXPECT_EQ(code_of(job->read_series(1)), ErrorCode::job_damaged);
  std::vector<Error> damaged;
  const auto recording = job->read_series(1, &damaged);
  ASSERT_OK(recording);
  EXPECT_EQ(damaged.size(), 1u);
  EXPECT_EQ(recording->rows(), 3000u - 960u);
  EXPECT_EQ(recording->time_s[960], 1920.0);
  EXPECT_FALSE(job->check()->ok());
  EXPECT_OK(job->append(1, 3000.0, std::vector<double>{1.0, 2.0}));  // and the run goes on
}

}  // namespace
}  // namespace zerodrift::commissioning
