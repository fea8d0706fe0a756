// Lists of registers as PLC projects give them: right addresses and scales, or a refusal that names line and column.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/controller/register_map.h"

namespace zerodrift::controller {
namespace {

Result<RegisterMap> map_of(const std::string& text, int base = -1, std::vector<std::string>* warnings = nullptr) {
  return register_map_from_list(text, "plc.csv", base, warnings);
}

/// Two sensors at 10 and 11, the room at 30, the switch at 40; temperatures in tenths.
void expect_right(const std::string& text, int base = -1) {
  const auto map = map_of(text, base);
  ASSERT_TRUE(map) << describe(map.error()) << "\n" << text;
  const Register& t = map->registers.at("temperature_C");
  EXPECT_EQ(t.address, 10) << text;
  EXPECT_EQ(t.count, 2) << text;
  EXPECT_EQ(t.type, RegisterType::int16) << text;
  EXPECT_DOUBLE_EQ(t.scale, 0.1) << text;
  EXPECT_EQ(t.space, RegisterSpace::holding) << text;
  EXPECT_EQ(map->registers.at("ambient_C").address, 30) << text;
  EXPECT_EQ(map->registers.at("compensation_state").address, 40) << text;
}

void expect_refused(const std::string& text, const std::string& column, const std::string& line) {
  const auto map = map_of(text);
  ASSERT_FALSE(map) << text;
  const auto& context = map.error().context;
  EXPECT_TRUE(context.contains("column") && context.at("column") == column) << describe(map.error());
  EXPECT_TRUE(context.contains("line") && context.at("line") == line) << describe(map.error());
}

/// A list with the four addresses as written in some notation.
std::string list(const std::string& header, const std::string& form, const std::vector<std::string>& addresses) {
  std::string out = header + "\n";
  const std::vector<std::string> elements = {"temperature_C[1]", "temperature_C[2]", "ambient_C", "compensation_state"};
  for (std::size_t i = 0; i < elements.size(); ++i) {
    out += fmt::format(fmt::runtime(form), elements[i], addresses[i], i == 3 ? "WORD" : "INT", i == 3 ? "1" : "0.1") +
           "\n";
  }
  return out;
}

const std::string plain_form = "{},{},{},{}";
const std::string plain_header = "name,address,type,scale";

}  // namespace

TEST(RegisterList, AddressesInEveryNotation) {
  expect_right(list(plain_header, plain_form, {"10", "11", "30", "40"}));
  expect_right(list(plain_header, plain_form, {"0x0A", "0x0B", "0x1E", "0x28"}));
  expect_right(list(plain_header, plain_form, {"40011", "40012", "40031", "40041"}));
  expect_right(list(plain_header, plain_form, {"400011", "400012", "400031", "400041"}));
  expect_right(list(plain_header, plain_form, {"4x00011", "4x00012", "4x00031", "4x00041"}));
  expect_right(list(plain_header, plain_form, {"4X11", "4X12", "4X31", "4X41"}));
  expect_right(list(plain_header, plain_form, {"%MW10", "%MW11", "%MW30", "%MW40"}));
  expect_right(list("name,address,function,type,scale", "{},{},holding,{},{}", {"40011", "40012", "40031", "40041"}));
  expect_right(list("name,address,function,type,scale", "{},{},3,{},{}", {"400011", "400012", "400031", "400041"}));
  expect_right(list(plain_header, plain_form, {"11", "12", "31", "41"}), 1);
  expect_right(list("name,address (1-based),type,scale", plain_form, {"11", "12", "31", "41"}));
  std::vector<std::string> warnings;
  ASSERT_TRUE(map_of(list(plain_header, plain_form, {"10", "11", "30", "40"}), -1, &warnings));
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(),
                          [](const auto& w) { return w.find("counted from 0") != std::string::npos; }));
  const auto input = map_of("name,address\nspindle_rpm,30005\n");
  ASSERT_TRUE(input) << describe(input.error());
  EXPECT_EQ(input->registers.at("spindle_rpm").space, RegisterSpace::input);
  EXPECT_EQ(input->registers.at("spindle_rpm").address, 4);
}

TEST(RegisterList, AddressesThatMayMeanAnotherRegisterAreRefused) {
  expect_refused("name,address\nambient_C,40011\nspindle_rpm,12\n", "address", "3");
  expect_refused("name,address,function\nambient_C,40011,input\n", "address", "2");
  for (const char* address : {"%MD10", "%MF10", "DB1.DBW10", "00011", "1x00011", "40011.3", "-1", "70000", "4x0"}) {
    expect_refused(fmt::format("name,address\nambient_C,{}\n", address), "address", "2");
  }
}

