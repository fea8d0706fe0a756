#pragma once
// The header map: what the columns of a file are, said by the user, in a file of its own that serves again for the next
// recording of the same logger.
//   {"columns": {"Temp 1 (degC)": {"channel": "T1_C"}, "CH5": {"channel": "dZ_um", "scale": 1000}, "Remark": null,
//               "CH6": {"channel": "probe2_um", "axis": "Z"}, "CH7": {"channel": "T2_C", "location": "front bearing"}},
//    "time": {"column": "Time", "format": "%d.%m.%Y %H:%M:%S", "unit": "s"},
//    "decimal": ",", "missing": ["DEFECT"]}
// A column is named as the header has it, by its label in the logger's block, or by its place: "#3".

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/recording/import/text_table.h"

namespace zerodrift::recording {

/// value in the channel's unit = scale * value in the file + offset. Without scale the unit converts.
struct ColumnRule {
  std::string channel;
  std::optional<double> scale = {};
  std::optional<double> offset = {};
  std::string unit = {};      // of the values in the file; empty: as the header says
  std::string axis = {};      // of a displacement: X, Y, Z; of a tilt: A, B (about X, Y); empty: by the channel's name
  std::string location = {};  // of a sensor, in words
};

struct TimeRule {
  std::vector<std::string> columns;  // one, or date and time of day; empty: found from the header
  std::string format;                // strptime's; empty: found from the cells
  std::string unit;                  // of numbers: s, ms, us, ns, min, h, d; empty: as the header says
};

struct HeaderMap {
  std::map<std::string, std::optional<ColumnRule>> columns;  // nothing: the column is dropped
  TimeRule time;
  TableOptions table;                // "encoding", "separator", "decimal"
  std::vector<std::string> missing;  // further words for a missing sample

  /// The rule for a column of a table, or null. By name, label, or place.
  const std::optional<ColumnRule>* rule_for(const std::string& name, const std::string& label,
                                            std::size_t column) const;
  /// Names in the map that no column of the table has.
  std::vector<std::string> names_without_column(const std::vector<std::string>& names,
                                                const std::vector<std::string>& labels) const;
};

Result<HeaderMap> header_map_from_json(const nlohmann::json& document, const std::string& file,
                                       std::vector<std::string>* warnings);
Result<HeaderMap> read_header_map(const std::filesystem::path& path, std::vector<std::string>* warnings);
nlohmann::json to_json(const HeaderMap& map);

/// The column of this name, label or place ("#3" from 1), or nothing.
std::optional<std::size_t> find_column(const std::string& wanted, const std::vector<std::string>& names,
                                       const std::vector<std::string>& labels);

}  // namespace zerodrift::recording
