#pragma once
// Effects that can be left in the truth while the shipped machine description does not know them. One table holds name,
// range and size of each; the ids are those of the contract.

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace zerodrift::machine {

struct ConcealableEffect {
  std::string_view id;
  std::string_view size_name;  // with its unit
  double low;
  double high;
  bool has_position;  // position_mm along the spindle
  bool has_sensor;    // a temperature channel
  std::string_view words;
};

/// The table; "none" is not in it.
std::span<const ConcealableEffect> concealable_effects();

/// One effect, drawn: only the fields that its id uses mean something.
struct HiddenEffect {
  std::string id;  // empty: nothing hidden
  double size = 0.0;
  double position_mm = 0.0;
  int sensor = 0;   // 1 to 20
  std::string law;  // extra_heat_source: "on", "n", "n2"
  double time_constant_s = 0.0;
  double from_s = 0.0;  // effects with a beginning

  bool is(std::string_view name) const { return id == name; }
  /// The size when the id is this one, else 0.
  double size_if(std::string_view name) const { return is(name) ? size : 0.0; }
};

/// Draws the sizes of the named effect, or also the effect for "random"; "none" hides nothing.
Result<HiddenEffect> draw_effect(const std::string& name, unsigned long long seed);
nlohmann::json to_json(const HiddenEffect& effect);

/// A promise that can be checked later: SHA-256 of salt and answer, hexadecimal.
struct Commitment {
  std::string salt;
  std::string answer;  // JSON text
  std::string sha256;
};
Commitment commit_to(const HiddenEffect& effect);

}  // namespace zerodrift::machine
