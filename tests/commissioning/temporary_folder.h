#pragma once
// A folder for one test, removed with it; and a way to reach into a job file past the program.

#include <gtest/gtest.h>
#include <sqlite3.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "core/base/error.h"

namespace zerodrift::commissioning {

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "zerodrift-XXXXXX").string();
    m_path = mkdtemp(pattern.data());
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(m_path, ignored);
  }
  std::filesystem::path operator/(const std::string& name) const { return m_path / name; }
  const std::filesystem::path& path() const { return m_path; }

 private:
  std::filesystem::path m_path;
};

inline void run_sql(const std::filesystem::path& file, const std::string& sql) {
  sqlite3* handle = nullptr;
  ASSERT_EQ(sqlite3_open(file.c_str(), &handle), SQLITE_OK);
  char* message = nullptr;
  EXPECT_EQ(sqlite3_exec(handle, sql.c_str(), nullptr, nullptr, &message), SQLITE_OK) << message;
  sqlite3_free(message);
  sqlite3_close(handle);
}

template <class T>
ErrorCode code_of(const T& result) {
  return result ? ErrorCode::internal : result.error().code;
}

/// ASSERT that a Result holds a value, showing its error otherwise.
#define ASSERT_OK(result) ASSERT_TRUE((result).has_value()) << ::zerodrift::describe((result).error())
#define EXPECT_OK(expression)                                                           \
  do {                                                                                  \
    const auto& expected_ok = (expression);                                             \
    EXPECT_TRUE(expected_ok.has_value()) << ::zerodrift::describe(expected_ok.error()); \
  } while (false)

}  // namespace zerodrift::commissioning
