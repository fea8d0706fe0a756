#include "core/base/resources.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

namespace zerodrift {
namespace {

namespace fs = std::filesystem;

class ResourcesTest : public testing::Test {
 protected:
  void SetUp() override {
    m_folder = fs::path(testing::TempDir()) / ("zd_resources_" + std::to_string(::getpid()));
    fs::create_directories(m_folder / "bin");
    fs::create_directories(m_folder / "share/zerodrift/resources/kind");
    std::ofstream(m_folder / "share/zerodrift/resources/kind/one.json") << "{}";
    std::ofstream(m_folder / "bin/program") << "";
  }
  void TearDown() override { fs::remove_all(m_folder); }

  fs::path m_folder;
};

}  // namespace

TEST_F(ResourcesTest, BesideAnInstalledProgram) {
  EXPECT_EQ(find_resource_beside(m_folder / "bin/program", "kind/one.json"),
            m_folder / "share/zerodrift/resources/kind/one.json");
  EXPECT_TRUE(find_resource_beside(m_folder / "bin/program", "kind/two.json").empty());
  EXPECT_TRUE(find_resource_beside({}, "kind/one.json").empty());
}

/// Where the system does not tell the program's path, its name does.
TEST_F(ResourcesTest, ByTheNameTheProgramWasCalled) {
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", ("/nowhere:" + (m_folder / "bin").string() + ":" + path).c_str(), 1);
  EXPECT_EQ(program_path("program"), fs::weakly_canonical(m_folder / "bin/program"));
  set_program_name("program");
  const auto found = find_resource("kind/one.json");
  set_program_name(nullptr);
  ::setenv("PATH", path.c_str(), 1);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(program_path(""), fs::path());
  EXPECT_EQ(program_path((m_folder / "bin/../bin/program").string()), fs::weakly_canonical(m_folder / "bin/program"));
}

TEST_F(ResourcesTest, TheEnvironmentComesFirst) {
  ::setenv("ZERODRIFT_RESOURCES", (m_folder / "share/zerodrift/resources").c_str(), 1);
  const auto found = find_resource("kind/one.json");
  const auto missing = find_resource("kind/two.json");
  ::unsetenv("ZERODRIFT_RESOURCES");
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(*found, m_folder / "share/zerodrift/resources/kind/one.json");
  EXPECT_FALSE(missing.has_value());
}

}  // namespace zerodrift
