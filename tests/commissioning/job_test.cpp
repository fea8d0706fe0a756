#include "core/commissioning/job.h"

#include <gtest/gtest.h>

#include "temporary_folder.h"

namespace zerodrift::commissioning {
namespace {

TEST(Job, KeepsItsHeaderAndLogsChanges) {
  const TemporaryFolder folder;
  {
    auto job = Job::create(folder / "a.zdj", {"VMC-850", "4711", "Works", "Ann", "first"});
    ASSERT_OK(job);
    EXPECT_OK(job->set_header({"VMC-850", "4711", "Works", "Ben", "first"}));
    EXPECT_OK(job->set_header({"VMC-850", "4711", "Works", "Ben", "first"}));  // no change, no log
  }
  auto job = Job::open(folder / "a.zdj");
  ASSERT_OK(job);
  const auto header = job->header();
  ASSERT_OK(header);
  EXPECT_EQ(header->machine, "VMC-850");
  EXPECT_EQ(header->engineer, "Ben");
  EXPECT_EQ(job->created_utc().size(), 24u);
  const auto changes = job->header_changes();
  ASSERT_OK(changes);
  ASSERT_EQ(changes->size(), 1u);
  EXPECT_EQ(changes->front().key, "engineer");
  EXPECT_EQ(changes->front().old_value, "Ann");
  EXPECT_EQ(changes->front().new_value, "Ben");
}

TEST(Job, IsOneFileWhenClosed) {
  const TemporaryFolder folder;
  {
    auto job = Job::create(folder / "a.zdj");
    ASSERT_OK(job);
    ASSERT_OK(job->put({"note", "{}", {}, {}, {}}));
  }
  { ASSERT_OK(Job::open(folder / "a.zdj")); }
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    ++files;
    EXPECT_EQ(entry.path().filename(), "a.zdj");
  }
  EXPECT_EQ(files, 1);
}

TEST(Job, NeverReplacesAFile) {
  const TemporaryFolder folder;
  std::ofstream(folder / "a.zdj") << "mine";
  const auto job = Job::create(folder / "a.zdj");
  EXPECT_EQ(code_of(job), ErrorCode::file_not_writable);
  std::string text;
  std::ifstream(folder / "a.zdj") >> text;
  EXPECT_EQ(text, "mine");
}

TEST(Job, HasOneWriter) {
  const TemporaryFolder folder;
  auto first = Job::create(folder / "a.zdj");
  ASSERT_OK(first);
  EXPECT_EQ(code_of(Job::open(folder / "a.zdj")), ErrorCode::job_busy);
  { const auto closed = std::move(*first); }
  EXPECT_OK(Job::open(folder / "a.zdj"));
}

TEST(Job, IsBusyWhileAnotherProgramHoldsTheDatabase) {
  const TemporaryFolder folder;
  auto job = Job::create(folder / "a.zdj");
  ASSERT_OK(job);
  sqlite3* other = nullptr;
  ASSERT_EQ(sqlite3_open((folder / "a.zdj").c_str(), &other), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(other, "BEGIN IMMEDIATE", nullptr, nullptr, nullptr), SQLITE_OK);
  EXPECT_EQ(code_of(job->put({"note", "{}", {}, {}, {}})), ErrorCode::job_busy);
  sqlite3_close(other);
  EXPECT_OK(job->put({"note", "{}", {}, {}, {}}));
}

TEST(Job, IsReadBesideItsWriter) {
  const TemporaryFolder folder;
  auto writer = Job::create(folder / "a.zdj");
  ASSERT_OK(writer);
  ASSERT_OK(writer->put({"note", R"({"n":1})", {}, {}, {}}));
  auto reader = Job::open_read_only(folder / "a.zdj");
  ASSERT_OK(reader);
  EXPECT_EQ((*reader->latest("note"))->body, R"({"n":1})");
  EXPECT_EQ((*writer->latest("note"))->body, R"({"n":1})");
  ASSERT_OK(writer->put({"note", R"({"n":2})", {}, {}, {}}));
  EXPECT_EQ((*writer->latest("note"))->body, R"({"n":2})");
  const auto latest = reader->latest("note");
  ASSERT_OK(latest);
  ASSERT_TRUE(latest->has_value());
  EXPECT_EQ((*latest)->body, R"({"n":2})");
  EXPECT_EQ(code_of(reader->put({"note", "{}", {}, {}, {}})), ErrorCode::file_not_writable);
  EXPECT_EQ(code_of(reader->set_header({})), ErrorCode::file_not_writable);
}

TEST(Job, ReadingLeavesNothingBeside) {
  const TemporaryFolder folder;
  const auto file = folder / "a.zdj";
  ASSERT_OK(Job::create(file));
  {
    const auto job = Job::open_read_only(file);
    ASSERT_OK(job);
    EXPECT_OK(job->header());
  }
  const auto entries = std::distance(std::filesystem::directory_iterator(folder.path()), {});
  EXPECT_EQ(entries, 1);
}

TEST(Job, IsReadFromAReadOnlyFolder) {
  const TemporaryFolder folder;
  {
    auto job = Job::create(folder / "a %20?#.zdj");  // characters that mean something in a URI
    ASSERT_OK(job);
    ASSERT_OK(job->put({"note", "{}", {}, {}, {}}));
  }
  using std::filesystem::perms;
  std::filesystem::permissions(folder.path(), perms::owner_read | perms::owner_exec);
  std::filesystem::permissions(folder / "a %20?#.zdj", perms::owner_read);
  if (geteuid() != 0) {
    EXPECT_EQ(code_of(Job::open(folder / "a %20?#.zdj")), ErrorCode::file_not_writable);
  }
  {
    auto job = Job::open_read_only(folder / "a %20?#.zdj");
    ASSERT_OK(job);
    EXPECT_OK(job->latest("note"));
  }
  std::filesystem::permissions(folder.path(), perms::owner_all);
}

}  // namespace
}  // namespace zerodrift::commissioning
