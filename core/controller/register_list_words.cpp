#include "core/controller/register_list_words.h"

#include <algorithm>
#include <charconv>
#include <vector>

namespace zerodrift::controller::list_words {
namespace {

using Words = std::initializer_list<std::string_view>;

// Modicon's numbers: 40001 is the first holding register, 30001 the first input register.
constexpr int modicon_block_5 = 10000;
constexpr int modicon_block_6 = 100000;
constexpr int holding_block = 4;
constexpr int input_block = 3;
constexpr int registers_there_are = 65536;

bool is_one_of(std::string_view text, Words words) {
  return std::find(words.begin(), words.end(), text) != words.end();
}

/// Lower case, umlauts as two letters, without blanks, "_", "-", "." and "/", and without what stands in brackets.
std::string plain(std::string_view given) {
  std::string text(given);
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : static_cast<char>(c);
  });
  static constexpr std::pair<std::string_view, std::string_view> letters[] = {{"ä", "ae"}, {"ö", "oe"}, {"ü", "ue"},
                                                                              {"Ä", "ae"}, {"Ö", "oe"}, {"Ü", "ue"},
                                                                              {"ß", "ss"}, {"（", "("}, {"）", ")"}};
  for (const auto& [from, to] : letters) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
      text.replace(at, from.size(), to);
    }
  }
  if (const auto open = text.find('('); open != std::string::npos && open > 0 && text.ends_with(')')) text.erase(open);
  std::erase_if(text, [](char c) { return std::string_view(" _-./:").find(c) != std::string_view::npos; });
  return text;
}

std::optional<int> whole(std::string_view digits, int base = 10) {
  int value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, base);
  if (digits.empty() || error != std::errc{} || end != digits.data() + digits.size() || value < 0) return std::nullopt;
  return value;
}

/// 4 or 3 of "4x00011", and the number behind it from 0.
std::optional<ListAddress> modicon(int block, int number, ListAddress::Form form) {
  if (number < 1 || number > registers_there_are || (block != holding_block && block != input_block))
    return std::nullopt;
  return ListAddress{form, number - 1, block == holding_block ? "holding" : "input"};
}

}  // namespace

