#include "broker.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <mosquitto.h>
#include <netinet/in.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

extern char** environ;

namespace zerodrift::controller {
namespace {

pid_t spawned(std::vector<std::string> words) {
  std::vector<char*> arguments;
  for (auto& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int handle : {STDOUT_FILENO, STDERR_FILENO}) {
    posix_spawn_file_actions_addopen(&actions, handle, "/dev/null", O_WRONLY, 0);
  }
  pid_t pid = -1;
  if (::posix_spawnp(&pid, arguments[0], &actions, nullptr, arguments.data(), environ) != 0) pid = -1;
  posix_spawn_file_actions_destroy(&actions);
  return pid;
}

bool accepts(int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  const int handle = ::socket(AF_INET, SOCK_STREAM, 0);
  const bool connected = ::connect(handle, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
  ::close(handle);
  return connected;
}

}  // namespace

std::string program(const std::string& name) {
  for (const char* folder : {"/usr/sbin/", "/usr/bin/", "/usr/local/sbin/", "/usr/local/bin/"}) {
    if (::access((folder + name).c_str(), X_OK) == 0) return folder + name;
  }
  return {};
}

bool run(const std::vector<std::string>& words) {
  const pid_t pid = spawned(words);
  int status = 0;
  return pid > 0 && ::waitpid(pid, &status, 0) == pid && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

bool Broker::installed() {
  return !program("mosquitto").empty();
}

Broker::Broker(const std::string& lines) : m_port(free_port()) {
  std::string configuration =
      "listener " + std::to_string(m_port) + " 127.0.0.1\npersistence false\nuser root\n" + lines;
  for (std::size_t at = 0; (at = configuration.find("FOLDER", at)) != std::string::npos;) {
    configuration.replace(at, 6, m_folder.path().string());
  }
  m_folder.write("broker.conf", configuration);
}

void Broker::start() {
  m_pid = spawned({program("mosquitto"), "-c", (m_folder.path() / "broker.conf").string()});
  ASSERT_GT(m_pid, 0);
  ASSERT_TRUE(eventually([this] { return accepts(m_port); })) << "mosquitto did not start";
}

void Broker::stop() {
  if (m_pid <= 0) return;
  ::kill(m_pid, SIGKILL);
  ::waitpid(m_pid, nullptr, 0);
  m_pid = -1;
}

DeviceProfile Broker::profile() const {
  DeviceProfile profile;
  profile.id = "bench";
  profile.kind = DeviceKind::mqtt;
  profile.host = "127.0.0.1";
  profile.port = m_port;
  profile.timeout_ms = 20000;
  profile.stale_after_s = 3600.0;
  profile.file = (m_folder.path() / "profile.json").string();
  return profile;
}

void Broker::publish(const std::string& topic, const std::string& payload, bool retained) const {
  mosquitto_lib_init();
  bool taken = false;
  mosquitto* client = mosquitto_new(nullptr, true, &taken);
  mosquitto_publish_callback_set(client, [](mosquitto*, void* done, int) { *static_cast<bool*>(done) = true; });
  ASSERT_EQ(mosquitto_connect(client, "127.0.0.1", m_port, 60), MOSQ_ERR_SUCCESS);
  ASSERT_EQ(
      mosquitto_publish(client, nullptr, topic.c_str(), static_cast<int>(payload.size()), payload.data(), 1, retained),
      MOSQ_ERR_SUCCESS);
  EXPECT_TRUE(eventually([&] { return mosquitto_loop(client, 10, 1) != MOSQ_ERR_SUCCESS || taken; }));
  EXPECT_TRUE(taken);
  mosquitto_disconnect(client);
  mosquitto_destroy(client);
  mosquitto_lib_cleanup();
}

}  // namespace zerodrift::controller
