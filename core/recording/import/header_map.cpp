#include "core/recording/import/header_map.h"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "core/base/json.h"
#include "core/recording/import/units.h"

namespace zerodrift::recording {
namespace {

constexpr NumberRange scale_range{-1e12, 1e12, false, "a number other than 0"};

std::string place_of(std::size_t column) {
  return "#" + std::to_string(column + 1);
}

ColumnRule rule_from(JsonObject& object) {
  ColumnRule rule;
  rule.channel = object.text("channel");
  if (rule.channel.empty()) object.reject("channel", "\"\"", "a channel's name, for example T1_C");
  rule.scale = object.number_if("scale", scale_range);
  if (rule.scale && *rule.scale == 0.0) object.reject("scale", "0", "a number other than 0");
  rule.offset = object.number_if("offset");
  rule.unit = object.text_or("unit", "");
  if (!rule.unit.empty() && !rule.scale && !is_unit_word(rule.unit)) {
    object.reject("unit", rule.unit, "a known unit (degC, degF, K, um, mm, inch, rpm, kW), or a scale beside it");
  }
  rule.axis = object.text_or("axis", "");
  const std::string kind = rule.channel.ends_with("_um") ? "XYZ" : rule.channel.ends_with("_urad") ? "AB" : "";
  if (!rule.axis.empty() && (rule.axis.size() != 1 || kind.find(rule.axis) == std::string::npos)) {
    object.reject("axis", rule.axis, "X, Y or Z of a channel in um; A or B of one in urad");
  }
  rule.location = object.text_or("location", "");
  return rule;
}

TimeRule time_from(JsonObject& object) {
  TimeRule rule;
  if (const auto* column = object.raw("column"); column != nullptr && column->is_array()) {
    rule.columns = object.texts_or_empty("column");
  } else if (const std::string name = object.text_or("column", ""); !name.empty()) {
    rule.columns = {name};
  }
  if (rule.columns.size() > 2) object.reject("column", "more than two", "one column, or date and time of day");
  rule.format = object.text_or("format", "");
  rule.unit = object.text_or("unit", "");
  if (const auto unit = unit_from(rule.unit); !rule.unit.empty() && (!unit || unit->quantity != Quantity::time)) {
    object.reject("unit", rule.unit, "s, ms, us, ns, min, h or d");
  }
  return rule;
}

TableOptions table_from(JsonObject& object) {
  TableOptions table;
  table.encoding = object.text_or("encoding", "");
  table.separator = object.text_or("separator", "");
  if (table.separator.size() > 1 && table.separator != "tab" && table.separator != "blanks") {
    object.reject("separator", table.separator, "one character, tab or blanks");
  }
  table.decimal = object.text_or("decimal", "");
  if (!table.decimal.empty() && table.decimal != "." && table.decimal != ",") {
    object.reject("decimal", table.decimal, "\".\" or \",\"");
  }
  return table;
}

HeaderMap map_from(JsonObject& root) {
  HeaderMap map;
  if (JsonObject* columns = root.object_if("columns")) {
    for (const std::string& name : columns->keys()) {
      if (columns->has(name)) {
        map.columns.emplace(name, rule_from(columns->object(name)));
      } else {
        columns->raw(name);
        map.columns.emplace(name, std::nullopt);
      }
    }
  }
  if (JsonObject* time = root.object_if("time")) map.time = time_from(*time);
  map.table = table_from(root);
  map.missing = root.texts_or_empty("missing");
  root.raw("proposals");  // what import writes beside, for the user to take over
  return map;
}

}  // namespace

std::optional<std::size_t> find_column(const std::string& wanted, const std::vector<std::string>& names,
                                       const std::vector<std::string>& labels) {
  for (const auto* list : {&names, &labels}) {
    const auto at = std::find(list->begin(), list->end(), wanted);
    if (at != list->end() && !wanted.empty()) return static_cast<std::size_t>(at - list->begin());
  }
  if (wanted.size() < 2 || wanted.front() != '#') return std::nullopt;
  std::size_t place = 0;
  const auto [end, error] = std::from_chars(wanted.data() + 1, wanted.data() + wanted.size(), place);
  if (error != std::errc{} || end != wanted.data() + wanted.size() || place < 1 || place > names.size()) {
    return std::nullopt;
  }
  return place - 1;
}

const std::optional<ColumnRule>* HeaderMap::rule_for(const std::string& name, const std::string& label,
                                                     std::size_t column) const {
  for (const std::string& key : {place_of(column), name, label}) {
    if (key.empty()) continue;
    if (const auto at = columns.find(key); at != columns.end()) return &at->second;
  }
  return nullptr;
}

std::vector<std::string> HeaderMap::names_without_column(const std::vector<std::string>& names,
                                                         const std::vector<std::string>& labels) const {
  std::vector<std::string> out;
  for (const auto& [name, rule] : columns) {
    if (!find_column(name, names, labels)) out.push_back(name);
  }
  return out;
}

Result<HeaderMap> header_map_from_json(const nlohmann::json& document, const std::string& file,
                                       std::vector<std::string>* warnings) {
  return from_json<HeaderMap>(document, file, warnings, map_from);
}

Result<HeaderMap> read_header_map(const std::filesystem::path& path, std::vector<std::string>* warnings) {
  ZD_TRY(const nlohmann::json document, read_json_file(path));
  return header_map_from_json(document, path.string(), warnings);
}

nlohmann::json to_json(const HeaderMap& map) {
  nlohmann::json columns = nlohmann::json::object();
  for (const auto& [name, rule] : map.columns) {
    nlohmann::json& entry = columns[name] = nullptr;
    if (!rule) continue;
    entry = {{"channel", rule->channel}};
    if (rule->scale) entry["scale"] = *rule->scale;
    if (rule->offset) entry["offset"] = *rule->offset;
    if (!rule->unit.empty()) entry["unit"] = rule->unit;
    if (!rule->axis.empty()) entry["axis"] = rule->axis;
    if (!rule->location.empty()) entry["location"] = rule->location;
  }
  nlohmann::json out = {{"columns", std::move(columns)}};
  nlohmann::json time = nlohmann::json::object();
  if (map.time.columns.size() == 1) time["column"] = map.time.columns.front();
  if (map.time.columns.size() == 2) time["column"] = map.time.columns;
  if (!map.time.format.empty()) time["format"] = map.time.format;
  if (!map.time.unit.empty()) time["unit"] = map.time.unit;
  if (!time.empty()) out["time"] = std::move(time);
  if (!map.table.encoding.empty()) out["encoding"] = map.table.encoding;
  if (!map.table.separator.empty()) out["separator"] = map.table.separator;
  if (!map.table.decimal.empty()) out["decimal"] = map.table.decimal;
  if (!map.missing.empty()) out["missing"] = map.missing;
  return out;
}

}  // namespace zerodrift::recording
