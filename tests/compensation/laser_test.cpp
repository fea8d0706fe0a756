#include "core/compensation/laser.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "core/base/file.h"
#include "core/compensation/positioning.h"

namespace zerodrift::compensation {
namespace {

constexpr const char* rtl = R"(HEADER::
File type: Linear
Owner: RENISHAW
Version no: 2

TARGET DATA::
Filetype: 1
Target-count: 7
Targets :
0.000000 100.000000 200.000000 300.000000 400.000000
500.000000 600.000000
Flags: 0 0 2 0

EQUIPMENT::
Laser: 1

USER-TEXT::
Machine: %MACHINE%
Serial No: 1
Date: 2026-11-20 10:00:00
By:
Axis: Y
Location:
TITLE:

RUNS::
Run-count: 2

DEVIATIONS::
Run Target Data:
1 1 0.000
1 2 1.200
1 3 2.500
1 4 3.000
1 5 3.500
1 6 4.000
1 7 5.000
2 7 5.600
2 6 4.500
2 5 4.100
2 4 3.600
2 3 3.100
2 2 1.900
2 1 0.700

ENVIRONMENT::
Air temp   : 20.1 20.2 0
Mat temp 1 : 20.203292 20.321342 0

EOF::
)";

std::string rtl_of(const std::string& machine, bool crlf) {
  std::string text = rtl;
  text.replace(text.find("%MACHINE%"), 9, machine);
  if (!crlf) return text;
  std::string out;
  for (const char c : text) out += c == '\n' ? std::string("\r\n") : std::string(1, c);
  return out;
}

}  // namespace

TEST(Laser, ContractForms) {
  const auto errors = parse_laser("position_mm;error_um\n10;1.5\n0;0.5\n20;2\n", "a.csv");
  ASSERT_TRUE(errors) << describe(errors.error());
  EXPECT_EQ(errors->targets_mm, (std::vector<double>{0, 10, 20}));
  EXPECT_DOUBLE_EQ(points_of(*errors)[1].error_up_um, 1.5);
  EXPECT_FALSE(errors->bidirectional());
  const auto measured = parse_laser("\xEF\xBB\xBFtarget_mm,measured_mm\n0,0\n10,10.003\n", "a.csv");
  ASSERT_TRUE(measured) << describe(measured.error());
  EXPECT_NEAR(points_of(*measured)[1].error_up_um, 3.0, 1e-9);
  const auto both = parse_laser(
      "target_mm,direction,run,measured_mm\n0,up,1,0.001\n0,up,2,0.003\n0,down,1,0\n5,+,1,5.001\n5,+,2,5.001\n5,-,1,4."
      "999\n",
      "a.csv");
  ASSERT_TRUE(both) << describe(both.error());
  EXPECT_TRUE(both->bidirectional());
  EXPECT_NEAR(points_of(*both)[0].error_up_um, 2.0, 1e-9);
  EXPECT_NEAR(points_of(*both)[1].error_down_um, -1.0, 1e-9);
}

TEST(Laser, FaultsNameTheLine) {
  EXPECT_EQ(parse_laser("a,b\n1,2\n", "a.csv").error().code, ErrorCode::csv_bad_header);
  const auto bad = parse_laser("position_mm,error_um\n0,1\n1,x\n", "a.csv");
  EXPECT_EQ(bad.error().context.at("line"), "3");
  EXPECT_EQ(parse_laser("position_mm,error_um\n0,1\n", "a.csv").error().code, ErrorCode::not_enough_data);
  LaserOptions two;
  two.max_points = 2;
  EXPECT_EQ(parse_laser("position_mm,error_um\n0,1\n1,1\n2,1\n", "a.csv", two).error().code, ErrorCode::limit_exceeded);
  LaserOptions mapped;
  mapped.columns = {{"Pos", "position_mm"}, {"Err", "error_um"}};
  EXPECT_TRUE(parse_laser("Pos,Err\n0,1\n1,1\n", "a.csv", mapped));
}

