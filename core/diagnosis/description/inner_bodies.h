#pragma once
// Rods are described as one body. Where the description tells that there are two - bearings that sit inside the
// section: a shaft in its cartridge - or that the steel is thick, the diagnosis fits the rod with its inside
// (physics::InnerBody), so that the difference between surface and inside is neither an effect nor noise.

#include "core/physics/machine.h"

namespace zerodrift::diagnosis {

/// The machine with an inside for every rod that has none and asks for one; starting values from its drawing.
physics::Machine with_inner_bodies(physics::Machine machine);

/// Exchanges heat with a lump: what it is handed is as coarse as that.
bool touches_lump(const physics::Machine& machine, const std::string& component);
/// Does any source only have a shape?
bool has_unknown_heat(const physics::Machine& machine);

}  // namespace zerodrift::diagnosis
