#pragma once
// Tables in the files that real controllers load (C6). Each format is one file here and one line in formats.cpp. It
// states what it can hold; what a table loses on the way is measured by reading the written file back and comparing -
// at every knot, in both directions, which is exact for straight pieces - and is told with each export.

#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/compensation/table.h"

namespace zerodrift::controller {

struct ExportCapabilities {
  bool equidistant = false;      // points on a fixed step only
  bool two_directions = false;   // a value for each direction of approach
  bool increments = false;       // steps from point to point instead of values
  bool temperature = false;      // terms that follow temperatures
  int max_points = 0;            // of an axis
  double resolution_um = 0.001;  // of a value in the file
  std::string_view sign;         // what is written, in words
};

struct ExportOptions {
  std::string axis;                         // for formats with one axis a file; empty: the only one
  compensation::Temperatures temperatures;  // state a table without temperature is written for; empty: the references
  int max_points = 0;                       // of the very controller; 0: the format's
  int linuxcnc_type = 0;                    // COMP_FILE_TYPE
  bool sinumerik_cec = false;               // leadscrew: two CEC tables, one a direction, instead of ENC_COMP
  int sinumerik_encoder = 0;
  int sinumerik_first_table = 0;    // CEC table number
  int first_r_parameter = 800;      // thermal: R parameters that hold the temperatures
  int fanuc_reference_point = 40;   // parameter 3620; raised when the travel needs it
  double fanuc_unit_um = 1.0;       // detection unit x magnification (3623)
  double fanuc_reference_mm = 0.0;  // where the reference point stands
};

struct ExportFile {
  std::string suffix;  // empty for the file itself, else appended to its name, for example ".CMA"
  std::string text;
};

struct Exported {
  std::vector<ExportFile> files;
  double loss_um = 0.0;              // largest difference between the table and what the file says
  std::vector<std::string> losses;   // what is lost, one short sentence each
  std::vector<std::string> confirm;  // what rests on no source at hand: confirm on one point before the rest
};

struct ExportFormat {
  std::string_view id;
  ExportCapabilities capabilities;
  Result<Exported> (*write)(const compensation::Table& table, const ExportOptions& options);
  /// Back from the main file's text: the axes as points (straight between them), errors in um.
  Result<compensation::Table> (*read)(std::string_view text, const ExportOptions& options);
};

/// What the format writes of a table; not_enough_data where that would be nothing but zeros.
Result<Exported> write_table(const ExportFormat& format, const compensation::Table& table,
                             const ExportOptions& options);
/// Before a file whose sign or form is to be confirmed: the same format with one axis moved at one place by a few um.
/// What must be seen stands in `confirm`.
Result<Exported> write_one_point(const ExportFormat& format, const compensation::Table& table,
                                 const ExportOptions& options);

/// linuxcnc, sinumerik-thermal, sinumerik-leadscrew, fanuc, heidenhain
const std::vector<ExportFormat>& export_formats();
Result<const ExportFormat*> export_format(const std::string& id);

}  // namespace zerodrift::controller
