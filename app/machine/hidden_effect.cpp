#include "app/machine/hidden_effect.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <random>

#include "core/base/hash.h"
#include "core/base/json.h"
#include "core/base/noise.h"

namespace zerodrift::machine {
namespace {

constexpr std::array effects{
    ConcealableEffect{"convection", "film_W_m2K", 11, 17, false, false,
                      "the film on the cartridge; the description has none"},
    ConcealableEffect{"speed_convection", "film_at_top_speed_W_m2K", 15, 40, false, false,
                      "more film on the cartridge, growing with (n / 8000 rpm)^0.7"},
    ConcealableEffect{"radiation", "emissivity", 0.6, 0.95, false, false,
                      "a painted cartridge instead of a bright one (0.08)"},
    ConcealableEffect{"coolant", "film_W_m2K", 25, 80, false, false,
                      "the coolant washes the front half of the cartridge while it is on"},
    ConcealableEffect{"bearing_viscosity", "per_K", 0.015, 0.035, false, false,
                      "the oil thins: viscosity falls by exp(-k (T - start)) in both bearings"},
    ConcealableEffect{"bearing_preload", "per_K", 0.03, 0.07, false, false,
                      "the preload grows by k (T - start) in both bearings"},
    ConcealableEffect{"extra_heat_source", "power_at_3000_rpm_W", 10, 28, true, false,
                      "a rubbing seal or a bad winding: on with rotation, with n or with n^2"},
    ConcealableEffect{"contact_resistance", "resistance_m2K_W", 1e-2, 2.5e-2, true, false,
                      "a joint across shaft and housing that conducts badly"},
    ConcealableEffect{"structure_ambient", "um_per_K", 2.5, 5, false, false,
                      "the structure follows the room and moves the nose in Z"},
    ConcealableEffect{"structure_bending", "um_per_K", 3, 8, false, false,
                      "dY follows the temperature difference front - rear of the housing"},
    ConcealableEffect{"sensor_lag", "time_constant_s", 150, 600, false, true, "a sensor with bad contact"},
    ConcealableEffect{"sensor_offset", "offset_C", 0.6, 1.4, false, true, "a sensor that reads wrong by a constant"},
    ConcealableEffect{"cutting_heat", "fraction", 0.03, 0.08, false, false,
                      "a part of the spindle load enters at the nose"},
    ConcealableEffect{"draught", "film_W_m2K", 10, 25, false, false,
                      "from some moment a door is open: more film on the cartridge"},
    ConcealableEffect{"bearing_run_in", "fraction", 0.4, 0.9, false, false,
                      "friction of both bearings starts higher by this part and settles"},
    ConcealableEffect{"bracket_slip", "step_um", 4, 10, false, false, "the bracket slips once: a step in dZ"},
    ConcealableEffect{"standing_heat", "power_W", 8, 20, true, false, "a heat that is there at rest as well"},
    ConcealableEffect{"sensor_gain", "fraction", 0.05, 0.15, false, true, "a sensor that reads its rise too large"},
};

constexpr std::array unlisted{
    ConcealableEffect{"unlisted:wandering_heat", "power_W", 15, 45, true, false,
                      "a heat that comes and goes by itself, whatever the machine does"},
    ConcealableEffect{"unlisted:slack", "step_um", 4, 10, false, false,
                      "dZ jumps by this much, softly, whenever the spindle's growth passes a certain length"},
    ConcealableEffect{"unlisted:creep", "um", 2, 5, false, false, "the nest settles: dZ follows ln(1 + t / 900 s)"},
};

const ConcealableEffect* find_entry(const std::string& id) {
  for (const auto table : {std::span<const ConcealableEffect>(effects), std::span<const ConcealableEffect>(unlisted)}) {
    for (const ConcealableEffect& entry : table) {
      if (entry.id == id) return &entry;
    }
  }
  return nullptr;
}

std::string all_names() {
  std::string names = "random, none";
  for (const ConcealableEffect& effect : effects) names += fmt::format(", {}", effect.id);
  return names;
}

}  // namespace

std::span<const ConcealableEffect> concealable_effects() {
  return effects;
}

std::span<const ConcealableEffect> unlisted_effects() {
  return unlisted;
}

const HiddenEffect* HiddenEffects::find(std::string_view name) const {
  const auto at = std::find_if(m_list.begin(), m_list.end(), [&](const auto& effect) { return effect.is(name); });
  return at == m_list.end() ? nullptr : &*at;
}

double HiddenEffects::size_if(std::string_view name) const {
  const HiddenEffect* effect = find(name);
  return effect == nullptr ? 0.0 : effect->size;
}

Result<HiddenEffect> draw_effect(const std::string& name, unsigned long long seed) {
  HiddenEffect drawn;
  if (name.empty() || name == "none") return drawn;
  Noise noise(seed * 0x9E3779B97F4A7C15ULL + 77);
  const ConcealableEffect* effect = name == "random" ? &effects[noise.index(effects.size())] : find_entry(name);
  if (effect == nullptr) {
    return fail(ErrorCode::bad_argument, {{"what", "--conceal"}, {"found", name}, {"expected", all_names()}});
  }
  drawn.id = effect->id;
  drawn.size = noise.uniform(effect->low, effect->high);
  if (drawn.is("contact_resistance")) drawn.position_mm = noise.uniform(200, 300);  // where heat flows along
  if (drawn.is("sensor_offset") && noise.uniform() < 0.5) drawn.size = -drawn.size;
  if (effect->has_position) drawn.position_mm = noise.uniform(60, 300);
  if (effect->has_sensor) drawn.sensor = 1 + static_cast<int>(noise.index(5));  // the five of the spindle
  constexpr std::array laws{"on", "n", "n2"};
  if (drawn.is("extra_heat_source")) drawn.law = laws[noise.index(laws.size())];
  if (drawn.is("unlisted:creep") && noise.uniform() < 0.5) drawn.size = -drawn.size;
  if (drawn.is("unlisted:slack")) drawn.from_um = noise.uniform(8, 20);
  const bool lags = drawn.is("structure_ambient") || drawn.is("structure_bending") || drawn.is("bearing_run_in");
  if (lags)
    drawn.time_constant_s = drawn.is("structure_ambient") ? noise.uniform(2400, 7200) : noise.uniform(600, 3000);
  if (drawn.is("draught") || drawn.is("bracket_slip")) drawn.from_s = noise.uniform(4800, 10000);
  return drawn;
}

namespace {

nlohmann::json json_of(const HiddenEffect& effect) {
  const ConcealableEffect* entry = find_entry(effect.id);
  nlohmann::json out = {{"id", effect.id}, {"parameters", {{std::string(entry->size_name), effect.size}}}};
  if (entry->has_position || effect.is("contact_resistance")) out["position_mm"] = effect.position_mm;
  if (entry->has_sensor) out["channel"] = fmt::format("T{}_C", effect.sensor);
  if (!effect.law.empty()) out["parameters"]["law"] = effect.law;
  if (effect.time_constant_s > 0) out["parameters"]["time_constant_s"] = effect.time_constant_s;
  if (effect.from_s > 0) out["parameters"]["from_s"] = effect.from_s;
  if (effect.from_um > 0) out["parameters"]["from_um"] = effect.from_um;
  return out;
}

}  // namespace

nlohmann::json to_json(const HiddenEffects& hidden) {
  if (hidden.list().empty()) return {{"id", "none"}};
  if (hidden.list().size() == 1) return json_of(hidden.list().front());
  nlohmann::json several = nlohmann::json::array();
  for (const HiddenEffect& effect : hidden.list()) several.push_back(json_of(effect));
  return {{"effects", several}};
}

Commitment seal(std::string answer) {
  // The salt must not follow from the seed, or the answer could be guessed by trying the table.
  std::random_device source;
  Commitment commitment;
  for (int i = 0; i < 4; ++i) commitment.salt += fmt::format("{:08x}", source());
  commitment.answer = std::move(answer);
  commitment.sha256 = sha256_hex(commitment.salt + commitment.answer);
  return commitment;
}

Commitment commit_to(const HiddenEffects& hidden) {
  return seal(json_text(to_json(hidden)));
}

}  // namespace zerodrift::machine
