#include "core/controller/devices/device.h"
#include "core/controller/devices/mqtt_device.h"
#include "core/controller/devices/mtconnect_device.h"

namespace zerodrift::controller {

Result<std::unique_ptr<Device>> open_device(const DeviceProfile& profile, const std::vector<std::string>& signals) {
  if (profile.kind == DeviceKind::mqtt) return open_mqtt(profile, signals);
  if (profile.kind == DeviceKind::mtconnect) return open_mtconnect(profile, signals);
  return fail(ErrorCode::data_does_not_fit,
              {{"what", "the kind of device " + profile.id}, {"found", "a control"}, {"expected", "a device to read"}});
}

}  // namespace zerodrift::controller
