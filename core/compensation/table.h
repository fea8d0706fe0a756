#pragma once
// The compensation table: for each linear axis the error as a function of position, direction of approach and
// temperatures. Everything in it is an error (actual - commanded, see sign.h); lengths of position in mm, errors in um.
//
//   error(x, T) = offset + sum over terms (um_per_K + slope * (x - x0) / 1000) * (T - reference)
//               + points at x, linear between them, held beyond the ends, by direction of approach
//                 (each point plus um_per_K * temperature difference of the axis's first term)
//   then limited to +-max_um.
//
// A machine may also hold segments (measured = a * commanded + b, the regression of a laser table): they give the
// forward and inverse transformation; the points are what a controller interpolates.

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace zerodrift::compensation {

enum class Approach {
  up,    // towards greater positions
  down,  // towards smaller ones
};

struct Segment {
  double from_mm = 0.0;
  double to_mm = 0.0;
  double a = 1.0;  // measured = a * commanded + b_mm
  double b_mm = 0.0;
  double r = 1.0;  // the correlation the criterion looked at
  int points = 0;  // measured points it was fitted to; 0: a joint between two fitted segments
};

struct TablePoint {
  double position_mm = 0.0;
  double error_up_um = 0.0;
  double error_down_um = 0.0;
  double um_per_K = 0.0;  // of the axis's first temperature term
};

struct TemperatureTerm {
  std::string sensor;  // channel, "T3_C" or "ambient_C"
  double um_per_K = 0.0;
  double reference_C = 20.0;
  double slope_um_per_m_per_K = 0.0;
};

struct AxisTable {
  std::vector<Segment> segments;
  std::vector<TablePoint> points;  // positions strictly increasing
  double offset_um = 0.0;
  std::vector<TemperatureTerm> terms;
  double reference_position_mm = 0.0;
  double max_um = 200.0;       // the compensation is limited to this
  double max_um_per_s = 2.0;   // and its change to this
  double max_um_per_K = 50.0;  // no coefficient may be steeper when the table is written to a machine
};

/// Temperatures of the training data; beyond them a model extrapolates.
struct ValidRange {
  double low_C = 0.0;
  double high_C = 0.0;
};

struct Table {
  std::string machine;
  std::uint32_t serial = 0;  // of the machine it was made for; 0: not known
  int version = 0;
  std::map<std::string, AxisTable> axes;    // "X", "Y", "Z"
  std::map<std::string, ValidRange> valid;  // by sensor channel
};

using Temperatures = std::map<std::string, double>;  // channel -> C; NaN: dead

/// channel_missing or sensor_dead when a term's temperature is not there.
Result<double> error_um(const AxisTable& axis, double position_mm, Approach approach, const Temperatures& temperatures);
/// -error_um
Result<double> compensation_um(const AxisTable& axis, double position_mm, Approach approach,
                               const Temperatures& temperatures);
/// The same for an axis of a table; an axis without a record has no error.
Result<double> error_um(const Table& table, const std::string& axis, double position_mm, Approach approach,
                        const Temperatures& temperatures);

/// Sensors a table needs, each once.
std::vector<std::string> sensors_of(const Table& table);
/// Sensors outside their valid range now, as "T3_C 43.1 C (valid 18 to 41)".
std::vector<std::string> outside_valid_range(const Table& table, const Temperatures& temperatures);
/// Coefficients steeper than the axis's own limit or this one, as limit_exceeded naming axis and sensor.
Status check_steepness(const Table& table, double max_um_per_K);
/// Every sensor at its reference: the state in which temperature terms give nothing.
Temperatures reference_temperatures(const Table& table);

/// Points ascending, numbers finite, sensors named; data_does_not_fit or bad_argument otherwise.
Status check(const Table& table);

/// Format "zerodrift-table/1". The CRC-32 is over the canonical text of everything else in it.
nlohmann::json to_json(const Table& table);
std::string crc32_text(const Table& table);
/// A CRC that does not fit is refused: whoever changed the content, nothing shows that all of it is meant.
Result<Table> table_from_json(const nlohmann::json& document, const std::string& file,
                              std::vector<std::string>* warnings = nullptr);
Result<Table> read_table_file(const std::filesystem::path& path, std::vector<std::string>* warnings = nullptr);
Status write_table_file(const std::filesystem::path& path, const Table& table);

/// What changes from one table to another.
struct DifferenceRow {
  double position_mm = 0.0;
  double old_up_um = 0.0;  // compensations
  double old_down_um = 0.0;
  double new_up_um = 0.0;
  double new_down_um = 0.0;
};
struct AxisDifference {
  std::string axis;
  std::vector<DifferenceRow> curve;  // at every position either table names, and at `positions`
  double largest_um = 0.0;           // largest |new - old| of the curve
  double largest_at_mm = 0.0;
};
/// Compensations of both tables at these temperatures; `positions` (axis -> mm) adds where the machine stands now.
Result<std::vector<AxisDifference>> difference(const Table& old_table, const Table& new_table,
                                               const Temperatures& temperatures,
                                               const std::map<std::string, double>& positions = {});

}  // namespace zerodrift::compensation
