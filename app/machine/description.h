#pragma once
// What is shipped with the machine: the description its maker would give (zerodrift-machine/1), and the connection
// profile (docs/profile.md). Both are written from the drawing, not from the built machine.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "app/machine/hidden_effect.h"

namespace zerodrift::machine {

/// The description; it leaves out what is hidden.
nlohmann::json machine_description(const HiddenEffects& hidden);

struct Endpoints {
  std::string host = "127.0.0.1";
  int port = 1502;
  int camera_port = 8090;
  int speedup = 1;
};
nlohmann::json connection_profile(const Endpoints& endpoints, const HiddenEffects& hidden);

}  // namespace zerodrift::machine
