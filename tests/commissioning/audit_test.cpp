#include <gtest/gtest.h>

#include "core/commissioning/job.h"
#include "temporary_folder.h"

namespace zerodrift::commissioning {
namespace {

AuditEntry entry(const std::string& action, const std::string& result) {
  AuditEntry e;
  e.machine = "VMC 4711";
  e.action = action;
  e.subject = "Z";
  e.old_value = "1";
  e.new_value = "2";
  e.result = result;
  return e;
}

class AuditTrail : public testing::Test {
 protected:
  void SetUp() override {
    auto job = Job::create(file, {"", "", "", "Ann", ""});
    ASSERT_OK(job);
    for (const char* result : {"started", "done", "started", "upload_rejected"}) {
      ASSERT_OK(job->audit(entry("push table", result)));
    }
  }
  Status verify() const {
    ZD_TRY(const Job job, Job::open(file));
    return job.verify_audit();
  }
  TemporaryFolder folder;
  std::filesystem::path file = folder / "a.zdj";
};

TEST_F(AuditTrail, SaysWhoWhenWhat) {
  auto job = Job::open(file);
  ASSERT_OK(job);
  EXPECT_OK(job->verify_audit());
  const auto trail = job->audit_trail();
  ASSERT_OK(trail);
  ASSERT_EQ(trail->size(), 4u);
  EXPECT_EQ(trail->at(0).engineer, "Ann");
  EXPECT_EQ(trail->at(0).id, 1);
  EXPECT_EQ(trail->at(0).utc.size(), 24u);
  EXPECT_EQ(trail->at(3).result, "upload_rejected");
  EXPECT_EQ(job->check()->audit_entries, 4);
}

TEST_F(AuditTrail, RefusesChangesThroughTheDatabase) {
  sqlite3* handle = nullptr;
  ASSERT_EQ(sqlite3_open(file.c_str(), &handle), SQLITE_OK);
  EXPECT_NE(sqlite3_exec(handle, "UPDATE audit SET result = 'done'", nullptr, nullptr, nullptr), SQLITE_OK);
  EXPECT_NE(sqlite3_exec(handle, "DELETE FROM audit", nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_close(handle);
  EXPECT_OK(verify());
}

TEST_F(AuditTrail, ShowsAChangedEntry) {
  run_sql(file, "DROP TRIGGER audit_fixed; UPDATE audit SET new_value = '3' WHERE id = 2");
  const Status status = verify();
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::job_damaged);
  EXPECT_NE(status.error().context.at("detail").find("entry 2"), std::string::npos);
}

TEST_F(AuditTrail, ShowsAMissingEntry) {
  run_sql(file, "DROP TRIGGER audit_kept; DELETE FROM audit WHERE id = 3");
  EXPECT_FALSE(verify());
}

TEST_F(AuditTrail, ShowsACutEnd) {
  run_sql(file, "DROP TRIGGER audit_kept; DELETE FROM audit WHERE id = 4");
  EXPECT_FALSE(verify());
}

TEST_F(AuditTrail, ShowsAnInsertedEntry) {
  run_sql(file,
          "INSERT INTO audit SELECT 5, utc, engineer, machine, action, subject, old_value, new_value, result, "
          "previous_hash, hash FROM audit WHERE id = 4");
  EXPECT_FALSE(verify());
}

}  // namespace
}  // namespace zerodrift::commissioning
