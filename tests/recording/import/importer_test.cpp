#include "core/recording/import/importer.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/recording/csv.h"
#include "tests/support/logger_files.h"

namespace zerodrift::recording {
namespace {

Imported read_as(std::string_view bytes, const HeaderMap& map = {}) {
  auto out = import_recording(bytes, "a.csv", map);
  EXPECT_TRUE(out.has_value()) << (out ? "" : describe(out.error()));
  return out ? std::move(*out) : Imported{};
}

Error refusal_of(std::string_view bytes, const HeaderMap& map = {}) {
  const auto out = import_recording(bytes, "a.csv", map);
  EXPECT_FALSE(out.has_value()) << bytes;
  return out ? Error{} : out.error();
}

bool warns(const Imported& imported, ErrorCode code) {
  return std::any_of(imported.warnings.begin(), imported.warnings.end(),
                     [&](const Error& warning) { return warning.code == code; });
}

const ColumnFate& fate_of(const Imported& imported, std::string_view name) {
  const auto at = std::find_if(imported.columns.begin(), imported.columns.end(),
                               [&](const ColumnFate& fate) { return fate.name == name; });
  static const ColumnFate none;
  return at == imported.columns.end() ? none : *at;
}

/// The channels hold the run's values, in this order: front, column, probe.
void expect_run(const Imported& imported, std::vector<std::string> channels, double accuracy = 1e-6) {
  const auto run = logger_files::run();
  ASSERT_GE(imported.recording.rows(), run.size());
  for (std::size_t k = 0; k < run.size(); ++k) {
    EXPECT_NEAR(imported.recording.time_s[k], run[k].time_s, 1e-6);
    const double right[] = {run[k].front_C, run[k].column_C, run[k].probe_um};
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const Channel* channel = imported.recording.find(channels[c]);
      ASSERT_NE(channel, nullptr) << channels[c];
      if (std::isnan(channel->values[k])) continue;
      EXPECT_NEAR(channel->values[k], right[c], accuracy) << channels[c] << " in row " << k;
    }
  }
}

/// A table of one channel under this heading, beside the time and a sensor.
std::string under(const std::string& heading, const char* values = "1,2,3") {
  std::string out = "time_s,T1_C,\"" + heading + "\"\n";
  const std::string numbers(values);
  for (std::size_t k = 0, at = 0; at <= numbers.size(); ++k) {
    const std::size_t end = std::min(numbers.find(',', at), numbers.size());
    out += std::to_string(10 * k) + ",20.5," + numbers.substr(at, end - at) + "\n";
    at = end + 1;
  }
  return out;
}

HeaderMap map_from_text(const char* text) {
  const auto map = header_map_from_json(nlohmann::json::parse(text), "map.json", nullptr);
  EXPECT_TRUE(map.has_value()) << (map ? "" : describe(map.error()));
  return map.value_or(HeaderMap{});
}

}  // namespace

TEST(Importer, LoggersFilesOfOneRun) {
  expect_run(read_as(logger_files::contract()), {"T1_C", "T2_C", "dZ_um"});
  const Imported graphtec = read_as(logger_files::graphtec());
  expect_run(graphtec, {"CH1_C", "CH2_C", "CH3_um"});
  EXPECT_EQ(fate_of(graphtec, "CH3").label, "PROBE Z");
  EXPECT_EQ(fate_of(graphtec, "CH3").proposal, "dZ_um");
  EXPECT_EQ(fate_of(graphtec, "CH2").missing.at("BURNOUT"), 1);
  EXPECT_EQ(fate_of(graphtec, "Number").fate, "counter");
  EXPECT_EQ(graphtec.time.start, "2025-11-03T07:12:40");
  const Imported benchlink = read_as(logger_files::benchlink());
  expect_run(benchlink, {"101_C", "102_C", "103_um"});
  EXPECT_EQ(fate_of(benchlink, "102 (C)").missing.at("9.90000000E+37"), 2);
  EXPECT_EQ(benchlink.time.order, "day-month-year");
  const Imported hobo = read_as(logger_files::hobo());
  expect_run(hobo, {"front_C", "column_C"});
  EXPECT_EQ(hobo.time.start, "2025-11-23T07:12:40+01:00");
  EXPECT_EQ(fate_of(hobo, "End Of File (LGR S/N: 1)").fate, "words");
  expect_run(read_as(logger_files::labview()), {"front_C", "column_C", "probe_um"});
  const Imported even = read_as(logger_files::labview(false));
  expect_run(even, {"front_C", "column_C", "probe_um"});
  EXPECT_EQ(even.time.rule, "interval");
  expect_run(read_as(logger_files::picolog()), {"front_Ave._C", "column_Ave._C", "probe_Ave._um"});
}

