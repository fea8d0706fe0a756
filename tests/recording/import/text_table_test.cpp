#include "core/recording/import/text_table.h"

#include <gtest/gtest.h>

#include <cmath>

namespace zerodrift::recording {
namespace {

SourceTable table_of(std::string_view bytes, const TableOptions& options = {}) {
  auto table = parse_source_table(bytes, "a.csv", options);
  EXPECT_TRUE(table.has_value()) << (table ? "" : describe(table.error()));
  return table ? std::move(*table) : SourceTable{};
}

Error error_of(std::string_view bytes) {
  const auto table = parse_source_table(bytes, "a.csv");
  EXPECT_FALSE(table.has_value());
  return table ? Error{} : table.error();
}

double number_at(const SourceTable& table, std::size_t row, std::size_t column) {
  const auto value = table.number(row, column);
  EXPECT_TRUE(value.has_value()) << (value ? "" : describe(value.error()));
  return value.value_or(-1.0);
}

std::string as_utf16(std::u16string_view text, bool little, bool mark) {
  std::string out;
  const auto put = [&](char16_t unit) {
    const char low = static_cast<char>(unit & 0xFF);
    const char high = static_cast<char>(unit >> 8);
    out += little ? low : high;
    out += little ? high : low;
  };
  if (mark) put(0xFEFF);
  for (const char16_t unit : text) put(unit);
  return out;
}

}  // namespace

TEST(TextTable, FindsTheEncoding) {
  const std::u16string_view text = u"Zeit;Temp °C;温度\r\n0;20,5;21,5\r\n10;20,6;21,6\r\n";
  const std::string utf8 =
      "Zeit;Temp \xC2\xB0"
      "C;\xE6\xB8\xA9\xE5\xBA\xA6\r\n0;20,5;21,5\r\n10;20,6;21,6\r\n";
  struct Case {
    std::string bytes;
    std::string encoding;
  };
  for (const Case& one : {Case{utf8, "UTF-8"}, Case{"\xEF\xBB\xBF" + utf8, "UTF-8 with BOM"},
                          Case{as_utf16(text, true, true), "UTF-16LE"}, Case{as_utf16(text, false, true), "UTF-16BE"},
                          Case{as_utf16(text, true, false), "UTF-16LE"},
                          Case{"Zeit;Temp \xA1\xE6;\xCE\xC2\xB6\xC8\n0;20,5;21,5\n10;20,6;21,6\n", "GB18030"},
                          Case{"Zeit;Temp \xB0"
                               "C;Gr\xF6\xDF"
                               "e\n0;20,5;21,5\n10;20,6;21,6\n",
                               "windows-1252"}}) {
    const SourceTable table = table_of(one.bytes);
    EXPECT_EQ(table.form.encoding, one.encoding);
    ASSERT_EQ(table.columns(), 3U) << one.encoding;
    EXPECT_EQ(number_at(table, 1, 2), 21.6);
  }
  EXPECT_EQ(table_of("Zeit;Temp \xB0"
                     "C\n0;1\n")
                .names[1],
            "Temp \xC2\xB0"
            "C");
  EXPECT_EQ(table_of("Zeit;\xCE\xC2\xB6\xC8\n0;1\n").names[1], "\xE6\xB8\xA9\xE5\xBA\xA6");
  TableOptions wrong;
  wrong.encoding = "UTF-8";
  EXPECT_EQ(parse_source_table("t;\xB0\n0;1\n", "a", wrong).error().code, ErrorCode::text_encoding);
  EXPECT_EQ(error_of(std::string_view("t,\0\n0,1\n", 8)).code, ErrorCode::wrong_format);
}

TEST(TextTable, FindsSeparatorsAndLineEnds) {
  for (const char* text :
       {"t,a,b\n0,1.5,2\n1,1.6,3\n", "t;a;b\r0;1,5;2\r1;1,6;3\r", "t\ta\tb\r\n0\t1.5\t2\r\n1\t1.6\t3\r\n",
        "  t    a   b\n  0  1.5   2\n  1  1.6   3  \n", "t|a|b\n0|1.5|2\n1|1.6|3\n", "sep=;\nt;a;b\n0;1.5;2\n1;1.6;3\n",
        "\"sep=;\"\nt;a;b\n0;1.5;2\n1;1.6;3\n", "t,a,b\n\"0\",\"1,5\",\"2\"\n\"1\",\"1,6\",\"3\"\n"}) {
    const SourceTable table = table_of(text);
    ASSERT_EQ(table.columns(), 3U) << text;
    EXPECT_EQ(number_at(table, 0, 1), 1.5) << text;
    EXPECT_EQ(number_at(table, 1, 2), 3.0) << text;
  }
  EXPECT_EQ(table_of("t  a\n0  1\n").form.separator, "blanks");
  EXPECT_EQ(table_of("sep=;\nt;a\n0;1\n").line(0), 3);
  EXPECT_EQ(table_of("t,\"a\nin two lines\"\n0,1\n").line(0), 3);
  EXPECT_EQ(error_of("t,a\n0,\"1\n1,2\n").code, ErrorCode::quote_open);
}

TEST(TextTable, OneNumberFormatForTheFile) {
  EXPECT_EQ(number_at(table_of("t;a\n0;20,09\n1;1.020,5\n"), 1, 1), 1020.5);
  EXPECT_EQ(number_at(table_of("t;a;b\n0;20,09;4.000\n"), 0, 2), 4000.0);
  EXPECT_EQ(number_at(table_of("t,a,b\n\"1,020\",20.0,\"4,000\"\n"), 0, 2), 4000.0);
  EXPECT_EQ(number_at(table_of("t;a\n0;0,012\n"), 0, 1), 0.012);
  EXPECT_EQ(number_at(table_of("t;a\n0;1 020,5\n1;2'345'678,5\n"), 1, 1), 2345678.5);
  EXPECT_EQ(number_at(table_of("t,a\n0,1.020\n"), 0, 1), 1.02);
  EXPECT_EQ(number_at(table_of("t;a\n0;-1,5E+01\n"), 0, 1), -15.0);
  EXPECT_EQ(number_at(table_of("t,a\n0,\xE2\x88\x92"
                               "2.5\n"),
                      0, 1),
            -2.5);
  EXPECT_EQ(number_at(table_of("t,a\n0,-   2.5\n"), 0, 1), -2.5);
  const Error either = error_of("t;a\n0;1,020\n1;4,000\n");
  EXPECT_EQ(either.code, ErrorCode::number_ambiguous);
  EXPECT_EQ(either.context.at("line"), "2");
  EXPECT_EQ(either.context.at("column"), "a");
  const Error both = error_of("t;a\n0;20,09\n1;20.19\n");
  EXPECT_EQ(both.code, ErrorCode::numbers_mixed);
  EXPECT_EQ(both.context.at("line"), "3");
  TableOptions said;
  said.decimal = ",";
  EXPECT_EQ(number_at(table_of("t;a\n0;1,020\n", said), 0, 1), 1.02);
  // Where a comma is a decimal sign, 1,02 is no thousand, and 10.20 no number.
  EXPECT_FALSE(NumberFormat({'.', true}).number("1,02"));
  EXPECT_FALSE(NumberFormat({',', true}).number("10.20"));
}

TEST(TextTable, BlocksBeforeTheTableAndUnitsRows) {
  const SourceTable logger = table_of(
      "Vendor, Nobody\nStart time, 2025/11/03, 07:12:40\nCH, Name, Range, Unit\nCH1, FRONT, 200, degC\n\n"
      "Number, Date&Time, ms, CH1, Alarm\nNO., Time, ms, degC, A12\n"
      "1, 2025/11/03 07:12:40, 0, +20.09, LL\n2, 2025/11/03 07:13:00, 0, +20.13, LL\n");
  EXPECT_EQ(logger.names, (std::vector<std::string>{"Number", "Date&Time", "ms", "CH1", "Alarm"}));
  EXPECT_EQ(logger.units[3], "degC");
  EXPECT_EQ(logger.line(0), 8);
  EXPECT_EQ(logger.block_end, 5U);
  EXPECT_EQ(logger.cells.at(3, 1), "FRONT");
  const SourceTable campbell = table_of(
      "\"TOA5\",\"st\",\"CR6\"\n\"TIMESTAMP\",\"RECORD\",\"T_Avg\"\n\"TS\",\"RN\",\"Deg C\"\n\"\",\"\",\"Avg\"\n"
      "\"2025-11-03 07:12:40\",0,20.5\n\"2025-11-03 07:13:00\",1,20.6\n");
  EXPECT_EQ(campbell.names[2], "T_Avg");
  EXPECT_EQ(campbell.units[2], "Deg C");
  const SourceTable scope = table_of("Time,Channel A\n(ms),(mV)\n\n0.5,1.25\n1.5,1.5\n");
  EXPECT_EQ(scope.names[0], "Time");
  EXPECT_EQ(scope.units[1], "(mV)");
  const SourceTable yokogawa = table_of(
      "Model,GP10\nDate,Time,mSec,CH1,CH2\n,,,degC,\n2025/11/03,07:12:40,0,20.1,1\n2025/11/03,07:13:00,0,20.2,2\n");
  EXPECT_EQ(yokogawa.names[3], "CH1");
  EXPECT_EQ(yokogawa.units[3], "degC");
  const SourceTable hash = table_of("# made by hand\n# t a\n0 1\n1 2\n");
  EXPECT_EQ(hash.names, (std::vector<std::string>{"t", "a"}));
  const SourceTable hobo =
      table_of("\"Plot Title: run\"\n#,\"Date Time, GMT+01:00\",\"Temp, C\"\n1,11/03/25 07:12:40 AM,20.1\n");
  EXPECT_EQ(hobo.names.front(), "#");
  const SourceTable labview = table_of(
      "LabVIEW Measurement\nSeparator\tTab\nDecimal_Separator\t,\n***End_of_Header***\n\nChannels\t1\n"
      "Y_Unit_Label\tDeg C\nX0\t0,0E+0\nDelta_X\t1,000\n***End_of_Header***\nX_Value\tTemp\tComment\n"
      "0,000\t20,125\n1,000\t20,250\tdoor open\n");
  EXPECT_EQ(labview.names[1], "Temp");
  EXPECT_EQ(labview.units[1], "Deg C");
  EXPECT_EQ(number_at(labview, 1, 1), 20.25);
}

TEST(TextTable, WithoutHeaderColumnsHaveNoNames) {
  const SourceTable table = table_of("0,20.5\n10,20.6\n");
  EXPECT_FALSE(table.has_header);
  EXPECT_EQ(table.columns(), 2U);
  EXPECT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.name_of(1), "#2");
}

