#pragma once
// A camera that sends JPEG pictures one after another over HTTP ("multipart/x-mixed-replace"). The pictures are found
// by their own marks (jpeg_cutter.h). Passwords in the url are sent as the camera asks for them, basic or digest.

#include <memory>
#include <string>

#include "core/vision/camera.h"
#include "core/vision/picture_stream.h"

namespace zerodrift::vision {

/// Null when what answers there is no such camera, or nothing that HTTP knows: another reader may know it.
/// camera_unreachable when nothing answers.
Result<std::unique_ptr<PictureStream>> open_mjpeg(const std::string& url, const CameraOptions& options,
                                                  const std::stop_token& stop);

}  // namespace zerodrift::vision
