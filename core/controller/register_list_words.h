#pragma once
// What the words in a list of registers mean. Shared by its reader; not for others.

#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace zerodrift::controller::list_words {

enum class ListColumn {
  unknown,
  name,
  address,
  function,
  type,
  count,
  scale,
  divisor,   // value = raw / divisor
  decimals,  // value = raw / 10^decimals
  bias,      // added to the value: no register map has it
  sign,
  missing,
  word_order,
  byte_order,
  endian,  // of both: "ABCD", "CDAB" ...
  unit,    // of the value: C, um ...
  slave,   // unit number of the line
  remark,
};
ListColumn list_column(std::string_view header);
/// "Register" is a name, or an address where its cells are numbers.
bool may_be_address(std::string_view header);

std::optional<std::string> type_word(std::string_view word);
std::optional<std::string> function_word(std::string_view word);
std::optional<std::string> order_word(std::string_view word);
/// Word order and byte order of "ABCD", "CDAB", "BADC", "DCBA", big and little endian.
std::optional<std::pair<std::string, std::string>> endian_word(std::string_view word);

/// "CDAB": of words and bytes at once.
bool names_both_orders(std::string_view word);
/// "little endian", "big": of a whole value, or of its bytes.
bool is_endian(std::string_view word);
/// A yes or a no, in a column that may say "signed" or "swapped".
bool is_flag(std::string_view word);

/// An address as it stands in a list.
struct ListAddress {
  enum class Form {
    plain,      // counts from 0 or from 1
    modicon_5,  // 40001 is the first holding register - or a plain number
    modicon_6,  // 400001
    modicon_x,  // 4x00001
    word,       // %MW0
  };
  Form form = Form::plain;
  int number = 0;        // as written, for plain; else from 0
  std::string function;  // of Modicon's numbers: "holding" or "input"; empty: not said
};
/// Nothing for what is no address of a register: coils, bits, %MD, data blocks.
std::optional<ListAddress> address_word(std::string_view word);

}  // namespace zerodrift::controller::list_words
