#pragma once
// Errors of a run measured with one or more cameras (V1 to V4). Each camera sees two machine axes; a direction that two
// cameras see is combined by uncertainty. error = actual - commanded: the target's displacement, in machine
// coordinates, since the zero was taken at the same commanded position, with what the reference marks do taken off.

#include <array>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/acquisition/error_source.h"
#include "core/vision/calibration.h"
#include "core/vision/camera.h"
#include "core/vision/error_view.h"
#include "core/vision/target.h"

namespace zerodrift::vision {

struct ErrorView {
  std::string id;  // "front"
  std::shared_ptr<const Camera> camera;
  std::shared_ptr<const Target> target;
  std::vector<Target> references;  // fixed marks; none: the camera's own drift remains in the error
  Calibration calibration;
  std::array<int, 2> axes{0, 2};  // machine axes of the calibration's x and y: 0 X, 1 Y, 2 Z
};

struct MeasureOptions {
  int frames = 5;                                 // averaged in one measurement
  std::chrono::milliseconds frame_timeout{4000};  // longer than the camera's own silent_after
  std::chrono::milliseconds settle{0};            // after the call, before the first frame counts
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
  Camera::Time seen{};               // mean arrival of the frames
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
  CameraErrorSource(std::vector<ErrorView> views, MeasureOptions options = {});

  Status take_zero(const TaskContext& context) override;
  Result<acquisition::ErrorSample> measure(const TaskContext& context) override;
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
  Result<ViewState> look(const ErrorView& view, const CameraTurn& turn, const TaskContext& context) const;
  std::vector<Result<ViewState>> look_all(const TaskContext& context) const;

  std::vector<ErrorView> m_views;
  MeasureOptions m_options;
  std::vector<Zero> m_zero;
  mutable std::mutex m_mutex;
  std::vector<ViewState> m_states;
};

}  // namespace zerodrift::vision
