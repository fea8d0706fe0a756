#include "core/recording/import/cell_words.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <set>
#include <string>

namespace zerodrift::recording {
namespace {

constexpr std::size_t longest_word = 40;

std::string in_capitals(std::string_view word) {
  std::string out(word);
  for (char& c : out) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return out;
}

/// Nothing but one of these signs, twice or more: "---", "+++++", "****".
bool is_row_of_signs(std::string_view cell) {
  if (std::string_view("-+*?_.").find(cell.front()) == std::string_view::npos) return false;
  if (cell == "--.---" || cell == "--.--" || cell == "--.-") return true;
  return cell.size() > 1 && std::all_of(cell.begin(), cell.end(), [&](char c) { return c == cell.front(); });
}

}  // namespace

bool is_empty(std::string_view cell) {
  return cell.find_first_not_of(" \t") == std::string_view::npos;
}

bool means_missing(std::string_view cell) {
  if (is_empty(cell)) return true;
  if (cell.size() > longest_word) return false;
  if (is_row_of_signs(cell) || cell == "-" || cell == "?") return true;
  static const std::set<std::string, std::less<>> words = {
      // not a number, in the forms of C libraries and of LabVIEW
      "NAN", "-NAN", "+NAN", "NAN(IND)", "-NAN(IND)", "QNAN", "SNAN", "IND", "INF", "+INF", "-INF", "INFINITY",
      "+INFINITY", "-INFINITY", "∞", "-∞", "1.#QNAN", "-1.#QNAN", "1.#QNB", "1.#IND", "-1.#IND", "1.#INF", "-1.#INF",
      "1.#INF00", "1.#QNAN0", "-1.#IND00", "-1.#INF00", "1.#J", "NUMINF",
      // spreadsheets
      "#N/A", "#NV", "#DIV/0!", "#VALUE!", "#WERT!", "#REF!", "#BEZUG!", "#NAME?", "#NUM!", "#ZAHL!", "#NULL!", "N/A",
      "N.A.", "NA", "N/V", "N.V.", "NULL", "NONE", "NIL", "(NULL)", "<NULL>", "MISSING", "NO DATA", "NODATA",
      "NO VALUE", "EMPTY", "BLANK", "无效", "缺失", "无数据",
      // loggers and controllers
      "OL", "+OL", "-OL", "O.L", "O.L.", "0L", "OVLD", "OVER", "UNDER", "OVERLOAD", "OVERFLOW", "UNDERFLOW",
      "OVERRANGE", "UNDERRANGE", "OVER RANGE", "UNDER RANGE", "OVER-RANGE", "UNDER-RANGE", "+OVER", "-OVER", "+OR",
      "-OR", "OUT OF RANGE", "BURNOUT", "BURN OUT", "BURN-OUT", "BURN_OUT", "B.OUT", "BOUT", "OPEN", "OPEN TC",
      "OPEN CIRCUIT", "OTC", "SHORT", "FAULT", "FAIL", "FAILED", "ERROR", "ERR", "ERR!", "SENSOR ERROR", "SENSOR FAULT",
      "INVALID", "BAD", "UNAVAILABLE", "UNKNOWN", "UNDEFINED", "DISCONNECTED", "OFFLINE", "NOT CONNECTED", "NO SENSOR",
      "NO PROBE", "FEHLER", "FÜHLERBRUCH", "FüHLERBRUCH", "BRUCH", "UNGÜLTIG", "UNGüLTIG", "UEBERLAUF", "断线",
      "超量程", "故障"};
  if (words.contains(in_capitals(cell))) return true;
  if (cell.find_first_of("eE") == std::string_view::npos) return false;
  std::string digits(cell.substr(cell.front() == '+' ? 1 : 0));
  std::replace(digits.begin(), digits.end(), ',', '.');
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  return error == std::errc{} && end == digits.data() + digits.size() && std::abs(value) >= 9.89e37 &&
         std::abs(value) <= 1.01e38;  // SCPI: 9.9E37, 9.91E37
}

std::optional<double> switch_value(std::string_view cell) {
  if (cell.empty() || cell.size() > 12) return std::nullopt;
  static const std::set<std::string, std::less<>> on = {"ON", "TRUE", "YES", "EIN", "AN", "WAHR", "JA", "开", "是"};
  static const std::set<std::string, std::less<>> off = {"OFF", "FALSE", "NO", "AUS", "FALSCH", "NEIN", "关", "否"};
  const std::string word = in_capitals(cell);
  if (on.contains(word)) return 1.0;
  if (off.contains(word)) return 0.0;
  return std::nullopt;
}

}  // namespace zerodrift::recording
