#pragma once
// The part of a profile that says what the rig is made of: the control, the devices beside it, and which of their
// signals is which quantity.

#include <array>

#include "core/base/json.h"
#include "core/controller/profile.h"

namespace zerodrift::controller {

/// Probes of a nest, in the order of an amplifier's array and of SignalSources::probes, where one that is not there has
/// no device.
inline constexpr std::array<const char*, 5> probe_names = {"X1", "X2", "Y1", "Y2", "Z"};

/// A text that is there and says something.
std::string filled(JsonObject& o, std::string_view key, const char* expected = "a name of its own");
/// `controller`, or the control among `devices`: the manual one, or the one that `control` names; and the others.
void read_devices(JsonObject& o, Profile& profile);
/// `device` and `signal` of a sensor or a quantity; both empty where it is the control's.
SignalSource read_source(JsonObject& o);
/// The quantities with a device of their own, and whether every device that is named is there and used once.
void read_signals(JsonObject& o, Profile& profile);

}  // namespace zerodrift::controller