TEST(TextTable, LinesThatAreNoRowsAreNamed) {
  const SourceTable table = table_of("t,a\n0,1.5\nt,a\n1,1.6\ndoor opened,\n# pause\n\n2,1.7\n");
  ASSERT_EQ(table.rows.size(), 3U);
  EXPECT_EQ(number_at(table, 2, 1), 1.7);
  ASSERT_EQ(table.remarks.size(), 2U);
  EXPECT_EQ(table.remarks[0].code, ErrorCode::header_repeated);
  EXPECT_EQ(table.remarks[1].context.at("line"), "5");
  const Error wide = error_of("t,a\n0,1\n1,2,3\n");
  EXPECT_EQ(wide.code, ErrorCode::csv_cell_count);
  EXPECT_EQ(wide.context.at("line"), "3");
  EXPECT_EQ(error_of("t,a,b\n0,1,2\n1,2\n").code, ErrorCode::csv_cell_count);
  EXPECT_EQ(error_of("t,a\n0,1\n1,2\nx,b\n0,1\n").code, ErrorCode::two_tables);
  EXPECT_EQ(error_of("t,a\n0,1\n1,2\n2,3\nx,b\n0,1\n1,2\n2,3\n").code, ErrorCode::two_tables);
  // Separators too many at the end of each line, or of some.
  EXPECT_EQ(table_of("t,a,,\n0,1,,\n1,2,\n").rows.size(), 2U);
}

TEST(TextTable, WordsForMissingSamples) {
  std::string text = "t;a\n";
  for (const char* word : {"OL", "---", "#N/A", "1.#QNAN", "BURNOUT", "UNAVAILABLE", "NaN", "Inf", "NULL", "9.9E37",
                           "9.90000000E+37", "+++++", "-OL", "#DIV/0!", "n/a", ""}) {
    text += "0;" + std::string(word) + "\n";
  }
  const SourceTable table = table_of(text);
  ASSERT_EQ(table.rows.size(), 16U);
  for (std::size_t row = 0; row < table.rows.size(); ++row) EXPECT_TRUE(std::isnan(number_at(table, row, 1))) << row;
  EXPECT_EQ(table_of("t;a\n0;20,5\n1;DOOR\n").number(1, 1).error().code, ErrorCode::csv_bad_number);
}

}  // namespace zerodrift::recording
