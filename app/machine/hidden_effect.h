#pragma once
// Effects that can be left in the truth while the shipped machine description does not know them. One table holds name,
// range and size of each; the ids are those of the contract.

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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
/// What a machine may do and no library of effects lists; never drawn as "random".
std::span<const ConcealableEffect> unlisted_effects();

/// One effect, drawn: only the fields that its id uses mean something.
struct HiddenEffect {
  std::string id;  // empty: nothing hidden
  double size = 0.0;
  double position_mm = 0.0;
  int sensor = 0;   // 1 to 20
  std::string law;  // extra_heat_source: "on", "n", "n2"
  double time_constant_s = 0.0;
  double from_s = 0.0;   // effects with a beginning
  double from_um = 0.0;  // slack: the growth at which it jumps

  bool is(std::string_view name) const { return id == name; }
};

/// What one machine hides: nothing, one effect or several.
class HiddenEffects {
 public:
  HiddenEffects() = default;
  HiddenEffects(HiddenEffect one) {
    if (!one.id.empty()) m_list.push_back(std::move(one));
  }
  explicit HiddenEffects(std::vector<HiddenEffect> list) : m_list(std::move(list)) {}

  const std::vector<HiddenEffect>& list() const { return m_list; }
  /// Null when that effect is not hidden here.
  const HiddenEffect* find(std::string_view name) const;
  bool is(std::string_view name) const { return find(name) != nullptr; }
  /// The size of that effect, 0 when it is not hidden here.
  double size_if(std::string_view name) const;

 private:
  std::vector<HiddenEffect> m_list;
};

/// Draws the sizes of the named effect, or also the effect for "random"; "none" hides nothing.
Result<HiddenEffect> draw_effect(const std::string& name, unsigned long long seed);
/// {"id": "none"}, the one effect, or {"effects": [...]}.
nlohmann::json to_json(const HiddenEffects& hidden);

/// A promise that can be checked later: SHA-256 of salt and answer, hexadecimal.
struct Commitment {
  std::string salt;
  std::string answer;  // JSON text
  std::string sha256;
};
Commitment seal(std::string answer);
Commitment commit_to(const HiddenEffects& hidden);

}  // namespace zerodrift::machine