ListColumn list_column(std::string_view header) {
  const std::string name = plain(header);
  const auto is = [&](Words words) { return is_one_of(name, words); };
  if (is({"name",      "register",      "registername", "meaning",      "tag",        "tagname",    "tagname",
          "symbol",    "symbolname",    "variable",     "variablename", "signal",     "signalname", "bezeichnung",
          "bedeutung", "variablenname", "symbolname",   "registername", "signalname", "kanal",      "channel",
          "groesse",   "名称",          "变量",         "变量名",       "变量名称",   "标签",       "标签名",
          "点名",      "信号",          "信号名",       "寄存器名",     "寄存器名称", "参数",       "参数名"})) {
    return ListColumn::name;
  }
  if (is({"address",
          "addr",
          "addresse",
          "adresse",
          "registeradresse",
          "registeraddress",
          "registeradresse",
          "regaddr",
          "modbusaddress",
          "modbusadresse",
          "modbusadresse",
          "modbusregister",
          "registernumber",
          "registernummer",
          "registernr",
          "registerno",
          "reg",
          "regnr",
          "regno",
          "startaddress",
          "startadresse",
          "number",
          "operand",
          "地址",
          "寄存器地址",
          "寄存器",
          "寄存器号",
          "寄存器编号",
          "modbus地址",
          "起始地址"})) {
    return ListColumn::address;
  }
  if (is({"function",      "functioncode", "functioncode",    "space",       "area",     "fc",
          "registertype",  "registertype", "registerart",     "registertyp", "funktion", "funktionscode",
          "funktionscode", "bereich",      "speicherbereich", "objecttype",  "功能码",   "功能",
          "区域",          "寄存器类型",   "存储区"})) {
    return ListColumn::function;
  }
  if (is({"type", "datatype", "datatype", "format", "dataformat", "datentyp", "typ", "datentyp", "datenformat",
          "数据类型", "类型", "格式", "数据格式"})) {
    return ListColumn::type;
  }
  if (is({"count", "length", "size", "elements", "quantity", "anzahl", "laenge", "groesseinworten", "elemente", "数量",
          "长度", "个数", "元素个数"})) {
    return ListColumn::count;
  }
  if (is({"scale",         "factor",     "gain",
          "multiplier",    "scaling",    "scalefactor",
          "scalingfactor", "resolution", "faktor",
          "skalierung",    "skala",      "skalierungsfaktor",
          "multiplikator", "aufloesung", "umrechnungsfaktor",
          "比例",          "系数",       "倍率",
          "缩放",          "比例系数",   "缩放系数",
          "比例因子",      "因子",       "分辨率",
          "换算系数"})) {
    return ListColumn::scale;
  }
  if (is({"divisor", "divider", "div", "teiler", "除数", "分频"})) return ListColumn::divisor;
  if (is({"decimals", "decimalplaces", "decimalpoint", "nachkommastellen", "kommastellen", "dezimalstellen", "小数位",
          "小数位数", "小数点"})) {
    return ListColumn::decimals;
  }
  if (is({"offset", "valueoffset", "bias", "versatz", "nullpunkt", "zero", "偏移", "偏移量", "偏置", "零点"})) {
    return ListColumn::bias;
  }
  if (is({"sign", "vorzeichen", "正负号", "符号位"})) return ListColumn::sign;
  if (is({"missing", "novalue", "invalid", "invalidvalue", "fehlwert", "ungueltig", "ersatzwert", "无效值",
          "缺失值"})) {
    return ListColumn::missing;
  }
  if (is({"wordorder", "wordorder", "words", "wortreihenfolge", "wortreihenfolge", "wordswap", "字序", "字顺序"})) {
    return ListColumn::word_order;
  }
  if (is({"byteorder", "byteorder", "bytes", "bytereihenfolge", "bytereihenfolge", "字节序", "字节顺序"})) {
    return ListColumn::byte_order;
  }
  if (is({"endian", "endianness", "endianess", "大小端", "字节端序"})) return ListColumn::endian;
  if (is({"unit", "units", "einheit", "masseinheit", "physicalunit", "engunit", "单位", "工程单位"}))
    return ListColumn::unit;
  if (is({"slave", "slaveid", "slaveid", "unitid", "unitid", "deviceid", "geraeteadresse", "slaveadresse",
          "slaveaddress", "stationsadresse", "station", "从站", "从站地址", "站号", "设备地址"})) {
    return ListColumn::slave;
  }
  if (is({"comment",      "comments",  "description", "remark",       "remarks",      "note",
          "notes",        "access",    "writable",    "writeable",    "readable",     "readonly",
          "schreibbar",   "lesbar",    "alarm",       "archive",      "archiv",       "logged",
          "log",          "visible",   "sichtbar",    "rw",           "rw",           "readwrite",
          "beschreibung", "kommentar", "bemerkung",   "zugriff",      "hinweis",      "text",
          "no",           "nr",        "#",           "lfdnr",        "pos",          "id",
          "group",        "gruppe",    "default",     "defaultvalue", "initialvalue", "standardwert",
          "读写",         "注释",      "描述",        "说明",         "备注",         "序号",
          "编号",         "分组",      "权限",        "访问",         "默认值"})) {
    return ListColumn::remark;
  }
  return ListColumn::unknown;
}

bool may_be_address(std::string_view header) {
  return is_one_of(plain(header), {"register", "reg", "offset", "variable"});
}

std::optional<std::string> type_word(std::string_view given) {
  const std::string word = plain(given);
  static const std::vector<std::pair<const char*, std::vector<std::string_view>>> known = {
      {"int16",
       {"int16", "int", "short", "s16", "i16", "signed", "int16", "sint16", "signedint", "signedint16", "16bitsigned",
        "signed16", "有符号16位", "有符号整数", "整数", "短整型"}},
      {"uint16",
       {"uint16", "uint", "word", "ushort", "u16", "unsigned", "bool", "", "uint16", "unsignedint16", "wort",
        "unsignedint", "16bitunsigned", "unsigned16", "无符号16位", "无符号整数", "字", "布尔"}},
      {"int32",
       {"int32", "dint", "long", "s32", "i32", "int32", "signedint32", "32bitsigned", "signed32", "有符号32位",
        "长整型", "双整数"}},
      {"uint32",
       {"uint32", "udint", "dword", "ulong", "u32", "uint32", "unsignedint32", "32bitunsigned", "doppelwort",
        "unsigned32", "无符号32位", "双字"}},
      {"float32",
       {"float32", "real", "float", "single", "f32", "float32", "real32", "32bitfloat", "gleitkomma", "浮点", "浮点数",
        "单精度", "单精度浮点", "实数"}}};
  for (const auto& [type, words] : known) {
    if (std::find(words.begin(), words.end(), word) != words.end()) return type;
  }
  return std::nullopt;
}

