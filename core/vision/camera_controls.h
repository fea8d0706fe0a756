#pragma once
// The controls of a V4L2 camera while it measures: what the camera would change by itself - focus, white balance,
// exposure, gain - is held, and put back as it was found when it is closed. A focus that moves changes the scale.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/vision/camera_identity.h"

namespace zerodrift::vision {

enum class Control { auto_exposure, exposure, gain, auto_focus, focus, auto_white_balance, white_balance };

/// How a device's controls are read and set; a device that lacks one gives no value and refuses to set it.
class ControlPort {
 public:
  virtual ~ControlPort() = default;
  virtual std::optional<double> value(Control control) const = 0;
  virtual bool set(Control control, double value) = 0;
};

/// V4L2 counts exposure in units of 100 us; manual is 1 of its menu (V4L2_EXPOSURE_MANUAL).
inline constexpr double exposure_unit_us = 100.0;
inline constexpr double manual_exposure = 1.0;

class HeldControls {
 public:
  /// The port must live as long as this.
  explicit HeldControls(ControlPort& port) : m_port(port) {}
  ~HeldControls() { restore(); }
  HeldControls(const HeldControls&) = delete;
  HeldControls& operator=(const HeldControls&) = delete;

  /// Switches the automatics off and sets what is asked; what is not asked stays as the automatics left it. A camera
  /// without a control is as good as one that holds it; camera_setting when it lacks one that is asked or does not take
  /// the value. Without `url`, which is the caller's.
  Status hold(std::optional<double> exposure_us, std::optional<double> gain);
  /// In the reverse order, so that a value is put back while its automatic is still off.
  void restore();
  /// As it is now; absent where an automatic sets it.
  std::optional<double> exposure_us() const;
  std::optional<double> gain() const;

 private:
  struct Found {
    Control control;
    double value;
  };
  bool change(Control control, double value);
  Status set_asked(Control control, const char* what, double value, double per_unit);

  ControlPort& m_port;
  std::vector<Found> m_found;
};

}  // namespace zerodrift::vision
