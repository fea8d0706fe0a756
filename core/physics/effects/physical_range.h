#pragma once
// What physics forbids for the parameters of effects: a film that heats the warmer side, a negative time or capacity.
// Unusual values are none of its business. Keys carry quantity and unit, so one key means the same in every effect.

#include <string_view>

#include "core/base/json.h"

namespace zerodrift::physics {

/// any_number where nothing is forbidden: a negative power cools, a displacement has either sign.
NumberRange physical_range(std::string_view effect, std::string_view key);

}  // namespace zerodrift::physics
