#include "include_rules.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <regex>
#include <string_view>

namespace zerodrift::architecture {
namespace {

// In the order in which data flows; a folder may include itself and those before it.
constexpr std::array<std::string_view, 13> core_order = {
    "base",    "access",    "commissioning", "recording",  "acquisition", "vision", "analysis",
    "physics", "diagnosis", "compensation",  "controller", "report",      "flow"};

bool starts(std::string_view text, std::string_view prefix) {
  return text.substr(0, prefix.size()) == prefix;
}

std::ptrdiff_t room_of(std::string_view path) {
  if (!starts(path, "core/")) return -1;
  const std::string_view rest = path.substr(5);
  const std::string_view room = rest.substr(0, rest.find('/'));
  const auto at = std::find(core_order.begin(), core_order.end(), room);
  return at == core_order.end() ? -1 : at - core_order.begin();
}

bool is_qt(std::string_view include) {
  // Qt's headers are Q followed by a capital, or folders named Qt...
  return (include.size() > 1 && include[0] == 'Q' && include[1] >= 'A' && include[1] <= 'Z') || starts(include, "Qt") ||
         starts(include, "qcustomplot");
}

bool is_opencv(std::string_view include) {
  return starts(include, "opencv2/") || starts(include, "opencv4/");
}

bool is_modbus(std::string_view include) {
  return include == "modbus.h" || starts(include, "modbus/");
}

}  // namespace

std::vector<std::string> broken_rules(const std::string& file, const std::string& include) {
  std::vector<std::string> broken;
  const auto demand = [&](bool kept, const char* rule) {
    if (!kept) broken.emplace_back(rule);
  };
  if (starts(file, "core/")) {
    demand(!is_qt(include), "core includes Qt");
    demand(!starts(include, "ui/"), "core includes ui");
    demand(!starts(include, "app/"), "core includes app");
    const auto from = room_of(file);
    const auto to = room_of(include);
    // The job and the report describe artefacts, so they may see the types; nobody sees the flow.
    const bool describes = starts(file, "core/commissioning/") || starts(file, "core/report/");
    const bool allowed = to < 0 || to <= from || (describes && !starts(include, "core/flow/"));
    demand(allowed, "a core folder includes one that stands after it");
  }
  if (starts(file, "ui/")) {
    demand(!starts(include, "core/"), "ui includes core");
    demand(!starts(include, "app/"), "ui includes app");
  }
  if (starts(file, "app/machine/")) {
    demand(!starts(include, "core/physics/") && !starts(include, "core/diagnosis/"),
           "the virtual machine includes the physics it is used to prove");
  }
  demand(!is_modbus(include) || starts(file, "core/controller/"), "modbus.h outside core/controller");
  demand(include != "mosquitto.h" || file == "core/controller/devices/mqtt_device.cpp" || starts(file, "app/machine/"),
         "mosquitto.h outside mqtt_device.cpp and the virtual machine");
  demand(include != "httplib.h" || file == "core/controller/devices/mtconnect_device.cpp" ||
             file == "core/vision/mjpeg_stream.cpp" || starts(file, "app/machine/"),
         "httplib.h outside mtconnect_device.cpp, mjpeg_stream.cpp and the virtual machine");
  demand((include != "arv.h" && include != "aravis.h") || file == "core/vision/aravis_source.cpp",
         "arv.h outside aravis_source.cpp");
  demand(include != "sqlite3.h" || starts(file, "core/commissioning/"), "sqlite3.h outside core/commissioning");
  demand(!is_opencv(include) || starts(file, "core/vision/"), "OpenCV outside core/vision");
  demand(!starts(include, "qcustomplot") || starts(file, "ui/plots/"), "qcustomplot.h outside ui/plots");
  return broken;
}

std::vector<Violation> check_tree(const std::filesystem::path& root) {
  static const std::regex include_line(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<Violation> violations;
  for (const char* top : {"core", "ui", "app"}) {
    if (!std::filesystem::exists(root / top)) continue;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / top)) {
      const auto extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp" && extension != ".inc") continue;
      const std::string file = entry.path().lexically_relative(root).generic_string();
      std::ifstream stream(entry.path());
      std::string line;
      for (int number = 1; std::getline(stream, line); ++number) {
        if (line.find(".dump(") != std::string::npos && file != "core/base/json.cpp")
          violations.push_back(
              {file, number, "JSON made text without json_text, which throws at bytes from elsewhere"});
        std::smatch match;
        if (!std::regex_search(line, match, include_line)) continue;
        for (auto& rule : broken_rules(file, match[1].str())) violations.push_back({file, number, rule});
      }
    }
  }
  return violations;
}

}  // namespace zerodrift::architecture
