#pragma once
// What is shipped with the machine: the description its maker would give (zerodrift-machine/1), and the connection
// profile (docs/profile.md). Both are written from the drawing, not from the built machine.

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "app/machine/hidden_effect.h"

namespace zerodrift::machine {

/// The description; it leaves out what is hidden.
nlohmann::json machine_description(const HiddenEffects& hidden);

/// Where the parts of the rig are reached that are devices of their own.
struct RigEndpoints {
  std::string serial_line;  // both temperature modules, units 1 and 2
  int amplifier_port = 0;
  int agent_port = 0;
  std::string broker_host;  // empty: no sensor at a broker
  int broker_port = 0;
  int operator_port = 0;  // 0: the control has a link
};

struct Endpoints {
  std::string host = "127.0.0.1";
  int port = 1502;
  int camera_port = 8090;
  int speedup = 1;
  std::uint32_t serial = 0;  // 0: not written
  std::optional<RigEndpoints> rig = std::nullopt;
};
nlohmann::json connection_profile(const Endpoints& endpoints, const HiddenEffects& hidden);

}  // namespace zerodrift::machine
