#pragma once
// What the kinds of devices share: numbers in their words, the files that a profile names for them, remarks with
// counts.

#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/controller/device_profile.h"

namespace zerodrift::controller {

/// A finite number and nothing else but blanks around it.
std::optional<double> number_in(std::string_view text);
/// A word by which devices say that they have no value: "UNAVAILABLE", "unknown", "null", nothing at all.
bool says_no_value(std::string_view text);

/// A file that the profile names under `key`; a relative path is beside the profile. job_reaches_out in a job.
Result<std::filesystem::path> file_of_profile(const DeviceProfile& profile, const std::string& key,
                                              const std::string& name);

struct Credentials {
  std::string user;
  std::string password;
};
/// From the profile's credentials_file, if it names one. A file that others than its owner may read or write is
/// refused. No error repeats any of its contents.
Result<std::optional<Credentials>> read_credentials(const DeviceProfile& profile);

/// Remarks, each once; one that is made repeatedly ends in how often it was. For any thread.
class RemarkList {
 public:
  void add(const std::string& remark);
  void add_once(const std::string& remark);
  std::vector<std::string> texts() const;

 private:
  mutable std::mutex m_lock;
  std::map<std::string, long> m_counts;
};

}  // namespace zerodrift::controller