TEST(RegisterList, TheIndexInBracketsIsObeyed) {
  expect_right(
      "name,address,type,scale\ntemperature_C[2],400012,INT,0.1\ntemperature_C[1],400011,INT,0.1\n"
      "ambient_C,400031,INT,0.1\ncompensation_state,400041,WORD,1\n");
  expect_right(
      "name,address,type,scale\ntemperature_C[1],400012,INT,0.1\ntemperature_C[0],400011,INT,0.1\n"
      "ambient_C,400031,INT,0.1\ncompensation_state,400041,WORD,1\n");
  // The first sensor behind the second: no array has that.
  expect_refused("name,address,type,scale\ntemperature_C[2],400011,INT,0.1\ntemperature_C[1],400012,INT,0.1\n",
                 "address", "2");
  expect_refused("name,address\ntemperature_C[1],1\ntemperature_C[3],2\n", "name", "3");
  expect_refused("name,address\ntemperature_C[1],1\ntemperature_C[1],2\n", "name", "3");
  expect_refused("name,address\ntemperature_C[2],1\ntemperature_C[3],2\n", "name", "2");
  expect_refused("name,address\ntemperature_C[x],1\n", "name", "2");
  expect_refused("name,address\ntemperature_C[1],1\ntemperature_C[2],5\n", "address", "3");
  // Elements with scales of their own.
  expect_refused("name,address,scale\ntemperature_C[1],1,0.1\ntemperature_C[2],2,0.01\n", "name", "3");
  expect_refused("name,address,type\ntemperature_C[1],1,INT\ntemperature_C[2],2,WORD\n", "name", "3");
}

TEST(RegisterList, ColumnNamesInGermanAndChinese) {
  expect_right(list("Bezeichnung;Adresse;Datentyp;Faktor", "{};{};{};{}", {"40011", "40012", "40031", "40041"}));
  expect_right(
      list("Variablenname;Modbus-Adresse;Typ;Skalierung", "{};{};{};{}", {"40011", "40012", "40031", "40041"}));
  expect_right(list("名称,寄存器地址,数据类型,系数", plain_form, {"40011", "40012", "40031", "40041"}));
  expect_right(list("变量名\t地址\t类型\t倍率", "{}\t{}\t{}\t{}", {"40011", "40012", "40031", "40041"}));
  expect_right(list("Name,Register,Type,Scale factor", plain_form, {"40011", "40012", "40031", "40041"}));
  std::string comma = list("Name;Adresse;Typ;Faktor", "{};{};{};{}", {"40011", "40012", "40031", "40041"});
  for (auto at = comma.find("0.1"); at != std::string::npos; at = comma.find("0.1")) comma[at + 1] = ',';
  expect_right(comma);
  expect_right("Projekt VMC\nStand 2025-11-03\n\n" + comma);
  const auto function = map_of("名称,地址,功能码\nambient_C,5,4\n");
  ASSERT_TRUE(function) << describe(function.error());
  EXPECT_EQ(function->registers.at("ambient_C").space, RegisterSpace::input);
}

TEST(RegisterList, AColumnThatCouldChangeAValueIsNotDropped) {
  for (const char* heading : {"K", "Wandlung", "Zoom", "", "Rohwert max", "mult."}) {
    expect_refused(fmt::format("name,address,{}\nambient_C,10,0.1\n", heading),
                   std::string(heading).empty() ? "#3" : heading, "2");
  }
  expect_refused("name,address,swap order\nambient_C,10,CDAB\n", "swap order", "2");
  expect_refused("name,address,Wert offset,offset\nambient_C,10,,5\n", "offset", "2");
  expect_refused("name,address,unit\nambient_C,10,°F\n", "unit", "2");
  expect_refused("name,address,scale,divisor\nambient_C,10,0.1,10\n", "divisor", "2");
  const auto divided = map_of("name,address,divisor,description,unit\nambient_C,10,10,room,°C\n");
  ASSERT_TRUE(divided) << describe(divided.error());
  EXPECT_DOUBLE_EQ(divided->registers.at("ambient_C").scale, 0.1);
  const auto decimals = map_of("name,address,Nachkommastellen\nambient_C,10,2\n");
  ASSERT_TRUE(decimals) << describe(decimals.error());
  EXPECT_DOUBLE_EQ(decimals->registers.at("ambient_C").scale, 0.01);
  std::vector<std::string> warnings;
  const auto remarks = map_of("name,address,wo\nambient_C,10,hinten links\n", -1, &warnings);
  ASSERT_TRUE(remarks) << describe(remarks.error());
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(),
                          [](const auto& w) { return w.find("column wo") != std::string::npos; }));
}

