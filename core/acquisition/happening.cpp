#include "core/acquisition/happening.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace zerodrift::acquisition {

std::string text_of(const Happening& happening) {
  std::string text = happening.name;
  std::replace(text.begin(), text.end(), '_', ' ');
  if (happening.overcome) text = "link: " + text;
  if (!happening.what.empty()) text += fmt::format(" ({})", fmt::join(happening.what, "; "));
  text += happening.count == 1 ? ", once" : fmt::format(", {} times", happening.count);
  return happening.overcome ? text + ", overcome" : text;
}

nlohmann::json to_json(const std::vector<Happening>& happenings) {
  nlohmann::json all = nlohmann::json::array();
  for (const auto& one : happenings) {
    all.push_back({{"name", one.name}, {"what", one.what}, {"count", one.count}, {"overcome", one.overcome}});
  }
  return all;
}

std::vector<Happening> happenings_from_json(const nlohmann::json& value) {
  std::vector<Happening> all;
  if (!value.is_array()) return all;
  for (const auto& one : value) {
    if (!one.is_object()) continue;
    all.push_back({one.value("name", ""), one.value("what", std::vector<std::string>()), one.value("count", 0),
                   one.value("overcome", false)});
  }
  return all;
}

void Tally::add(const std::string& name, const std::string& what) {
  Entry& entry = m_entries[name];
  ++entry.count;
  if (!what.empty()) entry.what.insert(what);
}

std::string Tally::particulars_of(const std::map<std::string, std::string>& context) {
  for (const char* key : {"sensor", "reason", "view"}) {
    if (const auto at = context.find(key); at != context.end()) return at->second;
  }
  const auto period = context.find("period_s");
  const auto every = context.find("every_s");
  if (period == context.end() || every == context.end()) return {};
  return fmt::format("every {} s instead of {} s", every->second, period->second);
}

std::vector<Happening> Tally::all() const {
  std::vector<Happening> all;
  for (const auto& [name, entry] : m_entries) {
    all.push_back({name, {entry.what.begin(), entry.what.end()}, entry.count, false});
  }
  return all;
}

}  // namespace zerodrift::acquisition
