#pragma once
// Recordings of real machines: not part of this repository. ZERODRIFT_DATA_DIR, or ../shared/data beside the project.

#include <cstdlib>
#include <filesystem>

namespace zerodrift::analysis::test {

inline std::filesystem::path data_dir() {
  const char* given = std::getenv("ZERODRIFT_DATA_DIR");
  return given != nullptr ? std::filesystem::path(given)
                          : std::filesystem::path(ZERODRIFT_SOURCE_DIR).parent_path() / "shared" / "data";
}

inline std::filesystem::path spindle_drift() {
  return data_dir() / "spindle-drift" / "spindle_drift.csv";
}

}  // namespace zerodrift::analysis::test