// A number that names no run is refused, whoever said which column holds the runs.
TEST(Laser, ARunBeyondAnyCountIsNone) {
  const std::string head = "target_mm,direction,run,measured_mm\n0,up,1,0.001\n10,up,";
  EXPECT_TRUE(parse_laser(head + "1,10.002\n", "a.csv"));
  for (const char* run : {"1e300", "-1", "1.5", "99999999999"}) {
    const auto report = parse_laser(head + run + ",10.002\n", "a.csv");
    ASSERT_FALSE(report) << run;
    EXPECT_EQ(report.error().context.at("column"), "run");
    EXPECT_EQ(report.error().context.at("found"), run);
  }
  LaserOptions options;
  options.mapping = LaserMapping{};
  options.mapping->separator = ' ';
  options.mapping->columns = {LaserColumn::position, LaserColumn::run, LaserColumn::error};
  const auto settled = parse_laser("0 1 1\n10 1e300 2\n", "a.dat", options);
  ASSERT_FALSE(settled);
  EXPECT_EQ(settled.error().context.at("found"), "1e300");
  std::string vendor = rtl_of("VMC", false);
  const auto at = vendor.find("Run Target Data");
  ASSERT_NE(at, std::string::npos);
  const auto row = vendor.find('\n', at) + 1;
  const auto digit = vendor.find_first_of("0123456789", row);
  vendor.insert(digit, "9999999999");
  EXPECT_FALSE(parse_laser(vendor, "a.rtl"));
}

TEST(Laser, RenishawLinear) {
  const auto report = parse_laser(rtl_of("VMC", true), "a.rtl");
  ASSERT_TRUE(report) << describe(report.error());
  EXPECT_EQ(report->machine, "VMC");
  EXPECT_EQ(report->axis, "Y");
  ASSERT_EQ(report->targets_mm.size(), 7U);
  const auto points = points_of(*report);
  EXPECT_DOUBLE_EQ(points[2].error_up_um, 2.5);
  EXPECT_DOUBLE_EQ(points[2].error_down_um, 3.1);
  EXPECT_DOUBLE_EQ(points[6].error_down_um, 5.6);
}

TEST(Laser, EncodingsSeen) {
  const std::string name = "\xE6\x9C\xBA\xE5\xBA\x8A";  // "machine tool" in Chinese
  EXPECT_EQ(parse_laser(rtl_of(name, false), "a.rtl")->machine, name);
  EXPECT_EQ(parse_laser(rtl_of("\xBB\xFA\xB4\xB2", false), "a.rtl")->machine, name);  // the same in GBK
  std::string utf16 = "\xFF\xFE";
  for (const char c : std::string("position_mm,error_um\n0,1\n1,2\n")) utf16 += std::string{c, '\0'};
  EXPECT_TRUE(parse_laser(utf16, "a.csv"));
}

TEST(Laser, RenHoldsCompensationsInAUnitThatItSays) {
  const std::string rows =
      "Compensation start: 0\nCompensation end: 200\nCompensation spacing: 100\nNo.\tAxis position\tCombined\n"
      "1\t0.0\t0\n2\t100.0\t-2\n3\t200.0\t-5\n";
  const auto ren = parse_laser("Units: um\n" + rows, "a.REN");
  ASSERT_TRUE(ren) << describe(ren.error());
  EXPECT_DOUBLE_EQ(points_of(*ren)[2].error_up_um, 5.0);
  EXPECT_FALSE(ren->warnings.empty());
  const auto in_mm = parse_laser("Units: mm\n" + rows, "a.REN");
  ASSERT_TRUE(in_mm) << describe(in_mm.error());
  EXPECT_DOUBLE_EQ(points_of(*in_mm)[2].error_up_um, 5000.0);
  const auto unsaid = parse_laser(rows, "a.REN");
  ASSERT_FALSE(unsaid);
  EXPECT_EQ(unsaid.error().context.at("column"), "Combined");
}

