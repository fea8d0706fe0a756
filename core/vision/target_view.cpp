#include "core/vision/target_view.h"

#include <utility>

namespace zerodrift::vision {
namespace {

// The newest pictures of a scene at rest differ by their noise, grey levels of a cell's mean.
constexpr double rest_noise = 8.0;

class LocatedView : public TargetView {
 public:
  LocatedView(ErrorView view, std::chrono::milliseconds frame_timeout)
      : m_view(std::move(view)), m_frame_timeout(frame_timeout) {}

  const std::string& id() const override { return m_view.id; }
  const Calibration& calibration() const override { return m_view.calibration; }
  const std::array<int, 2>& axes() const override { return m_view.axes; }
  acquisition::Latency latency() const override {
    return m_view.camera->is_file() ? acquisition::Latency::none() : m_view.latency;
  }
  std::vector<Region> marks() const override {
    std::vector<Region> out;
    for (const Target& reference : m_view.references) out.push_back(reference.region());
    return out;
  }

  Result<SeenTarget> next(Seconds after, const CameraTurn& turn, const std::stop_token& stop) override {
    SeenTarget seen;
    ZD_TRY(seen.frame, m_view.camera->next_picture(after, m_frame_timeout, stop));
    seen.stamp = seen.frame->stamp;
    seen.turn = turn;
    seen.location = locate_against(*m_view.target, m_view.references, seen.frame->image, &seen.references, &seen.turn);
    return seen;
  }

  ShownSince shown_since(Seconds from, std::size_t same) const override {
    if (m_view.camera->is_file()) return {};
    const Sketches sketches = m_view.camera->sketches(from);
    const Region cells = sketch_region(m_view.target->region(), m_view.target->image());
    const double noise = noise_of(sketches, same, cells);
    return {last_change(sketches, cells, noise), noise < rest_noise};
  }

 private:
  ErrorView m_view;
  std::chrono::milliseconds m_frame_timeout;
};

}  // namespace

std::unique_ptr<TargetView> located_view(ErrorView view, std::chrono::milliseconds frame_timeout) {
  return std::make_unique<LocatedView>(std::move(view), frame_timeout);
}

}  // namespace zerodrift::vision
