#include "core/controller/devices/device.h"

namespace zerodrift::controller {

Result<std::unique_ptr<Device>> open_device(const DeviceProfile& profile, const std::vector<std::string>& /*signals*/) {
  return fail(ErrorCode::data_does_not_fit,
              {{"what", "the kind of device " + profile.id}, {"found", "a control"}, {"expected", "a device to read"}});
}

}  // namespace zerodrift::controller
