#pragma once
// The cameras over HTTP on 127.0.0.1, as network cameras do it:
//   /front.mjpg, /side.mjpg   motion JPEG (multipart/x-mixed-replace), about frames_per_s of wall time
//   /front.png, /side.png     one frame of this moment without loss; header X-Machine-Time in seconds
// A frame is rendered when it is sent: a slow client skips frames, without clients nothing runs. With a latency a frame
// shows the scene of that long ago; frames never overtake each other.

#include <array>
#include <memory>

#include "app/machine/camera/frame_source.h"
#include "core/base/result.h"

namespace zerodrift::machine {

struct CameraOptions {
  std::array<ViewOptions, view_count> views = {view_options(View::front, 1), view_options(View::side, 1)};
  double frames_per_s = 20.0;
  double latency_s = 0.0;         // wall time from the scene to the sending of its picture
  double latency_jitter_s = 0.0;  // jumps within latency +- this
  int jpeg_quality = 97;
};

/// The options of the machine with this seed.
CameraOptions camera_options(std::uint64_t seed);

class CameraServer {
 public:
  CameraServer(const CameraOptions& options, const SceneSource& scene);
  ~CameraServer();
  CameraServer(const CameraServer&) = delete;
  CameraServer& operator=(const CameraServer&) = delete;

  /// Serves until stop(); port 0 picks a free one. The port that is served, or port_unavailable.
  Result<int> start(int port);
  void stop();
  void set_fault(CameraFault fault);
  void set_fault(View view, CameraFault fault);

 private:
  struct Service;
  std::unique_ptr<Service> m_service;
};

}  // namespace zerodrift::machine
