#pragma once
// Why a file could not be written, in the words of the person who must change something: it is the folder, mostly.

#include <filesystem>

#include "core/base/error.h"

namespace zerodrift {

/// disk_full, or file_not_writable naming the folder where that is the obstacle. `error_number` is errno.
Error write_failure(const std::filesystem::path& path, int error_number);

}  // namespace zerodrift
