// zerodrift-machine as a program: its line, its files, its end.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <regex>
#include <thread>

#include "core/base/file.h"
#include "core/base/hash.h"
#include "core/base/json.h"
#include "core/recording/csv.h"
#include "tests/machine/raw_modbus.h"

extern char** environ;

namespace zerodrift {
namespace {

namespace fs = std::filesystem;
const std::string program = std::string(ZERODRIFT_BIN_DIR) + "/zerodrift-machine";

class Folder {
 public:
  Folder() {
    std::string pattern = (fs::temp_directory_path() / "machine-test-XXXXXX").string();
    m_path = ::mkdtemp(pattern.data());
  }
  ~Folder() { fs::remove_all(m_path); }
  fs::path operator/(const std::string& name) const { return m_path / name; }

 private:
  fs::path m_path;
};

/// The program with its outputs in files.
class Running {
 public:
  Running(const Folder& folder, std::vector<std::string> arguments)
      : m_out((folder / "out.txt").string()), m_err((folder / "err.txt").string()) {
    arguments.insert(arguments.begin(), program);
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 1, m_out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_addopen(&actions, 2, m_err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ::posix_spawn(&m_pid, program.c_str(), &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
  }
  ~Running() {
    if (m_pid > 0) {
      ::kill(m_pid, SIGKILL);
      ::waitpid(m_pid, nullptr, 0);
    }
  }
  int end(int signal) {
    if (signal != 0) ::kill(m_pid, signal);
    int status = 0;
    ::waitpid(m_pid, &status, 0);
    m_pid = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string out() const { return *read_file(m_out); }
  std::string err() const { return *read_file(m_err); }
  int modbus_port() const {
    const std::regex ready(R"(ready modbus=(\d+) camera=http://127\.0\.0\.1:\d+/\n)");
    for (int i = 0; i < 600; ++i) {
      std::smatch match;
      const std::string text = fs::exists(m_out) ? out() : "";
      if (std::regex_match(text, match, ready)) return std::stoi(match[1]);
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return 0;
  }

 private:
  std::string m_out;
  std::string m_err;
  pid_t m_pid = -1;
};

const std::vector<std::string> free_ports{"--port", "0", "--camera-port", "0"};

std::vector<std::string> with(std::vector<std::string> more) {
  more.insert(more.end(), free_ports.begin(), free_ports.end());
  return more;
}

TEST(MachineProgram, ServesWritesItsFilesAndEndsCleanly) {
  const Folder folder;
  const auto profile = folder / "profile.json";
  const auto truth = folder / "truth.csv";
  Running machine(folder, with({"--speedup", "240", "--profile", profile.string(), "--truth", truth.string()}));
  const int port = machine.modbus_port();
  ASSERT_GT(port, 0) << machine.err();
  {
    testing::RawModbus client(port);
    EXPECT_EQ(client.read(0, 2), (std::vector<std::uint16_t>{0x5A44, 1}));
    EXPECT_EQ(client.read(12, 1), std::vector<std::uint16_t>{240});
    EXPECT_EQ(client.write(72, {0x453B, 0x8000}), 0);  // 3000 rpm
    std::this_thread::sleep_for(std::chrono::seconds(2));
  }
  const auto written = read_json_file(profile);
  ASSERT_TRUE(written);
  EXPECT_EQ((*written)["controller"]["port"], port);
  EXPECT_EQ((*written)["time_factor"], 240);
  EXPECT_EQ((*written)["sensors"].size(), 20U);
  EXPECT_EQ((*written)["machine"]["format"], "zerodrift-machine/1");
  EXPECT_EQ(machine.end(SIGTERM), 0);
  const auto rows = recording::read_recording(truth);
  ASSERT_TRUE(rows);
  EXPECT_GT(rows->time_s.back(), 300.0);
  EXPECT_NE(rows->find("thermal_dZ_um"), nullptr);
  EXPECT_NE(rows->find("T20_C"), nullptr);
}

TEST(MachineProgram, EndsOnInterruptToo) {
  const Folder folder;
  Running machine(folder, with({}));
  ASSERT_GT(machine.modbus_port(), 0);
  EXPECT_EQ(machine.end(SIGINT), 0);
}

TEST(MachineProgram, OpensWhatItConcealed) {
  const Folder folder;
  Running machine(folder, with({"--conceal", "random", "--seed", "5"}));
  ASSERT_GT(machine.modbus_port(), 0) << "stdout holds the ready line alone";
  const std::string before = machine.err();
  std::smatch promise;
  ASSERT_TRUE(std::regex_search(before, promise, std::regex("concealed sha256=([0-9a-f]{64})")));
  EXPECT_EQ(before.find("answer"), std::string::npos);
  EXPECT_EQ(machine.end(SIGTERM), 0);
  const std::string after = machine.err();
  std::smatch opened;
  ASSERT_TRUE(std::regex_search(after, opened, std::regex("opened salt=([0-9a-f]+) answer=(.*)\n")));
  EXPECT_EQ(sha256_hex(opened[1].str() + opened[2].str()), promise[1].str());
}

TEST(MachineProgram, WritesCasesThatRepeat) {
  const Folder folder;
  const auto write = [&](const std::string& name) {
    Running machine(folder, {"--write-case", (folder / name).string(), "--seed", "3", "--conceal", "sensor_offset"});
    return machine.end(0);
  };
  ASSERT_EQ(write("a"), 0);
  ASSERT_EQ(write("b"), 0);
  for (const char* file : {"run.csv", "second.csv", "machine.json"}) {
    EXPECT_EQ(*read_file(folder / "a" / file), *read_file(folder / "b" / file)) << file;
  }
  const auto run = recording::read_recording(folder / "a" / "run.csv");
  ASSERT_TRUE(run);
  EXPECT_GT(run->time_s.back(), 4 * 3600.0);
  EXPECT_LT(run->time_s.back(), 8 * 3600.0);
  const auto answer = read_json_file(folder / "a" / "answer.json");
  ASSERT_TRUE(answer);
  EXPECT_EQ((*answer)["answer"]["id"], "sensor_offset");
  const auto commitment = read_json_file(folder / "a" / "commitment.json");
  EXPECT_EQ((*commitment)["sha256"],
            sha256_hex((*answer)["salt"].get<std::string>() + (*answer)["committed_text"].get<std::string>()));
  EXPECT_EQ(read_file(folder / "a" / "machine.json")->find("sensor_offset"), std::string::npos);
}

TEST(MachineProgram, RefusesWrongUsage) {
  const Folder folder;
  const std::vector<std::vector<std::string>> wrong{
      {"--fault", "gremlin"}, {"--fault", "busy:often"}, {"--conceal", "gremlin"}, {"--speedup", "0"}, {"--bogus"}};
  for (const auto& arguments : wrong) {
    Running machine(folder, with(arguments));
    EXPECT_EQ(machine.end(0), 2) << arguments.back();
    EXPECT_NE(machine.err(), "");
  }
  Running machine(folder, with({"--truth", "/nowhere/truth.csv"}));
  EXPECT_EQ(machine.end(0), 1);
}

TEST(MachineProgram, FaultsReachTheWire) {
  const Folder folder;
  Running machine(folder, with({"--fault", "busy:always"}));
  const int port = machine.modbus_port();
  ASSERT_GT(port, 0);
  testing::RawModbus client(port);
  EXPECT_EQ(client.read_exception(0, 1), 6);
  EXPECT_EQ(machine.end(SIGTERM), 0);
}

TEST(MachineProgram, SporadicFaultsLetMostRequestsPass) {
  const Folder folder;
  Running machine(folder, with({"--fault", "busy"}));
  const int port = machine.modbus_port();
  ASSERT_GT(port, 0);
  testing::RawModbus client(port);
  int refused = 0;
  for (int i = 0; i < 100; ++i) refused += client.read_exception(0, 1) == 6 ? 1 : 0;
  EXPECT_EQ(refused, 10);
}

}  // namespace
}  // namespace zerodrift