TEST(Importer, UnitsComeFromNamesHeadersUnitsRowsAndTheMap) {
  const Imported read = read_as(
      "time_s,T1_F,Motor [K],dZ_mm,Probe (mil),n (1/s),Spindle load (kW),X_mm,dT_K\n"
      "0,68,293.15,0.001,1,50,5.5,100,3\n10,212,273.15,0.002,2,50,5.5,110,4\n");
  const Recording& r = read.recording;
  EXPECT_NEAR(r.find("T1_C")->values[1], 100.0, 1e-9);
  EXPECT_NEAR(r.find("Motor_C")->values[0], 20.0, 1e-9);
  EXPECT_NEAR(r.find("dZ_um")->values[1], 2.0, 1e-12);
  EXPECT_NEAR(r.find("Probe_um")->values[0], 25.4, 1e-12);
  EXPECT_NEAR(r.find("n_rpm")->values[0], 3000.0, 1e-9);
  EXPECT_NEAR(r.find("Spindle_load_W")->values[0], 5500.0, 1e-9);
  // Where an axis is is no error, and a difference of temperatures has no zero to shift.
  EXPECT_EQ(r.find("X_mm")->values[0], 100.0);
  EXPECT_EQ(r.find("dT_K")->values[0], 3.0);
  EXPECT_EQ(fate_of(read, "dT_K").proposal, "dT_C");
  EXPECT_EQ(fate_of(read, "n (1/s)").proposal, "spindle_rpm");
  EXPECT_EQ(fate_of(read, "Spindle load (kW)").proposal, "spindle_load_W");
  EXPECT_TRUE(warns(read, ErrorCode::column_converted));
  const Imported by_row = read_as("Time,A,B\ns,degF,um\n0,68,1\n10,77,2\n");
  EXPECT_NEAR(by_row.recording.find("A_C")->values[1], 25.0, 1e-9);
  EXPECT_EQ(by_row.recording.find("B_um")->values[1], 2.0);
  EXPECT_EQ(refusal_of("time_s,T1_C\ns,degF\n0,68\n").code, ErrorCode::unit_conflict);
}

// A motor that starts at 55 C in a recording without a room column stays at 55 C; a suspicion is no conversion.
TEST(Importer, ValuesAreNeverConvertedByTheirLook) {
  const Imported hot = read_as("time_s,T1_C,T2_C,motor\n0,55,68,293.15\n10,75,69,294.15\n");
  EXPECT_EQ(hot.recording.find("T1_C")->values[0], 55.0);
  EXPECT_EQ(hot.recording.find("T2_C")->values[0], 68.0);
  EXPECT_EQ(hot.recording.find("motor")->values[0], 293.15);
}

TEST(Importer, TheMapNamesScalesAndDrops) {
  const HeaderMap map = map_from_text(
      R"json({"columns": {"Temp 1 (degC)": {"channel": "T1_C"},
           "CH5": {"channel": "dZ_um", "scale": 1000, "offset": 0, "unit": "mm"}, "Remark": null,
           "#4": {"channel": "T2_C", "unit": "degF", "offset": 0.5}},
           "time": {"column": "Time", "format": "%d.%m.%Y %H:%M:%S"}, "missing": ["DEFECT", "-9999"]})json");
  const Imported read = read_as(
      "Time;Temp 1 (degC);CH5;B;Remark\n03.11.2025 07:12:40;20,5;0,001;68;a\n03.11.2025 "
      "07:13:00;DEFECT;0,002;-9999;b\n",
      map);
  EXPECT_EQ(read.recording.time_s.back(), 20.0);
  EXPECT_EQ(read.recording.find("T1_C")->values[0], 20.5);
  EXPECT_TRUE(std::isnan(read.recording.find("T1_C")->values[1]));
  EXPECT_NEAR(read.recording.find("dZ_um")->values[1], 2.0, 1e-12);
  EXPECT_NEAR(read.recording.find("T2_C")->values[0], 20.5, 1e-9);
  EXPECT_TRUE(std::isnan(read.recording.find("T2_C")->values[1]));
  EXPECT_EQ(fate_of(read, "Remark").fate, "dropped");
  // What import would save reads the file the same way.
  const auto saved = header_map_from_json(map_of(read, map), "saved", nullptr);
  ASSERT_TRUE(saved.has_value()) << describe(saved.error());
  const Imported again = read_as("Time;Temp 1 (degC);CH5;B;Remark\n03.11.2025 07:12:40;20,5;0,001;68;a\n", *saved);
  EXPECT_NEAR(again.recording.find("T2_C")->values[0], 20.5, 1e-9);
  EXPECT_NEAR(again.recording.find("dZ_um")->values[0], 1.0, 1e-12);
  EXPECT_EQ(refusal_of("time_s,a\n0,1\n", map_from_text(R"({"columns": {"b": null}})")).code,
            ErrorCode::map_column_missing);
  EXPECT_EQ(
      refusal_of("time_s,a\n0,1\n", map_from_text(R"({"columns": {"a": {"channel": "T_C", "unit": "mm"}}})")).code,
      ErrorCode::unit_conflict);
  EXPECT_EQ(refusal_of("time_s,a\n0,1\n",
                       map_from_text(R"({"columns": {"a": {"channel": "dZ_um", "unit": "mm", "scale": 100}}})"))
                .code,
            ErrorCode::unit_conflict);
}

