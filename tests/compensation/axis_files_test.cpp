// Axis files of other makers: right figures, or a refusal that names line, column and what is expected. The files are
// made here (tests/support/axis_files.h); what was measured is known.

#include "tests/support/axis_files.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/compensation/laser.h"
#include "core/compensation/positioning.h"

namespace zerodrift::compensation {
namespace {

using namespace test;

/// Errors at each target, direction and run, in um.
using Figures = std::map<std::tuple<double, bool, int>, double>;

std::string differences(const LaserReport& report, double tolerance_um) {
  Figures expected;
  for (const AxisReading& r : axis_readings()) expected[{r.target_mm, r.up, r.run}] = r.error_um;
  std::string out;
  for (const LaserReading& r : report.readings) {
    const double target = std::round(report.targets_mm[r.target]);
    const auto at = expected.find({target, r.approach == Approach::up, r.run});
    if (at == expected.end() || std::abs(at->second - r.deviation_um) > tolerance_um) {
      return fmt::format("{} mm, run {}: {} um", target, r.run, r.deviation_um);
    }
    expected.erase(at);
  }
  if (!expected.empty()) out = fmt::format("{} readings are missing", expected.size());
  return out;
}

void expect_right(const std::string& text, const std::string& file = "a.csv", double tolerance_um = 0.0501) {
  const auto report = parse_laser(text, file);
  ASSERT_TRUE(report) << describe(report.error()) << "\n" << text.substr(0, 200);
  EXPECT_EQ(differences(*report, tolerance_um), "") << text.substr(0, 200);
}

/// Refused at that line and column.
void expect_refused(const std::string& text, const std::string& column, const std::string& line = {},
                    const std::string& file = "a.csv") {
  const auto report = parse_laser(text, file);
  ASSERT_FALSE(report) << text.substr(0, 200);
  const auto& context = report.error().context;
  EXPECT_TRUE(context.contains("expected") || report.error().code == ErrorCode::csv_bad_number)
      << describe(report.error());
  const auto at = context.find("column");
  EXPECT_TRUE(at != context.end() && at->second == column) << describe(report.error());
  if (!line.empty()) {
    EXPECT_TRUE(context.contains("line") && context.at("line") == line) << describe(report.error());
  }
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

const std::vector<std::pair<std::string, std::string>> direction_pairs = {
    {"FWD", "REV"},
    {"fwd", "bwd"},
    {"Forward", "Backward"},
    {"forward", "reverse"},
    {"up", "down"},
    {"U", "D"},
    {"vorwärts", "rückwärts"},
    {"vorwaerts", "rueckwaerts"},
    {"Vorwärts", "Rückwärts"},
    {"VORWÄRTS", "RÜCKWÄRTS"},
    {"vor", "zurück"},
    {"hin", "zurück"},
    {"Hin", "Rück"},
    {"Hinweg", "Rückweg"},
    {"Vorlauf", "Rücklauf"},
    {"positiv", "negativ"},
    {"positive Richtung", "negative Richtung"},
    {"aufwärts", "abwärts"},
    {"steigend", "fallend"},
    {"Dir+", "Dir-"},
    {"dir +", "dir -"},
    {"+", "-"},
    {"(+)", "(-)"},
    {"X+", "X-"},
    {"+X", "-X"},
    {"+", "\xE2\x88\x92"},
    {"+1", "-1"},
    {"1", "-1"},
    {"plus", "minus"},
    {"pos", "neg"},
    {"positive direction", "negative direction"},
    {"Data forward direction", "Data backward direction"},
    {"→", "←"},
    {"↑", "↓"},
    {"->", "<-"},
    {"-->", "<--"},
    {">", "<"},
    {"正向", "反向"},
    {"正", "反"},
    {"正向", "负向"},
    {"去程", "回程"},
    {"正方向", "负方向"},
    {"前进", "后退"},
    {"上行", "下行"},
    {"cw", "ccw"},
    {"CW", "CCW"},
    {"F", "R"},
    {"F", "B"},
    {"increasing", "decreasing"},
    {"ascending", "descending"},
    {"1", "2"},
    {"1", "0"},
    {"right", "left"}};

}  // namespace

TEST(AxisFiles, DirectionsInEveryLanguage) {
  for (const auto& [up, down] : direction_pairs) {
    SCOPED_TRACE(up + " / " + down);
    expect_right(axis_table({axis_run("Run"), axis_direction("Direction", up, down), axis_target("Position (mm)"),
                             axis_error("Error (um)")}));
  }
  for (const char* name :
       {"Richtung", "Fahrtrichtung", "Approach", "Dir", "方向", "运动方向", "Anfahrrichtung", "direction"}) {
    expect_right(axis_table(
        {axis_run("Run"), axis_direction(name, "+", "-"), axis_target("Position (mm)"), axis_error("Error (um)")}));
  }
}

TEST(AxisFiles, ADirectionThatIsNotUnderstoodIsRefused) {
  for (const auto& [up, down] : std::vector<std::pair<std::string, std::string>>{{"A", "Q"},
                                                                                 {"bidirectional", "bidirectional"},
                                                                                 {"both", "both"},
                                                                                 {"hin/zurück", "hin/zurück"},
                                                                                 {"north", "south"}}) {
    expect_refused(axis_table({axis_run("Run"), axis_direction("Direction", up, down), axis_target("Position (mm)"),
                               axis_error("Error (um)")}),
                   "Direction");
  }
  // Sorted by position: a convention that nothing bears out.
  auto sorted = axis_readings();
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.target_mm < b.target_mm; });
  const auto with = [&](const char* up, const char* down) {
    return axis_table({axis_run("Run"), axis_direction("Direction", up, down), axis_target("Position (mm)"),
                       axis_error("Error (um)")},
                      ";", sorted);
  };
  expect_right(with("FWD", "REV"));
  expect_refused(with("cw", "ccw"), "direction");
  expect_refused(with("0", "1"), "direction");
  // Forward, said of the way back.
  expect_refused(axis_table({axis_run("Run"), axis_direction("Direction", "reverse", "forward"),
                             axis_target("Position (mm)"), axis_error("Error (um)")}),
                 "direction");
}

