#include "core/controller/devices/device_tools.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/json.h"

namespace zerodrift::controller {
namespace {

namespace fs = std::filesystem;

std::string_view without_blanks(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

Result<std::string> credential(const nlohmann::json& document, const char* key, const std::string& file) {
  const auto at = document.find(key);
  if (at == document.end())
    return fail(ErrorCode::json_missing_key, {{"file", file}, {"key", key}, {"expected", "a text"}});
  if (at->is_string()) return at->get<std::string>();
  return fail(ErrorCode::json_bad_value,
              {{"file", file}, {"key", key}, {"found", "not a text"}, {"expected", "a text in quotation marks"}});
}

}  // namespace

std::optional<double> number_in(std::string_view text) {
  text = without_blanks(text);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

bool says_no_value(std::string_view text) {
  constexpr std::array<std::string_view, 8> words = {"",     "unavailable", "unknown", "offline",
                                                     "null", "none",        "nan",     "n/a"};
  std::string word(without_blanks(text));
  std::ranges::transform(word, word.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::ranges::find(words, word) != words.end();
}

Result<fs::path> file_of_profile(const DeviceProfile& profile, const std::string& key, const std::string& name) {
  if (profile.of_job) {
    return fail(ErrorCode::job_reaches_out, {{"key", "devices." + profile.id + "." + key}, {"found", name}});
  }
  return fs::path(profile.file).parent_path() / name;
}

Result<std::optional<Credentials>> read_credentials(const DeviceProfile& profile) {
  if (profile.credentials_file.empty()) return std::nullopt;
  ZD_TRY(const fs::path path, file_of_profile(profile, "credentials_file", profile.credentials_file));
  const std::string file = path.string();
  std::error_code error;
  const fs::perms mode = fs::status(path, error).permissions();
  if (!error && fs::exists(path, error) && (mode & (fs::perms::group_all | fs::perms::others_all)) != fs::perms::none) {
    return fail(ErrorCode::bad_argument, {{"what", "The mode of the file " + file},
                                          {"found", fmt::format("{:04o}", static_cast<unsigned>(mode))},
                                          {"expected", "0600, so that its owner alone may read it"}});
  }
  auto document = read_json_file(path);
  if (!document) {
    // The library's own words may quote a part of the password.
    if (document.error().code == ErrorCode::json_syntax)
      document.error().context["detail"] = "its text is not repeated";
    return fail(document.error());
  }
  if (!document->is_object()) {
    return fail(ErrorCode::wrong_format,
                {{"file", file}, {"found", "another kind of JSON"}, {"expected", R"({"user": ..., "password": ...})"}});
  }
  Credentials credentials;
  ZD_TRY(credentials.user, credential(*document, "user", file));
  ZD_TRY(credentials.password, credential(*document, "password", file));
  return credentials;
}

void RemarkList::add(const std::string& remark) {
  const std::scoped_lock guard(m_lock);
  ++m_counts[remark];
}

void RemarkList::add_once(const std::string& remark) {
  const std::scoped_lock guard(m_lock);
  m_counts[remark] = 1;
}

std::vector<std::string> RemarkList::texts() const {
  const std::scoped_lock guard(m_lock);
  std::vector<std::string> all;
  for (const auto& [remark, count] : m_counts) {
    all.push_back(count == 1 ? remark : fmt::format("{} ({} times)", remark, count));
  }
  return all;
}

}  // namespace zerodrift::controller
