#include <gtest/gtest.h>

#include "core/commissioning/job.h"
#include "core/commissioning/schema.h"
#include "temporary_folder.h"

namespace zerodrift::commissioning {
namespace {

class Migrations : public testing::Test {
 protected:
  void SetUp() override {
    auto job = Job::create(file);
    ASSERT_OK(job);
    ASSERT_OK(job->put({"model", "{}", {}, {}, {}}));
    const auto known = migrations();
    steps.assign(known.begin(), known.end());
    backup = file.string() + ".v" + std::to_string(steps.size()) + ".bak";
  }
  TemporaryFolder folder;
  std::filesystem::path file = folder / "a.zdj";
  std::filesystem::path backup;
  std::vector<Migration> steps;
};

TEST_F(Migrations, NothingToDo) {
  const auto database = Database::open(file, OpenMode::read_write);
  ASSERT_OK(database);
  EXPECT_OK(migrate(**database, steps));
  EXPECT_FALSE(std::filesystem::exists(backup));
}

TEST_F(Migrations, FromTheFirstVersion) {
  const auto old_file = folder / "old.zdj";
  {
    const auto database = Database::open(old_file, OpenMode::create);
    ASSERT_OK(database);
    ASSERT_OK(migrate(**database, std::span(steps).first(1)));
    ASSERT_OK(
        (*database)->execute("INSERT INTO artefact (kind, body, content_hash, input_hash, made_by, engineer, "
                             "created_utc) VALUES ('model', '{}', 'c', 'i', 'zerodrift 0', 'Ann', 'then')"));
  }
  EXPECT_EQ(code_of(Job::open_read_only(old_file)), ErrorCode::file_not_writable);
  const auto job = Job::open(old_file);
  ASSERT_OK(job);
  EXPECT_EQ((*job->latest("model"))->engineer, "Ann");
  EXPECT_TRUE(std::filesystem::exists(old_file.string() + ".v1.bak"));
  EXPECT_OK(Job::open_read_only(old_file));
}

TEST_F(Migrations, KeepACopyAndTheData) {
  steps.emplace_back([](Database& d) { return d.execute("CREATE TABLE later (x); INSERT INTO later VALUES (5)"); });
  steps.emplace_back([](Database& d) { return d.execute("UPDATE later SET x = x + 1"); });
  const auto database = Database::open(file, OpenMode::read_write);
  ASSERT_OK(database);
  ASSERT_OK(migrate(**database, steps));
  EXPECT_EQ(*(*database)->integer("SELECT x FROM later"), 6);
  EXPECT_EQ(*(*database)->integer("PRAGMA user_version"), std::int64_t(steps.size()));
  EXPECT_EQ(*(*database)->integer("SELECT count(*) FROM artefact"), 1);
  const auto copy = Job::open_read_only(backup);
  ASSERT_OK(copy);
  EXPECT_TRUE(copy->latest("model")->has_value());
  EXPECT_EQ(code_of(Job::open_read_only(file)), ErrorCode::job_newer);  // for this program
}

TEST_F(Migrations, ThatFailChangeNothing) {
  steps.emplace_back([](Database& d) -> Status {
    ZD_CHECK(d.execute("CREATE TABLE later (x)"));
    return d.execute("INSERT INTO nowhere VALUES (1)");
  });
  {
    const auto database = Database::open(file, OpenMode::read_write);
    ASSERT_OK(database);
    EXPECT_FALSE(migrate(**database, steps));
  }
  const auto job = Job::open(file);
  ASSERT_OK(job);
  EXPECT_TRUE(job->check()->ok());
  EXPECT_TRUE(std::filesystem::exists(backup));
}

}  // namespace
}  // namespace zerodrift::commissioning
