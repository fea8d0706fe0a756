#pragma once
// The frames of one camera, rendered only when somebody asks. Safe to call from many threads.

#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <vector>

#include "app/machine/camera/renderer.h"
#include "core/base/result.h"

namespace zerodrift::machine {

struct CameraFault {
  enum class Kind {
    none,
    freeze,         // the same picture over and over
    occluded,       // a chip lies on the spindle target
    mark_occluded,  // a chip lies on the right one of the table's marks
  };
  Kind kind = Kind::none;
  double from_machine_s = 0.0;
  double until_machine_s = std::numeric_limits<double>::infinity();
};

struct Frame {
  vision::GrayImage image;
  double machine_time_s = 0.0;
};

struct EncodedFrame {
  std::vector<std::uint8_t> bytes;
  double machine_time_s = 0.0;
};

class FrameSource {
 public:
  FrameSource(View view, const ViewOptions& options, SceneSource scene);

  void set_fault(CameraFault fault);
  /// A new frame of this moment; frozen, the last one before the fault.
  Frame now();
  /// What the camera looks at now, to be rendered later: a picture that is on its way shows the moment it was taken.
  CameraScene look() const { return m_scene(m_view); }
  /// The frame of a tick of the stream as JPEG, from the scene of that tick. Clients that ask within one tick share the
  /// rendering.
  Result<std::shared_ptr<const EncodedFrame>> jpeg(std::int64_t tick, const CameraScene& scene, int quality);

 private:
  Frame render(const CameraScene& scene);

  const View m_view;
  const CameraRenderer m_renderer;
  const SceneSource m_scene;
  std::mutex m_mutex;
  CameraFault m_fault;
  std::uint64_t m_frames = 0;
  Frame m_last;  // empty before the first
  std::int64_t m_tick = -1;
  std::shared_ptr<const EncodedFrame> m_jpeg;
};

}  // namespace zerodrift::machine
