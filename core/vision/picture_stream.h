#pragma once
// An open camera or file as Camera reads it, picture by picture. One file for each library or protocol that delivers
// pictures: capture_stream (OpenCV: V4L2, RTSP, files), aravis_source (GigE Vision, USB3 Vision), mjpeg_stream (HTTP).

#include <memory>
#include <optional>
#include <stop_token>

#include "core/base/clock.h"
#include "core/vision/camera_identity.h"
#include "core/vision/image.h"

namespace zerodrift::vision {

struct StreamPicture {
  GrayImage image;
  std::optional<Seconds> stamp;  // by the device, on the host's clock; absent where it gives none
};

class PictureStream {
 public:
  virtual ~PictureStream() = default;
  /// Waits for the next whole picture; nothing when the stream ended or none came for the read timeout.
  virtual std::optional<StreamPicture> next(const std::stop_token& stop) = 0;
  /// Pictures a second as the source claims; 0 where it claims none.
  virtual double claimed_rate_hz() const { return 0.0; }
  virtual CameraIdentity identity() const { return {}; }
  /// Of this stream since it was opened; Camera counts pictures and reconnections.
  virtual CameraHealth health() const { return {}; }
};

}  // namespace zerodrift::vision
