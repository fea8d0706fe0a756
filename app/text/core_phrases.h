#pragma once
// The phrases of core, by the rooms they come from. A test holds them against core's sources.

#include <span>

namespace zerodrift {

std::span<const char* const> phrases_of_measuring();
std::span<const char* const> phrases_of_models();
std::span<const char* const> phrases_of_diagnosis();
std::span<const char* const> phrases_of_machines();
std::span<const char* const> phrases_of_devices();
std::span<const char* const> phrases_of_files();
std::span<const char* const> phrases_of_tables();
/// What the operating system says of files and connections (strerror of the C library).
std::span<const char* const> phrases_of_the_system();

}  // namespace zerodrift
