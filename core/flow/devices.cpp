#include "core/flow/devices.h"

#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <tuple>

#include "core/controller/device_readings.h"
#include "core/controller/probe_source.h"
#include "core/flow/steps/calibrate_step.h"

namespace zerodrift::flow {
namespace {

constexpr double fast_time_factor = 10.0;
constexpr int fast_frames = 3;

}  // namespace

std::shared_ptr<vision::Camera> open_camera(const controller::CameraProfile& profile) {
  vision::CameraOptions options;
  options.exposure_us = profile.exposure_us;
  options.gain_db = profile.gain_db;
  if (!vision::Camera::is_exclusive(profile.url)) return std::make_shared<vision::Camera>(profile.url, options);
  using Key = std::tuple<std::string, std::optional<double>, std::optional<double>>;
  static std::mutex mutex;
  static std::map<Key, std::weak_ptr<vision::Camera>> open;
  const std::lock_guard lock(mutex);
  auto& known = open[Key{profile.url, profile.exposure_us, profile.gain_db}];
  auto camera = known.lock();
  if (!camera) known = camera = std::make_shared<vision::Camera>(profile.url, options);
  return camera;
}

Result<Devices> Devices::open(const controller::Profile& profile, bool with_cameras, access::Permit permit,
                              std::shared_ptr<controller::Operator> person) {
  Devices devices;
  devices.profile = profile;
  devices.permit = permit;
  if (profile.manual) {
    ZD_TRY(auto control, controller::ManualControl::open(profile, std::move(person), permit));
    devices.by_hand = control.get();
    devices.machine = std::move(control);
  } else {
    ZD_TRY(auto machine, controller::ModbusMachine::open(profile, permit));
    devices.link = machine.get();
    devices.machine = std::move(machine);
  }
  if (!with_cameras || profile.error_source != controller::ErrorSourceKind::camera) return devices;
  for (const auto& camera : profile.cameras) {
    devices.cameras.push_back({camera, open_camera(camera)});
  }
  return devices;
}

std::vector<controller::DeviceState> Devices::device_states() const {
  const controller::DeviceReadings* readings = link != nullptr      ? link->devices()
                                               : by_hand != nullptr ? by_hand->devices()
                                                                    : nullptr;
  return readings != nullptr ? readings->states() : std::vector<controller::DeviceState>();
}

Result<controller::ModbusMachine*> Devices::linked(const std::string& operation) const {
  if (link != nullptr) return link;
  return fail(ErrorCode::machine_unsupported,
              {{"what", operation}, {"found", "a manual control"}, {"expected", "a control with a link"}});
}

Result<acquisition::Stand> come_to_measuring_position(Devices& devices) {
  if (devices.profile.measure_position_mm.empty()) {
    return fail(ErrorCode::no_measuring_position, {{"axes", "X, Y, Z"}});
  }
  return acquisition::come_to(*devices.machine, devices.profile.measure_position_mm);
}

Result<std::unique_ptr<acquisition::ErrorSource>> open_error_source(const commissioning::Job& job, Devices& devices,
                                                                    vision::CameraErrorSource** cameras) {
  if (devices.profile.error_source == controller::ErrorSourceKind::probes) {
    return std::make_unique<controller::ProbeErrorSource>(*devices.machine);
  }
  ZD_TRY(auto views, calibrated_views(job, devices));
  vision::MeasureOptions options;
  // Where machine time runs fast, a measurement of many frames would outlast the drift it is to catch.
  if (devices.profile.time_factor > fast_time_factor) {
    options.frames = fast_frames;
    options.span_s = 0.0;
  }
  options.rule.drift_um_per_s = devices.profile.max_drift_um_per_min / 60.0 * devices.profile.time_factor;
  auto source = std::make_unique<vision::CameraErrorSource>(std::move(views), options);
  if (cameras != nullptr) *cameras = source.get();
  return source;
}

}  // namespace zerodrift::flow
