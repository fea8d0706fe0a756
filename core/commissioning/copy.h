#pragma once
// A copy of a job to give away.

#include <filesystem>

#include "core/base/result.h"

namespace zerodrift::commissioning {

/// The job as it is on the disk now, with passwords replaced (core/base/redact.h); a job that is open may be copied.
/// Returns how many texts held one; their check sums no longer fit, which check() of the copy will say. A file that is
/// there is replaced.
Result<int> copy_without_secrets(const std::filesystem::path& job, const std::filesystem::path& copy);

}  // namespace zerodrift::commissioning
