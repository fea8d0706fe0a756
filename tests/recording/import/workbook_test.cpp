#include "core/recording/import/workbook.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/recording/import/importer.h"
#include "tests/support/workbook_writer.h"

namespace zerodrift::recording {

TEST(Workbook, ReadsValuesSharedStringsAndDates) {
  // 45964.30046296296 is 2025-11-03 07:12:40.
  const std::string bytes = workbook_of(
      {{"Notes", "<row r=\"1\"><c r=\"A1\" t=\"inlineStr\"><is><t>nothing</t></is></c></row>"},
       {"Run",
        "<row r=\"1\"><c r=\"A1\" t=\"s\"><v>0</v></c></row>"
        "<row r=\"3\"><c r=\"A3\" t=\"s\"><v>1</v></c><c r=\"B3\" t=\"s\"><v>2</v></c><c r=\"D3\" "
        "t=\"inlineStr\"><is><r><t>coolant</t></r><r><t>_on</t></r></is></c></row>"
        "<row r=\"4\"><c r=\"A4\" s=\"1\"><v>45964.30046296296</v></c><c r=\"B4\" s=\"3\"><v>20.09</v></c>"
        "<c r=\"D4\" t=\"b\"><v>0</v></c></row>"
        "<row><c s=\"1\"><v>45964.30069444444</v></c><c t=\"e\"><v>#N/A</v></c><c/><c t=\"b\"><v>1</v></c></row>"}},
      {"Run of November", "Time", "Motor (degC)"});
  HeaderMap map;
  map.table.sheet = "Run";
  const auto read = import_recording(bytes, "a.xlsx", map);
  ASSERT_TRUE(read.has_value()) << describe(read.error());
  EXPECT_EQ(read->form.encoding, "xlsx");
  EXPECT_EQ(read->form.sheet, "Run");
  EXPECT_EQ(read->time.start, "2025-11-03T07:12:40");
  EXPECT_EQ(read->recording.time_s, (std::vector{0.0, 20.0}));
  EXPECT_EQ(read->recording.find("Motor_C")->values[0], 20.09);
  EXPECT_TRUE(std::isnan(read->recording.find("Motor_C")->values[1]));
  EXPECT_EQ(read->recording.find("coolant_on")->values, (std::vector{0.0, 1.0}));
  map.table.sheet = "Other";
  EXPECT_EQ(import_recording(bytes, "a.xlsx", map).error().context.at("expected"), "Notes, Run");
}

TEST(Workbook, DurationsAndRowNumbers) {
  const std::string rows =
      "<row r=\"1\"><c r=\"A1\" t=\"str\"><v>Elapsed</v></c><c r=\"B1\" t=\"str\"><v>T1_C</v></c></row>"
      "<row r=\"5\"><c r=\"A5\" s=\"2\"><v>1.0</v></c><c r=\"B5\"><v>20</v></c></row>"
      "<row r=\"6\"><c r=\"A6\" s=\"2\"><v>1.5</v></c><c r=\"B6\" t=\"str\"><v>door</v></c></row>";
  const auto read = import_recording(workbook_of({{"a", rows}}), "a.xlsx");
  ASSERT_FALSE(read.has_value());
  EXPECT_EQ(read.error().code, ErrorCode::csv_bad_number);
  EXPECT_EQ(read.error().context.at("line"), "6");
  const auto cells = parse_workbook(workbook_of({{"a", rows}}), "a.xlsx");
  ASSERT_TRUE(cells.has_value());
  EXPECT_EQ(cells->cells.at(2, 0), "36:00:00");
}

TEST(Workbook, WhatIsNoWorkbookIsRefused) {
  const auto code = [](const std::string& bytes) { return parse_workbook(bytes, "a.xlsx").error().code; };
  EXPECT_EQ(code("PK\x03\x04 torn"), ErrorCode::wrong_format);
  EXPECT_EQ(code(zip_of({{"mimetype", "other"}})), ErrorCode::wrong_format);
  EXPECT_EQ(code(zip_of({{"xl/workbook.xml", "<workbook><sheets"}})), ErrorCode::wrong_format);
  EXPECT_EQ(code(workbook_of({{"a", "<row><c t=\"s\"><v>7</v></c></row>"}})), ErrorCode::wrong_format);
  EXPECT_EQ(code(workbook_of({{"a", "<row r=\"1\"><c r=\"A1\"><f>B1+1</f></c></row>"}})), ErrorCode::workbook_formula);
  EXPECT_EQ(import_recording("\xD0\xCF\x11\xE0 old", "a.xls").error().code, ErrorCode::wrong_format);
}

TEST(Workbook, WhatUnfoldsBeyondMeasureIsRefused) {
  const std::string bomb = workbook_of({{"a", std::string(std::size_t{110} << 20, ' ')}});
  EXPECT_LT(bomb.size(), std::size_t{1} << 20);
  EXPECT_EQ(parse_workbook(bomb, "a.xlsx").error().code, ErrorCode::file_too_large);
  std::string wide;
  for (int row = 1; row < 1500; ++row) {
    wide += "<row><c r=\"XFD" + std::to_string(row) + "\"><v>1</v></c></row>";
  }
  EXPECT_EQ(parse_workbook(workbook_of({{"a", wide}}), "a.xlsx").error().code, ErrorCode::file_too_large);
}

}  // namespace zerodrift::recording