TEST(AxisFiles, UnitsAreThoseOfTheNames) {
  struct UnitName {
    const char* text;
    double mm;
  };
  const std::vector<UnitName> units = {{"um", 1e-3},        {"µm", 1e-3},           {"μm", 1e-3},
                                       {"micron", 1e-3},    {"microns", 1e-3},      {"mm", 1.0},
                                       {"nm", 1e-6},        {"in", 25.4},           {"inch", 25.4},
                                       {"inches", 25.4},    {"\"", 25.4},           {"uin", 2.54e-5},
                                       {"µin", 2.54e-5},    {"microinch", 2.54e-5}, {"micro-inch", 2.54e-5},
                                       {"mil", 0.0254},     {"mils", 0.0254},       {"thou", 0.0254},
                                       {"tenths", 0.00254}, {"0.0001\"", 0.00254},  {"0.0001 in", 0.00254},
                                       {"1/1000 mm", 1e-3}, {"0.1 um", 1e-4},       {"x0.1 µm", 1e-4},
                                       {"10^-3 mm", 1e-3},  {"1e-3 mm", 1e-3},      {"微米", 1e-3},
                                       {"毫米", 1.0},       {"Mikrometer", 1e-3},   {"Zoll", 25.4}};
  for (const UnitName& unit : units) {
    const double um = 1000.0 * unit.mm;
    const int decimals = std::max(0, static_cast<int>(std::ceil(2.0 + std::log10(um))));
    for (const char* form : {"Error ({})", "Error [{}]", "Abweichung / {}", "Deviation, {}", "误差（{}）"}) {
      SCOPED_TRACE(fmt::format(fmt::runtime(form), unit.text));
      expect_right(axis_table({axis_run("Run"), axis_direction("Direction", "+", "-"), axis_target("Position (mm)"),
                               axis_error(fmt::format(fmt::runtime(form), unit.text), um, decimals)}));
    }
  }
  for (const UnitName& unit :
       {UnitName{"in", 25.4}, {"inch", 25.4}, {"\"", 25.4}, {"m", 1000.0}, {"um", 1e-3}, {"cm", 10.0}}) {
    expect_right(
        axis_table({axis_run("Run"), axis_direction("Direction", "+", "-"),
                    axis_target(fmt::format("Position ({})", unit.text), unit.mm, 6), axis_error("Error (um)")}));
  }
  expect_right(axis_table({axis_run("run"), axis_direction("direction", "+", "-"), axis_target("position_in", 25.4, 6),
                           axis_error("error_uin", 0.0254, 2)}));
  // A row of units below the names.
  const std::string rows = axis_table(
      {axis_run("Run"), axis_direction("Direction", "+", "-"), axis_target("Position"), axis_error("Error")});
  expect_right(replaced(rows, "Error\n", "Error\n;;mm;µm\n"));
  expect_right(replaced(rows, "Error\n", "Error\n-;-;[mm];[um]\n"));
  expect_right("Position unit: mm\nError unit: um\n\n" + rows);
}