TEST(RegisterList, FromAListOfAPlc) {
  std::vector<std::string> warnings;
  const auto good = map_of(
      "Name;Address;Data type;Factor;Function;Word order\n"
      "temperature_C[1];40011;INT;0.1;;\ntemperature_C[2];40012;INT;0.1;;\n"
      "compensation_state;0x28;BOOL;;3;\nhost_offset_um;40051;REAL;;;CDAB\nspindle_rpm;30005;REAL;;;\nM12;40008;WORD;;;"
      "\n",
      -1, &warnings);
  ASSERT_TRUE(good) << describe(good.error());
  EXPECT_EQ(good->name, "plc");
  EXPECT_EQ(good->registers.at("temperature_C").address, 10);
  EXPECT_EQ(good->registers.at("compensation_state").address, 40);
  EXPECT_FALSE(good->registers.at("host_offset_um").high_word_first);
  EXPECT_EQ(good->registers.at("spindle_rpm").space, RegisterSpace::input);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings.front().find("M12"), std::string::npos);
  for (const char* bad :
       {"name,address\na,1\na,2\n", "name,address,type\na,1,string\n", "tag\na\n", "name,address,scale\na,1,zero\n"}) {
    EXPECT_FALSE(map_of(bad)) << bad;
  }
  const auto one_unit = map_of("name,address,slave id\nambient_C,10,7\nspindle_rpm,11,7\n");
  ASSERT_TRUE(one_unit) << describe(one_unit.error());
  EXPECT_EQ(one_unit->unit, 7);
  expect_refused("name,address,slave id\nambient_C,10,7\nspindle_rpm,11,8\n", "slave id", "3");
}

TEST(RegisterList, OrdersOfWordsAndBytesWhereverTheyStand) {
  const std::vector<std::tuple<const char*, bool, bool>> orders = {
      {"ABCD", true, true}, {"CDAB", false, true}, {"BADC", true, false}, {"DCBA", false, false}};
  for (const char* column : {"Byte order", "Word order", "Endian", "Endianness", "Wortreihenfolge", "字节序"}) {
    for (const auto& [word, high_word, high_byte] : orders) {
      const auto map = map_of(fmt::format("name,address,type,{}\nambient_C,40031,REAL,{}\n", column, word));
      ASSERT_TRUE(map) << column << " " << word << ": " << describe(map.error());
      EXPECT_EQ(map->registers.at("ambient_C").high_word_first, high_word) << column << " " << word;
      EXPECT_EQ(map->registers.at("ambient_C").high_byte_first, high_byte) << column << " " << word;
    }
  }
  expect_refused("name,address,type,Byte order\nambient_C,40031,REAL,little endian\n", "Byte order", "2");
  EXPECT_FALSE(
      map_of("name,address,type,Byte order\nambient_C,40031,INT,little\n")->registers.at("ambient_C").high_byte_first);
  expect_refused("name,address,type,Byte order,Word order\nambient_C,40031,REAL,CDAB,high first\n", "Word order", "2");
  expect_refused("name,address,type,Byte order,Endian\nambient_C,40031,REAL,CDAB,DCBA\n", "Endian", "2");
}

TEST(RegisterList, AYesUnderAnUnknownHeadingMayChangeAValue) {
  for (const char* column : {"Signed", "Swapped", "Swap", "Vorzeichenbehaftet", "Byte swap", "BCD", "有符号"}) {
    for (const char* word : {"yes", "no", "x", "TRUE", "ja", "是"}) {
      expect_refused(fmt::format("name,address,type,{}\nambient_C,40031,INT,{}\n", column, word), column, "2");
    }
  }
  for (const char* column : {"Writable", "Alarm", "Remark", "Read only"}) {
    EXPECT_TRUE(map_of(fmt::format("name,address,type,{}\nambient_C,40031,INT,yes\n", column))) << column;
  }
}

}  // namespace zerodrift::controller