TEST(Importer, WithoutHeaderTheColumnsAreAsked) {
  EXPECT_EQ(refusal_of("0,20.5\n10,20.6\n").code, ErrorCode::table_no_header);
  const Imported read = read_as("0,20.5\n10,20.6\n", map_from_text(R"({"columns": {"#2": {"channel": "T1_C"}},
      "time": {"column": "#1", "unit": "min"}})"));
  EXPECT_EQ(read.recording.time_s.back(), 600.0);
  EXPECT_EQ(read.recording.find("T1_C")->values[1], 20.6);
}

TEST(Importer, TimesInTheirUnits) {
  const auto last = [](std::string_view text) { return read_as(text).recording.time_s.back(); };
  EXPECT_EQ(last("Time (min),a\n0,1\n1,2\n"), 60.0);
  EXPECT_EQ(last("Sekunden;a\n0;1,5\n20;2\n"), 20.0);
  EXPECT_EQ(last("hours,a\n0,1\n0.5,2\n"), 1800.0);
  EXPECT_EQ(last("time_ms,a\n0,1\n500,2\n"), 0.5);
  EXPECT_EQ(last("Elapsed,a\n25:59:00,1\n26:00:01,2\n"), 61.0);
  EXPECT_EQ(last("Date;Time;a\n03.11.2025;23:59:50;1\n04.11.2025;00:00:10;2\n"), 20.0);
  const Imported two_columns = read_as("Datum;Uhrzeit;a\n03.11.2025;07:12:40;1,5\n03.11.2025;07:13:00;2\n");
  EXPECT_EQ(two_columns.time.rule, "clock");
  EXPECT_EQ(two_columns.time.start, "2025-11-03T07:12:40");
  EXPECT_EQ(two_columns.recording.channels.size(), 1U);
  EXPECT_EQ(last("Date,Time,a\n2025-11-03 00:00:00,23:59:50,1\n2025-11-04 00:00:00,00:00:10,2\n"), 20.0);
  EXPECT_EQ(last("Datum;Uhrzeit;a\n03.11.2025;07:12:40,5;1,5\n03.11.2025;07:12:41,0;2\n"), 0.5);
  EXPECT_EQ(last("timestamp,a\n2025-11-03T07:12:40.121Z,1\n2025-11-03T08:13:00.121+01:00,2\n"), 20.0);
  EXPECT_EQ(last("Time,a\n11/23/2025 11:59:50 PM,1\n11/24/2025 12:00:10 AM,2\n"), 20.0);
  EXPECT_EQ(read_as("Elapsed (s),Stamp,a\n0,2025-11-03 07:12:40,1\n20,2025-11-03 07:13:00,2\n").time.start,
            "2025-11-03T07:12:40");
  EXPECT_EQ(refusal_of("Time,a\n0,1\n1,2\n").code, ErrorCode::time_unit_unknown);
  EXPECT_EQ(refusal_of("a,b\n0,1\n1,2\n").code, ErrorCode::time_missing);
  const Error bad = refusal_of("Time,a\n2025-11-03 07:12:40,1\n2025-11-03 07:99:00,2\n");
  EXPECT_EQ(bad.code, ErrorCode::time_unreadable);
  EXPECT_EQ(bad.context.at("line"), "3");
}

