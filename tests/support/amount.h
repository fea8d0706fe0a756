#pragma once
// How often a test of chance is done: few times in every check, often in `./check --long` (ZERODRIFT_LONG is set then).

#include <cstdlib>

namespace zerodrift {

inline int amount(int everyday, int at_length) {
  const char* value = std::getenv("ZERODRIFT_LONG");
  return value != nullptr && *value != '\0' && *value != '0' ? at_length : everyday;
}

/// Under a sanitizer that keeps freed memory aside, what a process holds says nothing about the program.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool memory_tells = false;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
inline constexpr bool memory_tells = false;
#else
inline constexpr bool memory_tells = true;
#endif
#else
inline constexpr bool memory_tells = true;
#endif

}  // namespace zerodrift
