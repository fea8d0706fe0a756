#include "core/vision/file_order.h"

#include <algorithm>

namespace zerodrift::vision {
namespace {

bool is_figure(char c) {
  return c >= '0' && c <= '9';
}

/// The figures at the front, without the zeros before them.
std::string_view number_at_front(std::string_view text) {
  std::size_t end = 0;
  while (end < text.size() && is_figure(text[end])) ++end;
  text = text.substr(0, end);
  text.remove_prefix(std::min(text.find_first_not_of('0'), text.size()));
  return text;
}

void skip_figures(std::string_view& text) {
  while (!text.empty() && is_figure(text.front())) text.remove_prefix(1);
}

}  // namespace

bool is_before_by_number(std::string_view a, std::string_view b) {
  const std::string_view whole_a = a;
  const std::string_view whole_b = b;
  while (!a.empty() && !b.empty()) {
    if (is_figure(a.front()) && is_figure(b.front())) {
      const std::string_view one = number_at_front(a);
      const std::string_view two = number_at_front(b);
      if (one.size() != two.size()) return one.size() < two.size();
      if (one != two) return one < two;
      skip_figures(a);
      skip_figures(b);
    } else if (a.front() != b.front()) {
      return static_cast<unsigned char>(a.front()) < static_cast<unsigned char>(b.front());
    } else {
      a.remove_prefix(1);
      b.remove_prefix(1);
    }
  }
  if (a.empty() != b.empty()) return a.empty();
  if (whole_a.size() != whole_b.size()) return whole_a.size() < whole_b.size();
  return whole_a < whole_b;
}

}  // namespace zerodrift::vision
