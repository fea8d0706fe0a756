// zerodrift-machine: the virtual machine tool. Modbus TCP server, two cameras, five axes, twenty temperature sensors,
// and physics of its own that the analysis never sees.

#include <fmt/format.h>
#include <pthread.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/machine/camera/camera_server.h"
#include "app/machine/description.h"
#include "app/machine/live_machine.h"
#include "app/machine/truth_log.h"
#include "core/base/json.h"
#include "core/controller/modbus_server.h"

namespace zerodrift::machine {
namespace {

struct Options {
  int speedup = 1;
  std::uint64_t seed = 1;
  std::string host = "127.0.0.1";
  int port = 1502;
  int camera_port = 8090;
  std::string profile;
  std::string truth;
};

void add_options(CLI::App& app, Options& options) {
  app.add_option("--speedup", options.speedup, "machine seconds in one second of wall time")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--seed", options.seed, "which machine of the series, and its noise")->capture_default_str();
  app.add_option("--host", options.host, "address of the Modbus server")->capture_default_str();
  app.add_option("--port", options.port, "Modbus TCP port; 0 takes a free one")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  app.add_option("--camera-port", options.camera_port, "HTTP port of the cameras; 0 takes a free one")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  app.add_option("--profile", options.profile, "write the connection profile to this file");
  app.add_option("--truth", options.truth, "write what the machine truly does to this CSV file");
}

/// Blocks the signals that end the program in every thread; wait_for_end then takes them.
sigset_t end_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

void wait_for_end(const sigset_t& signals) {
  int signal = 0;
  sigwait(&signals, &signal);
}

Status serve(const Options& options, const sigset_t& signals) {
  TruthLog truth;
  if (!options.truth.empty()) ZD_CHECK(truth.open(options.truth));
  const HiddenEffect hidden;
  LiveMachine machine(build_machine(options.seed, hidden), options.speedup,
                      [&truth](const Machine& now) { truth.moment(now); });
  controller::ModbusServerOptions server_options;
  server_options.host = options.host;
  server_options.port = options.port;
  server_options.read = [&](int address, int count) { return machine.read(address, count); };
  server_options.write = [&](int address, std::span<const std::uint16_t> words) {
    return machine.write(address, words);
  };
  CameraServer cameras(camera_options(options.seed), [&](View view) { return machine.scene(view); });
  ZD_TRY(const int camera_port, cameras.start(options.camera_port));
  machine.start();
  ZD_TRY(const auto server, controller::ModbusServer::start(std::move(server_options)));
  const Endpoints endpoints{options.host, server->port(), camera_port, options.speedup};
  if (!options.profile.empty()) ZD_CHECK(write_json_file(options.profile, connection_profile(endpoints, hidden)));
  fmt::print("ready modbus={} camera=http://127.0.0.1:{}/\n", server->port(), camera_port);
  std::fflush(stdout);
  wait_for_end(signals);
  cameras.stop();
  machine.stop();
  truth.close();
  return {};
}

int run(int argc, char** argv) {
  CLI::App app{"Zerodrift's virtual machine tool"};
  Options options;
  add_options(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  const sigset_t signals = end_signals();
  const Status done = serve(options, signals);
  if (done) return 0;
  fmt::print(stderr, "zerodrift-machine: {}\n", describe(done.error()));
  return 1;
}

}  // namespace
}  // namespace zerodrift::machine

int main(int argc, char** argv) {
  return zerodrift::machine::run(argc, argv);
}
