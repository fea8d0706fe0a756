#pragma once
// Errors of a run measured with one or more cameras (V1 to V4). Each camera sees two machine axes; a direction that two
// cameras see is combined by uncertainty. Only pictures count that must show the machine's stand: stamped later than
// its standstill by the camera's latency and its spread, after the move to it was seen in the pictures, and agreeing
// with each other. error = actual - commanded: the target's displacement, in machine coordinates, since the zero was
// taken at the same commanded position, with what the reference marks do taken off.

#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/acquisition/error_source.h"
#include "core/acquisition/latency.h"
#include "core/acquisition/standstill.h"
#include "core/vision/target_view.h"

namespace zerodrift::vision {

struct MeasureOptions {
  int frames = 5;                                 // that must agree in one measurement
  double span_s = 1.0;                            // host time they are spread over: what settles slowly shows in them
  std::chrono::milliseconds frame_timeout{4000};  // longer than the camera's own silent_after
  acquisition::StandstillRule rule = {};
};

/// What the last measurement saw in one view, for the drawing.
struct ViewState {
  std::string id;
  std::shared_ptr<const CameraFrame> frame;
  Location location;                 // of the mean, camera motion taken off
  std::vector<Region> marks;         // where the references stood in the template
  std::vector<Location> references;  // in the last frame
  std::string lost_marks;            // marks_not_seen() of the last frame that was measured without one of them
  CameraTurn turn;                   // of the camera, when enough references were last seen
  Seconds seen{0.0};                 // host time: mean stamp of the frames less the latency
  acquisition::Settled settled;
  int good_frames = 0;
  int refused_frames = 0;
  double least_share = 1.0;   // of the target's pixels measured, over the good frames
  double scatter_x_px = 0.0;  // of single frames
  double scatter_y_px = 0.0;
  ErrorUm error;                  // along the view's two axes since the zero; NaN when refused
  std::vector<PixelPoint> trail;  // displacement of the target at each good measurement since the zero, px
  std::string problem;            // "" when good
};

class CameraErrorSource : public acquisition::ErrorSource {
 public:
  explicit CameraErrorSource(std::vector<ErrorView> views, MeasureOptions options = {});
  /// `host` is the clock by which the views stamp their pictures.
  CameraErrorSource(std::vector<std::unique_ptr<TargetView>> views, MeasureOptions options, Clock& host);

  Status take_zero(const acquisition::Stand& stand, const TaskContext& context) override;
  Result<acquisition::ErrorSample> measure(const acquisition::Stand& stand, const TaskContext& context) override;
  std::string name() const override;
  /// The mean of the views' zeros along each axis; the template itself is {0, 0, 0}.
  std::optional<std::array<double, 3>> zero_um() const override;
  bool restore_zero_um(const std::array<double, 3>& zero_um) override;

  /// The last measurement of each view; may be called from any thread.
  std::vector<ViewState> states() const;
  /// The zero of each view in px (x, y, and uncertainties), to go on with after a restart without taking a new one.
  std::vector<std::array<double, 4>> zero_px() const;
  Status restore_zero(const std::vector<std::array<double, 4>>& zero_px);

 private:
  struct Zero {
    double x_px = 0.0, y_px = 0.0, sigma_x_px = 0.0, sigma_y_px = 0.0;
  };
  struct Window;
  /// What the controller says meanwhile, asked from the caller's thread.
  struct Meanwhile {
    std::atomic<bool> moved = false;
    Status still;
  };
  Result<ViewState> look(std::size_t view, const acquisition::Stand& stand, const CameraTurn& turn,
                         Meanwhile& meanwhile, const TaskContext& context);
  std::vector<Result<ViewState>> look_all(const acquisition::Stand& stand, Meanwhile& meanwhile,
                                          const TaskContext& context);
  bool arrived(std::size_t view, const acquisition::Stand& stand, Window& window) const;
  Seconds surely_here(std::size_t view, const acquisition::Stand& stand) const;
  ViewState state_of(std::size_t view, const acquisition::Stand& stand, const Window& window) const;
  acquisition::Latency latency_of(std::size_t view) const;

  std::vector<std::unique_ptr<TargetView>> m_views;
  MeasureOptions m_options;
  Clock& m_host;
  std::vector<Zero> m_zero;
  mutable std::mutex m_mutex;
  std::vector<ViewState> m_states;
  std::vector<acquisition::LatencyWatch> m_latencies;
};

}  // namespace zerodrift::vision
