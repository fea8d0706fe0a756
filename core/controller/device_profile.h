#pragma once
// The devices of a profile (docs/profile.md): what each one is, where it is reached, and which of its signals is which
// quantity of the machine.

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace zerodrift::controller {

enum class LinkKind {
  tcp,
  rtu,
};

struct ControllerSettings {
  LinkKind kind = LinkKind::tcp;
  std::string host = "127.0.0.1";
  int port = 502;
  std::string device;  // RTU: serial port
  int baud = 19200;
  char parity = 'E';  // N, E, O
  int stop_bits = 1;
  int unit = 1;
  int timeout_ms = 1000;
  std::string register_map = "zerodrift-virtual";  // name of a shipped map, or a path
  std::shared_ptr<const nlohmann::json> own_map;   // the map itself, where a profile carries it (in a job)
  int chunk_registers = 64;                        // registers a write when a table is staged; 8 to 123
};

enum class DeviceKind {
  modbus,     // "modbus-tcp", "modbus-rtu": modbus holds the link
  mqtt,       // host, port, TLS; signals are "topic" or "topic#/json/pointer"
  mtconnect,  // url; signals are data item ids
};

struct DeviceProfile {
  std::string id;
  DeviceKind kind = DeviceKind::modbus;
  ControllerSettings modbus;
  std::string file;              // of the profile: relative paths are beside it
  bool of_job = false;           // files that it names are not read
  double poll_period_s = 1.0;    // host time from one reading to the next
  double stale_after_s = 10.0;   // host time after which a value that was not renewed is missing
  int timeout_ms = 1000;         // until an answer is missed
  std::string host;              // mqtt
  int port = 1883;               // mqtt
  bool tls = false;              // mqtt
  std::string ca_file;           // mqtt: the broker's authority; empty: the system's
  std::string credentials_file;  // mqtt, mtconnect: {"user": ..., "password": ...}, never a part of the profile
  std::string url;               // mtconnect: the agent, "http://host:5000/"
};

/// Where a quantity is read: a device of the profile, and the signal in the device's own words: a register and, of
/// several values, which one, from 1 ("temperature_C[3]"), "topic#/json/pointer", or a data item's id.
struct SignalSource {
  std::string device;  // empty: the control
  std::string signal;
};

}  // namespace zerodrift::controller
