#include "core/recording/import/column_names.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "core/recording/import/cells.h"
#include "core/recording/recording.h"

namespace zerodrift::recording {
namespace {

std::string lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

bool holds_any(const std::string& lower, std::initializer_list<const char*> words) {
  return std::any_of(words.begin(), words.end(),
                     [&](const char* word) { return lower.find(word) != std::string::npos; });
}

/// The part of a channel's name before its unit: letters and digits of any script; all else is one underscore.
std::string tidy(std::string_view name) {
  std::string out;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    const bool kept = byte >= 0x80 || std::isalnum(byte) != 0 || c == '-' || c == '.' || c == '+';
    if (kept) {
      out += c;
    } else if (!out.empty() && out.back() != '_') {
      out += '_';
    }
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out;
}

/// "dZ", "dx1": a displacement along an axis.
bool is_delta_of_axis(std::string_view name) {
  return name.size() >= 2 && name.size() <= 3 && (name[0] == 'd' || name[0] == 'D') &&
         std::string_view("XYZABCUVWxyzabcuvw").find(name[1]) != std::string_view::npos;
}

/// A length that is an error of the machine: what probes measure, not where an axis is.
bool is_displacement(const std::string& name, const std::string& label) {
  for (const std::string& text : {name, label}) {
    if (is_delta_of_axis(text)) return true;
    if (holds_any(lower_case(text), {"probe", "error", "deviation", "drift", "displacement", "growth", "eddy", "lvdt",
                                     "capacitive", "taster", "abweichung", "verlagerung", "fehler", "sonde", "位移",
                                     "误差", "偏差", "热变形", "探头"})) {
      return true;
    }
  }
  return false;
}

/// A difference of temperatures: kelvin without the zero of the scale.
bool is_difference(const std::string& name) {
  const std::string lower = lower_case(name);
  return holds_any(lower, {"delta", "diff", "rise", "gradient", "Δ", "δ", "温差", "温升"}) || lower.starts_with("dt") ||
         lower.starts_with("d_t");
}

bool same_unit(const Unit& a, const Unit& b) {
  return a.quantity == b.quantity && std::abs(a.scale - b.scale) < 1e-12 * std::abs(b.scale) &&
         std::abs(a.offset - b.offset) < 1e-9;
}

/// "dZ_mm" of a channel in um: the other unit that a name has in it. A letter after an underscore is a name: "T_F".
std::string other_unit_in(const std::string& name, const std::optional<Unit>& unit) {
  const std::string inner = split_unit(name).unit;
  const auto other = unit_from(inner);
  const bool one = other && unit && inner.size() > 1 && other->quantity == unit->quantity;
  return one && !same_unit(*other, *unit) ? inner : std::string();
}

tl::unexpected<Error> conflict(const std::string& header, const std::string& unit, const std::string& other,
                               const std::string& file) {
  return fail(ErrorCode::unit_conflict, {{"file", file}, {"column", header}, {"found", unit}, {"expected", other}});
}

}  // namespace

std::optional<Unit> unit_of_channel(std::string_view channel) {
  const ChannelKind kind = kind_of(channel);
  if (kind == ChannelKind::coolant) return std::nullopt;
  const std::string unit = kind == ChannelKind::input ? split_unit(channel).unit : std::string(unit_of(kind));
  auto found = unit_from(unit);
  if (!found || found->quantity == Quantity::other || found->quantity == Quantity::time) return std::nullopt;
  return found;
}

Result<NamedChannel> channel_from(const std::string& header, const std::string& label, const StatedUnit& stated,
                                  std::size_t place, const std::string& file) {
  if (kind_of(header) != ChannelKind::input) {  // in the contract's form already
    const auto own = unit_of_channel(header);
    const auto other = unit_from(stated.unit);
    if (own && other && !stated.unit.empty() && !same_unit(*own, *other)) {
      return conflict(header, stated.unit, header, file);
    }
    const std::string inner = other_unit_in(header.substr(0, header.size() - unit_of(kind_of(header)).size() - 1), own);
    if (!inner.empty()) return conflict(header, inner, header, file);
    return NamedChannel{header, 1.0, 0.0};
  }
  const NameWithUnit split = split_unit(header);
  const bool by_underscore = !split.unit.empty() && header == split.name + "_" + header.substr(split.name.size() + 1) &&
                             header.size() > split.name.size() && header[split.name.size()] == '_';
  std::string unit_text = split.unit;
  std::string name = split.name;
  if (const auto whole = unit_from(header); header.size() > 1 && whole && whole->quantity == Quantity::temperature) {
    unit_text = header;  // "°C" and no name
    name.clear();
  }
  if (!stated.unit.empty()) {
    const auto own = unit_from(split.unit);
    const auto other = unit_from(stated.unit);
    if (own && other && !same_unit(*own, *other)) return conflict(header, stated.unit, split.unit, file);
    unit_text = stated.unit;
  }
  const auto unit = unit_from(unit_text);
  const NamedChannel as_it_is{header.empty() ? "column_" + std::to_string(place) : header, 1.0, 0.0};
  if (!unit || unit->quantity == Quantity::other || unit->quantity == Quantity::time) return as_it_is;
  std::string base = tidy(name);
  if (base.empty()) base = "column_" + std::to_string(place);
  if (const std::string inner = other_unit_in(base, unit); !inner.empty()) {
    return conflict(header, unit_text, inner, file);
  }
  if (unit->quantity == Quantity::length && unit->scale != 1.0 && !is_displacement(split.name, label)) return as_it_is;
  if (unit->quantity == Quantity::temperature && is_difference(split.name)) return as_it_is;
  const ChannelKind kind = kind_of(base);
  if (kind != ChannelKind::input && kind != ChannelKind::coolant) {  // "T1_C (degC)"
    const auto own = unit_of_channel(base);
    if (own && !same_unit(*own, *unit)) return conflict(header, unit_text, base, file);
    return NamedChannel{base, 1.0, 0.0};
  }
  const NamedChannel converted{base + "_" + std::string(unit->suffix), unit->scale, unit->offset};
  // A free input that carries its unit in its name ("pump_kW") is known by that name elsewhere.
  if (by_underscore && stated.unit.empty() && kind_of(converted.channel) == ChannelKind::input) return as_it_is;
  return converted;
}

std::string proposal_for(const std::string& header, const std::string& label, const std::string& channel,
                         const std::optional<Unit>& unit) {
  const ChannelKind kind = kind_of(channel);
  const std::string lower = lower_case(header + " " + label);
  std::string joined = lower;
  std::replace(joined.begin(), joined.end(), ' ', '_');
  const auto is_known = [](ChannelKind k) { return k == ChannelKind::speed || k == ChannelKind::ambient; };
  if (is_known(kind) || kind == ChannelKind::coolant || kind == ChannelKind::load || kind == ChannelKind::feed)
    return {};
  if (kind == ChannelKind::temperature) {
    const bool room = holds_any(lower, {"ambient", "room", "air", "umgebung", "raum", "halle", "室温", "环境"});
    return room ? "ambient_C" : "";
  }
  if (kind == ChannelKind::error) {
    if (is_delta_of_axis(channel.substr(0, channel.size() - 3))) return {};
    for (const char axis : {'x', 'y', 'z'}) {
      const std::string sign(1, axis);
      const bool named = lower.find(" " + sign + " ") != std::string::npos ||
                         (lower + " ").find(" " + sign + " ") != std::string::npos ||
                         lower.find("_" + sign + "_") != std::string::npos || lower.starts_with(sign + " ") ||
                         lower.find("d" + sign + " ") != std::string::npos ||
                         lower.find("_" + sign + " ") != std::string::npos;
      if (named) return std::string("d") + static_cast<char>(std::toupper(axis)) + "_um";
    }
    return {};
  }
  if (kind == ChannelKind::tilt) return {};
  const bool speed_unit = unit && unit->quantity == Quantity::speed;
  if (speed_unit || holds_any(joined, {"spindle_speed", "rpm", "drehzahl", "主轴转速", "转速"})) {
    return "spindle_rpm";
  }
  if (holds_any(lower, {"coolant", "kühlmittel", "kuehlmittel", "冷却"})) return "coolant_on";
  if (unit && unit->quantity == Quantity::power && holds_any(lower, {"spindle", "spindel", "主轴", "load", "last"})) {
    return "spindle_load_W";
  }
  if (unit && unit->quantity == Quantity::length) return tidy(split_unit(header).name) + "_um";
  if (unit && unit->quantity == Quantity::temperature) return tidy(split_unit(header).name) + "_C";
  const bool temperature =
      holds_any(lower, {"temp", "thermo", "therm", "温度", "pt100", "degree"}) ||
      (lower.size() > 2 && lower[0] == 't' && std::isdigit(static_cast<unsigned char>(lower[1])) != 0);
  return temperature && !unit ? tidy(split_unit(header).name) + "_C" : "";
}

}  // namespace zerodrift::recording
