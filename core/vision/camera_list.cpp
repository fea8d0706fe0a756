#include "core/vision/camera_list.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <optional>

#include "core/vision/aravis_source.h"

namespace zerodrift::vision {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view device_prefix = "video";

/// One line as the kernel gives it; "" when there is none.
std::string line_of(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  while (!line.empty() && (line.back() == ' ' || line.back() == '\n')) line.pop_back();
  return line;
}

std::optional<int> number_of(const std::string& name) {
  if (name.rfind(device_prefix, 0) != 0) return std::nullopt;
  int number = 0;
  const char* end = name.data() + name.size();
  const auto read = std::from_chars(name.data() + device_prefix.size(), end, number);
  return read.ec == std::errc() && read.ptr == end ? std::optional(number) : std::nullopt;
}

CameraIdentity identity_in(const fs::path& device) {
  CameraIdentity identity;
  identity.kind = "v4l2";
  identity.model = line_of(device / "name");
  // Its interface's folder lies in that of the USB device, which has the texts of the maker.
  std::error_code none;
  const fs::path usb = fs::canonical(device / "device", none).parent_path();
  if (none) return identity;
  identity.vendor = line_of(usb / "manufacturer");
  identity.serial = line_of(usb / "serial");
  if (fs::exists(usb / "serial", none) || fs::exists(usb / "manufacturer", none)) {
    identity.address = usb.filename().string();
  }
  return identity;
}

}  // namespace

std::vector<FoundCamera> v4l2_cameras(const fs::path& listed) {
  std::vector<std::pair<int, FoundCamera>> found;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(listed, none)) {
    const auto number = number_of(entry.path().filename().string());
    // A camera has several devices; the first delivers the pictures, the others what belongs to them.
    if (const std::string index = line_of(entry.path() / "index"); !number || (!index.empty() && index != "0"))
      continue;
    found.push_back({*number, {"/dev/" + entry.path().filename().string(), identity_in(entry.path())}});
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<FoundCamera> cameras;
  for (auto& one : found) cameras.push_back(std::move(one.second));
  return cameras;
}

CameraIdentity v4l2_identity(const std::string& source, const fs::path& listed) {
  std::error_code none;
  const fs::path device = source.front() == '/' ? fs::canonical(source, none) : fs::path("video" + source);
  return identity_in(listed / (none ? fs::path(source) : device).filename());
}

std::vector<FoundCamera> find_cameras() {
  std::vector<FoundCamera> cameras = aravis_cameras();
  for (auto& camera : v4l2_cameras()) cameras.push_back(std::move(camera));
  return cameras;
}

}  // namespace zerodrift::vision
