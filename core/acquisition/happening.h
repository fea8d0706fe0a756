#pragma once
// What went wrong in a run and how often, in one line each: the same on the page while it runs, after it, and in the
// report.

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <vector>

#include "core/base/error.h"

namespace zerodrift::acquisition {

struct Happening {
  std::string name;               // of the error code, or "gap", "reply_in_pieces"
  std::vector<std::string> what;  // which sensors, which reasons; may be empty
  int count = 0;
  bool overcome = false;  // a fault of the link that was asked again: nothing is missing because of it
};

/// "sensor stuck (T1_C), 2 times"; "link: machine busy, once, overcome".
std::string text_of(const Happening& happening);
nlohmann::json to_json(const std::vector<Happening>& happenings);
/// An older job has none: empty then.
std::vector<Happening> happenings_from_json(const nlohmann::json& value);

class Tally {
 public:
  void add(const std::string& name, const std::string& what);
  /// Which one an error is about: the sensor, the reason, the camera, or from what to what it changed; may be empty.
  static std::string particulars_of(const std::map<std::string, std::string>& context);
  std::vector<Happening> all() const;

 private:
  struct Entry {
    int count = 0;
    std::set<std::string> what;
  };
  std::map<std::string, Entry> m_entries;
};

}  // namespace zerodrift::acquisition
