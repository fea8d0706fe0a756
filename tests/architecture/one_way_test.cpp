// One way to do a step and one way to write to a machine: artefacts are put into a job by Flow alone, and the audit
// trail is written by MachineWrite alone (and by the lock of the window, which writes who locked and unlocked). What an
// effect is stands in its own file alone.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

namespace zerodrift::architecture {
namespace {

namespace fs = std::filesystem;

/// "file:line" of every line of app and core that matches, but for these files and core/commissioning itself.
std::vector<std::string> found(const std::string& pattern, const std::vector<std::string>& allowed) {
  const std::regex wanted(pattern);
  std::vector<std::string> places;
  for (const char* folder : {"app", "core"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(ZERODRIFT_SOURCE_DIR) / folder)) {
      const std::string file = fs::relative(entry.path(), ZERODRIFT_SOURCE_DIR).generic_string();
      if (entry.path().extension() != ".cpp" && entry.path().extension() != ".h") continue;
      // The virtual machine tool has no job.
      if (file.starts_with("core/commissioning/") || file.starts_with("app/machine/")) continue;
      if (std::find(allowed.begin(), allowed.end(), file) != allowed.end()) continue;
      std::ifstream lines(entry.path());
      int number = 0;
      for (std::string line; std::getline(lines, line);) {
        ++number;
        if (std::regex_search(line, wanted)) places.push_back(file + ":" + std::to_string(number));
      }
    }
  }
  return places;
}

TEST(OneWay, ArtefactsArePutIntoAJobByFlow) {
  EXPECT_EQ(found(R"((\.|->)put\()", {"core/flow/flow.cpp"}), std::vector<std::string>{});
  EXPECT_FALSE(found(R"((\.|->)put\()", {}).empty()) << "the pattern finds nothing at all";
}

TEST(OneWay, TheTrailIsWrittenByMachineWrite) {
  const std::string pattern = R"((\.|->)audit\([^)])";
  EXPECT_EQ(found(pattern, {"core/flow/machine_write.cpp", "app/desktop/pin_dialog.cpp"}), std::vector<std::string>{});
  EXPECT_FALSE(found(pattern, {}).empty()) << "the pattern finds nothing at all";
}

/// A diagnosis knows an effect by its traits: a new effect is a new file in core/physics/effects and nothing else here.
TEST(OneWay, ADiagnosisKnowsNoEffectByItsId) {
  const fs::path source = ZERODRIFT_SOURCE_DIR;
  std::string ids;
  const std::regex of_effect(R"re(const Effect \w+_effect = \{\s*"(\w+)")re");
  for (const auto& entry : fs::directory_iterator(source / "core/physics/effects")) {
    std::ifstream in(entry.path());
    const std::string text((std::istreambuf_iterator<char>(in)), {});
    if (std::smatch match; std::regex_search(text, match, of_effect)) ids += (ids.empty() ? "" : "|") + match[1].str();
  }
  ASSERT_GT(std::count(ids.begin(), ids.end(), '|'), 20);
  std::vector<std::string> places = found("\"(" + ids + ")\"", {});
  EXPECT_FALSE(places.empty()) << "the pattern finds nothing at all";
  std::erase_if(places, [](const std::string& place) { return !place.starts_with("core/diagnosis/"); });
  EXPECT_EQ(places, std::vector<std::string>{});
}

}  // namespace
}  // namespace zerodrift::architecture
