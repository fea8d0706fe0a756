#pragma once
// What recordings of a machine cannot show, whatever is missing: nothing drives it, too few sensors, rows too far
// apart, columns that no recording has.

#include <vector>

#include "core/diagnosis/diagnosis.h"

namespace zerodrift::diagnosis {

/// Of all recordings together.
std::vector<Note> limits_of(const physics::Machine& machine, const std::vector<recording::Recording>& recordings);
/// Sensors of the machine and displacements that no recording has.
std::vector<std::string> columns_lacking(const physics::Machine& machine,
                                         const std::vector<recording::Recording>& recordings);
/// Something drives the machine in one of the recordings, or it cools down from warm, and a channel shows it.
bool is_excited(const physics::Machine& machine, const std::vector<recording::Recording>& recordings);

}  // namespace zerodrift::diagnosis