// One sample a second in milliseconds since 1970 was taken for one each 1000 seconds.
TEST(Importer, TimesSince1970AreKnownByTheirSizeAndNamed) {
  for (const auto& [first, second] :
       std::vector<std::pair<const char*, const char*>>{{"1762153960", "1762153961"},
                                                        {"1762153960000", "1762153961000"},
                                                        {"1762153960000000", "1762153961000000"},
                                                        {"1762153960000000000", "1762153961000000000"}}) {
    for (const char* name : {"time_s", "Time", "epoch"}) {
      const Imported read = read_as(fmt::format("{},T1_C\n{},20\n{},21\n", name, first, second));
      ASSERT_EQ(read.recording.rows(), 2U) << first;
      EXPECT_NEAR(read.recording.time_s[1], 1.0, 1e-6) << first;
      EXPECT_EQ(read.time.start, "2025-11-03T07:12:40Z") << first;
      EXPECT_TRUE(warns(read, ErrorCode::time_epoch)) << first;
    }
  }
}

TEST(Importer, DatesOfTwoMeaningsAreAskedWhereTimesDependOnThem) {
  const Imported same_day = read_as("Time,a\n03/11/2025 07:12:40,1\n03/11/2025 07:13:00,2\n");
  EXPECT_EQ(same_day.recording.time_s.back(), 20.0);
  EXPECT_EQ(same_day.time.start, "");
  EXPECT_TRUE(warns(same_day, ErrorCode::time_start_unknown));
  const char* two_days = "Time,a\n03/11/2025 23:59:50,1\n04/11/2025 00:00:10,2\n";
  EXPECT_EQ(refusal_of(two_days).code, ErrorCode::time_ambiguous);
  EXPECT_EQ(read_as(two_days, map_from_text(R"({"time": {"column": "Time", "format": "%d/%m/%Y %H:%M:%S"}})"))
                .recording.time_s.back(),
            20.0);
}

TEST(Importer, ClocksThatJumpAreNamed) {
  const Imported autumn =
      read_as("Time,a\n2025-10-26 02:59:40,1\n2025-10-26 02:59:50,2\n2025-10-26 02:00:00,3\n2025-10-26 02:00:10,4\n");
  EXPECT_EQ(autumn.recording.time_s, (std::vector{0.0, 10.0, 20.0, 30.0}));
  EXPECT_TRUE(warns(autumn, ErrorCode::time_summer_end));
  const Imported spring =
      read_as("Time,a\n2025-03-30 01:59:40,1\n2025-03-30 01:59:50,2\n2025-03-30 03:00:00,3\n2025-03-30 03:00:10,4\n");
  EXPECT_EQ(spring.recording.time_s.back(), 3630.0);
  EXPECT_TRUE(warns(spring, ErrorCode::time_hour_missing));
  const Imported night = read_as("Time,a\n23:59:40,1\n23:59:50,2\n00:00:00,3\n");
  EXPECT_EQ(night.recording.time_s.back(), 20.0);
  EXPECT_TRUE(warns(night, ErrorCode::time_midnight));
  const Error back = refusal_of("Time,a\n2025-11-03 07:00:00,1\n2025-11-03 07:00:10,2\n2025-11-03 06:50:00,3\n");
  EXPECT_EQ(back.code, ErrorCode::csv_time_order);
  EXPECT_EQ(back.context.at("line"), "4");
  const Imported twice = read_as("time_s,a\n0,1\n10,2\n10,2\n20,3\n");
  EXPECT_EQ(twice.recording.rows(), 3U);
  EXPECT_TRUE(warns(twice, ErrorCode::time_repeated));
  EXPECT_EQ(refusal_of("time_s,a\n0,1\n10,2\n10,3\n").code, ErrorCode::csv_time_order);
}

