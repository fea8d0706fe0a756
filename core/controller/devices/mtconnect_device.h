#pragma once
// An MTConnect agent (ANSI/MTC1.4), read over HTTP. A signal is the id of a data item, or its name where one item alone
// has it. What the items are is read from /probe at first and after a restart of the agent (another instanceId); each
// read() asks /current.
//
// The agent reports changes only: a value keeps the time stamp of its last change for as long as it is the same. So the
// stamp does not say how old a value is. A value is current as long as the agent answers and does not say UNAVAILABLE,
// and its time (Reading::at) is the middle of the request.
//
// Values are converted by the units of the item into C, mm, W and 1/min; a unit that is not known is an error, for its
// numbers would be wrong.

#include <memory>
#include <string>
#include <vector>

#include "core/controller/devices/device.h"

namespace zerodrift::controller {

/// Ids of the agent's samples whose unit is known or not stated: what a profile can name. Asks /probe once.
Result<std::vector<std::string>> agent_samples(const DeviceProfile& profile);
Result<std::unique_ptr<Device>> open_mtconnect(const DeviceProfile& profile, const std::vector<std::string>& names);

}  // namespace zerodrift::controller
