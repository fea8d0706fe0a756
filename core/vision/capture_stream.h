#pragma once
// What OpenCV opens: RTSP and other video over the network, V4L2 devices, video files, image sequences.

#include <memory>
#include <string>

#include "core/vision/camera.h"
#include "core/vision/picture_stream.h"

namespace zerodrift::vision {

enum class SourceKind { stream, device, genicam, file };
SourceKind kind_of(const std::string& source);

/// Null when it cannot be opened. Throws cv::Exception as the library does. `stop` ends the wait for a device's
/// automatics (camera_controls.h). Errors: camera_setting.
Result<std::unique_ptr<PictureStream>> open_capture(const std::string& source, const CameraOptions& options,
                                                    const std::stop_token& stop);

}  // namespace zerodrift::vision
