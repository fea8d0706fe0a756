#pragma once
// A recording out of any logger's table: text in whatever encoding, separators and number format, or a sheet of a
// workbook. What a column becomes is said by its name, its unit and the header map, never by the look of its values;
// each column's fate is listed, and what could change a number and is not understood is an error with line and column.

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/recording/import/header_map.h"
#include "core/recording/import/text_table.h"
#include "core/recording/import/time_column.h"
#include "core/recording/recording.h"

namespace zerodrift::recording {

/// What became of a column of the file.
struct ColumnFate {
  std::size_t place = 0;  // from 1
  std::string name;       // as in the header
  std::string label;      // as in the logger's block
  std::string fate;       // "time", "channel", "dropped", "words", "empty", "counter", "alarm", "second-time"
  std::string channel;    // of the recording
  std::string unit;       // of the values in the file, as written
  std::string unit_from;  // "name", "units-row", "block", "map"; empty: no unit is known
  double scale = 1.0;     // channel = scale * value + offset
  double offset = 0.0;
  std::string axis;                    // that a displacement or tilt is of, by the map
  std::string location;                // of the sensor, by the map
  std::string proposal;                // a channel that it may be; never taken by itself
  std::map<std::string, int> missing;  // words for missing samples, and how often
};

struct Imported {
  Recording recording;
  TableForm form;
  TimeReading time;
  std::vector<ColumnFate> columns;
  std::vector<Error> warnings;
};

/// `file` is for messages and the recording's name.
Result<Imported> import_recording(std::string_view bytes, const std::string& file, const HeaderMap& map = {});
Result<Imported> import_file(const std::filesystem::path& path, const HeaderMap& map = {});

/// The map that reads such a file again the same way, each column named; with proposals beside.
nlohmann::json map_of(const Imported& imported, const HeaderMap& given);
/// What the map said of the channels of an import that was kept as to_json().
struct Assigned {
  std::map<std::string, std::string> axes;       // channel of a displacement or tilt -> X, Y, Z, A, B
  std::map<std::string, std::string> locations;  // channel -> where its sensor is
  std::vector<std::string> channels;             // all of them
};
Assigned assigned_in(const nlohmann::json& kept);
/// {"encoding", "separator", "decimal", "time": {...}, "columns": [...]}; warnings are the caller's to put into words.
nlohmann::json to_json(const Imported& imported);

}  // namespace zerodrift::recording