TEST(AxisFiles, AUnitThatIsNotSaidOrNotKnownIsRefused) {
  const auto with = [](const char* target, const char* error) {
    return axis_table({axis_run("Run"), axis_direction("Direction", "+", "-"), axis_target(target), axis_error(error)});
  };
  expect_refused(with("Position", "Error (um)"), "Position", "1");
  expect_refused(with("Position (mm)", "Error"), "Error", "1");
  expect_refused(with("Position (mm)", "Error (%)"), "Error (%)", "1");
  expect_refused(with("Position (mm)", "Error (um/m)"), "Error (um/m)", "1");
  expect_refused(with("Position (mm)", "Error (digits)"), "Error (digits)", "1");
  const std::string rows = axis_table(
      {axis_run("Run"), axis_direction("Direction", "+", "-"), axis_target("Position (mm)"), axis_error("Error (um)")});
  expect_refused(replaced(rows, "Error (um)\n", "Error (um)\n;;mm;mm\n"), "Error (um)", "2");
}

TEST(AxisFiles, RotaryAxesAreRefusedByName) {
  for (const char* unit : {"deg", "°", "degrees", "Grad", "度", "arcsec", "rad"}) {
    const auto report =
        parse_laser(axis_table({axis_run("Run"), axis_direction("Direction", "+", "-"),
                                axis_target(fmt::format("Position ({})", unit)), axis_error("Error (arcsec)")}),
                    "a.csv");
    ASSERT_FALSE(report) << unit;
    EXPECT_NE(report.error().context.at("found").find("rotary"), std::string::npos) << describe(report.error());
  }
  const auto arcsec =
      parse_laser(axis_table({axis_run("Run"), axis_target("Position (mm)"), axis_error("Error (arcsec)")}), "a.csv");
  ASSERT_FALSE(arcsec);
  EXPECT_NE(arcsec.error().context.at("found").find("rotary"), std::string::npos);
  EXPECT_EQ(parse_laser("HEADER::\nFile type: Rotary\n", "a.rta").error().code, ErrorCode::wrong_format);
}

TEST(AxisFiles, WhatStandsTwiceIsComparedAndCountedOnce) {
  for (const char decimal : {'.', ','}) {
    expect_right(
        axis_table({axis_run("Run"), axis_direction("Direction", "+", "-"), axis_target("Target (mm)", 1, 3, decimal),
                    axis_measured("Actual (mm)", 1, 4, decimal), axis_error("Deviation (um)", 1, 1, decimal)}));
    expect_right(axis_table(
        {axis_target("Sollposition [mm]", 1, 3, decimal), axis_measured("Istposition [mm]", 1, 4, decimal),
         axis_error("Abweichung [µm]", 1, 1, decimal), axis_direction("Richtung", "vor", "zurück"), axis_run("Lauf")}));
    expect_right(
        axis_table({axis_target("目标位置(mm)", 1, 3, decimal), axis_measured("实际位置(mm)", 1, 4, decimal),
                    axis_error("误差(µm)", 1, 1, decimal), axis_direction("方向", "正向", "反向"), axis_run("循环")}));
  }
  expect_right(axis_table({axis_target("Target (mm)"), axis_error("Error (mm)", 1000, 4), axis_error("Error (um)"),
                           axis_direction("Direction", "+", "-"), axis_run("Run")}));
  expect_right(axis_table({axis_target("Target (mm)"), axis_target("Target (in)", 25.4, 5), axis_error("Error (um)"),
                           axis_direction("Direction", "+", "-"), axis_run("Run")}));
  expect_right(axis_table({axis_target("Tgt_pos (mm)"), axis_measured("Reference (mm)"),
                           axis_error("Diff ref-tgt (um)"), axis_direction("Direction", "+", "-"), axis_run("Run")}));
  // The sign turned, said by the name.
  expect_right(
      axis_table({axis_target("Target (mm)"), axis_measured("Actual (mm)"), axis_error("Target - Actual (um)", -1.0),
                  axis_direction("Direction", "+", "-"), axis_run("Run")}));
  expect_right(axis_table({axis_target("Soll (mm)"), axis_error("Soll-Ist (um)", -1.0),
                           axis_direction("Richtung", "+", "-"), axis_run("Lauf")}));
}