TEST(Importer, SwitchesAndWords) {
  const Imported read =
      read_as("time_s,T1_C,coolant_on,execution,spindle_rpm\n0,20,OFF,READY,UNAVAILABLE\n10,21,ON,ACTIVE,3000\n");
  EXPECT_EQ(read.recording.find("coolant_on")->values, (std::vector{0.0, 1.0}));
  EXPECT_EQ(fate_of(read, "execution").fate, "words");
  EXPECT_TRUE(std::isnan(read.recording.find("spindle_rpm")->values[0]));
  EXPECT_EQ(read.recording.find("spindle_rpm")->values[1], 3000.0);
  EXPECT_EQ(read_as("time_s,door\n0,TRUE\n1,FALSE\n").recording.find("door")->values[0], 1.0);
  const Error word = refusal_of("time_s,coolant_on\n0,OFF\n10,MAYBE\n");
  EXPECT_EQ(word.code, ErrorCode::csv_bad_number);
  EXPECT_EQ(word.context.at("line"), "3");
  EXPECT_EQ(refusal_of("time_s,T1_C\n0,20\n10,ON\n").code, ErrorCode::csv_bad_number);
  EXPECT_TRUE(warns(read_as("time_s,T1_C\n0,20\n10,-9999\n"), ErrorCode::sentinel_suspected));
}

TEST(Importer, ElapsedTimeAndAClockBesideItMustAgree) {
  // WinCC calls a millionth of a day Time_ms.
  const char* text =
      "TimeString;a;Time_ms\n03.11.2025 07:12:40;1,5;45964300462,963\n03.11.2025 07:42:40;2;45964321296,296\n";
  const Error fault = refusal_of(text);
  EXPECT_EQ(fault.code, ErrorCode::unit_conflict);
  EXPECT_EQ(fault.context.at("column"), "Time_ms");
  EXPECT_EQ(read_as(text, map_from_text(R"({"time": {"column": "TimeString"}, "columns": {"Time_ms": null}})"))
                .recording.time_s.back(),
            1800.0);
}

TEST(Importer, LabviewSegmentsThatStartAgainAreRefused) {
  const std::string once = logger_files::labview();
  const auto second = once.find("Channels\t3");
  EXPECT_EQ(refusal_of(once + once.substr(second)).code, ErrorCode::csv_time_order);
}

TEST(Importer, NamesThatLookAlikeAreProposedOnly) {
  const Imported read = read_as("time_s,Room temp (degC),Temp 2,Coolant,RPM\n0,20,21,1,3000\n10,20,22,0,3000\n");
  EXPECT_EQ(fate_of(read, "Room temp (degC)").channel, "Room_temp_C");
  EXPECT_EQ(fate_of(read, "Room temp (degC)").proposal, "ambient_C");
  EXPECT_EQ(fate_of(read, "Temp 2").channel, "Temp 2");
  EXPECT_EQ(fate_of(read, "Temp 2").proposal, "Temp_2_C");
  EXPECT_EQ(fate_of(read, "Coolant").proposal, "coolant_on");
  EXPECT_EQ(fate_of(read, "RPM").proposal, "spindle_rpm");
  EXPECT_TRUE(warns(read, ErrorCode::column_proposed));
}

TEST(Importer, ColumnsOfOneNameKeepTheirPlaces) {
  const Imported read = read_as(
      "time_s,\"Temp, \xC2\xB0"
      "C (SEN 1)\",\"Temp, \xC2\xB0"
      "C (SEN 2)\"\n0,20,21\n");
  EXPECT_EQ(read.recording.find("Temp_2_C")->values[0], 20.0);
  EXPECT_EQ(read.recording.find("Temp_3_C")->values[0], 21.0);
  EXPECT_EQ(refusal_of("time_s,T1_F,T1_C\n0,68,20\n").code, ErrorCode::csv_bad_header);
}

TEST(Importer, ChannelNumbersMayBeNames) {
  const Imported read = read_as("Time (s),101,102\n0,20.5,21.5\n10,20.6,21.6\n");
  EXPECT_EQ(read.recording.find("101")->values[1], 20.6);
  const Imported joined = read_as(to_csv(read.recording));
  EXPECT_EQ(joined.recording.channels.size(), 2U);
}

