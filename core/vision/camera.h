#pragma once
// A live camera: a thread reads the stream as fast as it comes and keeps the newest frame, so that no queue grows. A
// frame is stamped by its device where that gives its time, else on arrival: it shows the past by the camera's latency
// (core/acquisition/latency.h). Sources: an http(s) or rtsp address, a V4L2 device ("0" or "/dev/video0"), a GigE
// Vision or USB3 Vision camera ("aravis:" with its serial number, name or address, or "aravis:*" for the only one), a
// video file, or an image sequence ("seq/img_%04d.png"); the last two are played in a loop at their own rate. Dead
// streams are opened anew by themselves, with a growing pause. Failures are named: camera_unreachable (never opened),
// camera_silent (no picture for a while), camera_frozen (the same picture for a while: a live picture has noise),
// camera_exchanged (another serial number than before), camera_ambiguous, camera_setting, camera_format.

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "core/base/result.h"
#include "core/vision/camera_identity.h"
#include "core/vision/picture_source.h"

namespace zerodrift::vision {

struct CameraOptions {
  std::chrono::milliseconds open_timeout{1000};
  std::chrono::milliseconds read_timeout{1500};
  std::chrono::milliseconds silent_after{3000};
  std::chrono::milliseconds frozen_after{3000};
  std::chrono::milliseconds repeats_after{1000};  // frozen, for one who waits for a fresh picture
  std::chrono::milliseconds longest_pause{5000};  // between attempts to open
  std::optional<double> exposure_us = {};         // set on opening, restored when closed; absent: left as it is
  std::optional<double> gain_db = {};
};

class Camera : public PictureSource {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// Starts reading at once and returns; whether it works shows in the frames.
  explicit Camera(std::string source, CameraOptions options = {});
  ~Camera() override;
  Camera(const Camera&) = delete;
  Camera& operator=(const Camera&) = delete;

  /// Whether only one reader can have it open: a device, but neither a stream nor a file.
  static bool is_exclusive(const std::string& source);

  const std::string& source() const;
  /// The newest frame, or why there is none.
  Result<std::shared_ptr<const CameraFrame>> newest() const;
  /// A frame taken after this moment: the first to arrive may have been on its way already and is passed over.
  Result<std::shared_ptr<const CameraFrame>> fresh_frame(Time after, std::chrono::milliseconds timeout,
                                                         const std::stop_token& stop = {}) const;
  Result<std::shared_ptr<const CameraFrame>> next_picture(Seconds after, std::chrono::milliseconds timeout,
                                                          const std::stop_token& stop = {}) const override;
  Sketches sketches(Seconds from) const override;
  bool is_file() const override;
  /// Frames a second over the last few seconds; 0 while nothing comes.
  double frames_per_s() const;
  /// Of the device that is open or was open last. Waits until it was opened once; nothing when it was not within
  /// `wait`.
  std::optional<CameraIdentity> identity(std::chrono::milliseconds wait = {}, const std::stop_token& stop = {}) const;
  CameraHealth health() const;

 private:
  struct Work;
  std::shared_ptr<Work> m_work;
};

}  // namespace zerodrift::vision