TEST(AxisFiles, WhatContradictsIsRefused) {
  expect_refused(
      axis_table({axis_target("Target (mm)"), axis_measured("Actual (mm)"), axis_error("Deviation (um)", -1.0),
                  axis_direction("Direction", "+", "-"), axis_run("Run")}),
      "Actual (mm)");
  expect_refused(axis_table({axis_target("Target (mm)"), axis_error("Error (um)"), axis_error("Error 2 (um)", 2.0),
                             axis_direction("Direction", "+", "-")}),
                 "Error 2 (um)");
  expect_refused(axis_table({axis_target("Target (mm)"), axis_target("Position (mm)", 2.0), axis_error("Error (um)"),
                             axis_direction("Direction", "+", "-"), axis_run("Run")}),
                 "Position (mm)");
  expect_refused(axis_table({axis_target("Target (mm)"), axis_error("Compensation (um)", -1.0),
                             axis_direction("Direction", "+", "-"), axis_run("Run")}),
                 "Compensation (um)");
}

TEST(AxisFiles, ColumnsBesideTheReadingsAreListedOrRefused) {
  const std::string text =
      axis_table({axis_words("No.", "7"), axis_words("Time", "12:30"), axis_target("Position (mm)"),
                  axis_words("Laser signal (%)", "87"), axis_error("Error (um)"), axis_words("Air temp (°C)", "20.1"),
                  axis_words("Pressure (hPa)", "1013"), axis_direction("Direction", "+", "-"), axis_run("Run"),
                  axis_words("Remark", "good"), axis_words("Status", "OK"), axis_words("", "")});
  expect_right(text);
  const auto report = parse_laser(text, "a.csv");
  ASSERT_TRUE(report);
  const auto fate = [&](const std::string& column) {
    for (const auto& one : report->columns) {
      if (one.column == column) return one.fate;
    }
    return std::string("not listed");
  };
  EXPECT_EQ(fate("Laser signal (%)"), "not used: in %");
  EXPECT_EQ(fate("Position (mm)"), "position in mm");
  EXPECT_EQ(fate("Error (um)"), "error in um");
  for (const char* column : {"No.", "Time", "Air temp (°C)", "Pressure (hPa)", "Remark", "Status"}) {
    EXPECT_NE(fate(column), "not listed") << column;
  }
  for (const char* name : {"Factor", "Scale", "K1", "Sign", "Temp?", "Korr"}) {
    const std::string other = axis_table({axis_target("Position (mm)"), axis_error("Error (um)"), axis_words(name, "2"),
                                          axis_direction("Direction", "+", "-"), axis_run("Run")});
    const auto refused = parse_laser(other, "a.csv");
    if (std::string(name) == "Temp?") continue;
    expect_refused(other, name, "1");
  }
  std::string bad = axis_table({axis_target("Position (mm)"), axis_error("Error (um)"), axis_words("Status", "OK"),
                                axis_direction("Direction", "+", "-"), axis_run("Run")});
  expect_refused(replaced(bad, "OK;+;1\n50", "FAIL;+;1\n50"), "Status");
}