TEST(Import, RefusesAFactorInAHeadingByName) {
  for (const char* name : {"T2", "dZ", "Probe Z", "Spindle", "前轴承"}) {
    for (const char* unit : {"°C", "um", "µm", "mm", "rpm"}) {
      for (const char* form :
           {"{} [0.1 {}]", "{} (0,01 {})", "{} ({} x10)", "{} [{}*10]", "{} {} x 0.1", "{} [1/100 {}]", "{} (10^-3 {})",
            "{} [1e-3 {}]", "{} [{}] ×10", "{} [{}/10]", "{} [10⁻² {}]"}) {
        const std::string heading = fmt::format(fmt::runtime(form), name, unit);
        const Error refused = refusal_of(under(heading));
        EXPECT_EQ(refused.code, ErrorCode::column_unclear) << heading << ": " << describe(refused);
        EXPECT_EQ(refused.context.at("column"), heading);
        EXPECT_EQ(refused.context.at("line"), "1");
        HeaderMap map;
        map.columns[heading] = ColumnRule{"T2_C", 0.1};
        const auto told = read_as(under(heading), map);
        ASSERT_NE(told.recording.find("T2_C"), nullptr) << heading;
        EXPECT_DOUBLE_EQ(told.recording.find("T2_C")->values[1], 0.2);
      }
    }
  }
  for (const char* bare : {"dZ_um x10", "T2_C*10", "dZ_um/10", "T2_C x 0.1"}) {
    EXPECT_EQ(refusal_of(under(bare)).code, ErrorCode::column_unclear) << bare;
  }
  const Error below = refusal_of("time,T1,dZ\ns,0.1 °C,0.1 µm\n0,200,1\n10,201,2\n20,202,3\n");
  EXPECT_EQ(below.context.at("column"), "T1") << describe(below);
  // Numbers that are places, ranges, classes and names.
  for (const char* heading : {"T2_C", "Probe X1 (um)", "Pt100 1/10 DIN (°C)", "T at 100 mm (°C)", "Probe 1000 um (um)",
                              "CH10 (°C)", "X10 (um)", "T_F (°C)", "Bearing 10", "n (1/min)", "T1.1 (°C)"}) {
    EXPECT_TRUE(import_recording(under(heading), "a.csv")) << heading;
  }
}

TEST(Import, RefusesNumbersWithTheirUnitBesideThem) {
  const Error refused = refusal_of(
      "\"54II\"\nTime;T1;T2;T1-T2\n00:00:00;20,00 °C;19,50 °C;0,50 °C\n00:00:10;20,05 °C;19,51 °C;0,54 °C\n");
  ASSERT_EQ(refused.code, ErrorCode::column_unclear) << describe(refused);
  EXPECT_EQ(refused.context.at("line"), "3");
  EXPECT_EQ(refused.context.at("column"), "#2");
  EXPECT_EQ(refusal_of("time_s,T1_C\n0,20 °F\n10,21 °F\n20,22 °F\n").code, ErrorCode::csv_bad_number);
}

TEST(Import, RefusesTwoUnitsInOneHeading) {
  for (const char* heading : {"dZ_mm_um", "dZ um [mm]", "dZ mm (µm)", "Probe_in [um]", "T2 °F (°C)", "T2_degF_C"}) {
    EXPECT_EQ(refusal_of(under(heading)).code, ErrorCode::unit_conflict) << heading;
  }
}

TEST(Import, WarnsOfTemperaturesThatLookLikeAnotherUnitAndKeepsThem) {
  const auto table = [](double first, double second, double room) {
    std::string out = "time_s,T1_C,T2_C,ambient_C\n";
    for (int k = 0; k < 30; ++k) out += fmt::format("{},{:.2f},{:.2f},{:.2f}\n", 10 * k, first + 0.1 * k, second, room);
    return out;
  };
  const auto suspected = [&](double first, double second, double room) {
    const auto read = read_as(table(first, second, room));
    EXPECT_DOUBLE_EQ(read.recording.find("T1_C")->values.front(), first);  // never converted
    std::string columns;
    for (const Error& warning : read.warnings) {
      if (warning.code == ErrorCode::unit_conflict) columns += warning.context.at("column") + " ";
    }
    return columns;
  };
  for (double room_C = 12.0; room_C < 40.0; room_C += 3.5) {
    EXPECT_EQ(suspected(room_C + 1.0, room_C, room_C), "") << room_C;
    EXPECT_EQ(suspected(room_C + 274.15, room_C, room_C), "T1_C ") << room_C;
    EXPECT_EQ(suspected(1.8 * room_C + 33.0, room_C, room_C), "T1_C ") << room_C;
    EXPECT_EQ(suspected(1.8 * room_C + 33.0, 1.8 * room_C + 32.0, 1.8 * room_C + 32.0), "T1_C T2_C ambient_C ")
        << room_C;
  }
  EXPECT_EQ(suspected(55.0, 21.0, 20.0), "") << "a motor that is warm from the day before";
}

}  // namespace zerodrift::recording
