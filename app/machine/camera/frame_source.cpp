#include "app/machine/camera/frame_source.h"

#include <utility>

#include "core/vision/image_codec.h"

namespace zerodrift::machine {

FrameSource::FrameSource(View view, const ViewOptions& options, SceneSource scene)
    : m_view(view), m_renderer(options), m_scene(std::move(scene)) {}

void FrameSource::set_fault(CameraFault fault) {
  const std::lock_guard lock(m_mutex);
  m_fault = fault;
}

Frame FrameSource::now() {
  const CameraScene scene = look();
  const std::lock_guard lock(m_mutex);
  return render(scene);
}

Result<std::shared_ptr<const EncodedFrame>> FrameSource::jpeg(std::int64_t tick, const CameraScene& scene,
                                                              int quality) {
  const std::lock_guard lock(m_mutex);
  if (m_jpeg && m_tick == tick) return m_jpeg;
  const Frame frame = render(scene);
  ZD_TRY(auto bytes, vision::encode_jpeg(frame.image, quality));
  m_jpeg = std::make_shared<const EncodedFrame>(EncodedFrame{std::move(bytes), frame.machine_time_s});
  m_tick = tick;
  return m_jpeg;
}

Frame FrameSource::render(const CameraScene& scene) {
  const bool active = m_fault.kind != CameraFault::Kind::none && scene.machine_time_s >= m_fault.from_machine_s &&
                      scene.machine_time_s < m_fault.until_machine_s;
  const bool frozen = active && m_fault.kind == CameraFault::Kind::freeze;
  if (frozen && !m_last.image.empty()) return m_last;
  RenderSwitches switches;
  switches.occluded = active && m_fault.kind == CameraFault::Kind::occluded;
  switches.mark_occluded = active && m_fault.kind == CameraFault::Kind::mark_occluded;
  m_last = {m_renderer.render(scene, m_frames++, switches), scene.machine_time_s};
  return m_last;
}

}  // namespace zerodrift::machine
