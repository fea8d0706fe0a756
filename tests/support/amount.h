#pragma once
// How often a test of chance is done: few times in every check, often in `./check --long` (ZERODRIFT_LONG is set then).

#include <cstdlib>

namespace zerodrift {

inline int amount(int everyday, int at_length) {
  const char* value = std::getenv("ZERODRIFT_LONG");
  return value != nullptr && *value != '\0' && *value != '0' ? at_length : everyday;
}

}  // namespace zerodrift
