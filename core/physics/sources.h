#pragma once
// The laws of the listed heat sources. Parameter 0 of each law is the scale of the whole source.

#include <vector>

#include "core/physics/builder.h"

namespace zerodrift::physics {

/// rated (1 - efficiency) n / rated speed, less the jacket's U (T - T_coolant).
Law motor_law(const HeatSource& source, int speed_input);
double jacket_conductance_W_K(const CoolingJacket& jacket);
/// Palmgren, with the modifiers' parameters following the scale in their order.
Law bearing_law(const HeatSource& source, int speed_input, double full_speed_rpm,
                const std::vector<BearingModifier>& modifiers);
Law input_law(double watts_per_unit, int input);
/// friction * |feed|
Law friction_law(double friction_N, int feed_input);
/// Terms "on", "n", "n2" of a speed, each with its own heat at full speed as parameter.
Law speed_law(const std::vector<std::string>& law, int speed_input, double full_speed_rpm);
/// One term of it: 1, n/full or (n/full)^2 while the spindle turns.
double speed_term(const std::string& term, double speed_rpm, double full_speed_rpm);

}  // namespace zerodrift::physics