TEST(AxisFiles, AColumnForEachRun) {
  const auto both = [](bool up, int run) { return fmt::format("Run {} {} (um)", run, up ? "up" : "down"); };
  expect_right(wide_axis_table("Position (mm)", both));
  expect_right(wide_axis_table("Position (mm)",
                               [](bool up, int run) { return fmt::format("{} {} (µm)", up ? "↑" : "↓", run); }));
  expect_right(wide_axis_table(
      "Sollposition / mm",
      [](bool up, int run) { return fmt::format("Abweichung {} Lauf {} / µm", up ? "vorwärts" : "rückwärts", run); },
      false, ','));
  expect_right(wide_axis_table(
      "目标位置(mm)", [](bool up, int run) { return fmt::format("{}误差{}(um)", up ? "正向" : "反向", run); }));
  expect_right(wide_axis_table(
      "Target (mm)", [](bool up, int run) { return fmt::format("Measured {} {} (mm)", up ? "fwd" : "rev", run); },
      true));
  // Directions in a row above, runs and units below.
  std::string grouped = wide_axis_table("Position (mm)", [](bool, int run) { return fmt::format("Run {} (um)", run); });
  grouped = ";up;down;up;down;up;down\n" + grouped;
  expect_right(grouped);
  // Means and figures beside the runs are not counted.
  std::string with_mean = wide_axis_table("Position (mm)", both);
  with_mean = replaced(with_mean, "(um)\n", "(um);Mean up (um);Mean down (um);Std dev (um)\n");
  std::string out;
  std::istringstream lines(with_mean);
  bool first = true;
  for (std::string line; std::getline(lines, line); first = false) out += line + (first ? "\n" : ";1.0;2.0;0.3\n");
  expect_right(out);
  expect_refused(wide_axis_table("Position (mm)",
                                 [](bool up, int run) { return fmt::format("Run {} (um)", 2 * run - (up ? 1 : 0)); }),
                 "Run 1 (um)", "1");
}

TEST(AxisFiles, ATableForEachDirection) {
  std::vector<AxisReading> up;
  std::vector<AxisReading> down;
  for (const AxisReading& r : axis_readings()) (r.up ? up : down).push_back(r);
  const std::vector<AxisColumn> columns = {axis_run("Run"), axis_target("Position (mm)"), axis_error("Error (um)")};
  for (const auto& [first, second] :
       std::vector<std::pair<std::string, std::string>>{{"Direction: forward", "Direction: reverse"},
                                                        {"Vorwärts", "Rückwärts"},
                                                        {"正向", "反向"},
                                                        {"=== Forward ===", "=== Backward ==="},
                                                        {"# Direction +", "# Direction -"},
                                                        {"Richtung: hin", "Richtung: zurück"}}) {
    SCOPED_TRACE(first);
    expect_right("Axis test\n\n" + first + "\n" + axis_table(columns, ";", up) + "\n" + second + "\n" +
                 axis_table(columns, ";", down));
    // The header once only.
    std::string rest = axis_table(columns, ";", down);
    rest.erase(0, rest.find('\n') + 1);
    expect_right(first + "\n" + axis_table(columns, ";", up) + "\n" + second + "\n" + rest);
  }
  expect_refused("Table 1\n" + axis_table(columns, ";", up) + "\nTable 2\n" + axis_table(columns, ";", down),
                 "Position (mm)");
}

TEST(AxisFiles, DecimalMarksAndThousandsAreTheFilesOwn) {
  const auto rows = [](char decimal, const char* separator, double mm_each) {
    return axis_table({axis_run("Run"), axis_direction("Direction", "+", "-"),
                       axis_target(mm_each == 1.0 ? "Position (mm)" : "Position (um)", mm_each, 3, decimal),
                       axis_error("Error (um)", 1.0, 1, decimal)},
                      separator);
  };
  expect_right(rows(',', ";", 1.0));
  expect_right(rows(',', "\t", 1.0));
  expect_right(rows('.', ",", 1.0));
  expect_right("sep=;\n" + rows(',', ";", 1.0));
  const auto grouped = [](char group, char decimal) {
    return axis_table({axis_run("Run"),
                       axis_direction("Direction", "+", "-"),
                       {"Position (um)",
                        [=](const AxisReading& r) {
                          const int um = static_cast<int>(1000.0 * r.target_mm);
                          return um < 1000 ? std::to_string(um) : fmt::format("{}{}{:03}", um / 1000, group, um % 1000);
                        }},
                       axis_error("Error (um)", 1.0, 1, decimal)});
  };
  expect_right(grouped('.', ','));
  expect_right(grouped(',', '.'));
  expect_right(grouped('\'', '.'));
  expect_right(grouped(' ', ','));
  // Comma and point both decimal, and a comma that may be either.
  std::string mixed = rows('.', ";", 1.0);
  mixed.replace(mixed.rfind('.'), 1, ",");
  EXPECT_FALSE(parse_laser(mixed, "a.csv"));
  EXPECT_FALSE(parse_laser("Position (mm);Error (um)\n1,000;2,000\n2,000;3,000\n", "a.csv"));
}

