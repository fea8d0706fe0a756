#pragma once
// The topics of an MQTT broker. A signal is "topic", whose messages are numbers, or "topic#/json/pointer" (RFC 6901)
// into JSON messages; JSON's true and false count as 1 and 0, a text that is a number as that number. Wildcards are
// refused: a value must come from one place.
//
// A thread of its own keeps the connection, from the first read() on, and opens it anew with a growing pause. read()
// gives the last value of each signal and when its message arrived. A retained message is not used: nobody knows when
// its value was measured. A value is missing until a live message comes, when the last one has no number in it, and
// when it is older than stale_after_s.

#include <memory>
#include <string>
#include <vector>

#include "core/controller/devices/device.h"

namespace zerodrift::controller {

Result<std::unique_ptr<Device>> open_mqtt(const DeviceProfile& profile, const std::vector<std::string>& names);

}  // namespace zerodrift::controller