std::string pos_of(const std::string& names) {
  std::string out = "HEADER::\nFile type: Positioning\n\nTARGET DATA::\nTargets :\n0.0 50.0\nFlags: 0\n";
  for (const char name : names) {
    const std::string title = name == 'B'   ? "Bidirectional"
                              : name == 'F' ? "Forward Directional"
                                            : "Backward Directional";
    const std::string second = name == 'B' ? "0.0025" : name == 'F' ? "0.0045" : "0.0005";
    out += "\nPosition   \t" + title + " Avg Error\n0.0000\t0.001000\n50.0000\t" + second + "\n";
  }
  return out + "ENVIRONMENT::\nAir temp   : 20.1 20.2 0\n";
}

// An API report has means: of each direction, and of both.
TEST(Laser, PosHasATableForEachDirection) {
  for (const char* tables : {"BFR", "FR", "RFB"}) {
    const auto pos = parse_laser(pos_of(tables), "a.pos");
    ASSERT_TRUE(pos) << describe(pos.error());
    EXPECT_EQ(pos->readings.size(), 4U) << tables;
    EXPECT_DOUBLE_EQ(points_of(*pos)[1].error_up_um, 4.5);
    EXPECT_DOUBLE_EQ(points_of(*pos)[1].error_down_um, 0.5);
    EXPECT_FALSE(pos->warnings.empty());
  }
  const auto both = parse_laser(pos_of("B"), "a.pos");
  ASSERT_TRUE(both) << describe(both.error());
  EXPECT_DOUBLE_EQ(points_of(*both)[1].error_up_um, 2.5);
  std::string comma = pos_of("BFR");
  std::replace(comma.begin(), comma.end(), '.', ',');
  const auto german = parse_laser(comma, "a.pos");
  ASSERT_TRUE(german) << describe(german.error());
  EXPECT_DOUBLE_EQ(points_of(*german)[1].error_down_um, 0.5);
  EXPECT_FALSE(parse_laser("Position\tSideways Avg Error\n0\t0\n50\t1\n", "a.pos"));
  EXPECT_FALSE(parse_laser("Units: inch\n" + pos_of("B"), "a.pos"));
  const auto um = parse_laser("Position (mm)\tForward Directional Avg Error (um)\n0\t1\n50\t2.5\n", "a.pos");
  ASSERT_TRUE(um) << describe(um.error());
  EXPECT_DOUBLE_EQ(points_of(*um)[1].error_up_um, 2.5);
  EXPECT_FALSE(parse_laser("Position (mm)\tForward Directional Avg Error (digits)\n0\t1\n50\t2.5\n", "a.pos"));
}

// Re-saved on a computer with decimal commas; cut; of another kind.
TEST(Laser, RtlWithDecimalCommasAndCutOnes) {
  std::string comma = rtl_of("VMC", true);
  for (std::size_t i = comma.find("Targets :"); i < comma.size(); ++i) {
    if (comma[i] == '.' && comma[i + 1] >= '0' && comma[i + 1] <= '9') comma[i] = ',';
  }
  const auto report = parse_laser(comma, "a.rtl");
  ASSERT_TRUE(report) << describe(report.error());
  ASSERT_EQ(report->targets_mm.size(), 7U);
  EXPECT_DOUBLE_EQ(report->targets_mm[6], 600.0);
  EXPECT_DOUBLE_EQ(points_of(*report)[2].error_up_um, 2.5);
  EXPECT_DOUBLE_EQ(points_of(*report)[6].error_down_um, 5.6);
  const auto without = [](const std::string& part) {
    std::string text = rtl_of("VMC", false);
    const auto at = text.find(part);
    return text.erase(at, part.size());
  };
  EXPECT_EQ(parse_laser(without(" 400.000000"), "a.rtl").error().code, ErrorCode::csv_bad_number);
  EXPECT_TRUE(parse_laser(rtl_of("VMC", false), "a.rtl")->warnings.empty());
  EXPECT_FALSE(parse_laser(without("2 1 0.700\n"), "a.rtl")->warnings.empty());
  std::string rotary = rtl_of("VMC", false);
  rotary.replace(rotary.find("Linear"), 6, "Rotary");
  EXPECT_EQ(parse_laser(rotary, "a.rtl").error().code, ErrorCode::wrong_format);
}

