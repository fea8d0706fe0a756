#pragma once
// What the tests of the devices begin with: files of their own, free ports, patience.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/controller/devices/device.h"

namespace zerodrift::controller {

/// A folder of its own, removed at the end.
class TestFolder {
 public:
  TestFolder();
  ~TestFolder();
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;
  const std::filesystem::path& path() const { return m_path; }
  /// Writes a file that its owner alone may read, unless `mode` says otherwise.
  std::string write(const std::string& name, const std::string& text, unsigned mode = 0600) const;

 private:
  std::filesystem::path m_path;
};

/// A TCP port of 127.0.0.1 on which nobody listens.
int free_port();

/// Calls until it is true; false after a minute, which is longer than a busy computer needs.
bool eventually(const std::function<bool()>& condition);

/// "ok", or the error as text.
std::string text_of(const Result<std::vector<Reading>>& readings);

bool has_remark(const Device& device, const std::string& part);

}  // namespace zerodrift::controller