TEST(AxisFiles, EncodingsOfSpreadsheets) {
  const std::string german =
      axis_table({axis_run("Lauf"),
                  axis_direction("Richtung", "vorw\xE4rts",
                                 "r\xFC"
                                 "ckw\xE4rts"),
                  axis_target("Position (mm)", 1, 3, ','), axis_error("Abweichung (\xB5m)", 1, 1, ',')});
  expect_right(german);
  std::string wide = "\xFF\xFE";
  for (const char c : axis_table({axis_run("Run"), axis_direction("Direction", "+", "-"), axis_target("Position (mm)"),
                                  axis_error("Error (um)")},
                                 "\t")) {
    wide += std::string{c, '\0'};
  }
  expect_right(wide);
  std::string mac = axis_table(
      {axis_run("Run"), axis_direction("Direction", "+", "-"), axis_target("Position (mm)"), axis_error("Error (um)")});
  std::replace(mac.begin(), mac.end(), '\n', '\r');
  expect_right(mac);
}

TEST(AxisFiles, RowsThatCannotBeReadAreNamed) {
  const std::string rows = axis_table(
      {axis_run("Run"), axis_direction("Direction", "+", "-"), axis_target("Position (mm)"), axis_error("Error (um)")});
  expect_refused(replaced(rows, "1;+;100.000;", "1;+;100.000;x"), "Error (um)", "4");
  expect_refused(replaced(rows, "1;+;100.000;", "1;?;100.000;"), "Direction", "4");
  expect_refused(replaced(rows, "1;+;100.000;", "1;+;1OO;"), "Position (mm)", "4");
  expect_refused(replaced(rows, "1;+;100.000;", "one and a half;+;100.000;"), "Run", "4");
  EXPECT_EQ(parse_laser(replaced(rows, "1;+;100.000;", "1;+;100.000;2;2;"), "a.csv").error().code,
            ErrorCode::csv_cell_count);
  expect_refused("0;1\n50;2\n100;3\n", "#1");
}

TEST(AxisFiles, SignsAndFactorsAreNotGuessed) {
  const auto with = [](const char* error, double um = 1.0) {
    return axis_table(
        {axis_target("Position (mm)"), axis_error(error, um), axis_direction("Direction", "+", "-"), axis_run("Run")});
  };
  for (const char* name : {"Error x10 (um)", "Error (um) x 10", "Error (x10)", "Error /10 (um)", "-Error (um)",
                           "Error, sign inverted (um)", "Abweichung Vorzeichen gedreht (um)", "Error 10^-1 (um)"}) {
    expect_refused(with(name), name, "1");
  }
  for (const char* title :
       {"error = target - actual", "Abweichung = Soll - Ist", "Scale factor: 10", "Faktor 0,1", "Sign: inverted"}) {
    EXPECT_FALSE(parse_laser(std::string(title) + "\n" + with("Error (um)"), "a.csv")) << title;
  }
  expect_right("error = actual - target\nScale factor: 1\n" + with("Error (um)"));
  // A unit above the table that does not say of what.
  EXPECT_FALSE(parse_laser("Unit: um\n" + axis_table({axis_target("Position"), axis_error("Error (um)"),
                                                      axis_direction("Direction", "+", "-"), axis_run("Run")}),
                           "a.csv"));
  // A run that says its direction too.
  std::string joined =
      axis_table({axis_target("Position (mm)"),
                  axis_error("Error (um)"),
                  {"Run", [](const AxisReading& r) { return fmt::format("{}{}", r.run, r.up ? "F" : "B"); }}});
  expect_refused(joined, "Run", "2");
  expect_right(axis_table({axis_target("Position (mm)"),
                           axis_error("Error (um)"),
                           axis_direction("Direction", "+", "-"),
                           {"Run", [](const AxisReading& r) { return fmt::format("Run {}", r.run); }}}));
}

