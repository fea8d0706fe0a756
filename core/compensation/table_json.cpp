// Reading and writing of "zerodrift-table/1".

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/base/hash.h"
#include "core/base/json.h"
#include "core/compensation/table.h"

namespace zerodrift::compensation {
namespace {

using nlohmann::json;

constexpr const char* format_name = "zerodrift-table/1";

json axis_to_json(const AxisTable& axis) {
  json segments = json::array();
  for (const auto& s : axis.segments) {
    segments.push_back(
        {{"from_mm", s.from_mm}, {"to_mm", s.to_mm}, {"a", s.a}, {"b_mm", s.b_mm}, {"r", s.r}, {"points", s.points}});
  }
  json points = json::array();
  for (const auto& p : axis.points) {
    points.push_back({{"position_mm", p.position_mm},
                      {"error_up_um", p.error_up_um},
                      {"error_down_um", p.error_down_um},
                      {"um_per_K", p.um_per_K}});
  }
  json terms = json::array();
  json slopes = json::array();
  for (const auto& t : axis.terms) {
    terms.push_back({{"sensor", t.sensor}, {"um_per_K", t.um_per_K}, {"reference_C", t.reference_C}});
    slopes.push_back(t.slope_um_per_m_per_K);
  }
  return {
      {"segments", segments},
      {"points", points},
      {"temperature",
       {{"offset_um", axis.offset_um},
        {"terms", terms},
        {"slope_um_per_m_per_K", slopes},
        {"reference_position_mm", axis.reference_position_mm}}},
      {"limits", {{"max_um", axis.max_um}, {"max_um_per_s", axis.max_um_per_s}, {"max_um_per_K", axis.max_um_per_K}}}};
}

json without_crc(const Table& table) {
  json axes = json::object();
  for (const auto& [name, axis] : table.axes) axes[name] = axis_to_json(axis);
  json valid = json::object();
  for (const auto& [sensor, range] : table.valid) valid[sensor] = {range.low_C, range.high_C};
  json document = {{"format", format_name},
                   {"machine", table.machine},
                   {"version", table.version},
                   {"axes", axes},
                   {"valid", valid}};
  if (table.serial != 0) document["serial"] = table.serial;
  return document;
}

void read_segments_and_points(JsonObject& object, AxisTable& axis) {
  for (JsonObject& s : object.objects_or_empty("segments")) {
    Segment segment;
    segment.from_mm = s.number("from_mm");
    segment.to_mm = s.number("to_mm");
    segment.a = s.number("a", positive);
    segment.b_mm = s.number("b_mm");
    segment.r = s.number_or("r", 1.0);
    segment.points = s.integer_or("points", 0, 0, 1000000);
    if (segment.to_mm < segment.from_mm) s.reject("to_mm", fmt::format("{}", segment.to_mm), "not below from_mm");
    axis.segments.push_back(segment);
  }
  for (JsonObject& p : object.objects_or_empty("points")) {
    TablePoint point;
    point.position_mm = p.number("position_mm");
    point.error_up_um = p.number("error_up_um");
    point.error_down_um = p.number_or("error_down_um", point.error_up_um);
    point.um_per_K = p.number_or("um_per_K", 0.0);
    if (!axis.points.empty() && point.position_mm <= axis.points.back().position_mm) {
      p.reject("position_mm", fmt::format("{}", point.position_mm), "a position above the one before");
    }
    axis.points.push_back(point);
  }
}

void read_temperature(JsonObject& object, AxisTable& axis) {
  JsonObject* temperature = object.object_if("temperature");
  if (temperature == nullptr) return;
  axis.offset_um = temperature->number_or("offset_um", 0.0);
  axis.reference_position_mm = temperature->number_or("reference_position_mm", 0.0);
  for (JsonObject& t : temperature->objects_or_empty("terms")) {
    TemperatureTerm term;
    term.sensor = t.text("sensor");
    term.um_per_K = t.number("um_per_K");
    term.reference_C = t.number("reference_C");
    axis.terms.push_back(term);
  }
  const std::vector<double> slopes = temperature->numbers_or_empty("slope_um_per_m_per_K");
  if (!slopes.empty() && slopes.size() != axis.terms.size()) {
    temperature->reject("slope_um_per_m_per_K", fmt::format("{} numbers", slopes.size()),
                        fmt::format("one for each of the {} terms, or none", axis.terms.size()));
  }
  for (std::size_t i = 0; i < slopes.size(); ++i) axis.terms[i].slope_um_per_m_per_K = slopes[i];
}

AxisTable read_axis(JsonObject& object) {
  AxisTable axis;
  read_segments_and_points(object, axis);
  read_temperature(object, axis);
  if (JsonObject* limits = object.object_if("limits"); limits != nullptr) {
    axis.max_um = limits->number_or("max_um", axis.max_um, positive);
    axis.max_um_per_s = limits->number_or("max_um_per_s", axis.max_um_per_s, positive);
    axis.max_um_per_K = limits->number_or("max_um_per_K", axis.max_um_per_K, positive);
  }
  return axis;
}

Table read_body(JsonObject& o) {
  Table table;
  o.word("format", {format_name});
  table.machine = o.text_or("machine", "");
  table.serial = static_cast<std::uint32_t>(o.integer_or("serial", 0, 0, 2147483647));
  table.version = o.integer_or("version", 0, 0, 65535);
  o.raw("crc32");
  JsonObject& axes = o.object("axes");
  for (const auto& name : axes.keys()) {
    if (name != "X" && name != "Y" && name != "Z") axes.reject(name, "axis " + name, "X, Y or Z");
    table.axes[name] = read_axis(axes.object(name));
  }
  if (JsonObject* valid = o.object_if("valid"); valid != nullptr) {
    for (const auto& sensor : valid->keys()) {
      const auto range = valid->numbers(sensor, 2);
      table.valid[sensor] = {range[0], range[1]};
    }
  }
  return table;
}

}  // namespace

std::string crc32_text(const Table& table) {
  return fmt::format("{:08x}", crc32_of(json_text(without_crc(table))));
}

json to_json(const Table& table) {
  json document = without_crc(table);
  document["crc32"] = fmt::format("{:08x}", crc32_of(json_text(document)));
  return document;
}

Result<Table> table_from_json(const json& document, const std::string& file, std::vector<std::string>* warnings) {
  ZD_TRY(Table table, from_json<Table>(document, file, warnings, read_body));
  ZD_CHECK(check(table));
  const auto stated = document.find("crc32");
  if (stated == document.end()) return table;
  // Of what was read, or of the document as it stands: one of an older version has fewer keys.
  json rest = document;
  rest.erase("crc32");
  const std::string of_document = fmt::format("{:08x}", crc32_of(json_text(rest)));
  if (!stated->is_string() || (*stated != crc32_text(table) && *stated != of_document)) {
    return fail(ErrorCode::json_bad_value, {{"file", file},
                                            {"key", "crc32"},
                                            {"found", stated->dump()},
                                            {"expected",
                                             "the check sum of this content: it was changed after it was "
                                             "made (make the table anew)"}});
  }
  return table;
}

Result<Table> read_table_file(const std::filesystem::path& path, std::vector<std::string>* warnings) {
  ZD_TRY(const json document, read_json_file(path));
  return table_from_json(document, path.string(), warnings);
}

Status write_table_file(const std::filesystem::path& path, const Table& table) {
  ZD_CHECK(check(table));
  return write_json_file(path, to_json(table));
}

}  // namespace zerodrift::compensation
