#pragma once
// Opens what a profile names: the machine - its control and the devices beside it -, the cameras, and the source of
// errors that goes with a calibration.

#include <memory>
#include <vector>

#include "core/acquisition/error_source.h"
#include "core/base/result.h"
#include "core/commissioning/job.h"
#include "core/controller/devices/manual_control.h"
#include "core/controller/modbus_machine.h"
#include "core/controller/profile.h"
#include "core/vision/camera.h"
#include "core/vision/camera_error_source.h"

namespace zerodrift::flow {

/// With the exposure and the gain that the profile gives it; it begins to read at once. A device that only one can read
/// is opened once in the program: the window's preview and a run share it.
std::shared_ptr<vision::Camera> open_camera(const controller::CameraProfile& profile);

struct CameraDevice {
  controller::CameraProfile profile;
  std::shared_ptr<vision::Camera> camera;
};

struct Devices {
  controller::Profile profile;
  access::Permit permit = access::Permit::read_only();
  std::unique_ptr<acquisition::MachineIo> machine;
  controller::ModbusMachine* link = nullptr;     // the machine, where its control has a link
  controller::ManualControl* by_hand = nullptr;  // the machine, where a person is its link
  std::vector<CameraDevice> cameras;             // reading already; empty when the errors come from probes

  /// The machine connects at its first request, the cameras by themselves; `with_cameras` false opens none.
  /// Without a permit to write the machine can only be read. operator_missing for a manual control without a person.
  static Result<Devices> open(const controller::Profile& profile, bool with_cameras = true,
                              access::Permit permit = access::Permit::read_only(),
                              std::shared_ptr<controller::Operator> person = nullptr);
  /// How the devices beside the control have done so far; none where the control has all of it.
  std::vector<controller::DeviceState> device_states() const;
  /// The control over its link; machine_unsupported for a manual one.
  Result<controller::ModbusMachine*> linked(const std::string& operation) const;
};

/// Drives to the profile's measuring position. no_measuring_position when the profile has none.
Result<acquisition::Stand> come_to_measuring_position(Devices& devices);

/// The error source of a run. From cameras it needs the job's calibration; from probes nothing.
/// For the drawing, `cameras` receives the camera source when there is one.
Result<std::unique_ptr<acquisition::ErrorSource>> open_error_source(const commissioning::Job& job, Devices& devices,
                                                                    vision::CameraErrorSource** cameras = nullptr);

}  // namespace zerodrift::flow
