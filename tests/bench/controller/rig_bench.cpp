// Forty channels on five devices once a second - two modules on one serial line at the pace of 19200 baud, three by TCP
// - in another process: what reading them costs, how old their values are, and what a dead device does to the others.
// Figures, no assertions.

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <array>
#include <csignal>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/controller/device_readings.h"
#include "core/controller/modbus_server.h"
#include "core/controller/rtu_reply.h"

namespace {

using namespace zerodrift;
using namespace zerodrift::controller;
using nlohmann::json;

constexpr int channels = 8;
constexpr double bits_per_byte = 11.0;
constexpr double baud = 19200.0;
constexpr std::size_t request_bytes = 8;
constexpr std::chrono::milliseconds between_samples{137};  // out of step with the devices

json map_document() {
  return {{"format", "zerodrift-register-map/1"},
          {"name", "eight"},
          {"registers", {{"temperature_C", {{"address", 0}, {"type", "int16"}, {"count", channels}, {"scale", 0.1}}}}}};
}

/// Units 1 and 2 on one line; `dead` never answers.
void serve_line(int line, int dead) {
  std::vector<std::uint8_t> request;
  for (;;) {
    std::uint8_t byte = 0;
    if (::read(line, &byte, 1) != 1) continue;
    request.push_back(byte);
    if (request.size() < request_bytes) continue;
    const int unit = request[0];
    request.clear();
    if (unit == dead || unit > 2) continue;
    std::vector<std::uint8_t> reply = {static_cast<std::uint8_t>(unit), 3, 2 * channels};
    for (int i = 0; i < channels; ++i) reply.insert(reply.end(), {0, static_cast<std::uint8_t>(200 + i)});
    append_rtu_crc(reply);
    const double bytes = static_cast<double>(request_bytes + reply.size());
    std::this_thread::sleep_for(std::chrono::duration<double>(bits_per_byte * bytes / baud));
    if (::write(line, reply.data(), reply.size()) < 0) return;
  }
}

/// Serves until it is killed; tells the TCP ports through the pipe.
[[noreturn]] void serve(int line, int pipe, int dead_unit, bool dead_socket) {
  std::vector<std::unique_ptr<ModbusServer>> servers;
  std::array<int, 3> ports{};
  for (int& port : ports) {
    ModbusServerOptions options;
    const bool dead = dead_socket && servers.empty();
    options.read = [dead](int, int count) -> RegisterReply {
      if (dead) std::this_thread::sleep_for(std::chrono::hours(1));
      return std::vector<std::uint16_t>(static_cast<std::size_t>(count), 215);
    };
    options.write = [](int, std::span<const std::uint16_t>) { return ModbusException::illegal_function; };
    servers.push_back(std::move(*ModbusServer::start(std::move(options))));
    port = servers.back()->port();
  }
  if (::write(pipe, ports.data(), sizeof ports) < 0) std::_Exit(1);
  serve_line(line, dead_unit);
  std::_Exit(0);
}

Profile profile_of(const std::string& port_of_line, const std::array<int, 3>& ports) {
  json devices = json::array({{{"id", "control"}, {"kind", "manual"}}});
  json sensors = json::array();
  for (int k = 0; k < 5; ++k) {
    json device = {
        {"id", fmt::format("device-{}", k + 1)}, {"timeout_ms", 300}, {"register_map_document", map_document()}};
    if (k < 2) {
      device.update({{"kind", "modbus-rtu"}, {"device", port_of_line}, {"parity", "N"}, {"unit", k + 1}});
    } else {
      device.update({{"kind", "modbus-tcp"}, {"host", "127.0.0.1"}, {"port", ports[static_cast<std::size_t>(k - 2)]}});
    }
    devices.push_back(device);
    for (int i = 1; i <= channels; ++i) {
      sensors.push_back({{"channel", fmt::format("T{}_C", channels * k + i)},
                         {"device", fmt::format("device-{}", k + 1)},
                         {"signal", fmt::format("temperature_C[{}]", i)}});
    }
  }
  return *profile_from_json({{"format", "zerodrift-profile/1"}, {"devices", devices}, {"sensors", sensors}}, "bench");
}

double processor_s() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

void measure(const std::string& title, int dead_unit, bool dead_socket, double seconds) {
  const int line = ::posix_openpt(O_RDWR | O_NOCTTY);
  if (line < 0 || ::grantpt(line) != 0 || ::unlockpt(line) != 0) return;
  const std::string port_of_line = ::ptsname(line);
  const int kept_open = ::open(port_of_line.c_str(), O_RDWR | O_NOCTTY);
  termios raw{};
  ::tcgetattr(kept_open, &raw);
  ::cfmakeraw(&raw);
  ::tcsetattr(kept_open, TCSANOW, &raw);
  std::array<int, 2> pipe{};
  if (::pipe(pipe.data()) != 0) return;
  const pid_t child = ::fork();
  if (child == 0) serve(line, pipe[1], dead_unit, dead_socket);
  std::array<int, 3> ports{};
  if (::read(pipe[0], ports.data(), sizeof ports) != sizeof ports) return;
  {
    const auto readings = DeviceReadings::open(profile_of(port_of_line, ports));
    if (!readings) {
      fmt::print("{}\n", describe(readings.error()));
    } else {
      (*readings)->wait_for_first();
      const double begun_s = processor_s();
      const Seconds start = host_clock().steady();
      while (host_clock().steady() - start < Seconds(seconds)) {
        std::this_thread::sleep_for(between_samples);
        acquisition::MachineSample sample;
        (*readings)->put_into(sample);
      }
      const double spent_s = processor_s() - begun_s;
      fmt::print("{}: {:.2f} % of a core\n", title, 100.0 * spent_s / (host_clock().steady() - start).count());
      for (const DeviceState& state : (*readings)->states()) {
        fmt::print("  {}: {} answers, {} missed, age mean {:.3f} s, largest {:.3f} s, round trip {:.1f} ms\n", state.id,
                   state.rounds, state.faults, state.mean_age_s, state.largest_age_s, 1000.0 * state.round_trip_s);
      }
    }
  }
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  for (const int open : {line, kept_open, pipe[0], pipe[1]}) ::close(open);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Reading a rig of five devices"};
  double seconds = 20.0;
  app.add_option("--seconds", seconds, "of each measurement");
  CLI11_PARSE(app, argc, argv);
  measure("all answer", 0, false, seconds);
  measure("a dead socket", 0, true, seconds);
  measure("a dead unit on the line", 2, false, seconds);
}