// Tables of other makers: the names or the numbers tell what the columns are; the wide form has a column a direction.
TEST(LaserColumns, AreGuessedFromNamesUnitsAndNumbers) {
  const auto named =
      preview_laser("Axis report\n\nNo.\tPosition (mm)\tError (um)\n1\t0.0\t0.5\n2\t10.0\t1.5\n3\t20\t2\n", "a.txt");
  ASSERT_TRUE(named) << describe(named.error());
  EXPECT_TRUE(named->certain);
  EXPECT_EQ(named->guess.first_line, 4);
  EXPECT_EQ(named->guess.columns[1], LaserColumn::position);
  EXPECT_EQ(named->guess.columns[2], LaserColumn::error);
  EXPECT_DOUBLE_EQ(named->guess.um_per_error, 1.0);
  // Bare numbers, blanks between: a row number, targets, errors in mm (they are small).
  const auto bare = preview_laser("1   0.000  0.0000\n2  50.000  0.0031\n3 100.000 -0.0012\n", "a.txt");
  ASSERT_TRUE(bare) << describe(bare.error());
  EXPECT_FALSE(bare->certain);
  EXPECT_EQ(bare->guess.columns, (std::vector{LaserColumn::ignored, LaserColumn::position, LaserColumn::error}));
  EXPECT_DOUBLE_EQ(bare->guess.um_per_error, 1000.0);
  // Actual positions beside the targets; decimal comma.
  const auto positions = preview_laser("Soll;Ist\n0,0;0,0021\n100,0;100,0042\n200,0;200,0011\n", "a.csv");
  ASSERT_TRUE(positions) << describe(positions.error());
  EXPECT_TRUE(positions->guess.decimal_comma);
  EXPECT_EQ(positions->guess.columns[1], LaserColumn::measured);
  // In Chinese, as GBK: position, error.
  const auto gbk = preview_laser("\xCE\xBB\xD6\xC3(mm),\xCE\xF3\xB2\xEE(um)\n0,1\n10,2\n", "a.csv");
  ASSERT_TRUE(gbk) << describe(gbk.error());
  EXPECT_EQ(gbk->encoding, "GBK");
  EXPECT_TRUE(gbk->certain);
  EXPECT_FALSE(preview_laser("no numbers\nat all\n", "a.txt"));
}

TEST(LaserColumns, WideFormAndOrderGiveDirections) {
  const auto wide = parse_laser("Position (mm),Forward error (um),Reverse error (um)\n0,1,3\n10,2,4\n", "a.csv");
  ASSERT_TRUE(wide) << describe(wide.error());
  EXPECT_TRUE(wide->bidirectional());
  EXPECT_DOUBLE_EQ(points_of(*wide)[1].error_up_um, 2.0);
  EXPECT_DOUBLE_EQ(points_of(*wide)[1].error_down_um, 4.0);
  EXPECT_EQ(wide->columns.size(), 3U);
  // There and back, twice: the turning point stands twice.
  std::string order = "Position_mm Error_um\n";
  for (int cycle = 0; cycle < 2; ++cycle) order += "0 1\n10 2\n20 3\n20 6\n10 5\n0 4\n";
  const auto both = parse_laser(order, "a.txt");
  ASSERT_TRUE(both) << describe(both.error());
  const auto points = points_of(*both);
  EXPECT_DOUBLE_EQ(points[0].error_up_um, 1.0);
  EXPECT_DOUBLE_EQ(points[0].error_down_um, 4.0);
  EXPECT_DOUBLE_EQ(points[2].error_up_um, 3.0);
  EXPECT_DOUBLE_EQ(points[2].error_down_um, 6.0);
}

