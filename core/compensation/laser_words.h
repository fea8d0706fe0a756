#pragma once
// What the words in an axis table mean: the direction in a cell, and the name of a column, in English, German and
// Chinese. What is not understood is said to be so, never guessed. Shared by the readers of laser reports; not for
// others.

#include <optional>
#include <string>
#include <string_view>

#include "core/compensation/laser_units.h"
#include "core/compensation/table.h"

namespace zerodrift::compensation::laser_parts {

struct DirectionWord {
  Approach approach = Approach::up;
  /// "cw", "left", "1" beside "0": a convention, which the order of the positions has to bear out.
  bool by_convention = false;
};
/// "FWD", "rückwärts", "Dir-", "negative direction", "←", "回程"; nothing for a word that is no direction.
std::optional<DirectionWord> direction_word(std::string_view word);
/// "both", "bidirectional", "双向".
bool means_both_directions(std::string_view text);
/// A direction among other words: "Forward Directional Avg Error", "Dev +", "偏差 正向".
std::optional<Approach> direction_in_name(std::string_view name);
/// A sign or a factor that is said in words or figures, of a column or above a table: "error = target - actual", "x10",
/// "sign inverted", "Faktor 0.1". What it does to a number is not guessed.
bool says_sign_or_factor(std::string_view text);
/// The number of a cell such as "Run 2" or "#3" that says nothing else.
std::optional<int> run_in_cell(std::string_view cell);
/// "Run 2", "Zyklus 3", "第2次"; nothing where no number is given.
std::optional<int> run_in_name(std::string_view name);

enum class ColumnRole {
  unknown,
  target,
  measured,
  error,         // actual - commanded
  compensation,  // the contrary sign, as a rule
  direction,
  run,
  axis,
  validity,  // whether the row counts
  remark,    // understood, and no reading: signal, temperature, time, row number, statistics, comments
};

struct ColumnName {
  std::string text;  // as the file has it
  ColumnRole role = ColumnRole::unknown;
  std::optional<Unit> unit;
  std::optional<Approach> approach;
  std::optional<int> run;
  bool both_directions = false;
  bool mean = false;
  bool negated = false;         // "target - actual"
  bool sign_or_factor = false;  // said in a way that is not understood: "x10", "sign inverted"
  bool value = false;           // named by direction or run alone: error or measured position, as its numbers are
  std::optional<double> scale;  // said by the user, into the unit of the role: mm or um
  std::optional<double> offset;
};
ColumnName column_name(std::string_view text);

}  // namespace zerodrift::compensation::laser_parts
