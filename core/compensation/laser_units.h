#pragma once
// Units as the headers of axis tables write them: "Error (um)", "error_um", "Abweichung / µm", "误差（微米）",
// "Error (0.0001\")". Shared by the readers of laser reports; not for others.

#include <optional>
#include <string>
#include <string_view>

namespace zerodrift::compensation::laser_parts {

enum class UnitKind {
  length,
  angle,
  other,  // %, C, hPa, mm/min ...: no length and no angle
};

struct Unit {
  UnitKind kind = UnitKind::length;
  double mm = 1.0;   // of one, when it is a length
  std::string name;  // as the file has it
};

/// "mm", "microinch", "mil", "0.0001\"", "1/1000 mm"; nothing for what is no unit known here.
std::optional<Unit> unit_of(std::string_view text);

struct NameAndUnit {
  std::string name;  // without its unit
  std::optional<Unit> unit;
};
NameAndUnit split_unit(std::string_view header);

/// ASCII in lower case, umlauts as two letters, brackets, signs and blanks of other scripts as those of ASCII.
std::string normalised(std::string_view text);

}  // namespace zerodrift::compensation::laser_parts
