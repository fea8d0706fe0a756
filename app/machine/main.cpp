// zerodrift-machine: the virtual machine tool. Modbus TCP server, two cameras, five axes, twenty temperature sensors,
// and physics of its own that the analysis never sees. As a rig, its parts are devices of their own.

#include <fmt/format.h>
#include <pthread.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/machine/camera/camera_server.h"
#include "app/machine/case_writer.h"
#include "app/machine/description.h"
#include "app/machine/faults.h"
#include "app/machine/live_machine.h"
#include "app/machine/pace_input.h"
#include "app/machine/rig/rig_parts.h"
#include "app/machine/truth_log.h"
#include "app/text/error_text.h"
#include "core/base/json.h"
#include "core/controller/modbus_server.h"

namespace zerodrift::machine {
namespace {

struct Options {
  int speedup = 1;
  bool paced = false;
  std::uint64_t seed = 1;
  std::string host = "127.0.0.1";
  int port = 1502;
  int camera_port = 8090;
  std::string profile;
  std::string truth;
  std::string camera_latency;
  double camera_fps = CameraOptions().frames_per_s;
  std::vector<std::string> faults;
  std::string conceal;
  std::string case_folder;
  bool rig = false;
  bool manual = false;  // a rig without a controller
  std::string mqtt_broker;
};

struct CameraLatency {
  double seconds = 0.0;
  double jitter_s = 0.0;
};

/// "0.8" or "0.8:0.4"; nothing for what is neither, or longer than a minute.
std::optional<CameraLatency> parse_latency(const std::string& text) {
  CameraLatency latency;
  const auto number = [](const std::string& word, double& value) {
    return CLI::detail::lexical_cast(word, value) && value >= 0.0 && value <= 60.0;
  };
  const std::size_t colon = text.find(':');
  if (!number(text.substr(0, colon), latency.seconds)) return std::nullopt;
  if (colon != std::string::npos && !number(text.substr(colon + 1), latency.jitter_s)) return std::nullopt;
  return latency;
}

/// "192.168.1.5:1883"; nothing for what has no host or no port.
std::optional<MqttBroker> parse_broker(const std::string& text) {
  MqttBroker broker;
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || colon == 0) return std::nullopt;
  broker.host = text.substr(0, colon);
  if (!CLI::detail::lexical_cast(text.substr(colon + 1), broker.port)) return std::nullopt;
  if (broker.port < 1 || broker.port > 65535) return std::nullopt;
  return broker;
}

void add_options(CLI::App& app, Options& options) {
  app.add_option("--speedup", options.speedup, "machine seconds in one second of wall time")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_flag("--paced", options.paced,
               "take the pace of the clock from standard input, a whole number up to --speedup a line");
  app.add_option("--seed", options.seed, "which machine of the series, and its noise")->capture_default_str();
  app.add_option("--host", options.host, "address of the Modbus server")->capture_default_str();
  app.add_option("--port", options.port, "Modbus TCP port; 0 takes a free one")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  app.add_option("--camera-port", options.camera_port, "HTTP port of the cameras; 0 takes a free one")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  app.add_option("--camera-latency", options.camera_latency,
                 "SECONDS[:JITTER]: how old the cameras' pictures are when they are sent, wall time")
      ->check([](const std::string& text) { return parse_latency(text) ? "" : "SECONDS or SECONDS:JITTER expected"; });
  app.add_option("--camera-fps", options.camera_fps, "pictures a second of wall time")
      ->check(CLI::Range(0.1, 100.0))
      ->capture_default_str();
  app.add_option("--profile", options.profile, "write the connection profile to this file");
  app.add_option("--truth", options.truth, "write what the machine truly does to this CSV file");
  app.add_option("--fault", options.faults, "a fault now and then (NAME) or all the time (NAME:always)");
  app.add_flag("--rig", options.rig,
               "the parts of a rig, each at its own address: control, temperature modules, probe amplifier, agent");
  app.add_flag("--manual", options.manual,
               "a rig whose control has no link: an operator's endpoint instead of the Modbus server");
  app.add_option("--mqtt-broker", options.mqtt_broker, "HOST:PORT: where the rig's wireless sensors publish")
      ->check([](const std::string& text) { return parse_broker(text) ? "" : "HOST:PORT expected"; });
  app.add_option("--conceal", options.conceal, "hide this effect from the machine description, or a random one");
  app.add_option("--write-case", options.case_folder, "write recordings and description there and end");
}

/// Blocks the signals that end the program, in every thread; wait_for_end then takes them.
sigset_t end_signals() {
  sigset_t endings;
  sigemptyset(&endings);
  sigaddset(&endings, SIGTERM);
  sigaddset(&endings, SIGINT);
  pthread_sigmask(SIG_BLOCK, &endings, nullptr);
  return endings;
}

/// Until a signal comes; meanwhile the clock goes at the pace that is named, and the camera's fault is set for the
/// machine time that is near.
void wait_for_end(const sigset_t& endings, const Options& options, const std::vector<Fault>& faults,
                  LiveMachine& machine, CameraServer& cameras) {
  PaceInput input(options.paced ? STDIN_FILENO : -1);
  const timespec at_once{};
  while (sigtimedwait(&endings, nullptr, &at_once) < 0) {
    if (const auto pace = input.wait(std::chrono::milliseconds(50), options.speedup)) machine.set_pace(*pace);
    const CameraFault fault = camera_fault(faults, machine.scene(View::front).machine_time_s, machine.first_turn_s());
    if (fault.kind != CameraFault::Kind::none) cameras.set_fault(fault);
  }
}

Result<std::vector<Fault>> parse_faults(const std::vector<std::string>& texts) {
  std::vector<Fault> faults;
  for (const std::string& text : texts) {
    ZD_TRY(faults.emplace_back(), parse_fault(text));
  }
  return faults;
}

controller::ModbusServerOptions control_options(const Options& options, LiveMachine& machine, ReplyFaults& faults) {
  controller::ModbusServerOptions control;
  control.host = options.host;
  control.port = options.port;
  control.read = [&machine](int address, int count) { return machine.read(address, count); };
  control.write = [&machine](int address, std::span<const std::uint16_t> words) {
    return machine.write(address, words);
  };
  control.fault = [&faults](bool) { return faults.next(); };
  return control;
}

CameraOptions camera_settings(const Options& options) {
  CameraOptions how = camera_options(options.seed);
  const CameraLatency latency = parse_latency(options.camera_latency).value_or(CameraLatency{});
  how.latency_s = latency.seconds;
  how.latency_jitter_s = latency.jitter_s;
  how.frames_per_s = options.camera_fps;
  return how;
}

/// One line: every address that is served.
std::string ready_line(const Endpoints& endpoints) {
  const bool manual = endpoints.rig && endpoints.rig->operator_port != 0;
  std::string line = manual ? "ready" : fmt::format("ready modbus={}", endpoints.port);
  line += fmt::format(" camera=http://127.0.0.1:{}/", endpoints.camera_port);
  if (!endpoints.rig) return line;
  const RigEndpoints& rig = *endpoints.rig;
  line += fmt::format(" rtu={} amplifier={} mtconnect=http://127.0.0.1:{}/", rig.serial_line, rig.amplifier_port,
                      rig.agent_port);
  if (!rig.broker_host.empty()) line += fmt::format(" mqtt={}:{}", rig.broker_host, rig.broker_port);
  if (manual) line += fmt::format(" operator=http://127.0.0.1:{}/", rig.operator_port);
  return line;
}

Status serve(const Options& options, const HiddenEffects& hidden, const sigset_t& endings) {
  ZD_TRY(const std::vector<Fault> faults, parse_faults(options.faults));
  const bool parts = options.rig || options.manual;
  TruthLog truth;
  if (!options.truth.empty()) ZD_CHECK(truth.open(options.truth));
  ReplyFaults reply_faults(faults);
  LiveMachine machine(
      build_machine(options.seed, hidden), options.speedup, [&truth](const Machine& now) { truth.moment(now); },
      parts ? RegisterScope::control_alone : RegisterScope::whole_machine);
  machine.set_sensor_fault(sensor_fault(faults));
  CameraServer cameras(camera_settings(options), [&](View view) { return machine.scene(view); });
  ZD_TRY(const int camera_port, cameras.start(options.camera_port));
  Endpoints endpoints{options.host, 0, camera_port, options.speedup, machine.serial()};
  std::unique_ptr<controller::ModbusServer> control;
  if (!options.manual) {
    ZD_TRY(control, controller::ModbusServer::start(control_options(options, machine, reply_faults)));
    endpoints.port = control->port();
  }
  std::unique_ptr<RigParts> rig;
  if (parts) {
    ZD_TRY(rig, RigParts::start(machine, {1.0 / options.speedup, parse_broker(options.mqtt_broker), options.manual}));
    endpoints.rig = rig->endpoints();
  }
  if (!options.profile.empty()) ZD_CHECK(write_json_file(options.profile, connection_profile(endpoints, hidden)));
  machine.start();
  fmt::print("{}\n", ready_line(endpoints));
  std::fflush(stdout);
  wait_for_end(endings, options, faults, machine, cameras);
  rig.reset();
  control.reset();
  cameras.stop();
  machine.stop();
  truth.close();
  return {};
}

/// What is hidden is promised on stderr before and opened there at the end; stdout holds the line "ready" alone.
Status work(const Options& options, const sigset_t& endings) {
  if (!options.mqtt_broker.empty() && !options.rig && !options.manual) {
    return fail(ErrorCode::bad_argument,
                {{"what", "--mqtt-broker"}, {"found", "alone"}, {"expected", "--rig or --manual with it"}});
  }
  ZD_TRY(const HiddenEffects hidden, draw_effect(options.conceal, options.seed));
  if (!options.case_folder.empty()) return write_case(options.case_folder, hidden, options.seed);
  if (options.conceal.empty()) return serve(options, hidden, endings);
  const Commitment commitment = commit_to(hidden);
  fmt::print(stderr, "concealed sha256={}\n", commitment.sha256);
  ZD_CHECK(serve(options, hidden, endings));
  fmt::print(stderr, "opened salt={} answer={}\n", commitment.salt, commitment.answer);
  return {};
}

int run(int argc, char** argv) {
  CLI::App app{"Zerodrift's virtual machine tool"};
  app.set_version_flag("--version", ZERODRIFT_VERSION);
  Options options;
  add_options(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  const sigset_t endings = end_signals();
  const Status done = work(options, endings);
  if (done) return 0;
  fmt::print(stderr, "zerodrift-machine: {}\n", lineOf(done.error()).toStdString());
  return done.error().code == ErrorCode::bad_argument ? 2 : 1;
}

}  // namespace
}  // namespace zerodrift::machine

int main(int argc, char** argv) {
  return zerodrift::machine::run(argc, argv);
}
