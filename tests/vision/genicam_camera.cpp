#include "tests/vision/genicam_camera.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <spawn.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <optional>

extern char** environ;

namespace zerodrift::testing {
namespace {

constexpr const char* program = "/usr/bin/arv-fake-gv-camera-0.8";
constexpr std::uint16_t gvcp_port = 3956;
// GigE Vision Control Protocol: WRITEREG and its acknowledgement.
constexpr std::uint16_t write_command = 0x0082, write_acknowledged = 0x0083;

/// Whether the camera took it; nothing when it does not answer.
std::optional<bool> written(std::uint32_t address, std::uint32_t value) {
  const std::array<std::uint16_t, 4> head{htons(0x4201), htons(write_command), htons(8), htons(1)};
  const std::array<std::uint32_t, 2> body{htonl(address), htonl(value)};
  std::array<char, 16> packet{};
  std::memcpy(packet.data(), head.data(), 8);
  std::memcpy(packet.data() + 8, body.data(), 8);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(gvcp_port);
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int handle = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  ::sendto(handle, packet.data(), packet.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof to);
  pollfd wait{handle, POLLIN, 0};
  std::array<std::uint16_t, 32> answer{};
  const bool answered = ::poll(&wait, 1, 500) > 0 && ::recv(handle, answer.data(), sizeof answer, 0) >= 8;
  ::close(handle);
  if (!answered) return std::nullopt;
  return answer[0] == 0 && ntohs(answer[1]) == write_acknowledged;
}

}  // namespace

GenicamCamera::GenicamCamera(std::vector<std::string> options) : m_options(std::move(options)) {
  const auto file = std::filesystem::temp_directory_path() / "zerodrift_fake_gige_camera.lock";
  // Another user's file in a common folder may be read, but not created again.
  m_lock = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (m_lock < 0) m_lock = ::open(file.c_str(), O_CREAT | O_RDONLY | O_CLOEXEC, 0644);
  EXPECT_GE(m_lock, 0);
  EXPECT_EQ(::flock(m_lock, LOCK_EX), 0);
}

GenicamCamera::~GenicamCamera() {
  stop();
  ::close(m_lock);
}

bool GenicamCamera::installed() {
  return ::access(program, X_OK) == 0;
}

void GenicamCamera::start(const std::string& serial) {
  std::vector<std::string> words = {program, "-i", "127.0.0.1", "-s", serial};
  words.insert(words.end(), m_options.begin(), m_options.end());
  std::vector<char*> arguments;
  for (auto& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int handle : {STDOUT_FILENO, STDERR_FILENO}) {
    posix_spawn_file_actions_addopen(&actions, handle, "/dev/null", O_WRONLY, 0);
  }
  ASSERT_EQ(::posix_spawn(&m_pid, program, &actions, nullptr, arguments.data(), environ), 0);
  posix_spawn_file_actions_destroy(&actions);
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(40);
  while (!written(width, 160)) {
    ASSERT_LT(std::chrono::steady_clock::now(), until) << "the fake camera does not answer";
    ::usleep(50000);
  }
  write_register(height, 120);
}

void GenicamCamera::stop() {
  if (m_pid <= 0) return;
  ::kill(m_pid, SIGKILL);
  ::waitpid(m_pid, nullptr, 0);
  m_pid = -1;
}

void GenicamCamera::write_register(std::uint32_t address, std::uint32_t value) const {
  std::optional<bool> done;
  for (int i = 0; i < 40 && !done; ++i) done = written(address, value);
  EXPECT_TRUE(done.value_or(false)) << "register " << std::hex << address;
}

std::string own_serial(const std::string& name) {
  return "ZD" + std::to_string(::getpid()) + name;
}

}  // namespace zerodrift::testing
