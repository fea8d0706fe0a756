#pragma once
// The cameras that this computer reaches: GigE Vision and USB3 Vision by discovery, V4L2 devices by the kernel's list.

#include <filesystem>
#include <string>
#include <vector>

#include "core/vision/camera_identity.h"

namespace zerodrift::vision {

struct FoundCamera {
  std::string url;  // for a profile
  CameraIdentity identity;
};

/// Takes a second or two: cameras on the network are given time to answer.
std::vector<FoundCamera> find_cameras();

/// Devices that deliver pictures, in the order of their numbers; `listed` is the kernel's folder of them.
std::vector<FoundCamera> v4l2_cameras(const std::filesystem::path& listed = "/sys/class/video4linux");
/// Of "0" or "/dev/video0"; of a link to a device, too.
CameraIdentity v4l2_identity(const std::string& source, const std::filesystem::path& listed = "/sys/class/video4linux");

}  // namespace zerodrift::vision
