#pragma once
// Units as people write them, and how each becomes the unit that a channel's name carries in the contract's form.

#include <optional>
#include <string>
#include <string_view>

namespace zerodrift::recording {

enum class Quantity { temperature, length, angle, speed, feed, power, time, other };

/// value in the contract's unit = scale * value in this unit + offset.
struct Unit {
  Quantity quantity = Quantity::other;
  std::string_view suffix;  // of a channel in the contract's unit: "C", "um", "urad", "rpm", "mm_min", "W", "s"; or ""
  double scale = 1.0;
  double offset = 0.0;
};

/// "degF", "°F", "[mm]", "(µm)", "1/min", ...; nothing for a word that is no unit. Units that the contract has no form
/// for (V, %, bar) are Quantity::other. Case counts where units differ by it.
std::optional<Unit> unit_from(std::string_view text);
bool is_unit_word(std::string_view text);

/// The name of a column without the unit in it: "Temp 1 (degC)", "T / °C", "n [1/min]", "Temp, °C (SEN S/N: 1)",
/// "T1_F".
struct NameWithUnit {
  std::string name;
  std::string unit;  // as written; empty: none
};
NameWithUnit split_unit(std::string_view header);

/// A factor that the values of a column with this heading are to be multiplied or divided by: "x10" of "dZ_um x10",
/// "0.1" of "T1 [0.1 °C]", "1/100" of "dX (1/100 mm)", "10^-3"; "" where the heading has none.
std::string factor_in(std::string_view heading);

}  // namespace zerodrift::recording
