#pragma once
// GigE Vision and USB3 Vision cameras through Aravis; the only file that sees that library. A camera is named by its
// serial number, Aravis' name of it ("Vendor-Model-Serial"), its address, or "*" for the only one that is found. A
// buffer that is not whole is counted and thrown away. The camera's own time stamps the pictures (device_clock.h).

#include <memory>
#include <string>
#include <vector>

#include "core/vision/camera.h"
#include "core/vision/camera_list.h"
#include "core/vision/picture_stream.h"

namespace zerodrift::vision {

/// By discovery, which gives each camera a second to answer.
std::vector<FoundCamera> aravis_cameras();

/// `url` as in a profile, "aravis:...". `serial` is that of the camera that was open before, "" for none: with another
/// one it is refused, whatever the url. Sets exposure and gain, switches their automatics off, and begins to read; all
/// is put back when the stream is closed. Errors: camera_unreachable, camera_ambiguous, camera_exchanged,
/// camera_setting, camera_format.
Result<std::unique_ptr<PictureStream>> open_aravis(const std::string& url, const std::string& serial,
                                                   const CameraOptions& options);

}  // namespace zerodrift::vision