TEST(LaserColumns, ASettledMappingIsKeptAndUsed) {
  LaserOptions options;
  options.mapping = LaserMapping{};
  options.mapping->separator = ' ';
  options.mapping->columns = {LaserColumn::position, LaserColumn::ignored, LaserColumn::error};
  options.mapping->um_per_error = 1000.0;
  options.mapping->negated = true;
  const auto report = parse_laser("0 99 0.001\n10 98 0.002\n", "a.dat", options);
  ASSERT_TRUE(report) << describe(report.error());
  EXPECT_DOUBLE_EQ(points_of(*report)[1].error_up_um, -2.0);
  const auto back = mapping_from_text(text_of(*options.mapping), 3);
  ASSERT_TRUE(back);
  EXPECT_EQ(text_of(*back), text_of(*options.mapping));
  EXPECT_FALSE(mapping_from_text(text_of(*options.mapping), 4));
  EXPECT_FALSE(mapping_from_text("nonsense", 3));
  const auto bad = parse_laser("0 99 0.001\n10 98 x\n", "a.dat", options);
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().context.at("line"), "2");
}

TEST(Laser, OneAxisOfAFileWithSeveral) {
  const std::string text = "axis,position_mm,error_um\nX,0,1\nX,10,2\nY,0,3\nY,10,4\n";
  EXPECT_EQ(parse_laser(text, "a.csv").error().code, ErrorCode::data_does_not_fit);
  LaserOptions options;
  options.axis = "y";
  const auto report = parse_laser(text, "a.csv", options);
  ASSERT_TRUE(report) << describe(report.error());
  EXPECT_EQ(report->axis, "Y");
  EXPECT_EQ(report->axes, (std::vector<std::string>{"X", "Y"}));
  EXPECT_DOUBLE_EQ(points_of(*report)[1].error_up_um, 4.0);
}

// A case small enough to do by hand: two targets, two runs each way.
TEST(Positioning, ByHand) {
  const auto report = parse_laser(
      "target_mm,direction,run,measured_mm\n0,up,1,0.001\n0,up,2,0.003\n0,down,1,-0.001\n0,down,2,-0.001\n"
      "10,up,1,10.005\n10,up,2,10.005\n10,down,1,10.001\n10,down,2,10.003\n",
      "a.csv");
  ASSERT_TRUE(report) << describe(report.error());
  const auto f = positioning_figures(*report);
  const double s = std::sqrt(2.0);  // of 1 and 3
  EXPECT_NEAR(f.B_um, 3.0, 1e-9);
  EXPECT_NEAR(f.B_mean_um, 3.0, 1e-9);
  EXPECT_NEAR(f.M_um, 3.0, 1e-9);  // means 0.5 and 3.5
  EXPECT_NEAR(f.E_um, 6.0, 1e-9);  // -1 to 5
  EXPECT_NEAR(f.E_up_um, 3.0, 1e-9);
  EXPECT_NEAR(f.R_up_um, 4.0 * s, 1e-9);
  EXPECT_NEAR(f.R_um, 2.0 * s + 3.0, 1e-9);
  EXPECT_NEAR(f.A_up_um, 5.0 - (2.0 - 2.0 * s), 1e-9);
  EXPECT_NEAR(f.A_um, 5.0 + 1.0, 1e-9);
  EXPECT_NEAR(f.Pa_um, 3.0, 1e-9);
  EXPECT_NEAR(f.U_max_um, 3.0, 1e-9);
  EXPECT_NEAR(f.Ps_max_um, 3.0 * s, 1e-9);
  EXPECT_NEAR(f.P_um, 3.0 + 3.0 + 3.0 * s, 1e-9);
}

TEST(Positioning, FiguresThatCannotBeGivenAreMissing) {
  const auto report = parse_laser("position_mm,error_um\n0,0\n10,3\n", "a.csv");
  ASSERT_TRUE(report);
  const auto f = positioning_figures(*report);
  EXPECT_DOUBLE_EQ(f.E_up_um, 3.0);
  EXPECT_TRUE(std::isnan(f.B_um));
  EXPECT_TRUE(std::isnan(f.A_up_um));
  EXPECT_TRUE(nlohmann::json::parse(to_json(f).dump())["B_um"].is_null());
}

