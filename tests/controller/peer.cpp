#include "peer.h"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <thread>

extern char** environ;

namespace zerodrift::controller {
namespace {

std::string first_line(int pipe, int timeout_ms) {
  std::string line;
  char c = 0;
  pollfd wait{pipe, POLLIN, 0};
  while (::poll(&wait, 1, timeout_ms) > 0 && ::read(pipe, &c, 1) == 1 && c != '\n') line += c;
  return line;
}

bool answers(int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  for (int i = 0; i < 200; ++i) {
    const int handle = ::socket(AF_INET, SOCK_STREAM, 0);
    const bool connected = ::connect(handle, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
    ::close(handle);
    if (connected) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return false;
}

}  // namespace

Peer::Peer(const std::vector<std::string>& options, const std::string& npm_package) {
  static int number = 0;
  m_profile = testing::TempDir() + "peer_" + std::to_string(::getpid()) + "_" + std::to_string(++number) + ".json";
  const std::string folder = std::string(ZERODRIFT_SOURCE_DIR) + "/tests/controller/";
  std::vector<std::string> words = {"/usr/bin/python3", folder + "peer_server.py", "--profile", m_profile};
  if (!npm_package.empty()) words = {"node", folder + "peer_server.js", npm_package, m_profile};
  words.insert(words.end(), options.begin(), options.end());
  std::vector<char*> arguments;
  for (auto& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  int pipe[2] = {-1, -1};
  if (::pipe(pipe) != 0) return;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, pipe[1], STDOUT_FILENO);
  posix_spawn_file_actions_addclose(&actions, pipe[0]);
  const int failed = ::posix_spawnp(&m_pid, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(pipe[1]);
  if (failed != 0) m_pid = -1;
  const std::string line = failed == 0 ? first_line(pipe[0], 30000) : "";
  ::close(pipe[0]);
  const auto equals = line.find('=');
  if (equals == std::string::npos) return;
  const std::string place = line.substr(equals + 1);
  if (place.starts_with("/")) {
    std::this_thread::sleep_for(std::chrono::milliseconds(500));  // a serial port has nothing to connect to
    m_running = true;
  } else {
    m_port = std::atoi(place.c_str());
    m_running = answers(m_port);
  }
}

Peer::~Peer() {
  if (m_pid > 0) {
    ::kill(m_pid, SIGKILL);
    ::waitpid(m_pid, nullptr, 0);
  }
  ::unlink(m_profile.c_str());
}

SerialCable::SerialCable() {
  const std::string base = testing::TempDir() + "serial_" + std::to_string(::getpid());
  m_host = base + "_a";
  m_device = base + "_b";
  std::vector<std::string> words = {"socat", "pty,raw,echo=0,link=" + m_host, "pty,raw,echo=0,link=" + m_device};
  std::vector<char*> arguments;
  for (auto& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  if (::posix_spawnp(&m_pid, "socat", nullptr, nullptr, arguments.data(), environ) != 0) return;
  for (int i = 0; i < 100 && !m_running; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    m_running = ::access(m_host.c_str(), F_OK) == 0 && ::access(m_device.c_str(), F_OK) == 0;
  }
}

SerialCable::~SerialCable() {
  if (m_pid > 0) {
    ::kill(m_pid, SIGTERM);
    ::waitpid(m_pid, nullptr, 0);
  }
}

}  // namespace zerodrift::controller
