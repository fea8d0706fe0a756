#pragma once
// How often a test of chance is done: few times in every check, often in `./check --long` (ZERODRIFT_LONG is set then).

#include <cstdlib>

namespace zerodrift {

inline int amount(int everyday, int at_length) {
  const char* value = std::getenv("ZERODRIFT_LONG");
  return value != nullptr && *value != '\0' && *value != '0' ? at_length : everyday;
}

/// Built with a sanitizer, whose checks and kept memory are no figures of the program's time and memory.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool instrumented = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
inline constexpr bool instrumented = true;
#else
inline constexpr bool instrumented = false;
#endif
#else
inline constexpr bool instrumented = false;
#endif

}  // namespace zerodrift
