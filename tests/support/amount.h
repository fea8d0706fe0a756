#pragma once
// How often a test of chance is done: few times in every check, often in `./check --long` (ZERODRIFT_LONG is set then).

#include <cstdlib>

namespace zerodrift {

inline int amount(int everyday, int at_length) {
  const char* value = std::getenv("ZERODRIFT_LONG");
  return value != nullptr && *value != '\0' && *value != '0' ? at_length : everyday;
}

/// Durations of the wall clock are judged in `./check --long` alone, which does one thing at a time: a computer that is
/// busy is late, and that is no fault of the program.
inline bool judges_durations() {
  return amount(0, 1) == 1;
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