// An independent acceptance report (ecmc FAT/SAT report of 3 November 2021, axis 1, deviations in um); its own printed
// E and R take one direction only, the figures here are recomputed by the standard.
TEST(Positioning, AnIndependentReport) {
  const std::vector<double> targets = {15.0, 25.2, 35.4, 45.6, 55.8};
  const std::vector<std::vector<double>> up = {{3.35, 2.33, 1.72, 2.13, 1.72},
                                               {-0.26, 0.15, 0.96, 0.56, 0.56},
                                               {1.02, -0.40, 2.25, 3.06, 4.49},
                                               {-8.49, -9.10, -7.88, -9.10, -10.53},
                                               {5.83, 6.24, 6.85, 5.62, 5.62}};
  const std::vector<std::vector<double>> down = {{5.18, 5.18, 4.16, 3.35, 3.14},
                                                 {-3.72, -3.93, -4.33, -4.13, -4.74},
                                                 {-1.83, -1.63, -0.20, -0.61, 0.0},
                                                 {-7.68, -8.09, -7.07, -8.09, -8.49},
                                                 {7.05, 7.25, 7.05, 7.05, 6.44}};
  LaserReport report;
  report.targets_mm = targets;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    for (int j = 0; j < 5; ++j) {
      report.readings.push_back({i, Approach::up, j + 1, up[i][static_cast<std::size_t>(j)]});
      report.readings.push_back({i, Approach::down, j + 1, down[i][static_cast<std::size_t>(j)]});
    }
  }
  const auto f = positioning_figures(report);
  const double last_digit = 0.0051;
  EXPECT_NEAR(f.B_um, 4.56, last_digit);
  EXPECT_NEAR(f.B_mean_um, 0.70, last_digit);
  EXPECT_NEAR(f.M_um, 14.95, last_digit);
  EXPECT_NEAR(f.E_up_um, 15.05, last_digit);
  EXPECT_NEAR(f.E_down_um, 14.85, last_digit);
  EXPECT_NEAR(f.E_um, 15.99, last_digit);
  EXPECT_NEAR(f.R_up_um, 7.50, last_digit);
  EXPECT_NEAR(f.R_down_um, 3.88, last_digit);
  EXPECT_NEAR(f.R_um, 8.35, last_digit);
  EXPECT_NEAR(f.A_up_um, 18.07, last_digit);
  EXPECT_NEAR(f.A_down_um, 16.54, last_digit);
  EXPECT_NEAR(f.A_um, 18.57, last_digit);
}

// A real drive that warms during the test; figures recomputed independently from the file.
TEST(Positioning, ARealAxis) {
  const char* folder = std::getenv("ZERODRIFT_DATA_DIR");
  const std::string data = folder != nullptr ? folder : std::string(ZERODRIFT_SOURCE_DIR) + "/../shared/data";
  const auto text = read_file(data + "/axis-positioning/axis_b02.csv");
  if (!text) GTEST_SKIP() << "recordings not found in " << data;
  LaserOptions axis_x;
  axis_x.axis = "X";
  const auto report = parse_laser(*text, "axis_b02.csv", axis_x);
  ASSERT_TRUE(report) << describe(report.error());
  EXPECT_EQ(report->axis, "X");
  EXPECT_EQ(report->targets_mm.size(), 9U);
  EXPECT_EQ(report->readings.size(), 90U);
  const auto f = positioning_figures(*report);
  EXPECT_NEAR(f.A_um, 135.26238990678445, 1e-9);
  EXPECT_NEAR(f.E_um, 122.848, 1e-9);
  EXPECT_NEAR(f.R_um, 55.156518716905694, 1e-9);
  EXPECT_NEAR(f.B_um, 33.578, 1e-9);
  EXPECT_NEAR(f.B_mean_um, 25.367777777777775, 1e-9);
  EXPECT_NEAR(f.M_um, 93.652, 1e-9);
  EXPECT_NEAR(f.P_um, 147.29957649500636, 1e-9);
}

}  // namespace zerodrift::compensation
