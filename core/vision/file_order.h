#pragma once
// The order in which people number their files: image_2 before image_10.

#include <string_view>

namespace zerodrift::vision {

/// Figures are compared as numbers, all else byte by byte; of names with the same numbers the one with fewer zeros
/// first.
bool is_before_by_number(std::string_view a, std::string_view b);

}  // namespace zerodrift::vision
