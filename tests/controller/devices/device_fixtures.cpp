#include "device_fixtures.h"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <thread>

namespace zerodrift::controller {

namespace fs = std::filesystem;

TestFolder::TestFolder() {
  static int number = 0;
  m_path = fs::path(testing::TempDir()) / ("devices_" + std::to_string(::getpid()) + "_" + std::to_string(++number));
  fs::create_directories(m_path);
}

TestFolder::~TestFolder() {
  std::error_code error;
  fs::remove_all(m_path, error);
}

std::string TestFolder::write(const std::string& name, const std::string& text, unsigned mode) const {
  const fs::path file = m_path / name;
  std::ofstream(file) << text;
  fs::permissions(file, static_cast<fs::perms>(mode));
  return file.string();
}

int free_port() {
  const int handle = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  EXPECT_EQ(::bind(handle, reinterpret_cast<sockaddr*>(&address), size), 0);
  EXPECT_EQ(::getsockname(handle, reinterpret_cast<sockaddr*>(&address), &size), 0);
  ::close(handle);
  return ntohs(address.sin_port);
}

bool eventually(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return true;
}

std::string text_of(const Result<std::vector<Reading>>& readings) {
  return readings ? "ok" : describe(readings.error());
}

bool has_remark(const Device& device, const std::string& part) {
  const auto remarks = device.remarks();
  return std::ranges::any_of(remarks, [&](const std::string& r) { return r.find(part) != std::string::npos; });
}

}  // namespace zerodrift::controller
