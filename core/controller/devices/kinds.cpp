#include "core/controller/devices/device.h"
#include "core/controller/devices/modbus_device.h"
#include "core/controller/devices/mqtt_device.h"
#include "core/controller/devices/mtconnect_device.h"

namespace zerodrift::controller {

Result<std::unique_ptr<Device>> open_device(const DeviceProfile& profile, const std::vector<std::string>& signals) {
  switch (profile.kind) {
    case DeviceKind::modbus:
      return open_modbus(profile, signals);
    case DeviceKind::mqtt:
      return open_mqtt(profile, signals);
    case DeviceKind::mtconnect:
      return open_mtconnect(profile, signals);
  }
  return fail(ErrorCode::internal, {{"detail", "a kind of device without a reader"}});
}

}  // namespace zerodrift::controller
