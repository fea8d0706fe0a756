#include "include_rules.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <ostream>
#include <string>

namespace zerodrift::architecture {

TEST(IncludeRules, HoldInTheTree) {
  const auto violations = check_tree(ZERODRIFT_SOURCE_DIR);
  for (const auto& v : violations) ADD_FAILURE() << v.file << ":" << v.line << ": " << v.rule;
}

struct Planted {
  const char* file;
  const char* include;
  const char* rule;
};

/// The test's name in lists.
void PrintTo(const Planted& planted, std::ostream* out) {
  *out << planted.include << " in " << planted.file;
}

class PlantedViolation : public testing::TestWithParam<Planted> {};

// Each rule must fail when it is broken: a tree with one bad line is made, and the line must be found.
TEST_P(PlantedViolation, IsFoundWithFileAndLine) {
  const auto root = std::filesystem::path(testing::TempDir()) / ("zd_planted_" + std::to_string(::getpid()));
  std::filesystem::remove_all(root);
  const auto path = root / GetParam().file;
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path) << "#pragma once\n#include <vector>\n#include <" << GetParam().include << ">\n";
  const auto violations = check_tree(root);
  std::filesystem::remove_all(root);
  ASSERT_FALSE(violations.empty());
  bool found = false;
  for (const auto& v : violations) found = found || v.rule == GetParam().rule;
  EXPECT_TRUE(found);
  EXPECT_EQ(violations.front().file, GetParam().file);
  EXPECT_EQ(violations.front().line, 3);
}

INSTANTIATE_TEST_SUITE_P(
    Rules, PlantedViolation,
    testing::Values(
        Planted{"core/base/x.h", "QString", "core includes Qt"},
        Planted{"core/flow/x.cpp", "QtCore/qstring.h", "core includes Qt"},
        Planted{"core/report/x.cpp", "ui/shell/main_window.h", "core includes ui"},
        Planted{"core/base/x.cpp", "app/text/error_text.h", "core includes app"},
        Planted{"core/vision/x.cpp", "core/analysis/clustering.h", "a core folder includes one that stands after it"},
        Planted{"core/commissioning/x.cpp", "core/flow/flow.h", "a core folder includes one that stands after it"},
        Planted{"ui/pages/x.cpp", "core/base/error.h", "ui includes core"},
        Planted{"ui/pages/x.cpp", "app/text/error_text.h", "ui includes app"},
        Planted{"app/cli/x.cpp", "modbus.h", "modbus.h outside core/controller"},
        Planted{"app/machine/x.cpp", "modbus/modbus.h", "modbus.h outside core/controller"},
        Planted{"core/controller/link.cpp", "mosquitto.h",
                "mosquitto.h outside mqtt_device.cpp and the virtual machine"},
        Planted{"core/controller/link.h", "httplib.h",
                "httplib.h outside mtconnect_device.cpp, mjpeg_stream.cpp and the virtual machine"},
        Planted{"core/vision/camera.cpp", "arv.h", "arv.h outside aravis_source.cpp"},
        Planted{"core/flow/x.cpp", "sqlite3.h", "sqlite3.h outside core/commissioning"},
        Planted{"app/machine/x.cpp", "opencv2/core.hpp", "OpenCV outside core/vision"},
        Planted{"ui/pages/x.cpp", "qcustomplot.h", "qcustomplot.h outside ui/plots"},
        Planted{"app/machine/x.cpp", "core/physics/simulate.h",
                "the virtual machine includes the physics it is used to prove"},
        Planted{"app/machine/x.cpp", "core/diagnosis/diagnosis.h",
                "the virtual machine includes the physics it is used to prove"}));

}  // namespace zerodrift::architecture
