#pragma once
// What the errors of a run need of one camera: its pictures with the target located in them, and when they last came to
// show something else.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/acquisition/latency.h"
#include "core/base/result.h"
#include "core/vision/calibration.h"
#include "core/vision/camera.h"
#include "core/vision/error_view.h"

namespace zerodrift::vision {

struct ErrorView {
  std::string id;  // "front"
  std::shared_ptr<const Camera> camera;
  std::shared_ptr<const Target> target;
  std::vector<Target> references;  // fixed marks; none: the camera's own drift remains in the error
  Calibration calibration;
  std::array<int, 2> axes{0, 2};      // machine axes of the calibration's x and y: 0 X, 1 Y, 2 Z
  acquisition::Latency latency = {};  // of the camera, as measured with the calibration; assumed where it was not
};

/// A picture with what was found in it.
struct SeenTarget {
  Seconds stamp{0.0};  // host time
  std::shared_ptr<const CameraFrame> frame;
  Location location;  // camera motion taken off
  std::vector<Location> references;
  CameraTurn turn;
};

/// What the newest pictures show, and since when.
struct ShownSince {
  std::optional<PictureChange> change;  // nothing: the pictures asked for all show the same
  bool at_rest = true;                  // the newest pictures show the same as the newest
};

class TargetView {
 public:
  virtual ~TargetView() = default;
  virtual const std::string& id() const = 0;
  virtual const Calibration& calibration() const = 0;
  virtual const std::array<int, 2>& axes() const = 0;
  virtual acquisition::Latency latency() const = 0;
  /// Where the fixed marks stood in the template, for the drawing.
  virtual std::vector<Region> marks() const = 0;
  /// The first picture stamped after this; `turn` is that of the camera when it was last seen.
  virtual Result<SeenTarget> next(Seconds after, const CameraTurn& turn, const std::stop_token& stop) = 0;
  /// From the last picture stamped at or before `from` to the newest; the newest `same` pictures are taken to show one
  /// place, and tell what noise is.
  virtual ShownSince shown_since(Seconds from, std::size_t same) const = 0;
};

/// With the target sought in a camera's pictures.
std::unique_ptr<TargetView> located_view(ErrorView view, std::chrono::milliseconds frame_timeout);

}  // namespace zerodrift::vision
