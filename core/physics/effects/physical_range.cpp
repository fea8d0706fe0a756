#include "core/physics/effects/physical_range.h"

#include <array>

namespace zerodrift::physics {
namespace {

constexpr NumberRange share_of_one{0.0, 1.0, false, "a share from 0 to 1"};
constexpr NumberRange tilt_of_film{-2.0, 2.0, false, "-2 to 2: beyond it one end's film would be negative"};
constexpr NumberRange more_than_nothing_left{-1.0, 1e300, false, "a share of -1 or more: -1 takes all away"};
constexpr NumberRange liquid_temperature{-273.15, 1e4, false, "degrees Celsius, above absolute zero"};

struct RangeRule {
  std::string_view key;
  NumberRange range;
};

constexpr std::array range_rules = {
    RangeRule{"h_W_m2K", not_negative},
    RangeRule{"end_h_W_m2K", not_negative},
    RangeRule{"nose_h_W_m2K", not_negative},
    RangeRule{"a_W_m2K", not_negative},
    RangeRule{"exponent", not_negative},
    RangeRule{"conductance_W_K", not_negative},
    RangeRule{"resistance_m2K_W", not_negative},
    RangeRule{"half_width_mm", not_negative},
    RangeRule{"contact_W_K", positive},
    RangeRule{"emissivity", share_of_one},
    RangeRule{"share", share_of_one},
    RangeRule{"inner_heat_share", share_of_one},
    RangeRule{"follows_room", share_of_one},
    RangeRule{"film_tilt", tilt_of_film},
    RangeRule{"beta_1_K", not_negative},
    RangeRule{"constant_share", more_than_nothing_left},
    RangeRule{"excess_share", more_than_nothing_left},
    RangeRule{"lag_s", not_negative},
    RangeRule{"second_lag_s", not_negative},
    RangeRule{"room_lag_s", positive},
    RangeRule{"period_s", positive},
    RangeRule{"temperature_C", liquid_temperature},
};

}  // namespace

NumberRange physical_range(std::string_view effect, std::string_view key) {
  if (key.ends_with("_prior_sigma")) return not_negative;
  // A body before a heater may be too small to count; a core behind a surface without a capacity has no temperature.
  if (key == "heat_capacity_J_K") return effect == "casting_core" ? positive : not_negative;
  for (const RangeRule& rule : range_rules) {
    if (rule.key == key) return rule.range;
  }
  return any_number;
}

}  // namespace zerodrift::physics