TEST(AxisFiles, AColumnMapSaysWhatColumnsAre) {
  const std::string text =
      axis_table({axis_words("K1", "2"), axis_target("Where", 25.4, 6), axis_error("Reading", 0.0254, 2),
                  axis_direction("Way", "FWD", "REV"), axis_run("Turn")});
  EXPECT_FALSE(parse_laser(text, "a.csv"));
  const auto with = [&](const char* columns) {
    std::vector<std::string> warnings;
    const auto map = recording::header_map_from_json(nlohmann::json::parse(columns), "map.json", &warnings);
    EXPECT_TRUE(map) << describe(map.error());
    LaserOptions options;
    options.map = *map;
    return parse_laser(text, "a.csv", options);
  };
  for (const char* map :
       {R"({"columns": {"K1": null, "Where": {"channel": "position_mm", "unit": "in"}, "Way": {"channel": "direction"},
            "Reading": {"channel": "error_um", "scale": 0.0254}, "Turn": {"channel": "run"}}})",
        R"({"columns": {"#1": null, "#2": {"channel": "target_mm", "scale": 25.4}, "#4": {"channel": "direction"},
            "#3": {"channel": "error_um", "scale": 0.0254}, "#5": {"channel": "run"}}})"}) {
    const auto report = with(map);
    ASSERT_TRUE(report) << describe(report.error());
    EXPECT_EQ(differences(*report, 0.0501), "");
  }
  const auto negated = with(R"({"columns": {"K1": null, "Where": {"channel": "position_mm", "unit": "in"},
      "Way": {"channel": "direction"}, "Reading": {"channel": "error_um", "scale": -0.0254}, "Turn": {"channel": "run"}}})");
  ASSERT_TRUE(negated) << describe(negated.error());
  EXPECT_NEAR(negated->readings[1].deviation_um, -axis_readings()[1].error_um, 0.05);
  EXPECT_FALSE(with(R"({"columns": {"Reading": {"channel": "T1_C"}}})"));
  EXPECT_FALSE(with(R"({"columns": {"K1": null, "Where": {"channel": "position_mm", "unit": "in"}}})"));
}

TEST(AxisFiles, OfTwoReadingsOfTheErrorNoneIsTakenSilently) {
  const auto with = [](const char* first, const char* second, double more_um) {
    AxisColumn other = axis_error(second);
    const auto cell = other.cell;
    other.cell = [cell, more_um](const AxisReading& r) {
      AxisReading moved = r;
      moved.error_um += more_um;
      return cell(moved);
    };
    return axis_table({axis_run("Run"), axis_direction("Direction", "+", "-"), axis_target("Position (mm)"),
                       axis_error(first), other});
  };
  for (const char* name : {"Temperature compensated error (um)", "Corrected error (um)", "korrigierte Abweichung (um)",
                           "bereinigter Fehler (um)"}) {
    EXPECT_FALSE(parse_laser(with("Raw error (um)", name, 5.0), "a.csv")) << name;
    expect_right(with("Raw error (um)", name, 0.0));
    expect_right(axis_table(
        {axis_run("Run"), axis_direction("Direction", "+", "-"), axis_target("Position (mm)"), axis_error(name)}));
  }
}

TEST(AxisFiles, ARtlThatStatesOtherUnitsIsRefused) {
  const auto with = [](const char* line) {
    return std::string("HEADER::\nFile type: Linear\nOwner: RENISHAW\n\nEQUIPMENT::\n") + line +
           "\n\nTARGET DATA::\nFiletype: 1\nTarget-count: 2\nTargets : \n0.0 100.0\n\nRUNS::\nRun-count: 2\n\n"
           "DEVIATIONS::\nRun Target Data:\n 1 1 0.5\n 1 2 1.5\n 2 2 1.0\n 2 1 0.0\n";
  };
  for (const char* line : {"Device: ML10", "Units: mm", "Deviation units: um", "Error unit: microns"}) {
    EXPECT_TRUE(parse_laser(with(line), "a.rtl")) << line;
  }
  for (const char* line : {"Units: inch", "Unit: in", "Deviation units: mm", "Error units: uin", "Target units: m"}) {
    const auto report = parse_laser(with(line), "a.rtl");
    ASSERT_FALSE(report) << line;
    EXPECT_EQ(report.error().code, ErrorCode::column_unclear);
    EXPECT_EQ(report.error().context.at("line"), "6");
  }
}

}  // namespace zerodrift::compensation
