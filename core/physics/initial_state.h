#pragma once
// How a run starts: at rest and uniform, unless the first samples of several sensors say otherwise together (one sensor
// out of line is a faulty sensor, not a warm machine).

#include <map>
#include <string>
#include <vector>

#include "core/physics/machine.h"
#include "core/recording/recording.h"

namespace zerodrift::physics {

/// Temperature over position: (mm, C), increasing in mm.
using Profile = std::vector<std::pair<double, double>>;

/// First present value of a channel; NaN if it has none.
double first_value(const recording::Recording& recording, const std::string& channel);
/// The start profile of each rod that is clearly not uniform.
std::map<std::string, Profile> warm_start_profiles(const Machine& machine, const recording::Recording& inputs);
/// By how much the middle of a rod's first samples is above its room (or below), in K; 0 where neither is known, or
/// where a rest of some hours could have left it.
double start_above_room_K(const Machine& machine, const std::string& component, const recording::Recording& inputs);
/// A rod is clearly not uniform or not as warm as its room, or parts that something else heats are warm already.
bool starts_warm(const Machine& machine, const recording::Recording& inputs);
/// How far apart the first samples of a component's sensors are, in K, beyond what offsets and noise account for; 0
/// where nothing speaks against a uniform start.
double uneven_start_K(const Machine& machine, const std::string& component, const recording::Recording& inputs);
/// Linear between the points, held beyond them.
double profile_at(const Profile& profile, double position_mm);

}  // namespace zerodrift::physics
