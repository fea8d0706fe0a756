#pragma once
// A path in the folder for temporary files that no other process uses: checks of two copies run beside each other.

#include <unistd.h>

#include <filesystem>
#include <string>

namespace zerodrift {

inline std::filesystem::path own_folder(const std::string& name) {
  return std::filesystem::temp_directory_path() / (name + "_" + std::to_string(::getpid()));
}

}  // namespace zerodrift
