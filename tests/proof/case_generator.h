#pragma once
// Concealed cases for the proof: a spindle in two dimensions (radius and length), stepped explicitly by the midpoint
// rule - another discretisation and another integrator than core/physics, sharing none of it - with machine parameters
// off by the tolerances, sensors with noise, steps, offsets, gaps and spikes, and hidden effects.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/proof/strength.h"
#include "core/recording/recording.h"

namespace zerodrift::proof {

struct HiddenEffect {
  std::string id;  // of the contract, or "unlisted:..." for what no library has
  double position_mm = -1.0;
  std::string channel;
  std::string law = {};  // of an extra heat source
  double heat_W = 0.0;   // of the coolant in the first recording, on average while it flows
};

struct Case {
  std::string name;
  nlohmann::json machine;                        // what the user has: nominal
  std::vector<recording::Recording> recordings;  // [0] to diagnose, [1] held out
  std::vector<recording::Recording> clean;       // the same without noise: the floor
  std::vector<HiddenEffect> hidden;
  std::string worst_channel;  // where the hidden effects change the reading most, in noise widths
};

/// Effects are sized by `rule` (strength.h); figures up to seed 1099008760 and tests that repeat those cases are `raw`.
/// `kind`: an effect's id, "none", "pair", "unlisted"; "" draws one as the mixture of the proof does.
Case make_case(std::uint64_t seed, const std::string& kind = "", StrengthRule rule = StrengthRule::raw);

}  // namespace zerodrift::proof