std::optional<std::string> function_word(std::string_view given) {
  const std::string word = plain(given);
  if (is_one_of(word, {"",
                       "holding",
                       "holdingregister",
                       "holdingregisters",
                       "hr",
                       "3",
                       "03",
                       "0x03",
                       "4x",
                       "6",
                       "16",
                       "36",
                       "316",
                       "3616",
                       "030616",
                       "fc3",
                       "fc03",
                       "halteregister",
                       "ausgangsregister",
                       "haltereg",
                       "rw",
                       "4xxxx",
                       "保持寄存器",
                       "保持",
                       "输出寄存器"})) {
    return "holding";
  }
  if (is_one_of(word, {"input", "inputregister", "inputregisters", "ir", "4", "04", "0x04", "3x", "fc4", "fc04",
                       "eingangsregister", "eingang", "3xxxx", "输入寄存器", "输入"})) {
    return "input";
  }
  return std::nullopt;
}

std::optional<std::string> order_word(std::string_view given) {
  const std::string word = plain(given);
  if (is_one_of(word, {"highfirst", "high", "big", "bigendian", "ab", "msw", "mswfirst", "hochzuerst", "highwordfirst",
                       "高字在前", "高位在前", "大端"})) {
    return "high_first";
  }
  if (is_one_of(word, {"lowfirst", "low", "little", "littleendian", "ba", "swapped", "swap", "lsw", "lswfirst",
                       "niedrigzuerst", "lowwordfirst", "低字在前", "低位在前", "小端"})) {
    return "low_first";
  }
  return std::nullopt;
}

std::optional<std::pair<std::string, std::string>> endian_word(std::string_view given) {
  const std::string word = plain(given);
  const auto orders = [](const char* words, const char* bytes) {
    return std::pair<std::string, std::string>{words, bytes};
  };
  if (is_one_of(word, {"abcd", "big", "bigendian", "大端"})) return orders("high_first", "high_first");
  if (is_one_of(word, {"cdab", "bigendianswap", "wordswap", "wordswapped"})) return orders("low_first", "high_first");
  if (is_one_of(word, {"badc", "byteswap", "byteswapped", "littleendianswap"}))
    return orders("high_first", "low_first");
  if (is_one_of(word, {"dcba", "little", "littleendian", "小端"})) return orders("low_first", "low_first");
  return std::nullopt;
}

bool names_both_orders(std::string_view given) {
  return is_one_of(plain(given), {"abcd", "cdab", "badc", "dcba"});
}

bool is_endian(std::string_view given) {
  return is_one_of(plain(given), {"little", "littleendian", "big", "bigendian", "大端", "小端"});
}

bool is_flag(std::string_view given) {
  return is_one_of(plain(given), {"yes", "no",   "y",      "n",   "x",   "true", "false", "on", "off", "ja", "nein",
                                  "j",   "wahr", "falsch", "oui", "non", "vrai", "faux",  "是", "否",  "✓"});
}

std::optional<ListAddress> address_word(std::string_view given) {
  std::string word;
  for (const char c : given) {
    if (c != ' ') word += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  if (word.starts_with("%mw") || word.starts_with("mw")) {
    const auto number = whole(std::string_view(word).substr(word.find('w') + 1));
    if (!number || *number >= registers_there_are) return std::nullopt;
    return ListAddress{ListAddress::Form::word, *number, ""};
  }
  if (word.starts_with("0x")) {
    const auto number = whole(std::string_view(word).substr(2), 16);
    if (!number) return std::nullopt;
    return ListAddress{ListAddress::Form::plain, *number, ""};
  }
  if (word.size() > 2 && word[1] == 'x') {
    const auto number = whole(std::string_view(word).substr(2));
    const bool block = word[0] == '4' || word[0] == '3';
    return number && block ? modicon(word[0] - '0', *number, ListAddress::Form::modicon_x) : std::nullopt;
  }
  const auto number = whole(word);
  if (!number) return std::nullopt;
  if (word.size() == 6)
    return modicon(*number / modicon_block_6, *number % modicon_block_6, ListAddress::Form::modicon_6);
  if (word.size() == 5) {
    if (word[0] == '0') return std::nullopt;  // of a coil
    const auto five = modicon(*number / modicon_block_5, *number % modicon_block_5, ListAddress::Form::modicon_5);
    if (five) return five;
  }
  if (*number >= registers_there_are) return std::nullopt;
  return ListAddress{ListAddress::Form::plain, *number, ""};
}

}  // namespace zerodrift::controller::list_words
