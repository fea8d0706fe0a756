#pragma once
// How numbers are written in a file: decimal point or comma, and what groups thousands. Decided for the file as a whole
// from all its cells; a cell such as "1,020" alone decides nothing, and a file of such cells alone is refused.

#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace zerodrift::recording {

struct NumberFormat {
  char decimal = '.';
  bool grouped = false;  // thousands are grouped by the other of point and comma

  /// The number, or nothing where the text is no number in this format. Blanks and apostrophes may group thousands.
  std::optional<double> number(std::string_view text) const;
};

/// A number in some format: digits, with points, commas and groups, and an exponent.
bool looks_like_number(std::string_view text);

/// Gathers what the cells of a file say about its format.
class NumberEvidence {
 public:
  struct Place {
    std::string cell;
    int line = 0;
    std::string column;
  };

  /// Text that is no number says nothing. `place` is asked for only where it is kept.
  template <class PlaceOf>
  void add(std::string_view text, PlaceOf place) {
    const Kind kind = kind_of_cell(text);
    if (kind == Kind::nothing || m_seen[static_cast<int>(kind)]) return;
    m_seen[static_cast<int>(kind)] = place();
  }
  /// Point where nothing speaks for a comma. number_ambiguous or numbers_mixed name a cell.
  Result<NumberFormat> decide(const std::string& file) const;

 private:
  enum class Kind {
    nothing,
    point,         // only a decimal point can be meant: 20.09
    comma,         // only a decimal comma: 20,09
    point_weak,    // 1.020: a decimal point, or thousands where the file has decimal commas
    comma_weak,    // 1,020
    point_groups,  // 1.234.567, or 1.234,5
    comma_groups,  // 1,234,567, or 1,234.5
    count
  };
  static Kind kind_of_cell(std::string_view text);

  std::optional<Place> m_seen[static_cast<int>(Kind::count)];
};

}  // namespace zerodrift::recording
