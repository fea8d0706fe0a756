#pragma once
// The problems a run has now, each under a key ("camera", "sensor T3_C"), and what is new about them.

#include <map>
#include <string>
#include <vector>

#include "core/base/error.h"

namespace zerodrift::acquisition {

class ProblemList {
 public:
  /// True when it is new, or another one than before under this key.
  bool raise(const std::string& key, const Error& error) {
    const auto at = m_problems.find(key);
    const bool changed = at == m_problems.end() || at->second.code != error.code;
    m_problems[key] = error;
    return changed;
  }
  /// True when it was there.
  bool clear(const std::string& key) { return m_problems.erase(key) > 0; }
  std::vector<Error> now() const {
    std::vector<Error> all;
    for (const auto& [key, error] : m_problems) all.push_back(error);
    return all;
  }

 private:
  std::map<std::string, Error> m_problems;
};

}  // namespace zerodrift::acquisition
